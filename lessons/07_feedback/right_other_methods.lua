-- The direct method with a noise model, a first stage with a projection, and segments of the heater data instead of a
-- recursion.
local drive, Ts = load("drive").tracking, 0.01
local data = iddata(drive.y, drive.u, Ts)
answer("G_direct", srivc(data, {1, 2, 0}))
local Yf, Uf = svf(drive.y, 2, 10, {Ts = Ts, hold = "foh"}), svf(drive.u, 2, 10, {Ts = Ts, hold = "zoh"})
local Rf = svf(drive.r, 4, 10, {Ts = Ts, hold = "zoh"})
local instruments = matrix{Rf:col(3), Rf:col(4), Rf:col(5)}:t()
answer("own_instruments", solve(instruments*matrix{-Yf:col(2), -Yf:col(3), Uf:col(3)}, instruments*Yf:col(1)))
answer("G_two_stage", clsrivc(iddata(drive.y, drive.u, Ts, {Reference = drive.r}), {1, 2, 0}, {route = "two-stage"}))
answer("G_final", rivc(data, {1, 2, 2, 2, 0}))
local heater = load("drifting_process")
local slow = iddata(heater.y, heater.u, 1)
local function about(instant)
    local G = srivc(slow[{instant - 300, instant + 300}], {1, 1, 0}, {InitialState = "estimate", Offset = "none"})
    return vector{dcgain(G), 1/G.den[2]}
end
answer("before_cleaning", about(2600))
answer("after_cleaning", about(4500))
report.figure("correlation", plot(drive.t, drive.u), "Voltage")
report.figure("tracking", plot(heater.t, heater.y), "Rise")
