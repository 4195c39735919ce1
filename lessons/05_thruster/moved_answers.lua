-- How a test changes the answers of the reference solution before grading. `move[name]` is a function of an answer, the sign
-- `e` and `inside`, which specifies whether the answer must stay within the tolerance of checks.lua or exceed it.
-- `scaled(near, far)` and `shifted(near, far)` use the first amount inside the tolerance and the second amount outside.
move.ring_frequency = scaled(0.02, 0.2)
move.dead_band = shifted(vector{3, -3}, vector{25, -25})
move.delay = shifted(0.002, 0.02)
move.thrust_300 = scaled(0.03, 0.3)
move.model = function(m)
    return {width = m.width, level = m.level*(1 + e*(inside and 0.01 or 0.6)), G = m.G, root = m.root}
end
move.fit = shifted(0.3, 30)
