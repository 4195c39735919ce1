-- ---
-- title: A real flexible robot arm
-- template: lesson
-- ---

-- %% [markdown]
-- These data are measured. An electric motor excites a flexible arm at many
-- frequencies: u is the torque on the ground, and y is the acceleration of
-- the arm. The sampling time was not published, so the time unit is one sample. The
-- true system is unknown. Estimate models from the first half of the data, and
-- validate them on the second half.

-- %% id=data
local arm = load("robot_arm")
local raw = iddata(arm.y, arm.u, 1)
local first, second = raw:split(0.5)
first, second = first:remove_mean(), second:remove_mean()
idplot(first)

-- %% [markdown]
-- First use least squares with four poles. The fit of the one-step-ahead prediction
-- is 98 %. Now simulate the model from the input only.

-- %% id=least_squares
local A = arx(first, {4, 4, 1})
print(string.format("predicts to %.1f %%, simulates to %.1f %%",
                    A.report.prediction_fit_percent, A.report.fit_percent))

-- %% [markdown]
-- The simulation is useless: with such fast sampling, the last samples are
-- sufficient to predict the next sample. Therefore, minimize the simulation error,
-- with six poles. By default, `srivc` selects the treatment of the initial state.
-- Here, the arm is assumed to be initially at rest.

-- %% id=from_rest
local G0 = srivc(first, {6, 6, 0}, {InitialState = "none", Offset = "none"})
local function fits(H)
    return string.format("first half %.1f %%, second half %.1f %%",
                         H.report.fit_percent, fit(second, H))
end
print(fits(G0))

-- %% [markdown]
-- This model is better. However, the arm was already moving at the first sample,
-- and its lightly damped oscillations decay slowly. Therefore, also estimate the
-- initial state. The figure and its fits are for the first 200 samples of the
-- second half.

-- %% id=in_motion
local G = srivc(first, {6, 6, 0}, {InitialState = "estimate", Offset = "none"})
print(fits(G))
compare(second:range(1, 200), G, G0, {labels = {"in motion", "from rest"}})

-- %% [markdown]
-- The three pairs of poles are three resonances, with frequencies in rad per sample
-- and small damping ratios. The wide band shows that the third resonance is
-- uncertain.

-- %% id=resonances
local frequency, damping = damp(G)
print(frequency, damping)
bode(G, logspace(-1.5, 0.45, 400))

-- %% [markdown]
-- The simulation error is independent of the input, but not white. An
-- autoregressive noise model, estimated together with the model of the arm,
-- improves the prediction, but not the simulation.

-- %% id=noise
resid(second, G)
local N = rivc(first, {6, 0, 2, 6, 0}, {InitialState = "estimate", Offset = "none"})
print(fits(N))
print(string.format("predicts the second half to %.1f %%", fit(second, N, {k = 1})))

-- %% [markdown]
-- A simulation fit of 97 % to validation data is more meaningful than a fit of 98 %
-- to estimation data. Both are more meaningful than the fit of the one-step-ahead
-- prediction.
