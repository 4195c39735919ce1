-- ---
-- title: Straight lines and first-order models by least squares
-- subtitle: Lesson 2 – Olympic winning times and a step response of four samples
-- lesson: 02_least_squares
-- template: lesson
-- language: en
-- seed: 1
-- answers:
--   line: vector
--   rmse: number
--   paris: vector
--   ct: vector
--   dt: vector
--   ct_noisy: vector
--   dt_noisy: vector
--   monte_carlo: vector
-- ---

-- %% [markdown]
-- Least squares is the workhorse of this course: every estimator of the later lessons solves a least-squares problem, or a
-- sequence of them. This lesson uses it twice. First on a *static* model, a straight line through the men's 100 m winning
-- times of the Olympic Games, where we also ask how far such a line may be trusted. Then on a *dynamic* model, the step
-- response of a first-order system known at four instants only, where we meet the reason why the rest of the course exists:
-- noise in the regressors makes plain least squares systematically wrong.
--
-- # The winning times of the men's 100 m
--
-- ## The data
--
-- The record holds the year of the Games, the winner's official time in seconds, and how it was taken: by hand until 1964, by
-- the automatic system since. The Games of 1916, 1940 and 1944 were not held because of the two world wars. The first two
-- steps are to load the data and to look at them before anything is computed.

