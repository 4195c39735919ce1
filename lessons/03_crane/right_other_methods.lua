-- Separate estimates of the outputs, the integrator with the option Integration, and the free swing from all zero crossings.
local c = load("crane")
local still = {InitialState = "none", Offset = "none"}
local function off(r, y) return iddata(y - mean(y:range(1, 50)), r.u, 0.02) end
local e, v, l = c.estimation, c.validation, c.limits
local Gx = tfsrivc(off(e, e.x), 3, 2, {TdMax = 0, Integration = true})
local Gt = tfcoe(off(e, e.theta), 3, 1, {TdMax = 0, InitialState = "none", Offset = "none"})
answer("G_position", Gx)
answer("G_angle", Gt)
answer("fits", vector{fit(off(v, v.x), Gx, still), fit(off(v, v.theta), Gt, still)})
answer("rest_angle", sum(c.steps.theta:range(1, 50))/50)
local from, to
for k = 1, #l.t do
    if math.abs(l.u[k]) > 4 then from, to = from or l.t[k], l.t[k] end
    if math.abs(l.x[k]) > 0.49 then to = l.t[k] end
end
answer("discarded", vector{from - 0.1, to + 1})
local s = c.free_swing
local swing = idfilt(s.theta - mean(s.theta), {2, 10}, {zero_phase = true, Ts = 0.02})
local zeros_at = {}
for k = 101, #swing - 100 do
    if swing[k - 1]*swing[k] < 0 then zeros_at[#zeros_at + 1] = s.t[k] - 0.02*swing[k]/(swing[k] - swing[k - 1]) end
end
answer("free_swing", math.pi*(#zeros_at - 1)/(zeros_at[#zeros_at] - zeros_at[1]))
report.figure("raw", plot(e.t, e.theta), "Angle")
report.figure("validation", compare(off(v, v.theta), Gt), "Angle of the validation record")
