-- ---
-- title: From data to a model that you can trust
-- template: lesson
-- ---

-- %% [markdown]
-- A differential equation describes a process, and a sensor measures samples of the
-- output. In this demo, the process is known, so you can check the result: y'' + 4
-- y' + 3 y = 2 u.

-- %% id=process
local s = tf("s")
local process = 2/(s^2 + 4*s + 3)
print(process)

-- %% [markdown]
-- The input switches between -1 and 1 at random (a pseudo-random binary signal): it
-- excites slow and fast motion. The sensor adds noise. In the figure, the output
-- follows the input.

-- %% id=data
local Ts = 0.05
local u = prbs(7, 8)
local y = lsim(process, u, Ts) + 0.02*randn(#u)
local data = iddata(y, u, Ts)
print(data)
idplot(data)

-- %% [markdown]
-- Use the first two thirds of the data for estimation, and the last third for
-- validation. srivc needs only the structure: 1 numerator coefficient, 2 poles, 0
-- samples of delay. Compare the estimates with the true parameters 4, 3 and 2. The
-- error of each estimate should be below three standard errors.

-- %% id=estimate
local estimation, validation = data:split(0.66)
local G = srivc(estimation, {1, 2, 0})
present(G)

-- %% [markdown]
-- Does the model describe new data? compare simulates the model with the input of
-- the validation data. The fit is below 100 % because a model cannot predict the
-- noise. The two curves should be close together.

-- %% id=compare
compare(validation, G)
print(string.format("fit on new data: %.1f %%", fit(validation, G)))

-- %% [markdown]
-- The residuals of a good model are white and independent of the input. The bars in
-- the figure should be within the shaded bounds. By chance, one bar in a hundred is
-- outside.

-- %% id=residuals
resid(validation, G)

-- %% [markdown]
-- The workflow has five steps: data, structure, estimation, validation on new data,
-- and residual analysis. To learn how to select a structure, run dynlab demo
-- order_selection.
