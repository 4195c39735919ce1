-- ---
-- title: Inside the iterations of SRIVC
-- template: lesson
-- ---

-- %% [markdown]
-- srivc needs no start values, and yet it iterates. What does it do? The process
-- is 2/(s^2 + 4 s + 3) again, sampled every 10 ms with much noise.

-- %% id=data
local s = tf("s")
local process = 2/(s^2 + 4*s + 3)
local Ts = 0.01
local u = prbs(4, 100)
local y = lsim(process, u, Ts) + 0.2*randn(#u)
local data = iddata(y, u, Ts)
idplot(data)

-- %% [markdown]
-- Derivatives of a noisy record are useless, so both sides of the equation are
-- filtered first and the filter's own derivatives are used. Least squares on
-- them (lssvf) is quick but biased: the noise sits in the regressors, the more so
-- the more the filter lets through. This one lets much through (10 rad/s): look
-- how far the parameters are from 4, 3 and 2.

-- %% id=least_squares
local first = lssvf(data, {2, 1, 0}, 10)
print(first.param)

-- %% [markdown]
-- SRIVC begins there. It filters with 1/F of its latest model, and multiplies the
-- equations with instruments: noise-free copies of the regressors, simulated by
-- that model. They have nothing to do with the noise, so the bias is gone. The new
-- model gives better filters and instruments; this is repeated until nothing
-- moves. Each row is one iteration: a1, a2, b0.

-- %% id=iterations
local G = srivc(data, {1, 2, 0}, {lambda = 10, Tol = 1e-10})
print(G.report.path)
present(G)

-- %% [markdown]
-- The largest relative change of each iteration, on a logarithmic scale. A
-- straight line downwards: every iteration takes off the same share.

-- %% id=changes
plot(G.report.changes, {xlabel = "iteration", ylabel = "largest relative change", y_log = true, style = "line_points"})

-- %% [markdown]
-- Does the end depend on the beginning? The filter of the first estimate is
-- moved over two decades. Look at a1: it does not.

-- %% id=starts
for _, lambda in ipairs({0.3, 3, 30}) do
  local H = srivc(data, {1, 2, 0}, {lambda = lambda, Tol = 1e-10})
  print(string.format("lambda %4.1f: %2d iterations, a1 = %.9f", lambda, H.report.iterations, H.param[1]))
end

-- %% [markdown]
-- Where nothing moves any more, the simulation error is at its smallest: with white
-- noise no method without bias scatters less. See it happen:
-- dynlab demo monte_carlo.
