-- ---
-- title: From data to a model that you can trust
-- template: lesson
-- ---

-- %% [markdown]
-- A differential equation describes a process, and a sensor measures samples of it.
-- Here a known process replaces the unknown one, so that we can check the
-- result: y'' + 4 y' + 3 y = 2 u.

-- %% id=process
local s = tf("s")
local process = 2/(s^2 + 4*s + 3)
print(process)

-- %% [markdown]
-- The input switches between -1 and 1 at random (a pseudo-random binary signal): it
-- excites slow and fast motion. The sensor adds noise. Look at the figure: can you
-- see the output follow the input?

-- %% id=data
local Ts = 0.05
local u = prbs(7, 8)
local y = lsim(process, u, Ts) + 0.02*randn(#u)
local data = iddata(y, u, Ts)
print(data)
idplot(data)

-- %% [markdown]
-- The first two thirds serve to estimate a model, and the rest to test it. The
-- method srivc needs only the structure: 1 coefficient of the numerator, 2 poles, 0
-- samples of delay. Look at the parameters: the true ones are 4, 3 and 2. Each
-- estimate should be within two or three standard errors.

-- %% id=estimate
local estimation, validation = data:split(0.66)
local G = srivc(estimation, {1, 2, 0})
present(G)

-- %% [markdown]
-- Does the model describe new data? It is simulated with the input of the
-- validation data, without the output. The fit stays below 100 % because noise
-- cannot be predicted. The two curves should be close together.

-- %% id=compare
compare(validation, G)
print(string.format("fit on new data: %.1f %%", fit(validation, G)))

-- %% [markdown]
-- The residuals must look like noise: not predictable from their past (white), and
-- not from the input. The bars in the figure should stay inside the shaded bounds.
-- By chance, one in a hundred is outside.

-- %% id=residuals
resid(validation, G)

-- %% [markdown]
-- Data, a structure, an estimate with its uncertainty, a test on new data, a look
-- at the residuals: these five steps are the whole workflow. Next: dynlab demo
-- order_selection shows how to find a structure.
