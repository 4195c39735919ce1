-- expects: linear_model: This model was estimated from the second data set, which is reserved for validation
-- expects: dryer_model: This model was estimated from the second half, which is reserved for validation
-- The models are estimated from the validation data.
local L = load("linear_system")
local learn = iddata(L.y_val, L.u_val, L.t[2])
local G = srivc(learn, {2, 3, 0})
answer("linear_orders", vector{3, 1})
answer("G_linear", G)
answer("linear_fit", fit(learn, G))
report.figure("linear_resid", resid(learn, G), "Residuals")

local H = load("heat_transfer")
local function prepared(y, u) return idfilt(detrend(iddata(y, u^2, 1), "start"), {0.015, math.huge}, {order = 2}) end
local plant = procsrivc(prepared(H.y, H.u), "P2D", {TdMax = 20, InitialState = "none", Offset = "none"})
answer("G_heat", plant)
report.figure("heat_high", test_your_model(plant, prepared(H.y_high, H.u_high)), "About 7 V")

local d = load("hairdryer")
local _, half = iddata(d.y, d.u, d.Ts):split(0.5)
half = half:remove_mean()
local dryer = srivc(half, {1, 2, 2})
answer("G_dryer", dryer)
answer("dryer_fit", fit(half, dryer))
report.figure("dryer_compare", compare(half, dryer), "The half it knows")
