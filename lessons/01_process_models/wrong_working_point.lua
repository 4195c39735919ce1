-- expects: exchanger_reading: the ratio of two levels
-- expects: exchanger_model: The model treats the operating point as a part of the response
-- expects: exchanger_follows: On a data set that you have not seen
-- The levels before the step are not subtracted from the signals.
local h, s = load("heat_exchanger"), load("suspension")
local heat, spring = iddata(h.y, h.u, h.t[2] - h.t[1]), iddata(s.y, s.u, s.t[2] - s.t[1])
local by_eye, swing = step_first_order(heat), step_second_order(spring)
local last = #h.t
answer("settling_time", 3*by_eye.T)
answer("exchanger_reading", vector{h.y[last]/h.u[last], by_eye.T})
answer("G_exchanger", procsrivc(heat, "P1", {InitialState = "none", Offset = "none"}))
answer("overshoot", math.exp(-math.pi*swing.z/math.sqrt(1 - swing.z^2)))
answer("suspension_reading", vector{swing.K, swing.z, swing.w0})
answer("G_suspension", procsrivc(spring, "P2U"))
report.figure("exchanger_test", test_your_model(by_eye, heat), "Heat exchanger")
report.figure("suspension_test", test_your_model(swing, spring), "Suspension")
