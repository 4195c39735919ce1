-- ---
-- title: The same experiment two hundred times
-- template: lesson
-- ---

-- %% [markdown]
-- One data set gives one estimate. Would other data, with other noise, give the
-- same? In simulation, you can repeat the experiment as often as you like. Here
-- three methods get the same 200 noisy data sets of y'' + 4 y' + 3 y = 2 u.

-- %% id=study
local s = tf("s")
local study = montecarlo{
  system = 2/(s^2 + 4*s + 3), input = prbs(4, 100), Ts = 0.01, sigma = 0.2, runs = 200,
  estimators = {lssvf = {{2, 1, 0}, 3}, ivsvf = {{2, 1, 0}, 3}, srivc = {{1, 2, 0}}}}

-- %% [markdown]
-- The mean compared with the truth shows the bias. Least squares (lssvf) is wrong
-- on average, for any number of data sets. Instruments (ivsvf, srivc) remove the
-- bias.

-- %% id=table
print(study)

-- %% [markdown]
-- The same as a figure: each histogram should be centered on the line.

-- %% id=histograms
study:histograms()

-- %% [markdown]
-- The scatter has a lower bound, found by Cramér and Rao: no unbiased method can
-- have less scatter (lssvf has less, around the wrong point). The ellipse contains
-- 95 % of the estimates of a method that reaches the bound. It is tilted: if a1 is
-- too large, so is b0.

-- %% id=scatter
study:scatter("a1", "b0")

-- %% [markdown]
-- In practice there is only one data set, and the method must compute the standard
-- error from it. Is it right? For srivc: the true scatter, the bound, and the mean
-- of the standard errors of the 200 estimates.

-- %% id=honest
print("scatter ", study.srivc.std)
print("bound   ", study.srivc.cramer_rao_std)
print("reported", study.srivc.reported_std)

-- %% [markdown]
-- The standard error of one estimate agrees with 200 repetitions of the experiment.
