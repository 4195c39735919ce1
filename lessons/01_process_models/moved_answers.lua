-- How a test changes the answers of the reference solution before grading. `move[name]` is a function of an answer, the sign
-- `e` and `inside`, which specifies whether the answer must stay within the tolerance of checks.lua or exceed it.
-- `scaled(near, far)` and `shifted(near, far)` use the first amount inside the tolerance and the second amount outside.
move.settling_time = scaled(0.05, 0.25)
move.exchanger_reading = scaled(vector{0.01, 0.05}, vector{0.08, 0.3})
move.G_exchanger = scaled(0.01, 0.06)
move.overshoot = scaled(0.03, 0.15)
move.suspension_reading = scaled(vector{0.01, 0.04, 0.02}, vector{0.1, 0.3, 0.15})
move.G_suspension = scaled(0.004, 0.05)
