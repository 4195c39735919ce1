-- expects: exchanger_follows: The model does not change with the data
-- expects: suspension_follows: The model does not change with the data
-- Correct models, copied from another group.
local h, s = load("heat_exchanger"), load("suspension")
local G1, G2 = tf({0.5015}, {76.24, 1}), tf({1666.7}, {1, 5, 166.67})
report.figure("exchanger_test", test_your_model(G1, iddata(h.y, h.u, 2)), "Heat exchanger")
report.figure("suspension_test", test_your_model(G2, iddata(s.y, s.u, 0.01)), "Suspension")
answer("settling_time", 229)
answer("exchanger_reading", vector{0.5, 76})
answer("G_exchanger", G1)
answer("overshoot", 0.54)
answer("suspension_reading", vector{10, 0.19, 12.9})
answer("G_suspension", G2)
