-- Readings by eye, and estimates by other methods: operating points subtracted by hand, transfer functions instead of
-- process models.
local h, s = load("heat_exchanger"), load("suspension")
local quiet = 0
while h.u[quiet + 1] == h.u[1] do quiet = quiet + 1 end
local heat = iddata(h.y - mean(h.y:range(1, quiet)), h.u - h.u[1], h.t[2] - h.t[1])
local spring = iddata(s.y, s.u, s.t[2] - s.t[1])
local G1 = tfsrivc(heat, 1, 0, {TdMax = 0})
local G2 = d2c(oe(spring, {2, 2, 1}))
answer("settling_time", 240)
answer("exchanger_reading", vector{0.505, 80})
answer("G_exchanger", G1)
answer("overshoot", 0.55)
answer("suspension_reading", vector{9.9, 0.187, 12.6})
answer("G_suspension", tfsrivc(spring, 2, 0, {TdMax = 0}))
report.figure("exchanger_test", compare(heat, G1), "Heat exchanger")
report.figure("suspension_test", compare(spring, G2), "Suspension")
