-- How a test moves the answers of the worked solution on their way out: `move[name]` is a function of an answer, `e` the
-- sign, and `inside` whether the answer must stay within what checks.lua allows or leave it; `scaled(near, far)` and
-- `shifted(near, far)` do either by the first inside and by the second outside.
move.crane = scaled(0.003, 0.1)
move.crane_fit = function(fit) return fit + (inside and 0.3*e or -4) end
move.tanks = scaled(0.01, 0.5)
move.free_run = function(errors) return inside and errors*(1 + 0.005*e) or vector{errors[1], errors[2], errors[3]*(e > 0 and 6 or 0.02)} end
move.simulated = function(y) return inside and y + 0.005*e or y*(1 + 0.2*e) end
