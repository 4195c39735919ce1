-- expects: discarded: counted in samples
-- expects: rest_angle: in degrees
-- expects: free_swing: in Hz
-- expects: swing_follows: On a data set that you have not seen
-- The answers are in samples, degrees and hertz instead of seconds, radians and rad/s.
local c = load("crane")
local from_rest = {InitialState = "none", Offset = "none", TdMax = 0}
local function prepared(r, y, u, between)
    return detrend(iddata(y, u or r.u, 0.02, {InterSample = between or "zoh"}), "start", {samples = 50})
end
local e, v = c.estimation, c.validation
local Gx = tfsrivc(prepared(e, e.x, 0.02*(cumsum(e.u) - e.u), "foh"), 3, 2, from_rest)*tf({1}, {1, 0})
local Gt = tfsrivc(prepared(e, e.theta), 3, 1, from_rest)
report.figure("raw", plot(e.t, e.theta), "Angle")
report.figure("validation", compare(prepared(v, v.theta), Gt), "Angle of the validation record")
answer("G_position", Gx)
answer("G_angle", Gt)
local still = {InitialState = "none", Offset = "none"}
answer("fits", vector{fit(prepared(v, v.x), Gx, still), fit(prepared(v, v.theta), Gt, still)})

local l, from, to = c.limits, nil, nil
for k = 1, #l.t do
    if math.abs(l.u[k]) > 10 or math.abs(l.x[k]) > 0.495 then
        from, to = from or k, k
    end
end
answer("discarded", vector{from, to})
answer("rest_angle", mean(e.theta:range(1, 50))*180/math.pi)

local s = c.free_swing
local a, rises = s.theta - mean(s.theta), {}
for k = 2, #a do
    if a[k - 1] < 0 and a[k] >= 0 and (#rises == 0 or s.t[k] - rises[#rises] > 0.6) then rises[#rises + 1] = s.t[k] end
end
answer("free_swing", (#rises - 1)/(rises[#rises] - rises[1]))
