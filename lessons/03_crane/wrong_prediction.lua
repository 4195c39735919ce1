-- expects: angle_model: predicts well, but simulates poorly
-- expects: common_poles: No pair of poles of the angle oscillates
-- expects: fits: No linear model simulates the angle so well
-- expects: crane_follows: predicts the next sample
-- The model of the angle is estimated with arx and assessed by its one-step-ahead prediction.
local c = load("crane")
local function angle_data(r) return detrend(iddata(r.theta, r.u, 0.02), "start", {samples = 50}) end
local function position_data(r) return detrend(iddata(r.x, r.u, 0.02), "start", {samples = 50}) end
local integral = 0.02*(cumsum(c.estimation.u) - c.estimation.u)
local through = detrend(iddata(c.estimation.x, integral, 0.02, {InterSample = "foh"}), "start", {samples = 50})
local Gx = tfsrivc(through, 3, 2, {TdMax = 0, InitialState = "none", Offset = "none"})*tf({1}, {1, 0})
local Gt = arx(angle_data(c.estimation), {3, 3, 1})
answer("G_position", Gx)
answer("G_angle", Gt)
answer("fits", vector{fit(position_data(c.validation), Gx, {InitialState = "none", Offset = "none"}), Gt.report.prediction_fit_percent})
answer("rest_angle", mean(c.estimation.theta:range(1, 50)))
local bad = {}
for k = 1, #c.limits.t do
    local hits = math.abs(c.limits.x[k]) > 0.495 or math.abs(c.limits.u[k]) > 10
    if hits then bad[#bad + 1] = c.limits.t[k] end
end
answer("discarded", vector{bad[1], bad[#bad]})
local s = c.free_swing
local middle = s.theta - mean(s.theta)
local count, begin, finish = -1, nil, nil
for k = 2, #middle do
    if middle[k - 1] < 0 and middle[k] >= 0 and s.t[k] - (finish or -1) > 0.6 then
        count, begin, finish = count + 1, begin or s.t[k], s.t[k]
    end
end
answer("free_swing", 2*math.pi*count/(finish - begin))
report.figure("raw", plot(c.estimation.t, c.estimation.u), "Voltage")
report.figure("validation", compare(position_data(c.validation), Gx), "Position of the validation record")
