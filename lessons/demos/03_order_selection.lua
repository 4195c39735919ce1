-- ---
-- title: How many poles, how many zeros?
-- template: lesson
-- ---

-- %% [markdown]
-- With more parameters, a model always fits its estimation data better, and
-- eventually fits even the noise. How many parameters are appropriate? In this
-- demo, the true system has 3 poles and 1 zero. A second data set with new noise is
-- used for validation.

-- %% id=data
local s = tf("s")
local process = (s + 2)/((s^2 + 0.8*s + 4)*(s + 1))
local Ts = 0.05
local u = prbs(7, 8)
local x = lsim(process, u, Ts)
local data = iddata(x + 0.1*randn(#u), u, Ts)
local second = iddata(x + 0.1*randn(#u), u, Ts)
idplot(data)

-- %% [markdown]
-- `srivcstruc` estimates and assesses every structure. The fit to the second data set
-- (val.) increases, then remains constant. The last column lists undetermined
-- parameters, whose standard error is larger than their absolute value. The star
-- marks the structure that selcstruc recommends, with the reason.

-- %% id=select
local candidates = srivcstruc(data, {poles = {1, 3}, zeros = {0, 2}, validate = second})
local G = selcstruc(candidates)

-- %% [markdown]
-- The fit to the estimation data alone selects the largest model.

-- %% id=fit_alone
selcstruc(candidates, "fit")

-- %% [markdown]
-- These are the parameters of the recommended model. The true parameters are 1.8,
-- 4.8, 4, 1 and 2.

-- %% id=model
present(G)
compare(second, G)

-- %% [markdown]
-- Choose the smallest model that validation data cannot distinguish from larger
-- models. Also inspect the residuals: resid(second, G).
