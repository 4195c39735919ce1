-- ---
-- title: Continuous-time models from noisy data
-- subtitle: Lesson 4 – LSSVF, IVSVF and TFSRIVC on a known system
-- lesson: 04_estimators
-- template: lesson
-- language: en
-- seed: 1
-- bibliography: references.bib
-- answers:
--   own_without_noise: vector
--   own: vector
--   record: data
--   G_lssvf: model
--   G_ivsvf: model
--   G_final: model
--   scatter: vector
-- ---

-- %% [markdown]
-- Three methods estimate a differential equation directly from samples [@garnier2008]: least squares on filtered signals (LSSVF), the same regression
-- with instruments (IVSVF), and the refined instrumental variables of TFSRIVC [@young2011]. Which of these methods can you trust? For a real plant,
-- the answer is unknown. Therefore, all data in this lesson are simulated. The system is given, and the computer generates the noise. You can compare
-- the estimates with the true parameters, first for one data set and then for two hundred data sets.
--
-- `dynlab demo` shows the methods in short guided tours. Run one of the tours before you start, or at any later time.
--
-- The work is planned for two sessions of three hours:
--
-- | session | questions, with minutes | aim |
-- |--------------|-------------------------|------------------------|
-- | Regressions and their bias | 1 (5), 2 (15), 3 (20), 4 (35), 5 (20), 6 (15), 7 (25), 8 (25), 9 (20) | write an estimator, detect its bias, remove the bias with instruments, and understand the effect of the filter |
-- | Comparison and uncertainty of the methods | 10 (25), 11 (35), 12 (25), 13 (20), 14 (25), 15 (30), 16 (20) | compare methods over many data sets with the Cramér–Rao bound and with discrete-time methods |
--
-- # The system and its data
--
-- ## The true system
--
-- The input $u$ drives a second-order system. The output $x$ is sampled every $T_s$ seconds and measured with additive noise,
--
-- $$ x(t) = \frac{B_o(p)}{F_o(p)}\,u(t), \qquad y(t_k) = x(t_k) + e(t_k), $$ {#eq:system}
--
-- with $B_o(p) = 2$ and $F_o(p) = p^2 + 4p + 3$, where $p$ is the derivative operator $\mathrm{d}/\mathrm{d}t$. The noise $e(t_k)$ is white and
-- Gaussian, with zero mean and standard deviation $\sigma$.
--
-- **Question 1.** Which model structure does @eq:system have: CARX, COE or CBJ? (CARX: $A\,y = B\,u + e$; COE: $y = \frac{B}{F}\,u + e$; CBJ: $y = \frac{B}{F}\,u + \frac{C}{D}\,e$.)
--
-- BEGIN SOLUTION
-- The structure is COE, a continuous-time output-error structure. The white disturbance is added to the output. In a CARX structure, the disturbance
-- would be filtered by $1/A$. In a CBJ structure, it would be filtered by $C/D$.
-- END SOLUTION
--
-- **Question 2.** Determine the main properties of the system: steady-state gain, poles, time constants, corner frequencies and bandwidth.

-- %% id=system
local s = tf("s")
local Go = 2/(s^2 + 4*s + 3)
-- BEGIN SOLUTION
local corner, damping, time_constant = damp(Go)
print(string.format("gain %.4f, bandwidth %.4f rad/s", dcgain(Go), bandwidth(Go)))
print("corner frequencies (rad/s):", corner)
print("time constants (s):", time_constant)
-- END SOLUTION

-- %% id=system_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- This cell runs, but its code is not printed (echo=false). Pass the values, figures and tables of your text to the report here; in a text cell
-- STARTER: --   report.value("gain", K, "%.2f")          is shown by  `gain`{.value}
-- STARTER: --   report.figure("name", fig, "caption")    by  ![caption](figure:name){#fig:name}  on a line of its own, and @fig:name refers to it
-- STARTER: --   report.table("name", {{"head"}, {"cell"}})  by  ::: {.table name=name #tbl:name}  then a line with the caption, then  :::
report.value("gain", dcgain(Go), "%.3f")
report.value("slow_corner", min(corner), "%.0f")
report.value("fast_corner", max(corner), "%.0f")
report.value("slow_constant", max(time_constant), "%.0f")
report.value("fast_constant", min(time_constant), "%.2f")
report.value("band", bandwidth(Go), "%.2f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- The steady-state gain is $B_o(0)/F_o(0) =$ `gain`{.value}. The real poles at $-$`slow_corner`{.value} and $-$`fast_corner`{.value} correspond to
-- time constants of `slow_constant`{.value} s and `fast_constant`{.value} s, and corner frequencies of `slow_corner`{.value} and
-- `fast_corner`{.value} rad/s. The slow pole dominates: the gain is 3 dB lower at `band`{.value} rad/s, slightly below the corner frequency of this
-- pole. (The bandwidth is this $-3$ dB frequency. Some texts call the faster corner frequency, `fast_corner`{.value} rad/s, the bandwidth of the
-- system.)
-- END SOLUTION
--
-- ## The data
--
-- The input is a pseudo-random binary sequence that may change once per second. The data contain one period of this sequence. There are two data
-- objects: one without noise, and one with noise of $\sigma = 0.2$.

-- %% id=record
local Ts, N = 0.01, 1500
local sigma = 0.2
local u = prbs(4, 100)
local x = lsim(Go, u, Ts)                 -- the noise-free output
local y = x + sigma*randn(N)              -- the measured output
local signals = {InputName = "input u", OutputName = "output y"}
local data0, data = iddata(x, u, Ts, signals), iddata(y, u, Ts, signals)
report.figure("record", idplot(data, {labels = {"measured"}})
              :add(data.t, x, {label = "without noise", line_width = 1.8}),
              "The data")
local snr = 20*math.log(std(x)/sigma, 10)
print(string.format("signal-to-noise ratio: %.1f dB", snr))

-- %% [markdown]
-- ![The data. Above: the measured output (thin) and the noise-free output (thick), which is not available in a real experiment. Below: the input.](figure:record){#fig:record}
--
-- The quality of these data is low on purpose (@fig:record). Between two samples, the output changes much less than the noise. The signal-to-noise
-- ratio of 5 dB is typical of noisy industrial data. Assume that the orders are known: two poles and no zeros. Question 16 tests this assumption.
--
-- # Least squares on filtered signals, by hand
--
-- ## The regression
--
-- Consider the CARX model $A(p)\,y(t) = B(p)\,u(t) + e(t)$ with $A(p) = p^2 + a_1 p + a_2$ and $B(p) = b_0$. The derivatives are not measured, and
-- numerical differentiation would amplify the noise. Therefore, first pass every signal through the same filter,
--
-- $$ y_f(t) = \frac{1}{E(p)}\,y(t), \qquad u_f(t) = \frac{1}{E(p)}\,u(t), \qquad E(p) = (p + \lambda)^2 , $$ {#eq:filter}
--
-- where $\lambda$ is the cutoff frequency. This filter provides $y_f$, $p\,y_f$ and $p^2 y_f$ without any differentiation. It is called the
-- *state-variable filter*.
--
-- **Question 3.** Write the model for the $N$ samples as a linear regression in matrix form, and state the sizes of the matrices. What is the
-- least-squares solution?
--
-- BEGIN SOLUTION
-- The filtered signals satisfy the same equation, sample by sample,
--
-- $$ p^2 y_f(t_k) = -a_1\,p\,y_f(t_k) - a_2\,y_f(t_k) + b_0\,u_f(t_k) + \varepsilon(t_k) , $$ {#eq:solution-sample}
--
-- and the equations for $k = 1, \dots, N$ are $Y = \Phi\theta + \varepsilon$ with
--
-- $$ Y = \begin{pmatrix} p^2 y_f(t_1) \\ \vdots \\ p^2 y_f(t_N) \end{pmatrix}, \quad
--    \Phi = \begin{pmatrix} -p\,y_f(t_1) & -y_f(t_1) & u_f(t_1) \\ \vdots & \vdots & \vdots \\
--    -p\,y_f(t_N) & -y_f(t_N) & u_f(t_N) \end{pmatrix}, \quad
--    \theta = \begin{pmatrix} a_1 \\ a_2 \\ b_0 \end{pmatrix} , $$ {#eq:solution-matrices}
--
-- where $Y$ and $\varepsilon$ are columns of $N$ values, $\Phi$ has $N$ rows and 3 columns, and $\theta$ has 3 values. The sum of squares
-- $\lVert Y - \Phi\theta \rVert^2$ is smallest for $\hat\theta = (\Phi^T\Phi)^{-1}\Phi^T Y$. A program computes this solution with an orthogonal
-- factorization of $\Phi$, without an inverse.
-- END SOLUTION
--
-- ## Your own estimator
--
-- **Question 4.** Write your own LSSVF. `svf(x, 2, lambda, {Ts = Ts})` returns a matrix `X` with the columns $p^2 x_f$, $p\,x_f$ and $x_f$
-- (`X:col(1)` is the first). `solve(Phi, Y)` returns the least-squares solution. Between the samples, the input is constant (zero-order hold,
-- `hold = "zoh"`). Assume that the measured output is piecewise linear (first-order hold, `hold = "foh"`), which is the default of `svf`. Set
-- $\lambda = 3$ rad/s and apply your estimator to the data without noise.

-- %% id=own_lssvf
-- BEGIN SOLUTION
local function regressors(y, u, lambda)
    local Yf = svf(y, 2, lambda, {Ts = Ts, hold = "foh"})
    local Uf = svf(u, 2, lambda, {Ts = Ts, hold = "zoh"})
    return matrix{-Yf:col(2), -Yf:col(3), Uf:col(3)}, Yf:col(1)
end
local function own_lssvf(y, u, lambda)
    local Phi, Y = regressors(y, u, lambda)
    return solve(Phi, Y)
end
-- STARTER: local function own_lssvf(y, u, lambda)
-- STARTER:     return zeros(3)                   -- replace with a1, a2, b0
-- STARTER: end
-- END SOLUTION
local lambda = 3
local own0 = own_lssvf(x, u, lambda)
print(string.format("a1 = %.5f, a2 = %.5f, b0 = %.5f", own0[1], own0[2], own0[3]))

-- %% id=own_lssvf_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local truth = vector{Go.den[2], Go.den[3], Go.num[#Go.num]}
local function largest_relative(theta, reference)
    local difference = max(abs(theta/reference - 1))
    return difference
end
local u_fine = prbs(4, 200)
local fine = lssvf(iddata(lsim(Go, u_fine, Ts/2), u_fine, Ts/2), {2, 1, 0}, lambda)
local function true_cell(i)
    return string.format("%g", truth[i])
end
report.value("own0_miss", 100*largest_relative(own0, truth), "%.4f")
report.value("fine_ratio", largest_relative(own0, truth)/largest_relative(fine.param, truth), "%.1f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- The estimates are accurate to `own0_miss`{.value} %. The remaining error is not a programming error, but an interpolation error: the filter
-- interpolates the output linearly between the samples, and the true output is curved. With half the sampling time, the error is `fine_ratio`{.value}
-- times smaller, as expected for an error proportional to $T_s^2$.
-- END SOLUTION
--
-- **Question 5.** Now use the data with noise. Are the estimates still close to the true parameters? Repeat the estimation with different noise. Are
-- the errors random, or do they always have the same sign? (`dynlab run analysis.lua --seed random` runs the script with different noise.)

-- %% id=own_noisy
-- BEGIN SOLUTION
local own = own_lssvf(y, u, lambda)
local others = {}
for repetition = 1, 5 do
    others[repetition] = own_lssvf(x + sigma*randn(N), u, lambda)
end
-- END SOLUTION

-- %% id=own_noisy_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local function cells(name, theta)
    return {name, string.format("%.3f", theta[1]), string.format("%.3f", theta[2]), string.format("%.3f", theta[3])}
end
local rows = {{"data set", "$a_1$", "$a_2$", "$b_0$"}, cells("truth", truth), cells("these data", own)}
for repetition, theta in ipairs(others) do
    table.insert(rows, cells(string.format("repetition %d", repetition), theta))
end
report.table("repetitions", rows)
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=repetitions #tbl:repetitions}
-- Your own LSSVF, $\lambda = 3$ rad/s: estimates from the data with noise and from five repetitions with different noise. All estimates are below the
-- true values.
-- :::
--
-- The estimates are not close to the true parameters, and the errors are systematic (@tbl:repetitions). Random errors would have both signs, but all
-- three parameters are too small in every repetition. The least-squares estimate is *biased*. The noise of $y$ appears on both sides of
-- @eq:solution-sample. For the true parameters, the equation error is
--
-- $$ \varepsilon(t) = \frac{A(p)}{E(p)}\,e(t) , $$ {#eq:solution-color}
--
-- and the columns $p\,y_f$ and $y_f$ of $\Phi$ contain the same noise $e$, filtered differently. The regressors and the equation error are
-- correlated, as in the long, noisy data set at the end of lesson 2. More samples would not help: the bias depends on the variance of the noise, not on
-- the number of samples.
-- END SOLUTION
--
-- ## The library's LSSVF
--
-- **Question 6.** `lssvf(data, {na, nb, nk}, lambda)` computes the LSSVF estimate from a data object: `na` poles, `nb` coefficients of $B$, and `nk`
-- samples of delay. Apply this function to both data objects and compare the estimates with the results of your program.

-- %% id=lssvf
-- BEGIN SOLUTION
local Glssvf0 = lssvf(data0, {2, 1, 0}, lambda)
local Glssvf = lssvf(data, {2, 1, 0}, lambda)
present(Glssvf)
print("own program, without noise:", own0 - Glssvf0.param)
print("own program, with noise:   ", own - Glssvf.param)
-- END SOLUTION

-- %% id=lssvf_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
report.value("agreement", math.max(largest_relative(own0, Glssvf0.param), largest_relative(own, Glssvf.param)), "%.0e")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- Both programs return the same estimates: the largest relative difference, `agreement`{.value}, is a rounding error. The library is faster, because
-- it computes the required sums of products during filtering and does not store $\Phi$.
-- END SOLUTION

-- %% [markdown]
-- # Instruments
--
-- ## IVSVF
--
-- To remove the bias, keep the regression of question 3, but solve it differently. Instead of $\Phi^T Y = \Phi^T\Phi\,\theta$, solve
--
-- $$ Z^T Y = Z^T\Phi\,\theta , $$ {#eq:iv}
--
-- where the *instruments* $Z$ are correlated with $\Phi$ but independent of the noise. IVSVF computes them in two steps. First, LSSVF estimates a
-- model. Then IVSVF simulates this model with the input $u$, and the simulated output replaces $y$ in the regressors.
--
-- **Question 7.** Estimate the model with `ivsvf` and compare it with LSSVF. As a bonus, write your own IVSVF: add three lines to your own LSSVF.

-- %% id=ivsvf
-- BEGIN SOLUTION
local Givsvf = ivsvf(data, {2, 1, 0}, lambda)
print("a1, a2, b0:", Givsvf.param, "standard errors:", Givsvf.std)

local Phi, Y = regressors(y, u, lambda)
local Z = regressors(lsim(Glssvf, u, Ts), u, lambda)
local own_iv = solve(Z:t()*Phi, Z:t()*Y)
print("own program:", own_iv - Givsvf.param)
-- END SOLUTION

-- %% id=ivsvf_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
report.value("iv_agreement", largest_relative(own_iv, Givsvf.param), "%.0e")
report.value("ls_miss", 100*largest_relative(Glssvf.param, truth), "%.0f")
report.value("iv_miss", 100*largest_relative(Givsvf.param, truth), "%.0f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- The largest parameter error is `ls_miss`{.value} % for LSSVF and `iv_miss`{.value} % for IVSVF. The model that generates the instruments is biased,
-- but this is not a problem. The instruments need only be independent of the noise and correlated with the regressors. The estimates of your IVSVF
-- agree with the library (`iv_agreement`{.value} relative difference).
-- END SOLUTION
--
-- ## The choice of λ
--
-- For both methods, you must choose the cutoff frequency $\lambda$ of the filter. The usual choice is slightly above the bandwidth of the system,
-- which is unknown for a real plant.
--
-- **Question 8.** How sensitive is IVSVF to this choice? Compare $\lambda = 0.3$, 3 and 30 rad/s. One data set is not enough for an answer.
-- `montecarlo` repeats the experiment with new noise as often as you specify (`dynlab help montecarlo`).

-- %% id=lambda
-- BEGIN SOLUTION
local function study(sigma, estimators)
    return montecarlo{system = Go, input = u, Ts = Ts, sigma = sigma,
                      runs = 200, estimators = estimators}
end
local filters = study(sigma, {{"ivsvf", {2, 1, 0}, 30, label = "λ = 30"},
                              {"ivsvf", {2, 1, 0}, 3, label = "λ = 3"},
                              {"ivsvf", {2, 1, 0}, 0.3, label = "λ = 0.3"}})
-- two panels: all estimates, and an enlarged view of the center
local function within(x, y, legend)
    local picture = filters:scatter("a1", "a2")
    return picture:set{x_range = x, y_range = y, legend = legend, title = ""}
end
local both = subplot(2, 1, {within({-5, 25}, {-5, 12}, "above"),
                            within({2.5, 5.5}, {2, 4}, "none")})
report.figure("lambda", both:set{height = 11}, "IVSVF with three filters")
-- END SOLUTION

-- %% id=lambda_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local function mean_and_std(result, i)
    return (string.format("%.3f (%.3f)", result.mean[i], result.std[i]):gsub("^%-", "−"))
end
local lambda_rows = {{"$\\lambda$ (rad/s)", "$a_1$", "$a_2$", "$b_0$", "largest $a_1$", "std. error, $a_1$"},
                     {"truth", true_cell(1), true_cell(2), true_cell(3), "", ""}}
for _, value in ipairs{"0.3", "3", "30"} do
    local result = filters["λ = " .. value]
    table.insert(lambda_rows, {value, mean_and_std(result, 1), mean_and_std(result, 2), mean_and_std(result, 3),
                               string.format("%.1f", result.max[1]), string.format("(%.3g)", result.reported_std[1])})
end
report.table("lambda", lambda_rows)
local best_std = filters["λ = 3"].std[1]
report.value("runs", filters.runs, "%d")
report.value("low_ratio", filters["λ = 0.3"].std[1]/best_std, "%.0f")
report.value("high_ratio", filters["λ = 30"].std[1]/best_std, "%.0f")
local function mean_error(result) return result.std[1]/math.sqrt(filters.runs) end
for name, label in pairs{low = "λ = 0.3", high = "λ = 30"} do
    local result = filters[label]
    report.value(name .. "_mean", result.mean[1], "%.2f")
    report.value(name .. "_mean_error", mean_error(result), "%.2f")
end
local near_best = montecarlo{system = Go, input = u, Ts = Ts, sigma = sigma, runs = 2000, estimators = {
    {"ivsvf", {2, 1, 0}, math.sqrt(3), label = "√3"}, {"ivsvf", {2, 1, 0}, 3, label = "3"}}}
report.value("root_std", near_best["√3"].std[1], "%.3f")
report.value("three_std", near_best["3"].std[1], "%.3f")
report.value("many_runs", near_best.runs, "%d")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=lambda #tbl:lambda}
-- IVSVF with three filters: mean over 200 data sets and, in parentheses, the standard deviation. The last column is the mean of the standard errors
-- that the method reported.
-- :::
--
-- ![IVSVF with three filters, 200 estimates each: $\hat a_2$ versus $\hat a_1$. Above: all estimates. Below: an enlarged view of the center, with the true value (4, 3). The ellipse contains 95 % of the estimates of the best possible unbiased method. Only the estimates for $\lambda = 3$ are close to the ellipse.](figure:lambda){#fig:lambda}
--
-- IVSVF is very sensitive to $\lambda$ (@tbl:lambda, @fig:lambda). Over `runs`{.value} data sets, the scatter of $\hat a_1$ is `low_ratio`{.value}
-- times larger with $\lambda = 0.3$ and `high_ratio`{.value} times larger with $\lambda = 30$ than with $\lambda = 3$. For some data sets, the
-- estimates are useless. Also note the means: `low_mean`{.value}\ ±\ `low_mean_error`{.value} and `high_mean`{.value}\ ±\ `high_mean_error`{.value}
-- (± the standard error of the mean of `runs`{.value} estimates) are significantly above 4. Instrumental-variable estimates are *consistent*: they
-- converge to the true parameters as the number of samples grows. With a finite number of noisy samples, they are not exactly unbiased.
-- END SOLUTION
--
-- **Question 9.** Explain this sensitivity. Insert the true parameters into the regression: how does the filter color the equation error, and which
-- filter is optimal? (`freqresp(G, w).abs` returns the magnitude of a transfer function.)

-- %% id=color
-- BEGIN SOLUTION
local w = 10^linspace(-2, 3, 300)
local function color(lambda)
    return freqresp((s^2 + 4*s + 3)/(s + lambda)^2, w).abs
end
local weights = plot(w, color(0.3), "λ = 0.3", w, color(3), "λ = 3",
                     w, color(30), "λ = 30", w, ones(#w), "E = A",
                     {x_log = true, y_log = true, height = 5.5, dash = {1, 0, 2, 3},
                      xlabel = "frequency (rad/s)", ylabel = "weight |A/E|",
                      legend = "direct"})
report.figure("color", weights, "How the filter colors the equation error")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ![How the filter colors the equation error: the magnitude $|A/E|$, which multiplies white measurement noise, for three values of $\lambda$ (solid: 3 rad/s) and for the optimal filter, $E = A$, for which the equation error is white](figure:color){#fig:color}
--
-- The regression weights all samples of $\varepsilon$ equally, which is optimal if $\varepsilon$ is white. According to @eq:solution-color,
-- $\varepsilon$ is the white noise $e$ filtered by $A/E$ (@fig:color). With $\lambda = 0.3$, the low-frequency part of the noise dominates. The
-- response of the filter is so slow that the data contain little more than its transient. With $\lambda = 30$, nearly all of the noise is at
-- frequencies where the system no longer responds, and it hides the information about the slow pole. Of the three magnitudes, the magnitude for
-- $\lambda = 3$ is closest to a constant. The magnitude is constant for $E = A$: the optimal filter is $1/A$, with the denominator of the system.
-- Among the polynomials $(p+\lambda)^2$, the polynomial with $\lambda = \sqrt 3 \approx 1.7$ is nearest to $A = p^2 + 4p + 3$, because the constant
-- terms agree. Over `many_runs`{.value} data sets, the scatter of $\hat a_1$ is `root_std`{.value} for this filter and `three_std`{.value} for
-- $\lambda = 3$. $A$ is unknown, but an iteration can approximate it.
-- END SOLUTION
--
-- # Refined instrumental variables
--
-- TFSRIVC estimates the output-error model
--
-- $$ y(t_k) = \frac{B(p)}{F(p)}\,u(t_k) + e(t_k) $$ {#eq:coe}
--
-- iteratively. In each iteration, TFSRIVC filters the signals with $1/F$ of the current model, computes instruments with this model, and solves
-- @eq:iv for a new model. The iterations end when the parameters converge. You do not have to choose $\lambda$.
--
-- ::: note
-- The second session begins here: *comparison and uncertainty of the methods*. Run your script (`dynlab run -i analysis.lua`). You will compare the models of the
-- first session with the model of TFSRIVC.
-- :::
--
-- **Question 10.** Estimate the model with `tfsrivc(data, np, nz, {TdMax = 0})`, where `np` and `nz` are the numbers of poles and zeros. `TdMax` is
-- the largest delay; with 0, the method does not search for a delay. `present` displays the parameters with their standard errors: compare
-- `present(Gtf)` with `present(Go)`. Compare the estimates of all methods with the true parameters.

-- %% id=tfsrivc
-- BEGIN SOLUTION
local Gtf = tfsrivc(data, 2, 0, {TdMax = 0})
present(Gtf)
present(Go)  -- the true system, without standard errors

local function miss(G) return lsim(G, u, Ts) - x end
local misses = plot(data.t, miss(Glssvf), "LSSVF", data.t, miss(Givsvf), "IVSVF",
                    data.t, miss(Gtf), "TFSRIVC",
                    {height = 5.5, xlabel = "time (s)", ylabel = "output − x",
                     dash = {1, 2, 0}})
report.figure("errors", misses, "Simulated outputs minus the noise-free output")
-- END SOLUTION

-- %% id=tfsrivc_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local function with_error(G, i)
    return string.format("%.2f ± %.2f", G.param[i], G.std[i])
end
local function model_row(name, G)
    return {name, with_error(G, 1), with_error(G, 2), with_error(G, 3),
            string.format("%.1f", fit(data, G)), string.format("%.1f", fit(data0, G))}
end
report.table("methods", {
    {"method", "$a_1$", "$a_2$", "$b_0$", "fit to $y$ (%)", "fit to $x$ (%)"},
    {"truth", true_cell(1), true_cell(2), true_cell(3), string.format("%.1f", fit(data, Go)), "100"},
    model_row("LSSVF", Glssvf), model_row("IVSVF", Givsvf), model_row("TFSRIVC", Gtf),
})
report.value("iterations", Gtf.report.iterations, "%d")
report.value("possible_fit", fit(data, Go), "%.1f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=methods #tbl:methods}
-- The three methods (± one standard error). The fits compare the simulated output with the measured output $y$ and with the noise-free output $x$.
-- :::
--
-- ![Simulated outputs of the three models minus the noise-free output $x$; for a perfect model, the difference is zero. The peak of $x$ is about 0.7.](figure:errors){#fig:errors}
--
-- TFSRIVC needed `iterations`{.value} iterations. Note two facts in @tbl:methods. First, a fit near `possible_fit`{.value} % does not indicate a bad
-- model: the true system has the same fit, because the remaining error is noise. Second, the fits to the measured output are similar for all three
-- models, although the parameters differ. The noise-free output, which is available only in a simulation, shows the difference (@fig:errors). For a
-- single data set, chance determines which of the two instrumental-variable methods is closer to the true parameters.
-- END SOLUTION
--
-- # Two hundred data sets
--
-- **Question 11.** With a single data set, a method can appear accurate by chance. Repeat the experiment 200 times with $\sigma = 0.2$ for the three
-- methods. Use $\lambda = 3$ for LSSVF and IVSVF. Which methods are biased? Which method has the smallest scatter? Are the reported standard errors
-- correct?

-- %% id=monte_carlo
-- BEGIN SOLUTION
local methods = {{"lssvf", {2, 1, 0}, 3, label = "LSSVF"},
                 {"ivsvf", {2, 1, 0}, 3, label = "IVSVF"},
                 {"tfsrivc", 2, 0, {TdMax = 0}, label = "TFSRIVC"}}
local low = study(0.2, methods)
report.figure("histograms", low:histograms(), "200 data sets with σ = 0.2")
-- END SOLUTION

-- %% id=monte_carlo_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local function study_rows(study)
    local function with_bound(i)
        return string.format("%g (%.3f)", truth[i], study.TFSRIVC.cramer_rao_std[i])
    end
    local list = {{"method", "$a_1$", "$a_2$", "$b_0$", "std. error, $a_1$"},
                  {"truth, bound", with_bound(1), with_bound(2), with_bound(3), ""}}
    for _, name in ipairs{"LSSVF", "IVSVF", "TFSRIVC"} do
        local result = study[name]
        table.insert(list, {name, mean_and_std(result, 1), mean_and_std(result, 2), mean_and_std(result, 3),
                            string.format("(%.3f)", result.reported_std[1])})
    end
    return list
end
report.table("low", study_rows(low))
report.value("ls_bias", abs(low.LSSVF.bias[1])/low.LSSVF.std[1], "%.1f")
report.value("ls_over", low.LSSVF.reported_std[1]/low.LSSVF.std[1], "%.2f")
report.value("iv_over", low.IVSVF.reported_std[1]/low.IVSVF.std[1], "%.2f")
report.value("tf_over", low.TFSRIVC.reported_std[1]/low.TFSRIVC.std[1], "%.2f")
report.value("tf_bound", low.TFSRIVC.std[1]/low.TFSRIVC.cramer_rao_std[1], "%.2f")
report.value("iv_more", 100*(low.IVSVF.std[1]/low.TFSRIVC.std[1] - 1), "%.0f")
report.value("std_error", 100/math.sqrt(2*(low.runs - 1)), "%.0f")
-- both methods use the same data, so the ratio of the standard deviations is more accurate than each standard deviation
local iv, tf_ = low.IVSVF.theta:col(1), low.TFSRIVC.theta:col(1)
local correlation = mean((iv - mean(iv))*(tf_ - mean(tf_)))/(std(iv)*std(tf_))
report.value("iv_more_error", 100*math.sqrt((1 - math.min(correlation, 1)^2)/(low.runs - 1)), "%.0f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=low #tbl:low}
-- $\sigma = 0.2$: mean over 200 data sets and, in parentheses, the standard deviation. The first row contains the true values and the Cramér–Rao
-- bound, which is the smallest possible standard deviation of an unbiased method. The last column is the mean of the standard errors that the method
-- reported for $a_1$.
-- :::
--
-- ![The estimates from 200 data sets with $\sigma = 0.2$, one row for each method and one column for each parameter; dashed: the true values. The histograms of LSSVF are narrow, but do not contain the true values.](figure:histograms){#fig:histograms}
--
-- * LSSVF has a small scatter around a wrong value: the bias of $\hat a_1$ is `ls_bias`{.value} times the scatter. A narrow histogram alone does not
--   indicate a good method.
-- * The estimates of IVSVF are centered on the true values. Their scatter is `iv_more`{.value}\ ±\ `iv_more_error`{.value} % larger than the scatter
--   of TFSRIVC, because the filter is not exactly optimal.
-- * The estimates of TFSRIVC are also centered on the true values, and their scatter is `tf_bound`{.value} times the Cramér–Rao bound. The
--   uncertainty of a standard deviation from 200 runs is `std_error`{.value} %. Within this uncertainty, no unbiased method can be more accurate.
-- * The standard errors of IVSVF and TFSRIVC are reliable: on average, they are `iv_over`{.value} and `tf_over`{.value} times the scatter. The
--   standard errors of LSSVF are `ls_over`{.value} times the scatter, because their formula assumes a white equation error. @fig:color shows that the
--   equation error is not white. In addition, standard errors never include the bias.
-- END SOLUTION
--
-- **Question 12.** Double the noise to $\sigma = 0.4$. How do the estimates of the three methods change?
--
-- First, enter a prediction: by what factor does the bias of LSSVF grow? `reveal` prints your prediction next to the result.

-- %% id=noise_guess
-- BEGIN SOLUTION
-- STARTER: predict_first("growth of the bias of a1", nil)
predict_first("growth of the bias of a1", 4)
-- END SOLUTION

-- %% id=more_noise
-- BEGIN SOLUTION
local high = study(0.4, methods)
-- one panel for each method, with the true value and the 95 % ellipse
local C, phi = high.TFSRIVC.cramer_rao, linspace(0, 2*math.pi, 91)
local va, cab, vb = C:at(1, 1), C:at(1, 3), C:at(3, 3)
local r = math.sqrt(-2*math.log(0.05))    -- contains 95 %
local ellipse_a = 4 + r*math.sqrt(va)*cos(phi)
local ellipse_b = 2 + r*(cab/math.sqrt(va)*cos(phi)
                         + math.sqrt(vb - cab^2/va)*sin(phi))
local function cloud(name)
    local theta = high[name].theta
    return plot(theta:col(1), theta:col(3), ellipse_a, ellipse_b,
                {style = {"points", "line"}, color = {5, 2}, dash = 0,
                 title = name, x_range = {1, 8}, y_range = {0.5, 4},
                 xlabel = "a_{1}", ylabel = "b_{0}"}):mark(4, 2, "truth")
end
local panels = subplot(1, 3, {cloud("LSSVF"), cloud("IVSVF"), cloud("TFSRIVC")})
report.figure("scatter", panels:set{height = 6}, "200 data sets with σ = 0.4")
reveal("growth of the bias of a1", high.LSSVF.bias[1]/low.LSSVF.bias[1])
-- END SOLUTION

-- %% id=more_noise_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
report.table("high", study_rows(high))
local function offset(study)
    return abs(study.LSSVF.bias[1])
end
report.value("ls_low", 100*offset(low)/truth[1], "%.0f")
report.value("ls_high", 100*offset(high)/truth[1], "%.0f")
report.value("ls_growth", offset(high)/offset(low), "%.1f")
report.value("tf_growth", high.TFSRIVC.std[1]/low.TFSRIVC.std[1], "%.2f")
report.value("tf_failures", high.TFSRIVC.failed + high.TFSRIVC.not_converged, "%d")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=high #tbl:high}
-- $\sigma = 0.4$: mean and standard deviation. @tbl:low explains the columns.
-- :::
--
-- ![$\hat b_0$ versus $\hat a_1$ from 200 data sets with $\sigma = 0.4$, one panel for each method; marked: the true value. The ellipse would contain 95 % of the estimates of the best unbiased method. The cloud of LSSVF is outside the ellipse.](figure:scatter){#fig:scatter}
--
-- The bias of LSSVF grows from `ls_low`{.value} % of $a_1$ to `ls_high`{.value} % (@tbl:high), by a factor of `ls_growth`{.value}. A factor of four
-- is the natural prediction, because the bias comes from the variance of the noise. However, the noise also affects the inverse matrix. For many
-- samples, the least-squares estimate converges to $(R + \sigma^2 E)^{-1} R\,\theta$ instead of $\theta$. $R$ and $E$ are the covariances of the
-- noise-free regressors and of their noise for $\sigma = 1$ (lesson 2). The bias is proportional to $\sigma^2$ only if $\sigma^2 E$ is small compared
-- with $R$. For more noise, the bias saturates, and it never exceeds 100 %. The means of IVSVF and TFSRIVC remain near the true values. Their scatter
-- grows with the noise, for TFSRIVC by a factor of `tf_growth`{.value}. The number of data sets for which TFSRIVC did not converge is
-- `tf_failures`{.value}. @fig:scatter also shows that the errors of $\hat a_1$ and $\hat b_0$ are correlated. If the model is too fast, $\hat b_0$ is
-- also too large, so the gain $b_0/a_2$, which the data determine well, is correct.
-- END SOLUTION
--
-- **Question 13.** LSSVF requires an assumption about the measured output between the samples: piecewise linear (`hold_y = "foh"`, as in your
-- program) or constant (`hold_y = "zoh"`). Does its bias depend on this assumption?

-- %% id=hold
-- BEGIN SOLUTION
local holds = study(sigma, {
    {"lssvf", {2, 1, 0}, 3, {hold_y = "foh"}, label = "piecewise linear"},
    {"lssvf", {2, 1, 0}, 3, {hold_y = "zoh"}, label = "constant"},
})
local held0 = lssvf(data0, {2, 1, 0}, 3, {hold_y = "zoh"})
-- END SOLUTION

-- %% id=hold_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local hold_rows = {{"output between samples", "$a_1$", "$a_2$", "$b_0$"}, {"truth", true_cell(1), true_cell(2), true_cell(3)}}
for _, name in ipairs(holds.labels) do
    local result = holds[name]
    table.insert(hold_rows, {name, mean_and_std(result, 1), mean_and_std(result, 2), mean_and_std(result, 3)})
end
table.insert(hold_rows, cells("constant, without noise", held0.param))
report.table("holds", hold_rows)
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=holds #tbl:holds}
-- LSSVF with two assumptions about the output between the samples, $\sigma = 0.2$: mean over 200 data sets and, in parentheses, the standard
-- deviation.
-- :::
--
-- The bias depends on this assumption; even its sign changes (@tbl:holds). White noise is defined only at the sampling instants, so the filtered
-- noise depends on the assumption about the noise between the samples. A zero-order hold of the output causes an error even without noise, because it
-- delays the output by half a sample. This part of the error is small for these data. Two correct LSSVF programs can therefore return different
-- estimates from the same noisy data. TFSRIVC does not depend on this assumption. It minimizes the error of the simulated output, which does not
-- contain $y$ between the samples.
-- END SOLUTION
--
-- # Why not discrete time?
--
-- Why not estimate a difference equation from the samples, as most programs do, and convert it to continuous time? For an input that is constant
-- between the samples, the sampled true system is
--
-- $$ x(t_k) + \alpha_1 x(t_{k-1}) + \alpha_2 x(t_{k-2}) = \beta_1 u(t_{k-1}) + \beta_2 u(t_{k-2}) , $$ {#eq:sampled}
--
-- and `c2d` and `d2c` convert between continuous and discrete time.
--
-- **Question 14.** Estimate the difference equation with `arx(data, {2, 2, 1})`: two poles, two coefficients of the input and one sample of delay, as
-- in @eq:sampled. Use the noise-free and the noisy data. Which of the models can `d2c` convert? (`print(pcall(d2c, G))` continues after an error; it
-- prints true if the conversion succeeds.) Compare these models with the model of `oe(data, {2, 2, 1})`, which minimizes the error of the simulated
-- output.

-- %% id=discrete
-- BEGIN SOLUTION
print("poles of the sampled true system:", pole(c2d(Go, Ts)))
print("arx without noise, converted, F:", d2c(arx(data0, {2, 2, 1})).den)

local Garx, Goe = arx(data, {2, 2, 1}), oe(data, {2, 2, 1})
print("poles of the arx model:", pole(Garx))
print("poles of the oe model: ", pole(Goe))
print("d2c can convert the noisy arx model:", (pcall(d2c, Garx)))
local t = linspace(0, 6, 601)
local answers = plot(t, step(Go, t), "truth", t, step(Garx, t), "arx",
                     t, step(Goe, t), "oe",
                     {height = 5.5, dash = {0, 1, 2}, color = {0, 1, 3},
                      xlabel = "time (s)", ylabel = "step response"})
report.figure("discrete", answers, "Step responses of the discrete-time models")
-- END SOLUTION

-- %% id=discrete_one_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
report.value("step_ratio", sigma/std(diff(x)), "%.0f")
report.value("weight1", -Garx.A[2], "%.2f")
report.value("weight2", -Garx.A[3], "%.2f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ![Step responses of the true system and of the difference equations that `arx` and `oe` estimated from the noisy data. The response of the `arx` model rises immediately and approaches a wrong level.](figure:discrete){#fig:discrete}
--
-- Without noise, `arx` and `d2c` reproduce the true system. With this noise, the `arx` model is useless (@fig:discrete). `arx` minimizes the error of
-- the *one-step-ahead prediction* from the last two samples. The noise is `step_ratio`{.value} times larger than the change of the output from one
-- sample to the next. The best prediction is then close to an average of the last two samples for any system: the weights are `weight1`{.value} and
-- `weight2`{.value}. One pole is negative. `d2c` cannot convert this model, because a sampled second-order differential equation does not have a
-- single negative real pole.
-- END SOLUTION
--
-- **Question 15.** Is this result specific to one data set? `montecarlo` also accepts functions of the data as estimators. Is the cause the fast
-- sampling or the noise? Repeat the experiment with several sampling times and signal-to-noise ratios.

-- %% id=discrete_study
-- BEGIN SOLUTION
local refused = 0
local discrete = study(sigma, {
    {"arx", function(d)
        local G = arx(d, {2, 2, 1})
        if not pcall(d2c, G) then refused = refused + 1 end
        return sort(pole(G).re)
    end},
    {"oe", function(d)
        return d2c(oe(d, {2, 2, 1}, {InitialState = "none", Offset = "none"}))
    end},
})
print(string.format("d2c failed for %d of %d arx models", refused, discrete.runs))

-- arx estimates of a1 from 100 data sets, for the models that d2c can convert
local function arx_a1(period, snr)
    local found = {}
    local function estimate(d)
        local ok, G = pcall(d2c, arx(d, {2, 2, 1}))
        if ok then table.insert(found, G.den[2]/G.den[1]) end
        return vector{ok and 1 or 0}
    end
    local bit = math.floor(1/period + 0.5)
    montecarlo{system = Go, input = prbs(4, bit), Ts = period, snr = snr,
               runs = 100, estimators = {{"arx", estimate}}};
    return found
end
-- END SOLUTION

-- %% id=discrete_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
report.value("sampled_slow", max(pole(c2d(Go, Ts)).re), "%.3f")
report.value("sampled_fast", min(pole(c2d(Go, Ts)).re), "%.3f")
report.value("arx_slow", discrete.arx.mean[2], "%.3f")
report.value("arx_fast", discrete.arx.mean[1], "%.3f")
report.value("arx_slow_std", discrete.arx.std[2], "%.3f")
report.value("arx_fast_std", discrete.arx.std[1], "%.3f")
report.value("refused", refused, "%d")
report.table("discrete", {
    {"method", "$a_1$", "$a_2$", "$B$: coefficient of $p$", "$B$: constant"},
    {"truth", true_cell(1), true_cell(2), "0", true_cell(3)},
    {"OE, converted", mean_and_std(discrete.oe, 1), mean_and_std(discrete.oe, 2), mean_and_std(discrete.oe, 3),
     mean_and_std(discrete.oe, 4)},
    {"TFSRIVC", mean_and_std(low.TFSRIVC, 1), mean_and_std(low.TFSRIVC, 2), "none", mean_and_std(low.TFSRIVC, 3)},
})
report.value("oe_more", discrete.oe.std[1]/low.TFSRIVC.std[1], "%.1f")
local periods, ratios = {0.01, 0.05, 0.1, 0.2, 0.3}, {5, 15, 25, 35, 45}
local grid = {{"$T_s$ (s)"}}
for _, snr in ipairs(ratios) do table.insert(grid[1], snr .. " dB") end
for i, period in ipairs(periods) do
    grid[i + 1] = {tostring(period)}
    for _, snr in ipairs(ratios) do
        local found = arx_a1(period, snr)
        table.insert(grid[i + 1], #found < 90 and #found .. " of 100" or
                     string.format("%.2f (%.2f)", mean(vector(found)), std(vector(found))))
    end
end
report.table("grid", grid)
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- The result is not specific to one data set. `d2c` could not convert `refused`{.value} of the 200 models of `arx`. The poles of the `arx` models are
-- `arx_slow`{.value}\ ±\ `arx_slow_std`{.value} and `arx_fast`{.value}\ ±\ `arx_fast_std`{.value} instead of `sampled_slow`{.value} and
-- `sampled_fast`{.value}.
--
-- ::: {.table name=grid #tbl:grid}
-- `arx` with other sampling times and signal-to-noise ratios: mean and, in parentheses, standard deviation of $\hat a_1$ over 100 data sets. If fewer
-- than 90 of the models can be converted, the table contains the number of these models. The true value is 4.
-- :::
--
-- Fast sampling and noise both contribute, but the noise is the main cause (@tbl:grid). At 5 dB, as in these data, no sampling time helps: the regressors contain the noise
-- of $y$, as in LSSVF, but no filter attenuates it. At 25 dB, models from data with slower sampling can be converted, but they are strongly biased.
-- The sampling time matters only if there is almost no noise: at 45 dB, `arx` fails at 0.01 s and is almost correct from 0.2 s on. The relevant ratio
-- is the noise relative to the change of the output from one sample to the next. The solution is the correct noise model, not another sampling time.
--
-- ::: {.table name=discrete #tbl:discrete}
-- $\sigma = 0.2$: mean over 200 data sets and, in parentheses, the standard deviation.
-- :::
--
-- Like TFSRIVC, `oe` minimizes the simulation error, and its estimates are close to the true system. However, a sampled second-order system always
-- has two coefficients of the input (@eq:sampled), even if the continuous-time system has no zeros. A discrete-time model cannot represent a constant
-- numerator and must estimate the second coefficient. As a result, the scatter of $\hat a_1$ is `oe_more`{.value} times the scatter of TFSRIVC
-- (@tbl:discrete). In addition, faster sampling moves the poles closer to $z = 1$, so the information about the time constants is in the last digits
-- of the coefficients. A continuous-time model has the same meaning for every sampling time.
-- END SOLUTION
--
-- # How many poles?
--
-- **Question 16.** So far, the orders were known. `srivcstruc` estimates models of several orders and recommends one. Does it select two poles and no
-- zeros from the data?

-- %% id=orders
-- BEGIN SOLUTION
local orders = srivcstruc(data, {poles = {1, 3}, zeros = {0, 1}})
print(orders.recommendation)
-- END SOLUTION

-- %% id=orders_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local order_rows = {{"poles", "zeros", "fit (%)", "$R_T^2$", "YIC", "BIC", "undetermined"}}
for _, row in ipairs(orders.rows) do
    table.insert(order_rows, {tostring(row.poles), tostring(row.zeros), string.format("%.2f", row.fit_percent),
                 string.format("%.4f", row.r_squared), string.format("%.2f", row.yic), string.format("%.4f", row.bic),
                 table.concat(row.undetermined, ", ")})
end
report.table("orders", order_rows)
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=orders #tbl:orders}
-- Transfer functions of several orders for the noisy data. Large values of the fit and of $R_T^2$, the fraction of the output variance that the model
-- explains, are better. Small values of YIC and BIC are better. The last column lists the parameters whose standard error is larger than their
-- absolute value.
-- :::
--
-- Yes, it does (@tbl:orders). The fit changes very little beyond two poles: additional parameters describe the noise and not the system. BIC is the
-- logarithm of the error variance plus $\ln N/N$ for each parameter. YIC (Young's information criterion) combines the unexplained variance with the
-- relative variance of the parameters. YIC alone would select one pole, because the data determine a model with two parameters most accurately. Use
-- several measures, and validation data if they are available.
-- END SOLUTION

-- %% [markdown]
-- # Try it: λ by hand
--
-- On a page (`dynlab preview`, or `dynlab report` with an output that ends in `.html`) the slider under the next cell, or the marked point of
-- @fig:lambda_by_hand, changes the cutoff frequency $\lambda$ of the filter. Observe how the filter colors the equation error, and how the estimates
-- from sixty data sets change. For which $\lambda$ is the cloud of LSSVF not centered on the true value? For which $\lambda$ is the cloud of
-- IVSVF not centered on the true value?

-- %% id=lambda_by_hand
do
    local lambda = slider("lambda", 3, 0.3, 30,
                          {log = true, unit = "rad/s", label = "λ"})
    local color = (s^2 + 4*s + 3)/(s + lambda)^2
    local w = 10^linspace(-2, 3, 101)
    local weight = plot(w, freqresp(color, w).abs,
                        {x_log = true, y_log = true, y_range = {1e-3, 1e3},
                         xlabel = "frequency (rad/s)", ylabel = "weight |A/E|"})
    weight:hline(1, "E = A")
    weight:handle{x = function(lambda) return lambda end, x_slider = "lambda",
                  y = freqresp(color, {lambda}).abs[1], text = "λ"}
    local M = montecarlo{system = Go, input = u, Ts = Ts, sigma = 0.2, runs = 60,
        estimators = {{"lssvf", {2, 1, 0}, lambda, label = "LSSVF"},
                      {"ivsvf", {2, 1, 0}, lambda, label = "IVSVF"}}}
    local cloud = M:scatter("a1", "b0"):set{x_range = {0, 8}, y_range = {0, 4}}
    report.figure("lambda_by_hand", subplot(1, 2, {weight, cloud}):set{height = 8},
                  "The filter and the estimates")
end

-- %% [markdown]
-- ![For the $\lambda$ of the cell above: left, the magnitude $|A/E|$ by which the filter colors the equation error; right, $\hat b_0$ versus $\hat a_1$ from sixty data sets, and the ellipse that would contain 95 % of the estimates of the best unbiased method](figure:lambda_by_hand){#fig:lambda_by_hand}

-- %% [markdown]
-- ## The same study in the workbench
--
-- `dynlab app` opens an empty session in the workbench in the browser (@fig:workbench). Under **Known system**, press **Start study**. The study
-- contains the system of @eq:system, an input, noise, and SRIVC. Drag **noise**: the cloud and the ellipse grow together. Add
-- `lssvf = {{2, 1, 0}, 3}` to the list of **estimators** and drag **noise** again: the cloud of LSSVF moves away from the true value. The table below
-- the figure compares the scatter with the Cramér–Rao bound. The script `session.lua` contains your steps. With `dynlab app crane`, you can identify
-- the crane in the same way.
--
-- ![A study of the known system in the workbench: controls, the cloud of estimates with the ellipse, and the script](workbench.png){#fig:workbench}

-- %% [markdown]
-- # What you have learned
--
-- BEGIN SOLUTION
-- * State-variable filters turn a differential equation into a linear regression without differentiation. LSSVF solves this regression by least
--   squares. The estimate is accurate without noise and biased with noise, and the bias grows with the noise.
-- * Instruments that are independent of the noise remove the bias if the number of samples is large: the estimates are consistent. The scatter of
--   IVSVF still depends on the filter that you choose. With an unsuitable filter and few samples, the scatter is so large that even the mean is
--   wrong.
-- * TFSRIVC determines the filter in a few iterations. For these data, there is no significant bias, the scatter is close to the Cramér–Rao bound,
--   and the reported standard errors are correct.
-- * You cannot assess a method with a single data set. Repeat the experiment in simulation, compute the mean *and* the scatter, and compare them with
--   the true value and the Cramér–Rao bound [@ljung1999, section 7.4].
-- * `arx` assumes white noise that is filtered by $1/A$. With noise added to the output, the `arx` estimate is biased at every sampling time. With
--   faster sampling, a smaller amount of noise is sufficient to make the estimate useless. Output-error models in discrete or continuous time do not
--   have this problem. For continuous-time models, fast sampling is an advantage.
-- END SOLUTION
--
-- # What you submit
--
-- ::: {.note}
-- If this lesson is graded, submit results with `answer(name, value)`. `dynlab check` lists missing answers:
--
-- * `own_without_noise` and `own`: the estimates $a_1$, $a_2$, $b_0$ of your LSSVF from the data without and with noise;
-- * `record`: the data with noise;
-- * `G_lssvf` and `G_ivsvf`: the models that `lssvf` and `ivsvf` estimate from these data with $\lambda = 3$;
-- * `G_final`: the model that you recommend;
-- * `scatter`: the standard deviations of $a_1$, $a_2$ and $b_0$ of the recommended method in your Monte Carlo study.
-- :::

-- %% id=hand_in
-- BEGIN SOLUTION
answer("own_without_noise", own0)
answer("own", own)
answer("record", data)
answer("G_lssvf", Glssvf)
answer("G_ivsvf", Givsvf)
answer("G_final", Gtf)
answer("scatter", low.TFSRIVC.std)
-- END SOLUTION

-- %% [markdown]
-- # Appendix: measures and literature
--
-- ::: measures
-- fit, RT2, YIC, BIC, Cramer-Rao
-- :::
--
-- ::: references
-- :::
