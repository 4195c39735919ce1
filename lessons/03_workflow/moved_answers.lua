-- How a test changes the answers of the reference solution before grading. `move[name]` is a function of an answer, the sign
-- `e` and `inside`, which specifies whether the answer must stay within the tolerance of checks.lua or exceed it.
-- `scaled(near, far)` and `shifted(near, far)` use the first amount inside the tolerance and the second amount outside.
move.linear_orders = shifted(0, 1)
move.G_linear = scaled(0.01, 0.15)
move.linear_fit = shifted(0.1, 4)
move.G_heat = scaled(0.02, 0.2)
move.G_dryer = scaled(0.005, 0.3)
move.dryer_fit = shifted(0.1, 40)
