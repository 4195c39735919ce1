-- The recommended model uses the known controller, and a recursive estimator of dynlab tracks the heater.
local experiment, T = load("drive").tracking, 0.01
local loop = iddata(experiment.y, experiment.u, T, {Reference = experiment.r})
local z = tf("z", T)
local controller = (0.12 + 0.6*T*z/(z - 1))/z
answer("G_direct", srivc(loop, {1, 2, 0}))
local speed = svf(experiment.y, 2, 10, {Ts = T, hold = "foh"})
local voltage = svf(experiment.u, 2, 10, {Ts = T, hold = "zoh"})
local wish = svf(experiment.r, 4, 10, {Ts = T, hold = "zoh"})
local Zt = matrix{wish:col(3), wish:col(4), wish:col(5)}:t()
answer("own_instruments", solve(Zt*matrix{-speed:col(2), -speed:col(3), voltage:col(3)}, Zt*speed:col(1)))
local first = srivc(iddata(experiment.u, experiment.r, T), {4, 3, 1})
answer("G_two_stage", srivc(iddata(experiment.y, lsim(first, experiment.r, T), T), {1, 2, 0}))
answer("G_final", clsrivc(loop, {1, 2, 0}, {controller = controller}))
local water = load("drifting_process")
local followed = rivsvf(iddata(water.y, water.u, 1), {1, 1, 0}, 0.05, {forgetting = 0.99, HistoryPoints = #water.t})
local theta = followed.history.theta
local function at(k) return vector{theta[{k, 2}]/theta[{k, 1}], 1/theta[{k, 1}]} end
answer("before_cleaning", at(2601))
answer("after_cleaning", at(4501))
report.figure("correlation", plot(experiment.t, experiment.r), "Reference")
report.figure("tracking", plot(water.t, theta:col(1)), "The coefficient a")
