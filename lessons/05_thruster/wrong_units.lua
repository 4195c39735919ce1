-- expects: ring_frequency: in rad/s
-- expects: dead_band: The neutral width is not subtracted
-- expects: delay: in ms
-- expects: model: The neutral width is not subtracted
-- expects: fit: the largest allowed error
-- expects: statics_follow: On a data set that you have not seen
-- expects: model_follows: On a data set that you have not seen
-- The frequency is in rad/s, the delay in milliseconds, and the pulse widths are not measured from neutral.
local T = load("thruster")
local Ts = 0.002
local function force(name) return T[name].force - mean(T[name].force:range(1, 250)) end
local all = {}
for k, name in ipairs{"sine_100", "sine_200", "sine_300"} do all[k] = iddata(force(name), T[name].pwm - 1500, Ts) end
local H = hammerstein(merge(table.unpack(all)), 1, 0,
                      {Breakpoints = {-300, -200, -100, -25, 25, 100, 200, 300}, TdMax = 0.08, NumTd = 10})
local points, levels = H.report.breakpoints, H.report.levels
local function response(name) return lsim(H, interp1(points, levels, T[name].pwm - 1500, {outside = "hold"}), Ts) end
local function smooth(v) return idfilt(v, {0, 16*math.pi}, {zero_phase = true, Ts = Ts}) end
local e, d = {}, {}
for k, name in ipairs{"square_100", "square_200", "square_300"} do
    local y = smooth(force(name))
    e[k], d[k] = y - smooth(response(name)), y - mean(y)
end
local _, S = etfe(iddata(force("square_300"), T.square_300.pwm - 1500, Ts), {smooth = 8})
local w, top = 0, 0
for k = 1, #S.w do
    if S.w[k] > 50 and S.w[k] < 250 and S.magnitude[k] > top then w, top = S.w[k], S.magnitude[k] end
end
answer("ring_frequency", w)
answer("dead_band", vector{1525, 1475})
answer("delay", 1000*H.IODelay)
answer("thrust_300", interp1(points, levels, vector{300, -300}))
answer("model", {width = points + 1500, level = levels, G = H, root = false})
answer("fit", 100*(1 - norm(vector(e))/norm(vector(d))))
report.figure("curve", plot(points, levels), "Static curve")
report.figure("validation", plot(T.square_300.t, force("square_300"), T.square_300.t, response("square_300")), "Square chirp")
