-- expects: position_model: This model was estimated from the validation data
-- expects: angle_model: The sign is wrong
-- expects: crane_follows: On a data set that you have not seen
-- expects: discarded: You discarded more than necessary
-- The position is estimated from the validation data, the angle has the wrong sign, and nearly all of limits is discarded.
local c = load("crane")
local start = {InitialState = "none", Offset = "none"}
local v = c.validation
local function voltage_to(y, r) return detrend(iddata(y, r.u, 0.02), "start", {samples = 50}) end
local both = matrix{v.x, v.theta}
local known = detrend(iddata(both, 0.02*(cumsum(v.u) - v.u), 0.02, {InterSample = "foh"}), "start", {samples = 50})
local p = tfsrivc(known, 3, 2, {TdMax = 0, CommonDenominator = true, InitialState = "none", Offset = "none"}).param
local Gx = tf({p[4], p[5], p[6]}, {1, p[1], p[2], p[3], 0})
local Gt = tfsrivc(voltage_to(-c.estimation.theta, c.estimation), 3, 1, {TdMax = 0, InitialState = "none", Offset = "none"})
answer("G_position", Gx)
answer("G_angle", Gt)
answer("fits", vector{fit(voltage_to(v.x, v), Gx, start), fit(voltage_to(v.theta, v), Gt, start)})
answer("rest_angle", mean(c.estimation.theta:range(1, 50)))
answer("discarded", vector{5, 30})
local s = c.free_swing
local swing, upward = s.theta - mean(s.theta), {}
for k = 2, #swing do
    if swing[k - 1] < 0 and swing[k] >= 0 and s.t[k] > (upward[#upward] or -1) + 0.6 then upward[#upward + 1] = s.t[k] end
end
answer("free_swing", 2*math.pi*(#upward - 1)/(upward[#upward] - upward[1]))
report.figure("raw", plot(v.t, v.x), "Position")
report.figure("validation", compare(voltage_to(v.x, v), Gx), "Position")
