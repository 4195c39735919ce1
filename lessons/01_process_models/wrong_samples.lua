-- expects: settling_time: counted in samples
-- expects: exchanger_reading: counted in samples
-- expects: exchanger_model: counted in samples
-- expects: exchanger_follows: On a data set that you have not seen
-- The data of the heat exchanger are used as if they had one sample per second.
local h, s = load("heat_exchanger"), load("suspension")
local heat = iddata(h.y, h.u, 1)
local spring = iddata(s.y, s.u, s.t[2] - s.t[1])
local K_T, K_z_w = step_first_order(heat), step_second_order(spring)
report.figure("exchanger_test", test_your_model(K_T, heat), "Heat exchanger")
report.figure("suspension_test", test_your_model(K_z_w, spring), "Suspension")
answer("settling_time", 3*K_T.T)
answer("exchanger_reading", vector{K_T.K, K_T.T})
answer("G_exchanger", procsrivc(heat, "P1", {InitialState = "estimate", Offset = "estimate"}))
answer("overshoot", max(s.y)/mean(s.y:range(300, #s.y)) - 1)
answer("suspension_reading", vector{K_z_w.K, K_z_w.z, K_z_w.w0})
answer("G_suspension", procsrivc(spring, "P2U"))
