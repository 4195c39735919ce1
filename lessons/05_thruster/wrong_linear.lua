-- expects: dead_band: a linear model has no dead band
-- expects: delay: The delay is too short
-- expects: thrust_300: Forward and reverse thrust are equal
-- expects: model: This model is linear
-- expects: statics_follow: On a data set that you have not seen
-- expects: model_follows: On a data set that you have not seen
-- One linear model for all answers.
local T = load("thruster")
local parts, squares = {}, {}
for k, size in ipairs{"100", "200", "300"} do
    local sine, square = T["sine_" .. size], T["square_" .. size]
    parts[k] = iddata(sine.force - mean(sine.force:range(1, 250)), sine.pwm - 1500, 0.002)
    squares[k] = {u = square.pwm - 1500, y = square.force - mean(square.force:range(1, 250))}
end
local G = tfsrivc(merge(table.unpack(parts)), 1, 0, {TdMax = 0.08, NumTd = 10, InitialState = "none", Offset = "none"})
local function slow(v) return idfilt(v, {0, 16*math.pi}, {zero_phase = true, Ts = 0.002}) end
local missed, moved = {}, {}
for k, square in ipairs(squares) do
    local y = slow(square.y)
    missed[k], moved[k] = y - slow(lsim(G, square.u, 0.002)), y - mean(y)
end
local _, spectrum = etfe(iddata(squares[3].y, squares[3].u, 0.002), {smooth = 8})
local highest = 0
for k = 1, #spectrum.w do
    local f = spectrum.w[k]/(2*math.pi)
    if f > 8 and f < 40 and (highest == 0 or spectrum.magnitude[k] > spectrum.magnitude[highest]) then highest = k end
end
answer("ring_frequency", spectrum.w[highest]/(2*math.pi))
answer("dead_band", vector{1, -1})
answer("delay", G.IODelay)
answer("thrust_300", dcgain(G)*vector{300, -300})
answer("model", {width = vector{-300, 0, 300}, level = vector{-300, 0, 300}, G = G, root = false})
answer("fit", 100*(1 - norm(vector(missed))/norm(vector(moved))))
report.figure("curve", plot(vector{-300, 300}, dcgain(G)*vector{-300, 300}), "A straight line")
report.figure("validation", plot(T.square_300.t, squares[3].y), "Square chirp")
