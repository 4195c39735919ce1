-- ---
-- title: Frequency by frequency: the system, its noise, its distortion
-- template: lesson
-- ---

-- %% [markdown]
-- A periodic sum of sines shows more than a random signal: only noise changes from
-- period to period. Here a lightly damped mechanism is followed by a slightly
-- nonlinear sensor: y = x + 0.1 x^3. The sines are at odd lines, and one of every
-- four is missing.

-- %% id=input
local N, Ts = 500, 0.05
local mechanism = tf({4}, {1, 0.8, 4})
local u, grid = multisine(N, {lines = range(1, 70), odd = true, detection = 4})
print(#grid.lines, "lines with a sine,", #grid.detection, "left out")
plot(range(0, Ts, Ts*(N - 1)), u, {xlabel = "time (s)", ylabel = "input"})

-- %% [markdown]
-- There are eight realizations with different phases, and four periods of each. The
-- first two periods are the transient and are omitted. In the figure, the output is
-- far above its noise. At the odd lines without a sine, there is more than noise,
-- and at the even lines there is only noise. The nonlinearity is odd: a cube, not a
-- square.

-- %% id=levels
local records = {}
for m = 1, 8 do
  local v = multisine(N, {lines = range(1, 70), odd = true, detection = 4, periods = 6})
  local x = lsim(mechanism, v, Ts)
  records[m] = iddata(x + 0.1*x^3 + 0.003*randn(#v), v, Ts)
end
local F = bla(merge(table.unpack(records)), {period = N, transient = 2})

-- %% [markdown]
-- A transfer function is fitted to this response, with a weight for the accuracy of
-- every frequency. The poles are those of the mechanism, within a few standard
-- errors. The gain is larger, because on average the cube increases the output: the
-- best linear approximation depends on the amplitude.

-- %% id=fit
local G = coe(F, {1, 2, 0})
present(G)
bode(F, G, mechanism, {labels = {"measured", "fitted", "without the bend"}})

-- %% [markdown]
-- With a quarter of the amplitude, the cube has a sixteenth of its weight, and the
-- gain decreases. A gain that depends on the amplitude is the surest sign of a
-- nonlinearity. No linear model can describe it.

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
-- Periods show the noise, and realizations show the distortion. The remainder is
-- the linear part, with known errors.