-- %% id=times
local games = load("winning_times")
local year, time = games.year, games.time
print(string.format("%d Games, from %d to %d", #year, year[1], year[#year]))
plot(year, time, {style = "points", xlabel = "year", ylabel = "winning time (s)",
     title = "Men's 100 m: winning times at the Olympic Games", height = 6})

-- %% [markdown]
-- **Question 1.** Describe what you see. Where does a straight line look reasonable, and where not?
--
-- BEGIN SOLUTION
-- The times fall, fast at first and then slowly. The first value, 12.0 s in 1896, stands far above all others: one race, a
-- handful of runners, a stopwatch. From 1900 on the fall is close to even, about a tenth of a second in nine years. It cannot go
-- on like this for ever, because a line reaches zero some day; within the range of the data it is a fair description and a usable
-- short-term forecast, no more.
-- END SOLUTION
--
-- ## The model
--
-- We postulate a straight line,
--
-- $$ \text{time} = a \cdot \text{year} + b , $$ {#eq:line}
--
-- and keep the result of 2024 aside: the line is fitted to the Games up to 2020 and then asked for 2024. With $N$ Games the model
-- becomes the overdetermined system $y = \Phi\theta + e$, one row per Games,
--
-- $$ y = \begin{pmatrix} y_1 \\ \vdots \\ y_N \end{pmatrix}, \qquad
--    \Phi = \begin{pmatrix} x_1 & 1 \\ \vdots & \vdots \\ x_N & 1 \end{pmatrix}, \qquad
--    \theta = \begin{pmatrix} a \\ b \end{pmatrix}. $$ {#eq:regression}
--
-- Years near 2000 make the two columns of $\Phi$ almost parallel. Measuring the year from the mean year, $x_i = \text{year}_i -
-- \overline{\text{year}}$, leaves $a$ as it is, turns $b$ into the time at the mean year, and makes the columns orthogonal.

-- %% id=regression
local N = #year - 1                       -- 2024 is kept for the test
local y = time:range(1, N)
local years = year:range(1, N)
local centre = mean(years)
local x = years - centre
local Phi = matrix{x, ones(N)}
local Phi_raw = matrix{years, ones(N)}
print(string.format("N = %d Games, mean year %.2f", N, centre))
print(string.format("condition number: %.3g with the raw years, %.3g with centred ones",
      lsq(Phi_raw, y).condition_number, lsq(Phi, y).condition_number))

-- %% [markdown]
-- ## Three roads to one answer
--
-- **Question 2.** The least-squares estimate minimises $J(\theta) = \lVert y - \Phi\theta \rVert^2$. Compute it in three ways: by the
-- normal equations $\Phi^T\Phi\,\theta = \Phi^T y$, by an orthogonal (QR) factorisation of $\Phi$, and by gradient descent. Do they
-- agree?

-- %% id=three_roads
-- BEGIN SOLUTION
local theta_normal = solve(Phi:t()*Phi, Phi:t()*y)
local fit = lsq(Phi, y)                   -- QR
local descent = gradient_descent(Phi, y, {MaxIter = 100000})

-- the same descent with x in units of its own spread
local spread = sqrt(mean(x^2))
local scaled = gradient_descent(matrix{x/spread, ones(N)}, y)
local theta_scaled = vector{scaled.theta[1]/spread, scaled.theta[2]}
-- END SOLUTION

-- %% id=three_roads_report echo=false
-- BEGIN SOLUTION
local function road(name, theta, steps)
    return {name, string.format("%.9f", theta[1]), string.format("%.9f", theta[2]), string.format("%d", steps)}
end
report.table("roads", {
    {"method", "a (s/year)", "b (s)", "steps"},
    road("normal equations", theta_normal, 1),
    road("QR factorisation", fit.theta, 1),
    road("gradient descent", descent.theta, descent.iterations),
    road("gradient descent, x scaled", theta_scaled, scaled.iterations),
})
report.value("a", fit.theta[1], "%.5f")
report.value("a_decade", -10*fit.theta[1], "%.3f")
report.value("b", fit.theta[2], "%.3f")
report.value("a_std", fit.std[1], "%.5f")
report.value("centre", centre, "%.1f")
report.value("condition", descent.condition_number, "%.0f")
report.value("steps", descent.iterations, "%d")
report.value("steps_scaled", scaled.iterations, "%d")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=roads #tbl:roads}
-- The same line by three methods.
-- :::
--
-- All roads of @tbl:roads lead to the same line. The normal equations and QR get there in one step. Gradient descent starts from zero
-- and walks downhill: with the years as they are it needs `steps`{.value} steps, because the valley is `condition`{.value} times
-- steeper across than along; with $x$ in units of its own spread the valley is round, and `steps_scaled`{.value} steps are enough. For two
-- parameters it is the slow road; for models with millions of parameters it is the only one, and scaling matters just as much. The
-- line falls by `a_decade`{.value} s per decade: $\hat a =$ `a`{.value} s/year with a standard error of `a_std`{.value} s/year, and
-- $\hat b =$ `b`{.value} s in the mean year `centre`{.value}.
-- END SOLUTION
--
-- ## Residuals
--
-- **Question 3.** Compute the residuals $\varepsilon = y - \Phi\hat\theta$ and their root mean square,
--
-- $$ \text{RMSE} = \sqrt{\frac{1}{N} \sum_{i=1}^{N} \varepsilon_i^2} \; . $$ {#eq:rmse}
--
-- Are they what a good model would leave?

-- %% id=residuals
-- BEGIN SOLUTION
local residuals = y - Phi*fit.theta
local rmse = sqrt(mean(residuals^2))
report.figure("residuals", plot(years, residuals, {style = "stems", height = 5,
              xlabel = "year", ylabel = "residual (s)"}), "What the straight line leaves unexplained")
-- END SOLUTION

-- %% id=residuals_report echo=false
-- BEGIN SOLUTION
report.value("rmse", rmse, "%.3f")
report.value("first_residual", residuals[1], "%.2f")
report.value("rmse_later", sqrt(mean(residuals:range(2, N)^2)), "%.3f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ![What the straight line leaves unexplained](figure:residuals){#fig:residuals}
--
-- The RMSE is `rmse`{.value} s. @fig:residuals shows that this one number hides a story. The Games of 1896 alone leave
-- `first_residual`{.value} s; without them the RMSE over the others is `rmse_later`{.value} s. And the signs are not random: residuals
-- below zero stand together in the 1930s and 1960s, and the last two are above zero, the line falls faster than the times do now. A good
-- model would leave residuals without any pattern, so a straight line is a first approximation and not the truth.
-- END SOLUTION
--
-- ## A forecast for Paris 2024
--
-- **Question 4.** Use the line to forecast the winning time of 2024 and give a 95 % prediction interval. Compare it with what
-- happened.

-- %% id=forecast
-- BEGIN SOLUTION
local line = polyfit_report(years, y, 1)
local paris = forecast(line, 2024, 0.95)
local actual = time[#time]
local picture = regression_plot(years, y, line, {forecast = 2024, level = 0.95,
                xlabel = "year", ylabel = "winning time (s)", text = string.format("%.2f s", paris.value)})
report.figure("forecast", picture, "Straight line, 95 % bands and the forecast for 2024")
-- END SOLUTION

-- %% id=forecast_report echo=false
-- BEGIN SOLUTION
report.value("N_games", N, "%d")
report.value("paris", paris.value, "%.2f")
report.value("paris_low", paris.low, "%.2f")
report.value("paris_high", paris.high, "%.2f")
report.value("actual", actual, "%.2f")
report.value("miss", actual - paris.value, "%.2f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ![Straight line, 95 % bands and the forecast for 2024](figure:forecast){#fig:forecast}
--
-- The forecast from the `N_games`{.value} Games to 2020 is `paris`{.value} s, with a 95 % prediction interval from `paris_low`{.value} to
-- `paris_high`{.value} s (@fig:forecast). Noah Lyles won in `actual`{.value} s, `miss`{.value} s slower than the forecast and well inside
-- the interval. The interval is wide because it must allow for one new race, not only for the uncertainty of the line, and because the
-- early, scattered Games inflate the estimated noise. It also rests on assumptions that the residuals have already put in doubt.
-- END SOLUTION

-- %% [markdown]
-- # A first-order system from four samples
--
-- ## The data
--
-- The second record is the response of a first-order system at rest to a unit step, at four instants, together with its time derivative. Both
-- are given twice: exact, and with measurement noise.

-- %% id=step
local record = load("step_response")
local t, u = record.t, record.u
plot(t, record.y, "output y", t, u, "input u", {style = "line_points", height = 5.5,
     xlabel = "time (s)", ylabel = "signals", title = "Four samples of a step response"})

-- %% [markdown]
-- ## A continuous-time model
--
-- **Question 5.** We postulate $G(s) = b/(s + a)$, that is
--
-- $$ \dot y(t) = -a\,y(t) + b\,u(t) . $$ {#eq:ct}
--
-- Write @eq:ct at the four instants as a linear regression, estimate $a$ and $b$ from the exact signals, and compare the simulated
-- output of the model with the samples.

-- %% id=continuous
-- BEGIN SOLUTION
local ct = lsq(matrix{-record.y, u}, record.ydot)
local Gc = tf({ct.theta[2]}, {1, ct.theta[1]})
print(Gc)
local fine = linspace(0, 2, 201)
report.figure("ct_fit", plot(fine, step(Gc, fine), "model", t, record.y, "samples", {style = {"line", "points"},
              height = 5.5, xlabel = "time (s)", ylabel = "output"}), "Step response of the continuous-time model")
-- END SOLUTION

-- %% id=continuous_report echo=false
-- BEGIN SOLUTION
report.value("a_ct", ct.theta[1], "%.4f")
report.value("b_ct", ct.theta[2], "%.4f")
report.value("ct_miss", max(abs(step(Gc, t) - record.y)), "%.0e")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ![Step response of the continuous-time model and the four samples](figure:ct_fit){#fig:ct}
--
-- With $\Phi$ made of the columns $-y$ and $u$, and $\dot y$ on the left, least squares gives $\hat a =$ `a_ct`{.value} and
-- $\hat b =$ `b_ct`{.value}. The model's step response passes through the four samples (@fig:ct): the largest distance is
-- `ct_miss`{.value}, the rounding of the stored data.
-- END SOLUTION
--
-- ## A discrete-time model
--
-- **Question 6.** Now postulate
--
-- $$ G(z) = \frac{b_1 z^{-1}}{1 + a_1 z^{-1}}, \qquad \text{that is} \qquad y(k) = -a_1\,y(k-1) + b_1\,u(k-1) , $$ {#eq:dt}
--
-- estimate $a_1$ and $b_1$, and compare again. How do the two models hang together?

-- %% id=discrete
-- BEGIN SOLUTION
local Ts = t[2] - t[1]
local function regress(y, u)
    local n = #y
    return lsq(matrix{-y:range(1, n - 1), u:range(1, n - 1)}, y:range(2, n)).theta
end
local dt = regress(record.y, u)
local Gd = tf({dt[2]}, {1, dt[1]}, {Ts = Ts})
print(Gd)
-- END SOLUTION

-- %% id=discrete_report echo=false
-- BEGIN SOLUTION
report.value("a1_dt", dt[1], "%.4f")
report.value("b1_dt", dt[2], "%.4f")
report.value("a1_from_ct", -math.exp(-ct.theta[1]*Ts), "%.4f")
report.value("dt_miss", max(abs(lsim(Gd, u, Ts) - record.y)), "%.0e")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- Three equations are left for two unknowns, because each needs the sample before. The estimates $\hat a_1 =$ `a1_dt`{.value} and
-- $\hat b_1 =$ `b1_dt`{.value} again reproduce the samples when the model is simulated (largest distance `dt_miss`{.value}). For an input
-- that is constant between the samples both models describe the same system: $a_1 = -e^{-aT_s}$, which is `a1_from_ct`{.value} for the
-- continuous-time estimate. The continuous-time parameters are easier to read: $1/a$ is the time constant, whatever the sampling.
-- END SOLUTION
--
-- ## The same with noise
--
-- **Question 7.** Repeat both fits with the noisy signals. How far are the estimates from the ones above?

-- %% id=noisy
-- BEGIN SOLUTION
local noisy_ct = lsq(matrix{-record.y_noisy, u}, record.ydot_noisy).theta
local noisy_dt = regress(record.y_noisy, u)
-- END SOLUTION

-- %% id=noisy_report echo=false
-- BEGIN SOLUTION
local function both(name, exact, noisy)
    return {name, string.format("%.4f", exact), string.format("%.4f", noisy)}
end
report.table("noisy", {
    {"parameter", "exact signals", "noisy signals"},
    both("a", ct.theta[1], noisy_ct[1]),
    both("b", ct.theta[2], noisy_ct[2]),
    both("a₁", dt[1], noisy_dt[1]),
    both("b₁", dt[2], noisy_dt[2]),
})
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=noisy #tbl:noisy}
-- Estimates from the exact and from the noisy samples.
-- :::
--
-- Noise on four samples moves every parameter (@tbl:noisy), the discrete-time ones by several percent. Is this bad luck of one record,
-- or does least squares miss on average?
-- END SOLUTION
--
-- **Question 8.** One noisy record cannot tell bad luck from a method that is wrong on average. Make many: simulate a longer record
-- of the same system, 400 samples with the input `prbs(7, 4)`, add white noise of standard deviation 0.3 to the output, and repeat the
-- discrete-time fit a thousand times. Where is the mean of the estimates of $a_1$, compared with the truth and with the scatter of the single estimates?

-- %% id=monte_carlo
-- BEGIN SOLUTION
local runs, samples, sigma = 1000, 400, 0.3
local u_long = prbs(7, 4):range(1, samples)
local x_long = lsim(Gd, u_long, Ts)
local estimates = zeros(runs)
for run = 1, runs do
    estimates[run] = regress(x_long + sigma*randn(samples), u_long)[1]
end
report.figure("monte_carlo", histogram(estimates, {truth = dt[1], xlabel = "estimate of a_{1}"}),
              "A thousand least-squares estimates from noisy records, and the true value")
-- END SOLUTION

-- %% id=monte_carlo_report echo=false
-- BEGIN SOLUTION
report.value("mc_truth", dt[1], "%.3f")
report.value("mc_mean", mean(estimates), "%.3f")
report.value("mc_std", std(estimates), "%.3f")
report.value("mc_ratio", abs(mean(estimates) - dt[1])/std(estimates), "%.1f")
report.value("runs", runs, "%d")
report.value("samples", samples, "%d")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ![A thousand least-squares estimates from noisy records, and the true value](figure:monte_carlo){#fig:mc}
--
-- The mean of `runs`{.value} estimates, each from `samples`{.value} samples, is `mc_mean`{.value} while the truth is `mc_truth`{.value}
-- (@fig:mc). The single estimates scatter by `mc_std`{.value} only, so the mean misses the truth by `mc_ratio`{.value} times their
-- scatter. That is no bad luck: the estimate is *biased*, and longer records would only make the wrong answer more certain. The reason
-- stands in the regression itself: the noisy output appears in $\Phi$ as well, so $\Phi$ and the equation error are correlated.
-- END SOLUTION
--
-- # What you hand in
--
-- Where this lesson is graded, hand in with `answer(name, value)`: `line`, the slope and the time at the mean year; `rmse` of its residuals; `paris`,
-- the forecast for 2024 and the lower and upper end of its 95 % prediction interval; `ct` ($a$, $b$) and `dt` ($a_1$, $b_1$) from the exact samples,
-- `ct_noisy` and `dt_noisy` from the noisy ones; `monte_carlo`, mean and standard deviation of your thousand estimates of $a_1$. Your script will
-- be run on four samples of another system, too. The figures that are looked for are `residuals`, `forecast` and `monte_carlo`.

-- %% id=hand_in
-- BEGIN SOLUTION
answer("line", fit.theta)
answer("rmse", rmse)
answer("paris", vector{paris.value, paris.low, paris.high})
answer("ct", ct.theta)
answer("dt", dt)
answer("ct_noisy", noisy_ct)
answer("dt_noisy", noisy_dt)
answer("monte_carlo", vector{mean(estimates), std(estimates)})
-- END SOLUTION

-- %% [markdown]
-- # What was learnt
--
-- BEGIN SOLUTION
-- * A model that is linear in its parameters is fitted by solving one linear system; the normal equations, QR and gradient descent
--   lead to the same point. Centred and scaled regressors keep the problem well conditioned.
-- * A forecast without an interval says little. The interval holds only as far as the model and its assumptions do, and the residuals tell.
-- * A dynamic model is fitted by the same formula once its signals stand in $\Phi$; in continuous time the time derivative is needed,
--   in discrete time the past output.
-- * Noise on the regressors biases simple least squares. More data do not help; instrumental variables and output-error methods, the
--   subject of lesson 4, do.
-- END SOLUTION
