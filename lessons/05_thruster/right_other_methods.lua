-- The recommended model is a Hammerstein model. The steady thrust is from the plateaus between switchings, the dead band by
-- eye.
local T, Ts = load("thruster"), 0.002
local function thrust(name) return T[name].force - mean(T[name].force:range(1, 250)) end
local function width(name) return T[name].pwm - 1500 end
local known = {}
for k, size in ipairs{"100", "200", "300"} do known[k] = iddata(thrust("sine_" .. size), width("sine_" .. size), Ts) end
local H = hammerstein(merge(table.unpack(known)), 1, 0,
                      {Breakpoints = {-300, -250, -200, -150, -100, -50, -25, 25, 50, 100, 150, 200, 250, 300}, TdMax = 0.08, NumTd = 10})
local points, levels = H.report.breakpoints, H.report.levels
local function below_8_hz(v) return idfilt(v, {0, 16*math.pi}, {zero_phase = true, Ts = Ts}) end
local error, swing = {}, {}
for k, size in ipairs{"100", "200", "300"} do
    local y = below_8_hz(thrust("square_" .. size))
    local model = lsim(H, interp1(points, levels, width("square_" .. size), {outside = "hold"}), Ts)
    error[k], swing[k] = y - below_8_hz(model), y - mean(y)
end
local F, u = thrust("square_300"), width("square_300")
local total, count = {[1] = 0, [-1] = 0}, {[1] = 0, [-1] = 0}
for k = 400, 4500 do
    if u[k] ~= 0 and u[k] == u[k - 100] and u[k] == u[k - 200] then
        local side = u[k] > 0 and 1 or -1
        total[side], count[side] = total[side] + F[k], count[side] + 1
    end
end
local _, S = etfe(iddata(thrust("square_200"), width("square_200"), Ts), {smooth = 16})
local ring, top = 0, 0
for k = 1, #S.w do
    if S.w[k] > 60 and S.w[k] < 240 and S.magnitude[k] > top then ring, top = S.w[k], S.magnitude[k] end
end
answer("ring_frequency", ring/(2*math.pi))
answer("dead_band", vector{28, -30})
answer("delay", H.IODelay)
answer("thrust_300", vector{total[1]/count[1], total[-1]/count[-1]})
answer("model", {width = points, level = levels, G = H, root = false})
answer("fit", 100*(1 - norm(vector(error))/norm(vector(swing))))
report.figure("curve", plot(points, levels), "Static curve")
report.figure("validation", plot(T.square_300.t, F), "Square chirp")
