-- expects: linear_model: arx estimates a difference equation
-- expects: linear_fit: This is the fit of the one-step-ahead prediction
-- expects: linear_follows: predicts well, but simulates poorly
-- expects: dryer_fit: No linear model simulates the second half so well
-- ARX models, assessed by their one-step-ahead prediction.
local L = load("linear_system")
local one, two = iddata(L.y, L.u, 0.05), iddata(L.y_val, L.u_val, 0.05)
local G = arx(one, {3, 3, 1})
answer("linear_orders", vector{3, 1})
answer("G_linear", G)
answer("linear_fit", G.report.prediction_fit_percent)
report.figure("linear_resid", resid(two, G), "Residuals")

local H = load("heat_transfer")
local function prepared(y, u) return idfilt(detrend(iddata(y, 100*(u/10)^2, 1), "start"), {0.015, math.huge}, {order = 2}) end
local plant = procsrivc(prepared(H.y, H.u), "P2D", {TdMax = 20, InitialState = "none", Offset = "none"})
answer("G_heat", plant)
report.figure("heat_high", test_your_model(plant, prepared(H.y_high, H.u_high)), "About 7 V")

local d = load("hairdryer")
local learn, check = iddata(d.y, d.u, d.Ts):split(0.5)
local dryer = arx(learn:remove_mean(), {2, 2, 3})
answer("G_dryer", dryer)
answer("dryer_fit", dryer.report.prediction_fit_percent)
report.figure("dryer_compare", compare(check:remove_mean(), dryer), "Second half")
