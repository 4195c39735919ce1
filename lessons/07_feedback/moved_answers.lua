-- How a test changes the answers of the reference solution before grading. `move[name]` is a function of an answer, the sign
-- `e` and `inside`, which specifies whether the answer must stay within the tolerance of checks.lua or exceed it.
-- `scaled(near, far)` and `shifted(near, far)` use the first amount inside the tolerance and the second amount outside.
local record = load("drive").tracking
-- Estimates a model from other data, because a model typed in by hand is not an estimate.
local function estimated(method, near, far)
    return function()
        local factor = 1 + e*(inside and near or far)
        return method(record.y*factor)
    end
end
move.G_direct = estimated(function(y) return srivc(iddata(y, record.u, 0.01), {1, 2, 0}, {InitialState = "none", Offset = "none"}) end, 1e-3, 0.05)
move.own_instruments = scaled(1e-3, 0.2)
local function through_reference(y)
    local S = srivc(iddata(record.u, record.r, 0.01), {4, 3, 1}, {InitialState = "none", Offset = "none"})
    return srivc(iddata(y, lsim(S, record.r, 0.01), 0.01), {1, 2, 0}, {InitialState = "none", Offset = "none"})
end
move.G_two_stage = estimated(through_reference, 1e-3, 0.8)
move.G_final = estimated(through_reference, 1e-3, 0.8)
move.before_cleaning = scaled(0.02, 0.6)
move.after_cleaning = scaled(0.02, 0.6)
