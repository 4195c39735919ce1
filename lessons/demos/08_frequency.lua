-- ---
-- title: Frequency by frequency: the system, its noise, its distortion
-- template: lesson
-- ---

-- %% [markdown]
-- A sum of sines that repeats tells more than a random signal: what changes from
-- period to period is noise, and nothing else can be. Here a lightly damped
-- mechanism is followed by a sensor that bends a little: y = x + 0.1 x^3.
-- The sines stand at odd lines, and one of every four stays out.

-- %% id=input
local N, Ts = 500, 0.05
local mechanism = tf({4}, {1, 0.8, 4})
local u, grid = multisine(N, {lines = range(1, 70), odd = true, detection = 4})
print(#grid.lines, "lines with a sine,", #grid.detection, "left out")
plot(range(0, Ts, Ts*(N - 1)), u, {xlabel = "time (s)", ylabel = "input"})

-- %% [markdown]
-- Eight realisations, each with phases of its own, four periods of each. The
-- first two periods are the way to steady state and are left out. In the figure
-- the output stands far above its noise, but at the odd lines without a sine
-- there is more than noise, and at the even ones there is not. The bend is odd:
-- a cube, no square.

-- %% id=levels
local records = {}
for m = 1, 8 do
  local v = multisine(N, {lines = range(1, 70), odd = true, detection = 4, periods = 6})
  local x = lsim(mechanism, v, Ts)
  records[m] = iddata(x + 0.1*x^3 + 0.003*randn(#v), v, Ts)
end
local F = bla(merge(table.unpack(records)), {period = N, transient = 2})

-- %% [markdown]
-- A transfer function is fitted to this response, every frequency weighted by what
-- is known of it. The poles are the mechanism's, within a few standard errors;
-- the gain is larger, for on average the cube lifts the output, too: the best
-- linear approximation is not the system at rest.

-- %% id=fit
local G = coe(F, {1, 2, 0})
present(G)
bode(F, G, mechanism, {labels = {"measured", "fitted", "without the bend"}})

-- %% [markdown]
-- With a quarter of the amplitude the cube has a sixteenth of its weight: the
-- gain falls back. A gain that depends on the amplitude is the surest sign of a
-- nonlinearity, and no linear model follows it.

-- %% id=small
local small = {}
for m = 1, 8 do
  local v = 0.25*multisine(N, {lines = range(1, 70), odd = true, detection = 4, periods = 6})
  local x = lsim(mechanism, v, Ts)
  small[m] = iddata(x + 0.1*x^3 + 0.003*randn(#v), v, Ts)
end
local Gs = coe(bla(merge(table.unpack(small)), {period = N, transient = 2}), {1, 2, 0})
print(string.format("gain at rest: %.3f, with a quarter of the amplitude %.3f", dcgain(G), dcgain(Gs)))

-- %% [markdown]
-- Periods tell noise, realisations tell distortion, and what remains is the
-- linear part, with errors that are known.
