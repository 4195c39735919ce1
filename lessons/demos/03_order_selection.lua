-- ---
-- title: How many poles, how many zeros?
-- template: lesson
-- ---

-- %% [markdown]
-- With more parameters, a model always follows its estimation data better, in the
-- end even the noise. So how many are right? Here the truth has 3 poles and 1 zero.
-- Let us see whether the data show this. A second data set with new noise will
-- help.

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
-- The program estimates and assesses every structure. Look at the fit to the second
-- data set (val.): it rises, then stays constant. Also look at the last column: a
-- parameter is undetermined if its standard error is larger than its value. The
-- star marks the structure that selcstruc recommends, with the reason.

-- %% id=select
local candidates = srivcstruc(data, {poles = {1, 3}, zeros = {0, 2}, validate = second})
local G = selcstruc(candidates)

-- %% [markdown]
-- What would the fit alone have chosen? The largest model, as always.

-- %% id=fit_alone
selcstruc(candidates, "fit")

-- %% [markdown]
-- The recommended model. The true parameters are 1.8, 4.8, 4, 1 and 2.

-- %% id=model
present(G)
compare(second, G)

-- %% [markdown]
-- Prefer the smallest model that validation data cannot distinguish from larger
-- ones. No criterion replaces a look at the residuals: try resid(second, G).
