-- expects: delay: the largest allowed error
-- expects: thrust_300: These are the square roots of the thrust
-- expects: model: The field root contradicts the output of this model
-- expects: fit: the fit to the sine chirps
-- expects: statics_follow: On a data set that you have not seen
-- expects: model_follows: On a data set that you have not seen
-- The model describes the root of the thrust, but its output is not squared; the fit is to the estimation data.
local T = load("thruster")
local Ts = 0.002
local function low(v) return idfilt(v, {0, 16*math.pi}, {zero_phase = true, Ts = Ts}) end
local function pushed(name) return low(T[name].force - mean(T[name].force:range(1, 250))) end
local function root(F) return F/sqrt(abs(F) + 1e-9) end
local known = {}
for k, size in ipairs{"100", "200", "300"} do
    local name = "sine_" .. size
    known[k] = iddata(root(pushed(name)), T[name].pwm - 1500, Ts)
end
local options = {Breakpoints = {-300, -200, -100, -25, 25, 100, 200, 300}, TdMax = 0.08, NumTd = 10}
local R = hammerstein(merge(table.unpack(known)), 1, 0, options)
local points, levels = R.report.breakpoints, R.report.levels
local left, all = {}, {}
for k, size in ipairs{"100", "200", "300"} do
    local name = "sine_" .. size
    local y = pushed(name)
    left[k] = y - low(lsim(R, interp1(points, levels, T[name].pwm - 1500, {outside = "hold"}), Ts))
    all[k] = y - mean(y)
end
local r = T.square_300
local _, S = etfe(iddata(r.force - mean(r.force:range(1, 250)), r.pwm - 1500, Ts), {smooth = 8})
local best = 0
for k = 1, #S.w do
    if S.w[k] > 60 and S.w[k] < 240 and (best == 0 or S.magnitude[k] > S.magnitude[best]) then best = k end
end
answer("ring_frequency", S.w[best]/(2*math.pi))
answer("dead_band", vector{points[5], points[4]})
answer("delay", R.IODelay)
answer("thrust_300", interp1(points, levels, vector{300, -300}))
answer("model", {width = points, level = levels, G = R, root = false})
answer("fit", 100*(1 - norm(vector(left))/norm(vector(all))))
report.figure("curve", plot(points, levels), "Static curve")
report.figure("validation", plot(r.t, r.force), "Square chirp")
