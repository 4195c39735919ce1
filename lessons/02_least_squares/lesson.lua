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
-- Least squares is the workhorse of this course. The estimators of later lessons either minimize a sum of squares, or start from the least-squares
-- solution and correct it. This lesson uses least squares twice. The first model is *static*: a straight line through the men's 100 m winning times
-- of the Olympic Games. You also determine how far you can trust such a line. The second model is *dynamic*: the step response of a first-order
-- system, known at only four sampling instants. This model shows why the course needs other estimators: noise in the regressors makes the
-- least-squares estimate biased. The winning times are real. The step response is simulated, so its true parameters are known.
--
-- To review the normal equations and gradient descent, see Guillaume Saint-Cirgue's [page on simple linear regression](https://machinelearnia.com/regression-lineaire-simple/) (in French, with a video of ten minutes).
--
-- # The winning times of the men's 100 m
--
-- ## The data
--
-- The data are the year of the Games, the winner's official time in seconds, and the timing method: by hand until 1964, electronically since then.
-- The Games of 1916, 1940 and 1944 were not held because of the two world wars. Load and plot the data before you compute anything.

-- %% id=times
local games = load("winning_times")
local year, time = games.year, games.time
print(string.format("%d Games, from %d to %d", #year, year[1], year[#year]))
report.figure("times", plot(year, time, {style = "points", height = 6,
              xlabel = "year", ylabel = "winning time (s)"}), "The winning times")

-- %% [markdown]
-- ![Winning times of the men's 100 m at the Olympic Games. Each point is one race; the gaps are the Games that were not held.](figure:times){#fig:times}
--
-- **Question 1.** Describe what you see in @fig:times. Where does a straight line look reasonable, and where not?
--
-- BEGIN SOLUTION
-- The times decrease (@fig:times), quickly at first and then slowly. The first value, 12.0 s in 1896, is far above all other values. It comes from
-- one race with a few runners, timed with a stopwatch. From 1900 on, the decrease is almost steady, about a tenth of a second in nine years. This
-- trend cannot continue forever, because the line eventually reaches zero. A line is a fair description within the range of the data, and it is
-- usable for short-term forecasts only.
-- END SOLUTION
--
-- ## The model
--
-- We postulate a straight line,
--
-- $$ \text{time} = a \cdot \text{year} + b , $$ {#eq:line}
--
-- and set the 2024 result aside: we fit the line to the Games up to 2020 and then use it to forecast 2024. With $N$ Games, the model becomes the
-- overdetermined system $y = \Phi\theta + e$ with one row per Games,
--
-- $$ y = \begin{pmatrix} y_1 \\ \vdots \\ y_N \end{pmatrix}, \qquad
--    \Phi = \begin{pmatrix} x_1 & 1 \\ \vdots & \vdots \\ x_N & 1 \end{pmatrix}, \qquad
--    \theta = \begin{pmatrix} a \\ b \end{pmatrix}. $$ {#eq:regression}
--
-- With calendar years, the two columns of $\Phi$ are almost parallel. If you subtract the mean year $m$, $x_i = \text{year}_i - m$, the columns are
-- orthogonal. The slope $a$ does not change, and $b$ becomes the time at the mean year.

-- %% id=regression
local N = #year - 1                       -- 2024 is reserved for the test
local y = time:range(1, N)
local years = year:range(1, N)
local center = mean(years)
local x = years - center
local Phi = matrix{x, ones(N)}
local Phi_raw = matrix{years, ones(N)}
print(string.format("N = %d Games, mean year %.2f", N, center))
print(string.format("condition number: %.3g raw, %.3g centered",
      lsq(Phi_raw, y).condition_number, lsq(Phi, y).condition_number))

-- %% [markdown]
-- ## Three methods, one answer
--
-- **Question 2.** The least-squares estimate minimizes $J(\theta) = \lVert y - \Phi\theta \rVert^2$. Compute the estimate in three ways: from the
-- normal equations $\Phi^T\Phi\,\theta = \Phi^T y$, with an orthogonal (QR) factorization of $\Phi$, and by gradient descent. Do the results agree?

-- %% id=three_roads
-- BEGIN SOLUTION
local theta_normal = solve(Phi:t()*Phi, Phi:t()*y)
local fit = lsq(Phi, y)                   -- QR
local descent = gradient_descent(Phi, y, {MaxIter = 100000})

-- gradient descent with x divided by its standard deviation
local spread = sqrt(mean(x^2))
local scaled = gradient_descent(matrix{x/spread, ones(N)}, y)
local theta_scaled = vector{scaled.theta[1]/spread, scaled.theta[2]}
-- END SOLUTION

-- %% id=three_roads_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- This cell runs, but its code is not printed (echo=false). Pass the values, figures and tables of your text to the report here; in a text cell
-- STARTER: --   report.value("gain", K, "%.2f")          is shown by  `gain`{.value}
-- STARTER: --   report.figure("name", fig, "caption")    by  ![caption](figure:name){#fig:name}  on a line of its own, and @fig:name refers to it
-- STARTER: --   report.table("name", {{"head"}, {"cell"}})  by  ::: {.table name=name #tbl:name}  then a line with the caption, then  :::
-- formats a number such as 2·10⁻¹² as a formula
local function power_of_ten(x)
    if x == 0 then return "0" end
    local exponent = math.floor(math.log(x, 10))
    return string.format("$%.0f\\cdot10^{%d}$", x/10^exponent, exponent)
end
local function road(name, theta, steps)
    return {name, (string.format("%.5f", theta[1]):gsub("-", "−")), string.format("%.3f", theta[2]),
            power_of_ten((max(abs(theta/fit.theta - 1)))), string.format("%d", steps)}
end
report.table("roads", {
    {"method", "$a$ (s/year)", "$b$ (s)", "difference from QR", "steps"},
    road("normal equations", theta_normal, 1),
    road("QR factorization", fit.theta, 1),
    road("gradient descent", descent.theta, descent.iterations),
    road("gradient descent, x scaled", theta_scaled, scaled.iterations),
})
report.value("a", fit.theta[1], "%.5f")
report.value("a_decade", -10*fit.theta[1], "%.3f")
report.value("b", fit.theta[2], "%.3f")
report.value("a_std", fit.std[1], "%.5f")
report.value("center", center, "%.1f")
report.value("condition", descent.condition_number, "%.0f")
report.value("steps", descent.iterations, "%d")
report.value("steps_scaled", scaled.iterations, "%d")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=roads #tbl:roads}
-- The same line by three methods. The fourth column is the largest relative difference of $a$ or $b$ from the QR values.
-- :::
--
-- All methods of @tbl:roads return the same line. The normal equations and QR need one step. Gradient descent starts from zero and follows the
-- negative gradient. Without scaling, it needs `steps`{.value} steps, because the curvature of $J$ is `condition`{.value} times larger in one
-- direction than in the other. If $x$ is divided by its standard deviation, the curvature is the same in all directions, and `steps_scaled`{.value}
-- steps are enough. For two parameters, gradient descent is slow. For models with millions of parameters, however, no computer can store the matrix
-- $\Phi^T\Phi$. Only gradient-based methods are then feasible (stochastic gradient descent, conjugate gradients, L-BFGS), and scaling is equally
-- important. The line decreases by `a_decade`{.value} s per decade: $\hat a =$ `a`{.value}\ s/year with a standard error of `a_std`{.value}\ s/year,
-- and $\hat b =$ `b`{.value} s in the mean year `center`{.value}.
-- END SOLUTION
--
-- ## Residuals
--
-- **Question 3.** Compute the residuals $\varepsilon = y - \Phi\hat\theta$ and their root mean square,
--
-- $$ \text{RMSE} = \sqrt{\frac{1}{N} \sum_{i=1}^{N} \varepsilon_i^2} \; . $$ {#eq:rmse}
--
-- Do the residuals look like the residuals of a good model?

-- %% id=residuals
-- BEGIN SOLUTION
local residuals = y - Phi*fit.theta
local rmse = sqrt(mean(residuals^2))
report.figure("residuals", plot(years, residuals, {style = "stems", height = 5,
              y_range = {-0.4, 1.1}, xlabel = "year", ylabel = "residual (s)"}),
              "Residuals of the straight line")
-- END SOLUTION

-- %% id=residuals_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
report.value("rmse", rmse, "%.3f")
report.value("first_residual", residuals[1], "%.2f")
report.value("rmse_later", sqrt(mean(residuals:range(2, N)^2)), "%.3f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ![Residuals of the straight line: measured minus fitted time. Adjacent residuals tend to have the same sign, and 1896 is an outlier.](figure:residuals){#fig:residuals}
--
-- The RMSE is `rmse`{.value} s. @fig:residuals shows two effects that this single number hides. First, the residual of the Games of 1896 is
-- `first_residual`{.value} s. Over all other Games, the RMSE is `rmse_later`{.value} s. Second, the signs are not random: negative residuals cluster
-- in the 1930s and 1960s. The last two residuals are positive, because the line now decreases faster than the times. The residuals of a good model
-- have no pattern, so the straight line is only a first approximation.
-- END SOLUTION
--
-- ## A forecast for Paris 2024
--
-- **Question 4.** Use the line to forecast the winning time of 2024, $x_0$ years after the mean year, and compute a 95 % prediction interval,
--
-- $$ \hat a x_0 + \hat b \;\pm\; t_{0.975,\,N-2}\; s\,\sqrt{1 + \frac{1}{N} + \frac{x_0^2}{\sum_i x_i^2}} \; , \qquad
--    s^2 = \frac{1}{N-2}\sum_{i=1}^{N} \varepsilon_i^2 , $$ {#eq:interval}
--
-- where $t_{0.975,\,N-2}$ is the quantile of Student's distribution, `tinv(0.975, N - 2)`. Compare the forecast with the actual result.
--
-- Before you compute the interval, predict its half-width, which is the distance from the forecast to each limit. Replace `nil` in the next cell with
-- your prediction in seconds. After you compute the interval, `reveal("half-width of the interval", value)` prints your prediction next to the result.

-- %% id=forecast_guess
-- BEGIN SOLUTION
-- STARTER: predict_first("half-width of the interval", nil, "s")
predict_first("half-width of the interval", 0.2, "s")
-- END SOLUTION

-- %% id=forecast
-- BEGIN SOLUTION
local line = polyfit_report(years, y, 1)
local paris = forecast(line, 2024, 0.95)
local actual = time[#time]
local picture = regression_plot(years, y, line, {forecast = 2024, level = 0.95,
                xlabel = "year", ylabel = "winning time (s)",
                text = string.format("forecast: %.2f s", paris.value)})
picture:mark(2024, actual, string.format("actual: %.2f s", actual))
picture:set{x_range = {1890, 2050}}
report.figure("forecast", picture, "Line, 95 % bands and the forecast for 2024")
reveal("half-width of the interval", (paris.high - paris.low)/2)
-- END SOLUTION

-- %% id=forecast_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
report.value("N_games", N, "%d")
report.value("paris", paris.value, "%.2f")
report.value("paris_low", paris.low, "%.2f")
report.value("paris_high", paris.high, "%.2f")
report.value("actual", actual, "%.2f")
report.value("miss", actual - paris.value, "%.2f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ![The fitted line with its 95 % confidence band (inner) and 95 % prediction band (outer), the forecast for 2024 and the actual time. The prediction band applies to single races. The confidence band applies to the line only.](figure:forecast){#fig:forecast}
--
-- The forecast from the `N_games`{.value} Games up to 2020 is `paris`{.value} s, with a 95 % prediction interval from `paris_low`{.value} to
-- `paris_high`{.value} s (@fig:forecast). Noah Lyles won in `actual`{.value} s, `miss`{.value} s slower than the forecast but well inside the
-- interval. The interval is wide for two reasons. First, it must include the scatter of one new race (the 1 in @eq:interval), not only the
-- uncertainty of the line. Second, the scattered times of the early Games increase the estimated noise. The interval also depends on assumptions that
-- the residuals contradict.
-- END SOLUTION

-- %% [markdown]
-- # A first-order system from four samples
--
-- ## The data
--
-- The second data set is the simulated response of a first-order system at rest to a unit step. It contains four samples of the output (@fig:samples)
-- and of its time derivative. Each signal is available without noise, and with white noise that has a standard deviation of 0.05.

-- %% id=step
local record = load("step_response")
local t, u = record.t, record.u
local four = plot(t, record.y, "output", t, record.y_noisy, "noisy output",
                  t, u, "input", {style = {"points", "points", "stairs"},
                  height = 5.5,
                  x_range = {-0.1, 1.6}, y_range = {-0.2, 1.8},
                  xlabel = "time (s)", ylabel = "output, input"})
report.figure("samples", four, "Four samples of a step response")

-- %% [markdown]
-- ![The four samples of the output, exact and noisy, and the input. The data contain no values between the samples.](figure:samples){#fig:samples}
--
-- ## A continuous-time model
--
-- **Question 5.** We postulate $G(s) = b/(s + a)$, that is
--
-- $$ \dot y(t) = -a\,y(t) + b\,u(t) . $$ {#eq:ct}
--
-- Write @eq:ct at the four instants as a linear regression, and estimate $a$ and $b$ from the exact signals. Compare the simulated output of the
-- model with the samples.

-- %% id=continuous
-- BEGIN SOLUTION
local ct = lsq(matrix{-record.y, u}, record.ydot)
local Gc = tf({ct.theta[2]}, {1, ct.theta[1]})
print(Gc)
local fine = linspace(0, 2, 201)
report.figure("ct_fit", plot(fine, step(Gc, fine), "model", t, record.y, "samples",
              {style = {"line", "points"}, height = 5.5,
               xlabel = "time (s)", ylabel = "output"}),
              "Step response of the continuous-time model")
-- END SOLUTION

-- %% id=continuous_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
report.value("a_ct", ct.theta[1], "%.4f")
report.value("b_ct", ct.theta[2], "%.4f")
report.value("ct_miss", max(abs(step(Gc, t) - record.y)), "%.0e")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ![Step response of the continuous-time model (line) and the four samples (points). The response passes through all samples](figure:ct_fit){#fig:ct}
--
-- $\Phi$ has the columns $-y$ and $u$, and $\dot y$ is on the left-hand side. The least-squares estimates are $\hat a =$ `a_ct`{.value} and
-- $\hat b =$ `b_ct`{.value}. The model's step response passes through the four samples (@fig:ct): the largest error is `ct_miss`{.value}, which is
-- due to the rounding of the stored data.
-- END SOLUTION
--
-- ## A discrete-time model
--
-- **Question 6.** Now postulate
--
-- $$ G(z) = \frac{b_1 z^{-1}}{1 + a_1 z^{-1}}, \qquad \text{that is} \qquad y(k) = -a_1\,y(k-1) + b_1\,u(k-1) , $$ {#eq:dt}
--
-- estimate $a_1$ and $b_1$, and compare again. How are the two models related?

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
local simulated = lsim(Gd, u, Ts)
report.figure("dt_fit", plot(fine, step(Gc, fine), "continuous time",
              t, simulated, "discrete time", t, record.y, "samples",
              {style = {"line", "stairs", "points"}, dash = {1, 0, 0}, height = 4.8,
               xlabel = "time (s)", ylabel = "output"}),
              "The discrete-time model")
-- END SOLUTION

-- %% id=discrete_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
report.value("a1_dt", dt[1], "%.4f")
report.value("b1_dt", dt[2], "%.4f")
report.value("a1_from_ct", -math.exp(-ct.theta[1]*Ts), "%.4f")
report.value("b1_from_ct", ct.theta[2]/ct.theta[1]*(1 - math.exp(-ct.theta[1]*Ts)), "%.4f")
report.value("dt_miss", max(abs(simulated - record.y)), "%.0e")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- There are three equations for two unknowns, because each equation needs the previous sample. The estimates $\hat a_1 =$ `a1_dt`{.value} and
-- $\hat b_1 =$ `b1_dt`{.value} again reproduce the samples in simulation (@fig:dt, largest error `dt_miss`{.value}). For an input that is constant
-- between the samples, both models describe the same system,
--
-- $$ a_1 = -e^{-aT_s} , \qquad b_1 = \frac{b}{a}\left(1 - e^{-aT_s}\right) , $$ {#eq:solution-sampled}
--
-- which is `a1_from_ct`{.value} and `b1_from_ct`{.value} for the continuous-time estimates. The continuous-time parameters are easier to interpret,
-- because $1/a$ is the time constant and does not depend on the sampling time.
--
-- ![The simulated output of the discrete-time model (stairs), the samples (points), and the response of the continuous-time model. Both models agree at the samples. Only the continuous-time model describes the response between the samples.](figure:dt_fit){#fig:dt}
-- END SOLUTION
--
-- ## Estimation from noisy signals
--
-- **Question 7.** Repeat both fits with the noisy signals. How much do the estimates differ from the estimates without noise?

-- %% id=noisy
-- BEGIN SOLUTION
local noisy_ct = lsq(matrix{-record.y_noisy, u}, record.ydot_noisy).theta
local noisy_dt = regress(record.y_noisy, u)
-- END SOLUTION

-- %% id=noisy_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local function both(name, exact, noisy)
    return {name, string.format("%.4f", exact), string.format("%.4f", noisy)}
end
report.table("noisy", {
    {"parameter", "exact signals", "noisy signals"},
    both("$a$", ct.theta[1], noisy_ct[1]),
    both("$b$", ct.theta[2], noisy_ct[2]),
    both("$a_1$", dt[1], noisy_dt[1]),
    both("$b_1$", dt[2], noisy_dt[2]),
})
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=noisy #tbl:noisy}
-- Estimates from the exact and from the noisy samples.
-- :::
--
-- Noise in the four samples changes every parameter (@tbl:noisy). The discrete-time parameters change by several percent. Is this a random error of
-- one experiment, or is the least-squares estimate biased?
-- END SOLUTION
--
-- **Question 8.** One noisy experiment cannot distinguish a random error from a bias. Repeat the experiment many times. First use the same four
-- samples, five thousand times with new noise. Then simulate a longer data set of the same system with the model of question 6: 400 samples with the input
-- `prbs(7, 4)`, and white noise with a standard deviation of 0.3 in the output. Repeat the discrete-time fit a thousand times. Compare the bias,
-- which is the mean of the estimates of $a_1$ minus the true value, with the scatter (standard deviation) of the estimates. How do bias and scatter
-- depend on the noise standard deviation $\sigma$ and on the number of samples $N$?

-- %% id=monte_carlo
-- BEGIN SOLUTION
-- the four samples with new noise in each run
local few_runs, few_ct, few_dt = 5000, {}, {}
for run = 1, few_runs do
    local yn, dn = record.y + 0.05*randn(4), record.ydot + 0.05*randn(4)
    few_ct[run] = lsq(matrix{-yn, u}, dn).theta[1]
    few_dt[run] = regress(yn, u)[1]
end
few_ct, few_dt = vector(few_ct), vector(few_dt)

-- returns estimates of a1 from longer data sets, and their limit for many samples
local function study(runs, samples, sigma)
    local u_long = prbs(11, 4):range(1, samples)
    if samples == 400 then u_long = prbs(7, 4):range(1, samples) end
    local x_long = lsim(Gd, u_long, Ts)
    local found = zeros(runs)
    for run = 1, runs do
        found[run] = regress(x_long + sigma*randn(samples), u_long)[1]
    end
    local n = samples - 1
    local clean = matrix{-x_long:range(1, n), u_long:range(1, n)}
    local R = clean:t()*clean/n
    local limit = solve(R + matrix{{sigma^2, 0}, {0, 0}}, R*dt)[1]
    return found, limit
end
local runs, samples, sigma = 1000, 400, 0.3
local estimates, limit = study(runs, samples, sigma)
local bars = histogram(estimates, {truth = dt[1], xlabel = "estimate of a_{1}"})
bars:vline(mean(estimates), "mean")
bars:set{x_range = {dt[1] - 0.015, (max(estimates)) + 0.01}, height = 5}
report.figure("monte_carlo", bars, "A thousand estimates and the true value")
-- END SOLUTION

-- %% id=monte_carlo_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
report.value("mc_truth", dt[1], "%.3f")
report.value("mc_mean", mean(estimates), "%.3f")
report.value("mc_std", std(estimates), "%.3f")
report.value("mc_ratio", abs(mean(estimates) - dt[1])/std(estimates), "%.1f")
report.value("mc_limit", limit, "%.3f")
report.value("runs", runs, "%d")
report.value("samples", samples, "%d")
report.value("few_runs", few_runs, "%d")
for name, found in pairs{few_ct = few_ct, few_dt = few_dt} do
    report.value(name, mean(found), "%.3f")
    report.value(name .. "_std", std(found), "%.3f")
    report.value(name .. "_error", std(found)/math.sqrt(few_runs), "%.3f")
end
report.value("few_dt_share", 100*abs(mean(few_dt) - dt[1])/std(few_dt), "%.0f")
report.value("few_dt_luck", abs(noisy_dt[1] - dt[1])/std(few_dt), "%.1f")
local law = {{"noise $\\sigma$", "samples $N$", "mean of $\\hat a_1$", "bias", "expected bias", "scatter"}}
for _, case in ipairs{{0.1, 400}, {0.3, 400}, {0.1, 1600}, {0.3, 1600}, {0.3, 6400}} do
    local found, value = study(300, case[2], case[1])
    table.insert(law, {string.format("%.1f", case[1]), string.format("%d", case[2]),
                 (string.format("%.4f", mean(found)):gsub("-", "−")), string.format("%.4f", mean(found) - dt[1]),
                 string.format("%.4f", value - dt[1]), string.format("%.4f", std(found))})
end
report.table("law", law)
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- *Four samples:* We repeated the experiment `few_runs`{.value} times. The discrete-time estimates of $a_1$ have a mean of
-- `few_dt`{.value}\ ±\ `few_dt_error`{.value} (± the standard error of the mean) and a scatter of `few_dt_std`{.value}. The true value is
-- `mc_truth`{.value}. For $a$ of the continuous-time model, the mean is `few_ct`{.value}\ ±\ `few_ct_error`{.value} and the scatter is
-- `few_ct_std`{.value}. The bias is small (for $a_1$, `few_dt_share`{.value} % of the scatter). The errors in @tbl:noisy are therefore random errors
-- of typical size: the error of $\hat a_1$ is `few_dt_luck`{.value} times the scatter.
--
-- ![A thousand least-squares estimates of $a_1$, each from 400 samples with $\sigma = 0.3$; dashed: the true value, and the mean of the estimates. Almost no estimate reaches the true value.](figure:monte_carlo){#fig:mc}
--
-- *Long data sets with more noise:* the mean of `runs`{.value} estimates, each from `samples`{.value} samples, is `mc_mean`{.value}. The true value is
-- `mc_truth`{.value} (@fig:mc). The scatter of the estimates is only `mc_std`{.value}, so the difference is `mc_ratio`{.value} times the scatter. The
-- estimate is *biased*. The cause is that the noisy output also appears in $\Phi$, so $\Phi$ and the equation error are correlated. White noise on
-- the output adds $\sigma^2$ to the first diagonal element of $\Phi^T\Phi/N$. If $R$ is this matrix for the exact signals, the estimates converge to
--
-- $$ \hat\theta \;\to\; (R + \sigma^2 E)^{-1} R\,\theta , \qquad E = \begin{pmatrix} 1 & 0 \\ 0 & 0 \end{pmatrix} , $$ {#eq:solution-limit}
--
-- which is `mc_limit`{.value} for $a_1$ here.
--
-- ::: {.table name=law #tbl:law}
-- Mean, bias and scatter of $\hat a_1$ over 300 data sets per row, and the expected bias from @eq:solution-limit.
-- :::
--
-- @tbl:law shows how bias and scatter depend on the experiment. The scatter is proportional to $\sigma/\sqrt N$ if the noise is small. The bias grows
-- with $\sigma^2$ and does not depend on $N$. With little noise and four samples, the scatter hides the bias. With much noise and many samples, the
-- bias dominates. More data then reduce the scatter, but not the bias.
-- END SOLUTION

-- %% [markdown]
-- # Try it: bias and scatter
--
-- On a page (`dynlab preview`, or `dynlab report` with an output that ends in `.html`), use the sliders under the next cell. They change the noise
-- $\sigma$, the number of samples $N$ and the sampling time $T_s$ of a hundred data sets of the system $1/(s + 1)$. Which slider changes the bias of
-- $\hat a_1$, and which changes the scatter?

-- %% id=bias_by_hand
do
    local sigma = slider("sigma", 0.3, 0.1, 0.5, {step = 0.1, label = "σ"})
    local N = slider("N", 400, 100, 1300, {step = 300})
    local Ts = slider("Ts", 0.2, 0.1, 0.5, {step = 0.1, unit = "s", label = "T_s"})
    local u = prbs(11, 4):range(1, N)
    local x = lsim(tf({1}, {1, 1}), u, Ts)
    local a1, found = -math.exp(-Ts), zeros(100)
    rng(1)
    for run = 1, 100 do
        local y = x + sigma*randn(N)
        local Phi = matrix{-y:range(1, N - 1), u:range(1, N - 1)}
        found[run] = lsq(Phi, y:range(2, N)).theta[1]
    end
    local bias = mean(found) - a1
    local bars = histogram(found - a1, {truth = 0,
                           xlabel = "estimate minus true a_{1}"})
    bars:vline(bias, "mean")
    bars:set{x_range = {-0.2, 0.8}, height = 5, title =
             string.format("bias %.3f, scatter %.3f", bias, std(found))}
    report.figure("bias_by_hand", bars, "Bias and scatter of a hundred estimates")
end

-- %% [markdown]
-- ![The errors of a hundred least-squares estimates of $a_1$ for the $\sigma$, $N$ and $T_s$ of the cell above; dashed: zero, and their mean](figure:bias_by_hand){#fig:bias_by_hand}
--
-- In @fig:bias_by_hand, more samples make the histogram narrower and do not change its mean. More noise changes the width and the mean. With faster
-- sampling, successive values of the output are more similar.

-- %% [markdown]
-- # What you have learned
--
-- BEGIN SOLUTION
-- * To fit a model that is linear in its parameters, solve one linear system. The normal equations, QR and gradient descent return the same solution.
--   Centered and scaled regressors keep the problem well conditioned.
-- * A forecast requires a prediction interval. The interval is valid only if the model and its assumptions are correct. Test them with the residuals.
-- * The same formula fits a dynamic model when its signals form the columns of $\Phi$. A continuous-time model needs the time derivative, and a
--   discrete-time model needs the past output.
-- * Noise in the regressors makes the least-squares estimate biased. For small $\sigma$, the bias is proportional to $\sigma^2$. The scatter is
--   proportional to $1/\sqrt N$, but the bias does not decrease with $N$. More data do not remove the bias, but instrumental variables and output-error methods do (lesson 4). Repetitions show
--   whether an error is random or a bias.
-- END SOLUTION
--
-- # What you submit
--
-- ::: {.note}
-- If this lesson is graded, submit results with `answer(name, value)`:
--
-- * `line`: the slope and the time at the mean year; `rmse`: the RMSE of the residuals of this line;
-- * `paris`: the forecast for 2024 and the lower and upper limits of its 95 % prediction interval;
-- * `ct` ($a$, $b$) and `dt` ($a_1$, $b_1$) from the exact samples; `ct_noisy` and `dt_noisy` from the noisy samples;
-- * `monte_carlo`: the mean and the standard deviation of your thousand estimates of $a_1$.
--
-- Grading also runs your script on four samples of another system. The checks look for the figures `residuals`, `forecast` and `monte_carlo`.
-- :::

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
-- # Appendix: measures
--
-- ::: measures
-- prediction-interval
-- :::
