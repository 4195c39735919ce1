-- expects: record: This is the data set without noise
-- expects: final_model: it is a discrete-time model
-- expects: final_is_estimated: the largest allowed error
-- expects: follows_data: The answer is the same for another data set
-- A difference equation is recommended, and no noise is added.
local u, Ts = prbs(4, 100), 0.01
local y = lsim(tf({2}, {1, 4, 3}), u, Ts)
local data = iddata(y, u, Ts)
local filtered, held = svf(y, 2, 3, {Ts = Ts, hold = "foh"}), svf(u, 2, 3, {Ts = Ts, hold = "zoh"})
local theta = solve(matrix{-filtered:col(2), -filtered:col(3), held:col(3)}, filtered:col(1))
answer("own_without_noise", theta)
answer("own", theta)
answer("record", data)
answer("G_lssvf", lssvf(data, {2, 1, 0}, 3))
answer("G_ivsvf", ivsvf(data, {2, 1, 0}, 3))
answer("G_final", arx(data, {2, 1, 1}))
local runs = montecarlo{system = tf({2}, {1, 4, 3}), input = u, Ts = Ts, sigma = 0.2, runs = 200, estimators = {tfsrivc = {2, 0, {TdMax = 0}}}}
answer("scatter", runs.tfsrivc.std)
