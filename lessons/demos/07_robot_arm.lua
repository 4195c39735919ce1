-- ---
-- title: A real flexible robot arm
-- template: lesson
-- ---

-- %% [markdown]
-- These data are measured. An electric motor shakes a flexible arm with many
-- frequencies at once: u is the torque on the ground, and y is the acceleration of
-- the arm. The sampling time was not published, so the time unit is one sample. The
-- truth is unknown too: the second half of the data tests the models of the first
-- half.

-- %% id=data
local arm = load("robot_arm")
local raw = iddata(arm.y, arm.u, 1)
local first, second = raw:split(0.5)
first, second = first:remove_mean(), second:remove_mean()
idplot(first)

-- %% [markdown]
-- First use least squares with four poles. It predicts the next sample to 98 %. Now
-- simulate the model from the input alone.

-- %% id=least_squares
local A = arx(first, {4, 4, 1})
print(string.format("predicts to %.1f %%, simulates to %.1f %%",
                    A.report.prediction_fit_percent, A.report.fit_percent))

-- %% [markdown]
-- The simulation is useless: with such fast sampling, the last samples alone
-- predict the next one. Therefore, minimize the simulation error, with six poles.
-- By default, `srivc` chooses the initial state. Here it starts from rest.

-- %% id=from_rest
local G0 = srivc(first, {6, 6, 0}, {InitialState = "none", Offset = "none"})
local function fits(H)
    return string.format("first half %.1f %%, second half %.1f %%",
                         H.report.fit_percent, fit(second, H))
end
print(fits(G0))

-- %% [markdown]
-- This is better, but look at the plot again: the arm was already moving at the
-- first sample, and this model starts from rest. Its lightly damped oscillations
-- last long. Estimate the initial state too. The figure shows the first 200 samples
-- of the second half, and its fits are for these.

-- %% id=in_motion
local G = srivc(first, {6, 6, 0}, {InitialState = "estimate", Offset = "none"})
print(fits(G))
compare(second:range(1, 200), G, G0, {labels = {"in motion", "from rest"}})

-- %% [markdown]
-- Three pairs of poles are three resonances, with their frequencies (rad per
-- sample) and small damping ratios. The wide band shows that the third is
-- uncertain.

-- %% id=resonances
local frequency, damping = damp(G)
print(frequency, damping)
bode(G, logspace(-1.5, 0.45, 400))

-- %% [markdown]
-- And the noise? The error of the simulation is free of the input but not white. An
-- autoregressive noise model, estimated together with the arm, predicts better and
-- does not simulate better.

-- %% id=noise
resid(second, G)
local N = rivc(first, {6, 0, 2, 6, 0}, {InitialState = "estimate", Offset = "none"})
print(fits(N))
print(string.format("predicts the second half to %.1f %%", fit(second, N, {k = 1})))

-- %% [markdown]
-- A fit of 97 % to validation data is worth more than 98 % to estimation data. Both
-- are worth more than the prediction of the next sample.
