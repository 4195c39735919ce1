-- ---
-- title: How many poles, how many zeros?
-- template: lesson
-- ---

-- %% [markdown]
-- With more parameters a model always follows its own record better, in the end
-- even the noise. So how many are right? Here the truth has 3 poles and 1 zero;
-- let us see whether the data say so. A second record with fresh noise will help.

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
-- Every structure is estimated and measured. Look at the fit to the second record
-- (val.): it climbs, then stays where it is. Look at the last column, too: a
-- parameter is undetermined when its standard error is larger than itself. The
-- star marks the structure that selcstruc recommends; it says why.

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
-- Prefer the smallest model that a second record cannot tell from larger ones.
-- No criterion replaces a look at the residuals: try resid(second, G).
