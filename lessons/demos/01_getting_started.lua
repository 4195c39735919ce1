-- ---
-- title: From a record to a model that can be trusted
-- template: lesson
-- ---

-- %% [markdown]
-- A process is described by a differential equation; what is measured are
-- samples. Here a known process plays the part of the unknown one, so that the
-- answer can be judged:  y'' + 4 y' + 3 y = 2 u.

-- %% id=process
local s = tf("s")
local process = 2/(s^2 + 4*s + 3)
print(process)

-- %% [markdown]
-- The input switches between -1 and 1 at random (a pseudo-random binary
-- signal): it excites slow and fast motion alike. The sensor adds noise.
-- Look at the figure: can you see the output follow the input?

-- %% id=data
local Ts = 0.05
local u = prbs(7, 8)
local y = lsim(process, u, Ts) + 0.02*randn(#u)
local data = iddata(y, u, Ts)
print(data)
idplot(data)

-- %% [markdown]
-- The first two thirds are used to estimate a model, the rest to test it. The
-- method srivc wants the structure only: 1 coefficient above, 2 poles below, 0
-- samples of delay. Look at the parameters: the true ones are 4, 3 and 2. Each
-- should lie within two or three of its standard errors.

-- %% id=estimate
local estimation, validation = data:split(0.66)
local G = srivc(estimation, {1, 2, 0})
present(G)

-- %% [markdown]
-- Does the model predict what it has never seen? It is simulated on the input of
-- the validation record, without a look at the output. The fit stays below 100 %
-- because noise cannot be predicted; the two curves should run side by side.

-- %% id=compare
compare(validation, G)
print(string.format("fit on new data: %.1f %%", fit(validation, G)))

-- %% [markdown]
-- What is left over must look like noise: not predictable from its own past
-- (white) and not from the input. The bars in the figure should stay inside the
-- shaded bounds; one in a hundred is outside by chance.

-- %% id=residuals
resid(validation, G)

-- %% [markdown]
-- A record, a structure, an estimate with its uncertainty, a test on new data, a
-- look at the residuals: these five steps are the whole workflow. Next:
-- dynlab demo order_selection shows how a structure is found.
