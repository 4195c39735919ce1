-- How a test moves the answers of the worked solution on their way out: `move[name]` is a function of an answer, `e` the
-- sign, and `inside` whether the answer must stay within what checks.lua allows or leave it; `scaled(near, far)` and
-- `shifted(near, far)` do either by the first inside and by the second outside.
move.linear_orders = shifted(0, 1)
move.G_linear = scaled(0.01, 0.15)
move.linear_fit = shifted(0.1, 4)
move.G_heat = scaled(0.02, 0.2)
move.G_dryer = scaled(0.005, 0.3)
move.dryer_fit = shifted(0.1, 40)
