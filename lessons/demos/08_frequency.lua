-- ---
-- title: Frequency by frequency: the system, its noise, its distortion
-- template: lesson
-- ---

-- %% [markdown]
-- A periodic multisine provides more information than a random signal, because only
-- the noise changes from period to period. In this demo, a slightly nonlinear
-- sensor, y = x + 0.1 x^3, measures a lightly damped mechanism. The sines are at
-- odd frequency lines, and one of every four lines is omitted.

-- %% id=input
local N, Ts = 500, 0.05
local mechanism = tf({4}, {1, 0.8, 4})
local u, grid = multisine(N, {lines = range(1, 70), odd = true, detection = 4})
print(#grid.lines, "lines with a sine,", #grid.detection, "left out")
plot(range(0, Ts, Ts*(N - 1)), u, {xlabel = "time (s)", ylabel = "input"})

-- %% [markdown]
-- There are eight realizations with different phases and four periods each. The
-- first two periods contain the transient and are omitted. In the figure, the
-- output is far above the noise. The odd lines without a sine contain a distortion
-- above the noise, and the even lines contain only noise. The nonlinearity is
-- therefore odd: a cube, not a square.

-- %% id=levels
local records = {}
for m = 1, 8 do
  local v = multisine(N, {lines = range(1, 70), odd = true, detection = 4, periods = 6})
  local x = lsim(mechanism, v, Ts)
  records[m] = iddata(x + 0.1*x^3 + 0.003*randn(#v), v, Ts)
end
local F = bla(merge(table.unpack(records)), {period = N, transient = 2})

-- %% [markdown]
-- Fit a transfer function to this response, weighted by the accuracy at each
-- frequency. The poles agree with the poles of the mechanism within a few standard
-- errors. The gain is larger, because the cube increases the output on average: the
-- best linear approximation depends on the amplitude.

-- %% id=fit
local G = coe(F, {1, 2, 0})
present(G)
bode(F, G, mechanism, {labels = {"measured", "fitted", "without the bend"}})

-- %% [markdown]
-- With a quarter of the amplitude, the relative effect of the cube is one
-- sixteenth, and the gain decreases. A gain that depends on the amplitude is the
-- clearest sign of a nonlinearity. No linear model can describe this effect.

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
-- The variation over the periods is the noise, and the variation over the
-- realizations also contains the distortion. The average is the best linear
-- approximation, with known standard errors.
