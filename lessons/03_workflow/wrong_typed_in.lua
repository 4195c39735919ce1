-- expects: linear_follows: The model does not change with the data
-- expects: heat_follows: The model does not change with the data
-- Models copied from the lecture instead of estimated.
local L = load("linear_system")
local two = iddata(L.y_val, L.u_val, 0.05)
local G = tf({5.625, 22.5}, {1, 3.05, 11.25, 11.25})
answer("linear_orders", vector{3, 1})
answer("G_linear", G)
answer("linear_fit", fit(two, G))
report.figure("linear_resid", resid(two, G), "Residuals")

local plant = tf({0.667}, {64.6*5.5, 64.6 + 5.5, 1}, {IODelay = 4.1})
answer("G_heat", plant)
local H = load("heat_transfer")
report.figure("heat_high", test_your_model(plant, detrend(iddata(H.y_high, H.u_high^2, 1), "start")), "About 7 V")

local d = load("hairdryer")
local learn, check = iddata(d.y, d.u, d.Ts):split(0.5)
learn, check = learn:remove_mean(), check:remove_mean()
local dryer = srivc(learn, {1, 2, 2})
answer("G_dryer", dryer)
answer("dryer_fit", fit(check, dryer))
report.figure("dryer_compare", compare(check, dryer), "Second half")
