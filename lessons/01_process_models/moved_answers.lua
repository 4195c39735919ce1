-- How a test moves the answers of the worked solution on their way out: `move[name]` is a function of an answer, `e` the
-- sign, and `inside` whether the answer must stay within what checks.lua allows or leave it; `scaled(near, far)` and
-- `shifted(near, far)` do either by the first inside and by the second outside.
move.settling_time = scaled(0.05, 0.25)
move.exchanger_reading = scaled(vector{0.01, 0.05}, vector{0.08, 0.3})
move.G_exchanger = scaled(0.01, 0.06)
move.overshoot = scaled(0.03, 0.15)
move.suspension_reading = scaled(vector{0.01, 0.04, 0.02}, vector{0.1, 0.3, 0.15})
move.G_suspension = scaled(0.004, 0.05)
