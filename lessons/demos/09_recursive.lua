-- ---
-- title: Parameters that drift while the record is taken
-- template: lesson
-- ---

-- %% [markdown]
-- The outflow of a tank silts up: gain and time constant grow. One model for
-- the whole record is then an average of many. Here the plant is known,
-- y' + a(t) y = b(t) u , with  a  falling from 2 to 1 and  b  jumping
-- from 2 to 3 in the middle, so that the answer can be judged.

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
-- One fit for all: its parameters lie between, and it is right nowhere.

-- %% id=constant
local average = srivc(data, {1, 1, 0})
present(average)

-- %% [markdown]
-- `rsrivc` takes the samples one after the other. With  forgetting = 0.99  a
-- sample counts for half after 70 later ones: the estimate follows the plant
-- some 100 samples behind, and its band tells how sure it is.

-- %% id=forgetting
local G = rsrivc(data, {1, 1, 0}, 3, {forgetting = 0.99})
plot_history(G, {truth = {a1 = a, b0 = b}})

-- %% [markdown]
-- Long memory follows slowly and scatters little, short memory the other way
-- round. Which is better depends on how fast the plant changes. An estimate
-- that lags leaves errors that hang together, so the band of 0.999 is no
-- narrower than that of 0.99, and the truth still lies outside now and then.

-- %% id=memory
local quick = rsrivc(data, {1, 1, 0}, 3, {forgetting = 0.95})
local slow = rsrivc(data, {1, 1, 0}, 3, {forgetting = 0.999})
plot_history(slow, {truth = {a1 = a, b0 = b}})
for _, one in ipairs{{"0.95", quick}, {"0.99", G}, {"0.999", slow}} do
  print(one[1], one[2].param, one[2].std)
end

-- %% [markdown]
-- Or the parameters are thought to walk at random, each at its own pace: a
-- Kalman filter. Large steps for  b  catch its jump, small ones for  a  keep
-- it calm.

-- %% id=walk
local walk = rsrivc(data, {1, 1, 0}, 3, {drift = {1e-5, 2e-4}})
plot_history(walk, {truth = {a1 = a, b0 = b}})
