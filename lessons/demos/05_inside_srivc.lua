-- ---
-- title: Inside the iterations of SRIVC
-- template: lesson
-- ---

-- %% [markdown]
-- srivc is an iterative method, but it needs no initial values. This demo shows its
-- iterations. The process is 2/(s^2 + 4 s + 3), sampled every 10 ms with a high
-- noise level.

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
-- equation, and use the derivatives of the filtered signals. Least squares with
-- these signals (lssvf) is fast but biased, because the regressors contain the
-- noise that the filter passes. This filter (10 rad/s) passes a large part of the
-- noise: compare the estimates with the true parameters 4, 3 and 2.

-- %% id=least_squares
local first = lssvf(data, {2, 1, 0}, 10)
print(first.param)

-- %% [markdown]
-- SRIVC begins with this model. In each iteration, it filters the signals with 1/F
-- of the current model. It multiplies the equations by instruments, which are
-- noise-free regressors simulated with this model. The instruments do not depend on
-- the noise, so they remove the bias. SRIVC repeats these steps with the new model
-- until the parameters converge. Each row is one iteration: a1, a2, b0.

-- %% id=iterations
local G = srivc(data, {1, 2, 0}, {lambda = 10, Tol = 1e-10})
print(G.report.path)
present(G)

-- %% [markdown]
-- The figure shows the largest relative change in each iteration on a logarithmic
-- scale. The line is straight, because every iteration reduces the change by the
-- same factor.

-- %% id=changes
plot(G.report.changes, {xlabel = "iteration", ylabel = "largest relative change", y_log = true, style = "line_points"})

-- %% [markdown]
-- Does the result depend on the initial estimate? The filter of the initial
-- estimate varies over two decades, but the estimate of a1 does not change.

-- %% id=starts
for _, lambda in ipairs({0.3, 3, 30}) do
  local H = srivc(data, {1, 2, 0}, {lambda = lambda, Tol = 1e-10})
  print(string.format("lambda %4.1f: %2d iterations, a1 = %.9f", lambda, H.report.iterations, H.param[1]))
end

-- %% [markdown]
-- After convergence, SRIVC minimizes the simulation error. With white noise, no
-- unbiased method has less scatter. To verify this, run dynlab demo monte_carlo.
