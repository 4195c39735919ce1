-- Gradient descent instead of QR, normal equations instead of lsq, and a study that is vectorized in another way.
local games, four = load("winning_times"), load("step_response")
local n = #games.year - 1
local years, times = games.year:range(1, n), games.time:range(1, n)
local x = years - mean(years)
local scale = sqrt(mean(x^2))
local walked = gradient_descent(matrix{x/scale, ones(n)}, times).theta
local a, b = walked[1]/scale, walked[2]
local e = times - a*x - b
local s2, xp = sum(e^2)/(n - 2), 2024 - mean(years)
local half = 2.0518*math.sqrt(s2*(1 + 1/n + xp^2/sum(x^2)))  -- Student's factor for 27 degrees of freedom
answer("line", vector{a, b})
answer("rmse", norm(e)/math.sqrt(n))
answer("paris", vector{a*xp + b, a*xp + b - half, a*xp + b + half})
report.figure("residuals", plot(years, e), "Residuals")
report.figure("forecast", plot(years, times, years, a*x + b), "Line")

local function normal(Phi, y) return solve(Phi:t()*Phi, Phi:t()*y) end
local function step_on(y, u) return normal(matrix{-y:range(1, #y - 1), u:range(1, #y - 1)}, y:range(2, #y)) end
local plant = normal(matrix{-four.y, four.u}, four.ydot)
local sampled = step_on(four.y, four.u)
answer("ct", plant)
answer("dt", sampled)
answer("ct_noisy", normal(matrix{-four.y_noisy, four.u}, four.ydot_noisy))
answer("dt_noisy", step_on(four.y_noisy, four.u))
local u = prbs(7, 4):range(1, 400)
local x0 = lsim(c2d(tf({plant[2]}, {1, plant[1]}), 0.5), u, 0.5)
local found = {}
for run = 1, 500 do found[run] = step_on(x0 + 0.3*randn(400), u)[1] end
answer("monte_carlo", vector{mean(vector(found)), std(vector(found))})
report.figure("monte_carlo", histogram(vector(found)), "Study")
