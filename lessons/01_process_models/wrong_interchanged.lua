-- expects: exchanger_reading: K is inverted
-- expects: exchanger_model: Input and output are interchanged
-- expects: exchanger_follows: On a data set that you have not seen
-- expects: suspension_model: wrong sign
-- expects: suspension_follows: On a data set that you have not seen
-- The input is the first argument of iddata, where the output belongs. The output of the suspension has the wrong sign.
local h, s = load("heat_exchanger"), load("suspension")
local heat, spring = iddata(h.y, h.u, h.t[2] - h.t[1]), iddata(s.y, s.u, s.t[2] - s.t[1])
local by_eye, swing = step_first_order(heat), step_second_order(spring)
local good = procsrivc(heat, "P1", {InitialState = "estimate", Offset = "estimate"})
answer("settling_time", 3*by_eye.T)
answer("exchanger_reading", vector{(h.u[#h.u] - h.u[1])/(mean(h.y:range(250, #h.y)) - mean(h.y:range(1, 30))), by_eye.T})
answer("G_exchanger", tf({1/good.Kp}, {good.Tp1, 1}))
answer("overshoot", math.exp(-math.pi*swing.z/math.sqrt(1 - swing.z^2)))
answer("suspension_reading", vector{swing.K, swing.z, swing.w0})
answer("G_suspension", procsrivc(iddata(-s.y, s.u, s.t[2] - s.t[1]), "P2U"))
report.figure("exchanger_test", test_your_model(by_eye, heat), "Heat exchanger")
report.figure("suspension_test", test_your_model(swing, spring), "Suspension")
