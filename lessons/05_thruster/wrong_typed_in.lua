-- expects: statics_follow: The results do not change with the data
-- expects: model_follows: The model does not change with the data
-- The values of the data sheet, and a model of another group.
local T = load("thruster")
local curve = {width = vector{-300, -200, -100, -25, 25, 100, 200, 300}, level = vector{-4.553, -3.204, -1.55, 0.028, -0.034, 1.738, 3.533, 5.039}}
local G = tf({15.24}, {1, 15.24}, {IODelay = 0.0394})
local function slow(v) return idfilt(v, {0, 16*math.pi}, {zero_phase = true, Ts = 0.002}) end
local off, whole = {}, {}
for k, name in ipairs{"square_100", "square_200", "square_300"} do
    local r = T[name]
    local s = lsim(G, interp1(curve.width, curve.level, r.pwm - 1500, {outside = "hold"}), 0.002)
    local y = slow(r.force - mean(r.force:range(1, 250)))
    off[k], whole[k] = y - slow(s*abs(s)), y - mean(y)
end
answer("ring_frequency", 18)
answer("dead_band", vector{25, -25})
answer("delay", 0.031)
answer("thrust_300", vector{23.8, -18.8})
answer("model", {width = curve.width, level = curve.level, G = G, root = true})
answer("fit", 100*(1 - norm(vector(off))/norm(vector(whole))))
report.figure("curve", plot(curve.width, curve.level*abs(curve.level)), "Static curve")
report.figure("validation", plot(T.square_300.t, T.square_300.force), "Square chirp")
