-- expects: linear_fit: This is the fit to the data from which the model was estimated
-- expects: heat_model: The input is the fraction of full power
-- expects: heat_follows: far too large
-- expects: dryer_model: The model has no delay
-- expects: dryer_fit: This is the fit to the half from which the model was estimated
-- Fits to the estimation data, a power without unit, and no delay.
local L = load("linear_system")
local one, two = iddata(L.y, L.u, 0.05), iddata(L.y_val, L.u_val, 0.05)
local G = srivc(one, {2, 3, 0})
answer("linear_orders", vector{3, 1})
answer("G_linear", G)
answer("linear_fit", fit(one, G))
report.figure("linear_resid", resid(two, G), "Residuals")

local H = load("heat_transfer")
local function prepared(y, u) return idfilt(detrend(iddata(y, (u/10)^2, 1), "start"), {0.015, math.huge}, {order = 2}) end
local plant = procsrivc(prepared(H.y, H.u), "P2D", {TdMax = 20, InitialState = "none", Offset = "none"})
answer("G_heat", plant)
report.figure("heat_high", test_your_model(plant, prepared(H.y_high, H.u_high)), "About 7 V")

local d = load("hairdryer")
local learn, check = iddata(d.y, d.u, d.Ts):split(0.5)
learn, check = learn:remove_mean(), check:remove_mean()
local dryer = srivc(learn, {1, 1, 0})
answer("G_dryer", dryer)
answer("dryer_fit", fit(learn, dryer))
report.figure("dryer_compare", compare(check, dryer), "Second half")
