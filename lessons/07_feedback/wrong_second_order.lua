-- expects: own_instruments: You used a second-order filter for the reference, whose second derivative jumps
-- A second-order filter is used for the reference.
local track, step = load("drive").tracking, 0.01
local seen = iddata(track.y, track.u, step, {Reference = track.r})
answer("G_direct", srivc(seen, {1, 2, 0}))
local Y2, U2, R2 = svf(track.y, 2, 10, {Ts = step, hold = "foh"}), svf(track.u, 2, 10, {Ts = step, hold = "zoh"}), svf(track.r, 2, 10, {Ts = step, hold = "zoh"})
answer("own_instruments", solve(R2:t()*matrix{-Y2:col(2), -Y2:col(3), U2:col(3)}, R2:t()*Y2:col(1)))
answer("G_two_stage", clsrivc(seen, {1, 2, 0}, {route = "two-stage"}))
answer("G_final", clivsvf(seen, {2, 1, 0}, 10))
local drift = load("drifting_process")
local hot = iddata(drift.y, drift.u, 1)
local function piece(middle)
    local M = srivc(hot[{middle - 250, middle + 250}], {1, 1, 0}, {InitialState = "estimate", Offset = "none"})
    return vector{dcgain(M), 1/M.den[2]}
end
answer("before_cleaning", piece(2600))
answer("after_cleaning", piece(4500))
report.figure("correlation", plot(track.t, track.y), "Speed")
report.figure("tracking", plot(drift.t, drift.u), "Power")
