-- How a test changes the answers of the reference solution before grading. `move[name]` is a function of an answer, the sign
-- `e` and `inside`, which specifies whether the answer must stay within the tolerance of checks.lua or exceed it.
-- `scaled(near, far)` and `shifted(near, far)` use the first amount inside the tolerance and the second amount outside.
move.crane = scaled(0.003, 0.1)
move.crane_fit = function(fit) return fit + (inside and 0.3*e or -4) end
move.tanks = scaled(0.01, 0.5)
move.free_run = function(errors) return inside and errors*(1 + 0.005*e) or vector{errors[1], errors[2], errors[3]*(e > 0 and 6 or 0.02)} end
move.simulated = function(y) return inside and y + 0.005*e or y*(1 + 0.2*e) end
