-- ---
-- title: Samples taken whenever it suits
-- template: lesson
-- ---

-- %% [markdown]
-- Laboratory analyses, sensors that save their battery, lost packets: the time
-- from one sample to the next need not be constant. Here it is any number
-- between 0.01 s and 0.1 s.

-- %% id=instants
local N = 3000
local t = cumsum(0.01 + 0.09*rand(N))
print(t:range(1, 5))
plot(diff(t):range(1, 100), {xlabel = "sample", ylabel = "time to the next sample (s)", style = "points"})

-- %% [markdown]
-- The coefficients of a difference equation belong to one sampling time, and here
-- there is none. A differential equation does not need one. Truth: y'' + 2.8 y' + 4
-- y = 5 u, the input three sines.

-- %% id=data
local process = tf({5}, {1, 2.8, 4})
local u = sin(0.714*t) + sin(1.428*t) + sin(2.142*t)
local y = lsim(process, u, t, {hold = "foh"}) + 0.05*randn(N)
local data = iddata(y, u, nil, {SamplingInstants = t, InterSample = "foh"})
print(data)
idplot(data:range(1, 500))

-- %% [markdown]
-- The call is the same as for regular data. Look at the parameters: the true ones
-- are 2.8, 4 and 5. The filters use the exact length of every step.

-- %% id=estimate
local G = srivc(data, {1, 2, 0})
present(G)

-- %% [markdown]
-- What if we ignore the instants and use the mean step for all samples? Look at a1
-- and the fit, and at the last line, the only warning: the residuals are no longer
-- white noise.

-- %% id=ignored
local wrong = srivc(iddata(y, u, mean(diff(t)), {InterSample = "foh"}), {1, 2, 0})
present(wrong)

-- %% [markdown]
-- Keep the time stamps. Pass them to the data object. Nothing else changes.
