-- How a test changes the answers of the reference solution before grading. `move[name]` is a function of an answer, the sign
-- `e` and `inside`, which specifies whether the answer must stay within the tolerance of checks.lua or exceed it.
-- `scaled(near, far)` and `shifted(near, far)` use the first amount inside the tolerance and the second amount outside.
move.discarded = shifted(vector{-0.05, 0.05}, vector{-6, 6})
move.rest_angle = shifted(5e-4, 5e-3)
move.G_position = scaled(0.003, 0.3)
move.G_angle = function(G)  -- changes the gain and the time scale
    local c = inside and 1 + 0.0005*e or 1 + 0.2*e
    local function stretched(polynomial)
        local all = {}
        for k = 1, #polynomial do all[k] = polynomial[k]*c^(#polynomial - k) end
        return all
    end
    return tf(stretched(G.num), stretched(G.den))*(inside and 1.002 or 1.3)
end
move.fits = shifted(0.3, 5)
move.free_swing = scaled(0.005, 0.06)
