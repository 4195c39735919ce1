-- ---
-- title: A real flexible robot arm
-- template: lesson
-- ---

-- %% [markdown]
-- This record was measured: a flexible arm on an electric motor is shaken with many
-- frequencies at once; u is the torque on the ground, y the arm's acceleration.
-- Nobody published the sampling time, so time counts samples. Nobody knows the truth
-- either: the second half of the record must judge what is found in the first.

-- %% id=data
local arm = load("robot_arm")
local raw = iddata(arm.y, arm.u, 1)
local first, second = raw:split(0.5)
first, second = first:remove_mean(), second:remove_mean()
idplot(first)

-- %% [markdown]
-- Least squares first, with four poles. The next sample is predicted to 98 %. Now
-- let the model run on the input alone, as it would have to in a simulator.

-- %% id=least_squares
local A = arx(first, {4, 4, 1})
print(string.format("predicts to %.1f %%, simulates to %.1f %%",
                    A.report.prediction_fit_percent, A.report.fit_percent))

-- %% [markdown]
-- It hardly simulates anything: with so fast a sampling the last samples alone tell
-- the next one. So minimise the error of the simulation, with six poles.
-- By default `srivc` chooses how the record begins; here it is told to start from rest.

-- %% id=from_rest
local G0 = srivc(first, {6, 6, 0}, {InitialState = "none", Offset = "none"})
local function fits(H)
    return string.format("first half %.1f %%, second half %.1f %%",
                         H.report.fit_percent, fit(second, H))
end
print(fits(G0))

-- %% [markdown]
-- Better, but look at the plot again: the arm was moving already when the record
-- began, and this model was told that it rested. Its lightly damped swings ring for
-- long. Let the state at the beginning be estimated, too. The figure shows the first
-- 200 samples of the second half; its fits are those of them.

-- %% id=in_motion
local G = srivc(first, {6, 6, 0}, {InitialState = "estimate", Offset = "none"})
print(fits(G))
compare(second:range(1, 200), G, G0, {labels = {"in motion", "from rest"}})

-- %% [markdown]
-- Three pairs of poles, three resonances: their frequencies (rad per sample) and how
-- little they are damped. The band tells that little is known of the third.

-- %% id=resonances
local frequency, damping = damp(G)
print(frequency, damping)
bode(G, logspace(-1.5, 0.45, 400))

-- %% [markdown]
-- And the noise? The error of the simulation is free of the input but not white. An
-- autoregressive model of it, estimated together with the arm, predicts better and
-- simulates no better.

-- %% id=noise
resid(second, G)
local N = rivc(first, {6, 0, 2, 6, 0}, {InitialState = "estimate", Offset = "none"})
print(fits(N))
print(string.format("predicts the second half to %.1f %%", fit(second, N, {k = 1})))

-- %% [markdown]
-- A fit of 97 % on data that were not used is worth more than 98 % on those that were,
-- and both are worth more than the prediction of the next sample.
