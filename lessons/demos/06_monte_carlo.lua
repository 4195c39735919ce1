-- ---
-- title: The same experiment two hundred times
-- template: lesson
-- ---

-- %% [markdown]
-- One record gives one estimate. Would another record, with other noise, give the
-- same? In simulation the experiment can be repeated as often as one likes. Here
-- three methods get the same 200 noisy records of  y'' + 4 y' + 3 y = 2 u.

-- %% id=study
local s = tf("s")
local study = montecarlo{
  system = 2/(s^2 + 4*s + 3), input = prbs(4, 100), Ts = 0.01, sigma = 0.2, runs = 200,
  estimators = {lssvf = {{2, 1, 0}, 3}, ivsvf = {{2, 1, 0}, 3}, srivc = {{1, 2, 0}}}}

-- %% [markdown]
-- The mean against the truth shows the bias. Least squares (lssvf) is wrong on
-- average, however many records there are; instruments (ivsvf, srivc) cure it.

-- %% id=table
print(study)

-- %% [markdown]
-- The same as a picture: each histogram should stand around the line.

-- %% id=histograms
study:histograms()

-- %% [markdown]
-- The scatter has a lower bound, found by Cramér and Rao: no method without bias
-- can scatter less (lssvf does, around the wrong point). The ellipse holds 95 % of
-- the estimates of a method that reaches the bound. A tilted ellipse: when a1 comes
-- out too large, so does b0.

-- %% id=scatter
study:scatter("a1", "b0")

-- %% [markdown]
-- In practice there is one record only, and the standard error must be worked out
-- from it. Is it honest? For srivc: the true scatter, the bound, and the mean of what
-- the 200 estimates said of themselves.

-- %% id=honest
print("scatter ", study.srivc.std)
print("bound   ", study.srivc.cramer_rao_std)
print("reported", study.srivc.reported_std)

-- %% [markdown]
-- A standard error is worth as much as an experiment repeated 200 times.
