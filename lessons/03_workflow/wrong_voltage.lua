-- expects: heat_model: The gain is in °C/V
-- expects: heat_follows: far too large
-- The input of the plant model is the voltage instead of the power.
local L = load("linear_system")
local one, two = iddata(L.y, L.u, 0.05), iddata(L.y_val, L.u_val, 0.05)
local G = srivc(one, {2, 3, 0})
answer("linear_orders", vector{3, 1})
answer("G_linear", G)
answer("linear_fit", fit(two, G))
report.figure("linear_resid", resid(two, G), "Residuals")

local H = load("heat_transfer")
local function prepared(y, u) return idfilt(detrend(iddata(y, u, 1), "start"), {0.015, math.huge}, {order = 2}) end
local plant = procsrivc(prepared(H.y, H.u), "P2D", {TdMax = 20, InitialState = "none", Offset = "none"})
answer("G_heat", plant)
report.figure("heat_high", test_your_model(plant, prepared(H.y_high, H.u_high)), "About 7 V")

local d = load("hairdryer")
local learn, check = iddata(d.y, d.u, d.Ts):split(0.5)
learn, check = learn:remove_mean(), check:remove_mean()
local dryer = tfsrivc(learn, 2, 0, {TdMax = 0.5})
answer("G_dryer", dryer)
answer("dryer_fit", fit(check, dryer))
report.figure("dryer_compare", compare(check, dryer), "Second half")
