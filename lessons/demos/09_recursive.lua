-- ---
-- title: Parameters that drift during the experiment
-- template: lesson
-- ---

-- %% [markdown]
-- The outflow of a tank silts up: gain and time constant grow. One model for all
-- data is then an average of many. Here the plant is known, so that we can check
-- the result: y' + a(t) y = b(t) u , where a falls from 2 to 1, and b jumps from 2
-- to 3 in the middle.

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
-- One fit for all data: its parameters are in between, and it is right nowhere.

-- %% id=constant
local average = srivc(data, {1, 1, 0})
present(average)

-- %% [markdown]
-- `rsrivc` processes one sample at a time. With forgetting = 0.99, the weight of a
-- sample is one half after 70 later ones. The estimate follows the plant about 100
-- samples behind, and the band shows its uncertainty.

-- %% id=forgetting
local G = rsrivc(data, {1, 1, 0}, 3, {forgetting = 0.99})
plot_history(G, {truth = {a1 = a, b0 = b}})

-- %% [markdown]
-- A long memory follows slowly and has little scatter, and a short memory the
-- opposite. Which is better depends on how fast the plant changes. A late estimate
-- has correlated residuals, so the band of 0.999 is not narrower than that of 0.99,
-- and the truth is still outside at times.

-- %% id=memory
local quick = rsrivc(data, {1, 1, 0}, 3, {forgetting = 0.95})
local slow = rsrivc(data, {1, 1, 0}, 3, {forgetting = 0.999})
plot_history(slow, {truth = {a1 = a, b0 = b}})
for _, one in ipairs{{"0.95", quick}, {"0.99", G}, {"0.999", slow}} do
  print(one[1], one[2].param, one[2].std)
end

-- %% [markdown]
-- A Kalman filter assumes a random walk of the parameters, each with its own step
-- size. Large steps for b follow its jump, and small steps for a keep it smooth.

-- %% id=walk
local walk = rsrivc(data, {1, 1, 0}, 3, {drift = {1e-5, 2e-4}})
plot_history(walk, {truth = {a1 = a, b0 = b}})
