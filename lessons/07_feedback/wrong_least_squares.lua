-- expects: direct: This is the model of LSSVF
-- expects: own_instruments: the instruments must not be the regressors
-- expects: two_stage: This is the closed loop
-- The regressors are used as instruments, and the input of the second stage is the reference.
local record = load("drive").tracking
local d = iddata(record.y, record.u, 0.01)
answer("G_direct", lssvf(d, {2, 1, 0}, 10))
local y2, u2 = svf(record.y, 2, 10, {Ts = 0.01, hold = "foh"}), svf(record.u, 2, 10, {Ts = 0.01, hold = "zoh"})
answer("own_instruments", lsq(matrix{-y2:col(2), -y2:col(3), u2:col(3)}, y2:col(1)).theta)
answer("G_two_stage", srivc(iddata(record.y, record.r, 0.01), {1, 2, 0}))
local voltage = lsim(srivc(iddata(record.u, record.r, 0.01), {4, 3, 1}), record.r, 0.01)
answer("G_final", srivc(iddata(record.y, voltage, 0.01), {1, 2, 0}))
local warm = load("drifting_process")
local minutes = iddata(warm.y, warm.u, 1)
local function in_piece(i, j)
    local M = srivc(minutes[{i, j}], {1, 1, 0}, {InitialState = "estimate", Offset = "none"})
    return vector{dcgain(M), 1/M.den[2]}
end
answer("before_cleaning", in_piece(2350, 2850))
answer("after_cleaning", in_piece(4250, 4750))
report.figure("correlation", plot(record.t, record.u), "Voltage")
report.figure("tracking", plot(warm.t, warm.y), "Rise")
