-- ---
-- title: Parameters that drift during the experiment
-- template: lesson
-- ---

-- %% [markdown]
-- The outflow of a tank silts up, so the gain and the time constant grow. One model
-- for all data is then an average over time. In this demo, the plant is known, so
-- you can check the result: y' + a(t) y = b(t) u, where a decreases from 2 to 1,
-- and b jumps from 2 to 3 in the middle.

-- %% id=plant
local Ts, N = 0.05, 4000
local u = prbs(9, 8):range(1, N)
local a = linspace(2, 1, N)
local b = zeros(N) + 2
for k = N//2 + 1, N do b[k] = 3 end
local x = zeros(N)
for k = 1, N - 1 do
  local decay = math.exp(-a[k]*Ts)
  x[k + 1] = decay*x[k] + (1 - decay)/a[k]*b[k]*u[k]
end
local data = iddata(x + 0.1*randn(N), u, Ts)
idplot(data)

-- %% [markdown]
-- The parameters of one model for all data are averages, and the model is never
-- correct.

-- %% id=constant
local average = srivc(data, {1, 1, 0})
present(average)

-- %% [markdown]
-- `rsrivc` processes one sample at a time. With forgetting = 0.99, the weight of a
-- sample is one half after 70 samples. The estimate tracks the plant with a delay
-- of about 100 samples. The band shows its uncertainty.

-- %% id=forgetting
local G = rsrivc(data, {1, 1, 0}, 3, {forgetting = 0.99})
plot_history(G, {truth = {a1 = a, b0 = b}})

-- %% [markdown]
-- With a long memory, the estimate has little scatter, but a long delay. With a
-- short memory, the delay is short, but the scatter is large. The best choice
-- depends on the rate of change of the plant. A delayed estimate has correlated
-- residuals, so the band for 0.999 is not narrower than the band for 0.99. The true
-- value is sometimes outside the band.

-- %% id=memory
local quick = rsrivc(data, {1, 1, 0}, 3, {forgetting = 0.95})
local slow = rsrivc(data, {1, 1, 0}, 3, {forgetting = 0.999})
plot_history(slow, {truth = {a1 = a, b0 = b}})
for _, one in ipairs{{"0.95", quick}, {"0.99", G}, {"0.999", slow}} do
  print(one[1], one[2].param, one[2].std)
end

-- %% [markdown]
-- A Kalman filter assumes a random walk of the parameters, with a separate variance
-- for each parameter. A large variance for b tracks the jump, and a small variance
-- for a keeps the estimate smooth.

-- %% id=walk
local walk = rsrivc(data, {1, 1, 0}, 3, {drift = {1e-5, 2e-4}})
plot_history(walk, {truth = {a1 = a, b0 = b}})
