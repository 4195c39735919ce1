-- expects: position_model: The integrator is missing
-- expects: fits: the largest allowed error
-- expects: crane_follows: On a data set that you have not seen
-- expects: discarded: After the last saturated voltage, the trolley is still at a buffer while voltage is applied
-- The model of the position has no integrator, and only the part with saturated voltage is discarded.
local c = load("crane")
local e, v, l, s = c.estimation, c.validation, c.limits, c.free_swing
local function drive(r) return 0.02*(cumsum(r.u) - r.u) end
local function place(r) return detrend(iddata(r.x, drive(r), 0.02, {InterSample = "foh"}), "start", {samples = 50}) end
local function tilt(r) return detrend(iddata(r.theta, r.u, 0.02), "start", {samples = 50}) end
local calm = {InitialState = "none", Offset = "none"}
local F_x = tfsrivc(place(e), 3, 2, {TdMax = 0, InitialState = "none", Offset = "none"})
local F_t = tfsrivc(tilt(e), 3, 1, {TdMax = 0, InitialState = "none", Offset = "none"})
answer("G_position", F_x)
answer("G_angle", F_t)
answer("fits", vector{fit(place(v), F_x, calm), fit(tilt(v), F_t, calm)})
answer("rest_angle", mean(e.theta:range(1, 50)))
local saturated = {}
for k = 1, #l.t do
    if math.abs(l.u[k]) > 10 then table.insert(saturated, l.t[k]) end
end
answer("discarded", vector{saturated[1], saturated[#saturated]})
local a, rises = s.theta - mean(s.theta), {}
for k = 2, #a do
    local apart = #rises == 0 or s.t[k] - rises[#rises] > 0.6
    if apart and a[k - 1] < 0 and a[k] >= 0 then table.insert(rises, s.t[k]) end
end
answer("free_swing", 2*math.pi*(#rises - 1)/(rises[#rises] - rises[1]))
report.figure("raw", plot(e.t, e.x), "Position")
report.figure("validation", compare(place(v), F_x), "Position of the validation record")
