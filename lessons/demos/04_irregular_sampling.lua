-- ---
-- title: Irregularly sampled data
-- template: lesson
-- ---

-- %% [markdown]
-- With laboratory analyses, battery-powered sensors and lost packets, the time
-- between two samples is not constant. In this demo, it is random between 0.01 s
-- and 0.1 s.

-- %% id=instants
local N = 3000
local t = cumsum(0.01 + 0.09*rand(N))
print(t:range(1, 5))
plot(diff(t):range(1, 100), {xlabel = "sample", ylabel = "time to the next sample (s)", style = "points"})

-- %% [markdown]
-- The coefficients of a difference equation are valid for one constant sampling
-- time. A differential equation does not depend on the sampling time. The true
-- system is y'' + 2.8 y' + 4 y = 5 u, and the input is a sum of three sines.

-- %% id=data
local process = tf({5}, {1, 2.8, 4})
local u = sin(0.714*t) + sin(1.428*t) + sin(2.142*t)
local y = lsim(process, u, t, {hold = "foh"}) + 0.05*randn(N)
local data = iddata(y, u, nil, {SamplingInstants = t, InterSample = "foh"})
print(data)
idplot(data:range(1, 500))

-- %% [markdown]
-- The syntax is the same as for regularly sampled data. Compare the estimates with
-- the true parameters 2.8, 4 and 5. The filters use the exact time between the
-- samples.

-- %% id=estimate
local G = srivc(data, {1, 2, 0})
present(G)

-- %% [markdown]
-- What happens if you ignore the sampling instants and use their mean spacing?
-- Inspect a1 and the fit. The last line contains the only warning: the residuals
-- are not white.

-- %% id=ignored
local wrong = srivc(iddata(y, u, mean(diff(t)), {InterSample = "foh"}), {1, 2, 0})
present(wrong)

-- %% [markdown]
-- Keep the time stamps, and pass them to the data object. No other change is
-- required.
