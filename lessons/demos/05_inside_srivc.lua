-- ---
-- title: Inside the iterations of SRIVC
-- template: lesson
-- ---

-- %% [markdown]
-- srivc needs no initial values, although it iterates. What does it do? The process
-- is again 2/(s^2 + 4 s + 3), sampled every 10 ms with much noise.

-- %% id=data
local s = tf("s")
local process = 2/(s^2 + 4*s + 3)
local Ts = 0.01
local u = prbs(4, 100)
local y = lsim(process, u, Ts) + 0.2*randn(#u)
local data = iddata(y, u, Ts)
idplot(data)

-- %% [markdown]
-- Derivatives of noisy data are useless. Therefore, filter both sides of the
-- equation, and use the derivatives inside the filter. Least squares on them
-- (lssvf) is quick but biased, because the regressors contain the noise that the
-- filter passes. This filter passes much noise (10 rad/s): look how far the
-- parameters are from 4, 3 and 2.

-- %% id=least_squares
local first = lssvf(data, {2, 1, 0}, 10)
print(first.param)

-- %% [markdown]
-- SRIVC begins there. It filters with 1/F of its latest model, and multiplies the
-- equations by instruments: noise-free copies of the regressors, simulated by that
-- model. They do not depend on the noise, so the bias is gone. The new model gives
-- better filters and instruments. SRIVC repeats this until it converges. Each row
-- is one iteration: a1, a2, b0.

-- %% id=iterations
local G = srivc(data, {1, 2, 0}, {lambda = 10, Tol = 1e-10})
print(G.report.path)
present(G)

-- %% [markdown]
-- The largest relative change of each iteration, on a logarithmic scale. The line
-- is straight: every iteration reduces the change by the same factor.

-- %% id=changes
plot(G.report.changes, {xlabel = "iteration", ylabel = "largest relative change", y_log = true, style = "line_points"})

-- %% [markdown]
-- Does the result depend on the start? The filter of the first estimate varies over
-- two decades. Look at a1: it does not.

-- %% id=starts
for _, lambda in ipairs({0.3, 3, 30}) do
  local H = srivc(data, {1, 2, 0}, {lambda = lambda, Tol = 1e-10})
  print(string.format("lambda %4.1f: %2d iterations, a1 = %.9f", lambda, H.report.iterations, H.param[1]))
end

-- %% [markdown]
-- When SRIVC has converged, the simulation error is smallest: with white noise, no
-- unbiased method has less scatter. See for yourself: dynlab demo monte_carlo.
