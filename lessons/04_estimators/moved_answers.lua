-- How a test changes the answers of the reference solution before grading. `move[name]` is a function of an answer, the sign
-- `e` and `inside`, which specifies whether the answer must stay within the tolerance of checks.lua or exceed it.
-- `scaled(near, far)` and `shifted(near, far)` use the first amount inside the tolerance and the second amount outside.
-- untouched: record
local record
local function estimated(method, near, far)  -- estimates a model from other data, because a model typed in by hand is not an estimate
    return function()
        local factor = 1 + e*(inside and near or far)
        return method(iddata(record.y*factor, record.u, record.Ts))
    end
end
move.record = function(data) record = data; return data end
move.own_without_noise, move.own = scaled(4e-4, 0.05), scaled(4e-4, 0.05)
move.G_lssvf = estimated(function(data) return lssvf(data, {2, 1, 0}, 3) end, 4e-4, 0.01)
move.G_ivsvf = estimated(function(data) return ivsvf(data, {2, 1, 0}, 3) end, 4e-4, 0.01)
move.G_final = estimated(function(data) return tfsrivc(data, 2, 0, {TdMax = 0}) end, 0.01, 0.7)
move.scatter = scaled(0.1, 0.7)
