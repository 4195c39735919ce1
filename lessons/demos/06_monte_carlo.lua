-- ---
-- title: The same experiment two hundred times
-- template: lesson
-- ---

-- %% [markdown]
-- One data set results in one estimate. How does the estimate change with different
-- noise? In a simulation, you can repeat the experiment many times. In this demo,
-- three methods use the same 200 noisy data sets of y'' + 4 y' + 3 y = 2 u.

-- %% id=study
local s = tf("s")
local study = montecarlo{
  system = 2/(s^2 + 4*s + 3), input = prbs(4, 100), Ts = 0.01, sigma = 0.2, runs = 200,
  estimators = {lssvf = {{2, 1, 0}, 3}, ivsvf = {{2, 1, 0}, 3}, srivc = {{1, 2, 0}}}}

-- %% [markdown]
-- The difference between the mean and the true value is the bias. Least squares
-- (lssvf) is biased for any number of data sets. Instruments (ivsvf, srivc) remove
-- the bias.

-- %% id=table
print(study)

-- %% [markdown]
-- In the histograms, the estimates of an unbiased method are centered on the line.

-- %% id=histograms
study:histograms()

-- %% [markdown]
-- The Cramér-Rao bound is a lower bound of the scatter of an unbiased method.
-- (lssvf has less scatter, but around a wrong value.) The ellipse contains 95 % of
-- the estimates of a method that reaches the bound. The ellipse is tilted: if a1 is
-- too large, b0 is also too large.

-- %% id=scatter
study:scatter("a1", "b0")

-- %% [markdown]
-- In practice, there is only one data set, and the method must compute the standard
-- error from it. Is this standard error correct? For srivc, compare the scatter,
-- the bound, and the mean of the standard errors of the 200 estimates.

-- %% id=honest
print("scatter ", study.srivc.std)
print("bound   ", study.srivc.cramer_rao_std)
print("reported", study.srivc.reported_std)

-- %% [markdown]
-- The standard error agrees with the scatter over 200 repetitions of the
-- experiment.
