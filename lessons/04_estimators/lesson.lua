-- ---
-- title: Continuous-time models from noisy data
-- subtitle: Lesson 4 – LSSVF, IVSVF and TFSRIVC on a system that is known
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
-- with instruments (IVSVF), and the refined instrumental variables of TFSRIVC [@young2011]. Which of them can you believe? For a real plant, the
-- answer is unknown. All data of this lesson are therefore simulated. The system is given and the computer generates the noise, so you can compare
-- every estimate with the truth, once and then two hundred times.
--
-- `dynlab demo` shows the methods in short guided tours. Run one before you start, or when you want to see more.
--
-- The work is planned for two sessions of three hours:
--
-- | session | questions, with minutes | aim |
-- |--------------|-------------------------|------------------------|
-- | Regressions and their bias | 1 (5), 2 (15), 3 (20), 4 (35), 5 (20), 6 (15), 7 (25), 8 (25), 9 (20) | write an estimator, see its bias, remove it by instruments, and understand the effect of the filter |
-- | Which method, and how certain | 10 (25), 11 (35), 12 (25), 13 (20), 14 (25), 15 (30), 16 (20) | compare methods over many data sets with the best possible method, and with discrete time |
--
-- # The system and its data
--
-- ## The true system
--
-- The input $u$ drives a second-order system. Its output $x$ is sampled every $T_s$ seconds and measured with an error,
--
-- $$ x(t) = \frac{B_o(p)}{F_o(p)}\,u(t), \qquad y(t_k) = x(t_k) + e(t_k), $$ {#eq:system}
--
-- with $B_o(p) = 2$ and $F_o(p) = p^2 + 4p + 3$, where $p$ means $\mathrm{d}/\mathrm{d}t$ and the $e(t_k)$ are independent, Gaussian, of mean zero
-- and standard deviation $\sigma$.
--
-- **Question 1.** Which model structure does @eq:system have: CARX, COE or CBJ? (CARX: $A\,y = B\,u + e$; COE: $y = \frac{B}{F}\,u + e$; CBJ: $y = \frac{B}{F}\,u + \frac{C}{D}\,e$.)
--
-- BEGIN SOLUTION
-- COE, a continuous-time output-error structure. The disturbance is added to the output. It passes neither through $1/F_o$, as in CARX, nor through a
-- separate noise model, as in CBJ.
-- END SOLUTION
--
-- **Question 2.** What are the system's main features: steady-state gain, poles, time constants with their corner frequencies, and
-- bandwidth?

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
-- The steady-state gain is $B_o(0)/F_o(0) =$ `gain`{.value}. Two real poles at $-$`slow_corner`{.value} and $-$`fast_corner`{.value} give time
-- constants of `slow_constant`{.value} s and `fast_constant`{.value} s, and corner frequencies of `slow_corner`{.value} and `fast_corner`{.value}
-- rad/s. The slow pole dominates: the gain has already fallen by 3 dB at `band`{.value} rad/s, a little below its corner frequency. (Bandwidth here
-- means this $-3$ dB frequency. Some texts call the faster corner frequency, `fast_corner`{.value} rad/s, the band of the system.)
-- END SOLUTION
--
-- ## The data
--
-- The input is a pseudo-random binary sequence that may change once per second. The data have one period of it, with $\sigma = 0.2$, in two data
-- objects: without noise and with noise.

-- %% id=record
local Ts, N = 0.01, 1500
local sigma = 0.2
local u = prbs(4, 100)
local x = lsim(Go, u, Ts)                 -- the noise-free output
local y = x + sigma*randn(N)              -- the measured one
local signals = {InputName = "input u", OutputName = "output y"}
local data0, data = iddata(x, u, Ts, signals), iddata(y, u, Ts, signals)
report.figure("record", idplot(data, {labels = {"measured"}})
              :add(data.t, x, {label = "without noise", line_width = 1.8}),
              "The data")
local snr = 20*math.log(std(x)/sigma, 10)
print(string.format("signal-to-noise ratio: %.1f dB", snr))

-- %% [markdown]
-- ![The data. Above: the measured output (thin) and the noise-free output (thick), which a real experiment does not show. Below: the input.](figure:record){#fig:record}
--
-- These data are poor on purpose (@fig:record). Between two samples, the output changes much less than the noise. The signal-to-noise ratio of 5 dB
-- is typical of poor industrial data. We assume that the orders are known, two poles and no zero, and come back to this assumption at the end.
--
-- # Least squares on filtered signals, by hand
--
-- ## The regression
--
-- Take the CARX model $A(p)\,y(t) = B(p)\,u(t) + e(t)$ with $A(p) = p^2 + a_1 p + a_2$ and $B(p) = b_0$. Its derivatives are not measured, and
-- differentiating noisy samples is hopeless. Therefore, first pass every signal through the same filter,
--
-- $$ y_f(t) = \frac{1}{E(p)}\,y(t), \qquad u_f(t) = \frac{1}{E(p)}\,u(t), \qquad E(p) = (p + \lambda)^2 , $$ {#eq:filter}
--
-- The state of this filter contains $y_f$, $p\,y_f$ and $p^2 y_f$ without any differentiation, so it is called the *state-variable filter*.
--
-- **Question 3.** Write the model for the $N$ samples as a linear regression in matrix form, with the sizes of the matrices. What is its
-- least-squares solution?
--
-- BEGIN SOLUTION
-- The filtered signals satisfy the same equation, sample by sample,
--
-- $$ p^2 y_f(t_k) = -a_1\,p\,y_f(t_k) - a_2\,y_f(t_k) + b_0\,u_f(t_k) + \varepsilon(t_k) , $$ {#eq:solution-sample}
--
-- and for $k = 1, \dots, N$ they become $Y = \Phi\theta + \varepsilon$ with
--
-- $$ Y = \begin{pmatrix} p^2 y_f(t_1) \\ \vdots \\ p^2 y_f(t_N) \end{pmatrix}, \quad
--    \Phi = \begin{pmatrix} -p\,y_f(t_1) & -y_f(t_1) & u_f(t_1) \\ \vdots & \vdots & \vdots \\
--    -p\,y_f(t_N) & -y_f(t_N) & u_f(t_N) \end{pmatrix}, \quad
--    \theta = \begin{pmatrix} a_1 \\ a_2 \\ b_0 \end{pmatrix} , $$ {#eq:solution-matrices}
--
-- where $Y$ and $\varepsilon$ are columns of $N$ values, $\Phi$ has $N$ rows and 3 columns, and $\theta$ has 3 values. The sum of squares
-- $\lVert Y - \Phi\theta \rVert^2$ is smallest for $\hat\theta = (\Phi^T\Phi)^{-1}\Phi^T Y$. A program computes it by an orthogonal factorization of
-- $\Phi$, without forming an inverse.
-- END SOLUTION
--
-- ## Your own estimator
--
-- **Question 4.** Write your own LSSVF. `svf(x, 2, lambda, {Ts = Ts})` returns a matrix `X` with the columns $p^2 x_f$, $p\,x_f$ and $x_f$
-- (`X:col(1)` is the first). `solve(Phi, Y)` returns the least-squares solution. Between the samples, the input is constant, `hold = "zoh"`. The
-- measured output is taken as piecewise linear, `hold = "foh"`, which is the default of `svf`. Set $\lambda = 3$ rad/s and try it on the data without
-- noise.

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
-- STARTER:     return zeros(3)                   -- to be replaced by a1, a2, b0
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
-- The estimates are right within `own0_miss`{.value} %. The remaining error is not a programming error but the price of sampling: the filter
-- interpolates the output linearly between the samples, and the true output is curved. With half the sampling time, the error is `fine_ratio`{.value}
-- times smaller, as expected for an error proportional to $T_s^2$.
-- END SOLUTION
--
-- **Question 5.** Now use the data with noise. Are the estimates still close to the truth? Repeat with other noise: are the errors random, or do they
-- always have the same sign? (`dynlab run analysis.lua --seed random` runs everything with other noise.)

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
local rows = {{"record", "$a_1$", "$a_2$", "$b_0$"}, cells("truth", truth), cells("this record", own)}
for repetition, theta in ipairs(others) do
    table.insert(rows, cells(string.format("repetition %d", repetition), theta))
end
report.table("repetitions", rows)
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=repetitions #tbl:repetitions}
-- Your own LSSVF, $\lambda = 3$ rad/s: estimates from the data with noise and from five repetitions with other noise. All are below the truth.
-- :::
--
-- They are not (@tbl:repetitions), and the errors are systematic. By chance, some estimates would be above the truth and some below. But all three
-- parameters are too small, in every repetition. Least squares is *biased* here. The noise of $y$ appears on both sides of @eq:solution-sample. For
-- the true parameters the remaining equation error is
--
-- $$ \varepsilon(t) = \frac{A(p)}{E(p)}\,e(t) , $$ {#eq:solution-color}
--
-- and the columns $p\,y_f$ and $y_f$ of $\Phi$ contain the same $e$ with another filter. Regressors and error are correlated, as in the long noisy
-- data at the end of lesson 2. Longer data would not help: the bias depends on the variance of the noise, not on the number of samples.
-- END SOLUTION
--
-- ## The library's LSSVF
--
-- **Question 6.** `lssvf(data, {na, nb, nk}, lambda)` does the same for a data object: `na` poles, `nb` coefficients of $B$, `nk` samples of delay.
-- Apply it to both data objects and compare it with your own program.

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
-- Both programs give the same numbers: the largest relative difference, `agreement`{.value}, is rounding. The library is only faster, because it
-- computes the necessary sums of products while it filters, and never stores $\Phi$.
-- END SOLUTION

-- %% [markdown]
-- # Instruments
--
-- ## IVSVF
--
-- The solution is to keep the regression of question 3 and to solve it in another way. Instead of $\Phi^T Y = \Phi^T\Phi\,\theta$, solve
--
-- $$ Z^T Y = Z^T\Phi\,\theta , $$ {#eq:iv}
--
-- where the *instruments* $Z$ resemble $\Phi$ but are independent of the noise. IVSVF computes them in two steps. First, LSSVF estimates a model.
-- Then IVSVF simulates this model with the input $u$, and the simulated output replaces $y$ in the regressors.
--
-- **Question 7.** Estimate the model by `ivsvf` and compare it with LSSVF. As a bonus, write it yourself: add three lines to your own LSSVF.

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
-- The worst parameter of LSSVF misses the truth by `ls_miss`{.value} %, and the worst of IVSVF by `iv_miss`{.value} %. The instruments come from a
-- biased model, but this does not matter. They need not be right: they must be independent of the noise and resemble the regressors. The three lines
-- agree with the library (`iv_agreement`{.value} relative difference).
-- END SOLUTION
--
-- ## The choice of λ
--
-- Both methods need a number from the user, the cut-off frequency $\lambda$ of the filter. The usual choice is a little above the bandwidth of the
-- system, which is unknown for a real plant.
--
-- **Question 8.** How sensitive is IVSVF to this choice? Compare $\lambda = 0.3$, 3 and 30 rad/s. One data set says little. `montecarlo` repeats the
-- experiment with new noise as often as you like (`dynlab help montecarlo`).

-- %% id=lambda
-- BEGIN SOLUTION
local function study(sigma, estimators)
    return montecarlo{system = Go, input = u, Ts = Ts, sigma = sigma,
                      runs = 200, estimators = estimators}
end
local filters = study(sigma, {{"ivsvf", {2, 1, 0}, 30, label = "λ = 30"},
                              {"ivsvf", {2, 1, 0}, 3, label = "λ = 3"},
                              {"ivsvf", {2, 1, 0}, 0.3, label = "λ = 0.3"}})
-- the same picture twice: all estimates, and the middle enlarged
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
local lambda_rows = {{"$\\lambda$ (rad/s)", "$a_1$", "$a_2$", "$b_0$", "largest $a_1$", "reported, $a_1$"},
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
-- ![IVSVF with three filters, 200 estimates each: $\hat a_2$ over $\hat a_1$. Above: all estimates. Below: the center enlarged, with the true value (4, 3) and the ellipse that contains 95 % of the estimates of the best possible unbiased method. Only $\lambda = 3$ stays close to it.](figure:lambda){#fig:lambda}
--
-- IVSVF is very sensitive (@tbl:lambda, @fig:lambda). Over `runs`{.value} data sets, the scatter of $\hat a_1$ is `low_ratio`{.value} times larger
-- with $\lambda = 0.3$ and `high_ratio`{.value} times larger with $\lambda = 30$ than with $\lambda = 3$. Some data sets give nonsense. Also note the
-- means: `low_mean`{.value}\ ±\ `low_mean_error`{.value} and `high_mean`{.value}\ ±\ `high_mean_error`{.value} (± the standard error of a mean of
-- `runs`{.value}) are significantly above 4. Instrumental variables are *consistent*: they converge to the truth as the number of samples grows. With
-- a finite number of noisy samples, they are not exactly unbiased.
-- END SOLUTION
--
-- **Question 9.** Why? Put the true parameters into the regression: how does the filter color the remaining noise, and which filter is the best one?
-- (`freqresp(G, w).abs` returns the magnitude of a transfer function.)

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
-- ![How the filter colors the equation error: the magnitude $|A/E|$, which multiplies white measurement noise, for three values of $\lambda$ (solid: 3 rad/s) and for the best filter, $E = A$, which keeps it white](figure:color){#fig:color}
--
-- The regression gives all samples of $\varepsilon$ the same weight, which is optimal if they are white. By @eq:solution-color, $\varepsilon$ is the
-- white noise $e$ filtered by $A/E$ (@fig:color). With $\lambda = 0.3$, the slow part of the noise is much larger than the rest. The filter's memory
-- is so long that the data contain little more than its transient. With $\lambda = 30$, nearly all of the noise is at frequencies where the system no
-- longer responds, and it hides the information about the slow pole. Of the three, $\lambda = 3$ is closest to a constant magnitude. The magnitude is
-- constant for $E = A$: the best filter is $1/A$, with the denominator of the system. Among the filters $(p+\lambda)^2$, the one nearest to
-- $A = p^2 + 4p + 3$ has $\lambda = \sqrt 3 \approx 1.7$, where the constant terms agree. Over `many_runs`{.value} data sets, its scatter in
-- $\hat a_1$ is `root_std`{.value}, and the scatter for $\lambda = 3$ is `three_std`{.value}. $A$ is unknown, but you can approach it in steps.
-- END SOLUTION
--
-- # Refined instrumental variables
--
-- TFSRIVC estimates the output-error model
--
-- $$ y(t_k) = \frac{B(p)}{F(p)}\,u(t_k) + e(t_k) $$ {#eq:coe}
--
-- iteratively. It filters with $1/F$ of the current model, computes instruments with the same model, and solves @eq:iv. It repeats this with the new
-- model until the parameters converge. There is no $\lambda$ to choose.
--
-- ::: note
-- The second session begins here: *which method, and how certain*. Run your script (`dynlab run -i analysis.lua`). You will compare the models of the
-- first session with the new one.
-- :::
--
-- **Question 10.** Estimate the model by `tfsrivc(data, np, nz, {TdMax = 0})`, where `np` and `nz` are the numbers of poles and zeros. The largest
-- delay is zero, so the method does not search for a delay. `present` shows the parameters with their standard errors: compare `present(Gtf)` with
-- `present(Go)`. Compare all methods with the truth.

-- %% id=tfsrivc
-- BEGIN SOLUTION
local Gtf = tfsrivc(data, 2, 0, {TdMax = 0})
present(Gtf)
present(Go)  -- the truth in the same form, without errors

local function miss(G) return lsim(G, u, Ts) - x end
local misses = plot(data.t, miss(Glssvf), "LSSVF", data.t, miss(Givsvf), "IVSVF",
                    data.t, miss(Gtf), "TFSRIVC",
                    {height = 5.5, xlabel = "time (s)", ylabel = "output − x",
                     dash = {1, 2, 0}})
report.figure("errors", misses, "Simulated outputs less the noise-free output")
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
-- The three methods (± one reported standard error). The fits compare the simulated output with the measured output $y$ and with the noise-free
-- output $x$.
-- :::
--
-- ![Simulated outputs of the three models minus the noise-free output $x$; a perfect model would give zero. The peak of $x$ is about 0.7.](figure:errors){#fig:errors}
--
-- TFSRIVC needed `iterations`{.value} iterations. Note two things in @tbl:methods. A fit near `possible_fit`{.value} % does not mean a bad model: the
-- true system itself reaches no more, because the rest is noise. And the fits to the measured output are similar for all three models, although their
-- parameters are not. The noise-free output, which only a simulation has, shows the difference (@fig:errors). For one data set, chance decides which
-- of the two instrumental-variable methods is closer to the truth.
-- END SOLUTION
--
-- # Two hundred data sets
--
-- **Question 11.** One data set can make a method look good by chance. Repeat the experiment 200 times with $\sigma = 0.2$ for the three methods,
-- with $\lambda = 3$ for the methods that need it. Which methods are biased? Which method has the smallest scatter? Are the reported standard errors
-- right?

-- %% id=monte_carlo
-- BEGIN SOLUTION
local methods = {{"lssvf", {2, 1, 0}, 3, label = "LSSVF"},
                 {"ivsvf", {2, 1, 0}, 3, label = "IVSVF"},
                 {"tfsrivc", 2, 0, {TdMax = 0}, label = "TFSRIVC"}}
local low = study(0.2, methods)
report.figure("histograms", low:histograms(), "200 records with σ = 0.2")
-- END SOLUTION

-- %% id=monte_carlo_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local function study_rows(study)
    local function with_bound(i)
        return string.format("%g (%.3f)", truth[i], study.TFSRIVC.cramer_rao_std[i])
    end
    local list = {{"method", "$a_1$", "$a_2$", "$b_0$", "reported, $a_1$"},
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
-- both methods use the same data, so the ratio of their scatters is more certain than each of them
local iv, tf_ = low.IVSVF.theta:col(1), low.TFSRIVC.theta:col(1)
local correlation = mean((iv - mean(iv))*(tf_ - mean(tf_)))/(std(iv)*std(tf_))
report.value("iv_more_error", 100*math.sqrt((1 - math.min(correlation, 1)^2)/(low.runs - 1)), "%.0f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=low #tbl:low}
-- $\sigma = 0.2$: mean over 200 data sets and, in parentheses, the standard deviation. First row: the truth and the Cramér–Rao bound, which is the
-- smallest possible standard deviation of an unbiased method. Last column: the mean of the standard errors that the method reported for $a_1$.
-- :::
--
-- ![The estimates from 200 data sets with $\sigma = 0.2$, one row for each method and one column for each parameter; dashed: the truth. The histograms of LSSVF are narrow and miss the truth.](figure:histograms){#fig:histograms}
--
-- * LSSVF has a small scatter around a wrong value: on average it misses $a_1$ by `ls_bias`{.value} times its scatter. A narrow histogram alone is no
--   merit.
-- * IVSVF is centered on the truth. Its scatter is `iv_more`{.value}\ ±\ `iv_more_error`{.value} % above that of TFSRIVC, because its filter is not
--   quite the best.
-- * TFSRIVC is also centered on the truth, and its scatter is `tf_bound`{.value} times the Cramér–Rao bound. A standard deviation from 200 runs is
--   itself uncertain by `std_error`{.value} %. Within this uncertainty, no method can extract more from these data.
-- * You can trust the errors that IVSVF and TFSRIVC report: on average they are `iv_over`{.value} and `tf_over`{.value} times the true scatter. The
--   errors of LSSVF are `ls_over`{.value} times the true scatter, because their formula assumes a white equation error. @fig:color shows that the
--   error is not white. Above all, standard errors do not include the bias.
-- END SOLUTION
--
-- **Question 12.** Double the noise to $\sigma = 0.4$. What happens to the three methods?
--
-- First, enter a prediction: by what factor does the bias of LSSVF grow? `outcome` prints your prediction next to the result.

-- %% id=noise_guess
-- BEGIN SOLUTION
-- STARTER: guess("growth of the bias of a1", nil)
guess("growth of the bias of a1", 4)
-- END SOLUTION

-- %% id=more_noise
-- BEGIN SOLUTION
local high = study(0.4, methods)
-- one panel for each method, with the true value and the ellipse of the bound
local C, phi = high.TFSRIVC.cramer_rao, linspace(0, 2*math.pi, 91)
local va, cab, vb = C:at(1, 1), C:at(1, 3), C:at(3, 3)
local r = math.sqrt(-2*math.log(0.05))    -- holds 95 %
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
report.figure("scatter", panels:set{height = 6}, "200 records with σ = 0.4")
outcome("growth of the bias of a1", high.LSSVF.bias[1]/low.LSSVF.bias[1])
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
-- $\sigma = 0.4$: mean and standard deviation, with the columns of @tbl:low.
-- :::
--
-- ![$\hat b_0$ over $\hat a_1$ from 200 data sets with $\sigma = 0.4$, one panel for each method; marked: the true value. The ellipse would contain 95 % of the estimates of the best unbiased method. The cloud of LSSVF misses it.](figure:scatter){#fig:scatter}
--
-- The bias of LSSVF grows from `ls_low`{.value} % of $a_1$ to `ls_high`{.value} % (@tbl:high), by a factor of `ls_growth`{.value}. A factor of four
-- is the natural prediction, because the bias comes from the variance of the noise. But the noise is also in the denominator. For many samples, the
-- least-squares estimate tends to $(R + \sigma^2 E)^{-1} R\,\theta$ instead of $\theta$. Here $R$ and $E$ are the covariances of the noise-free
-- regressors and of their noise for $\sigma = 1$ (lesson 2). The bias is proportional to $\sigma^2$ only while $\sigma^2 E$ is small compared with
-- $R$. Then it saturates, and it never exceeds 100 %. IVSVF and TFSRIVC stay near the truth. Their scatter grows with the noise, for TFSRIVC by a
-- factor of `tf_growth`{.value}. The number of data sets for which its iterations did not converge is `tf_failures`{.value}. @fig:scatter also shows
-- that the errors of $\hat a_1$ and $\hat b_0$ are correlated. A model that is too fast gets too large a $b_0$, so the gain $b_0/a_2$, which the data
-- determine well, is right.
-- END SOLUTION
--
-- **Question 13.** LSSVF must assume how the measured output behaves between its samples: piecewise linear (`hold_y = "foh"`, as in your program) or
-- constant (`hold_y = "zoh"`). Does its bias depend on this assumption?

-- %% id=hold
-- BEGIN SOLUTION
local holds = study(sigma, {
    {"lssvf", {2, 1, 0}, 3, {hold_y = "foh"}, label = "straight lines"},
    {"lssvf", {2, 1, 0}, 3, {hold_y = "zoh"}, label = "held"},
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
table.insert(hold_rows, cells("held, without noise", held0.param))
report.table("holds", hold_rows)
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=holds #tbl:holds}
-- LSSVF with two assumptions about the output between its samples, $\sigma = 0.2$: mean over 200 data sets and, in parentheses, the standard
-- deviation.
-- :::
--
-- It does, and even its sign changes (@tbl:holds). White noise exists only at the samples. The filtered noise depends on the assumption about the
-- noise between them. A constant output between samples is wrong even without noise, because it lags half a sample behind. This part of the error is
-- small here. Two programs can therefore disagree about LSSVF on the same noisy data, and both can be right. TFSRIVC does not depend on the
-- assumption. Its iterations end where the error of the simulated output is smallest, and this error does not contain $y$ between the samples.
-- END SOLUTION
--
-- # Why not discrete time?
--
-- A computer works with samples, so why not estimate a difference equation, as most programs do, and convert it afterwards? For an input that is
-- constant between the samples, sampling the true system gives
--
-- $$ x(t_k) + \alpha_1 x(t_{k-1}) + \alpha_2 x(t_{k-2}) = \beta_1 u(t_{k-1}) + \beta_2 u(t_{k-2}) , $$ {#eq:sampled}
--
-- and `c2d` and `d2c` convert between the two forms.
--
-- **Question 14.** Estimate the difference equation by `arx(data, {2, 2, 1})`: two poles, two coefficients of the input and one sample of delay, as
-- in @eq:sampled. Use the noise-free and the noisy data. Which of the models can `d2c` convert? (`print(pcall(d2c, G))` continues after an error, and
-- prints true if there was none.) Compare with `oe(data, {2, 2, 1})`, which minimizes the error of the simulated output.

-- %% id=discrete
-- BEGIN SOLUTION
print("poles of the sampled truth:", pole(c2d(Go, Ts)))
print("arx without noise, converted, F:", d2c(arx(data0, {2, 2, 1})).den)

local Garx, Goe = arx(data, {2, 2, 1}), oe(data, {2, 2, 1})
print("poles found by arx:", pole(Garx))
print("poles found by oe: ", pole(Goe))
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
-- ![Step responses of the true system and of the difference equations that `arx` and `oe` estimated from the noisy data. The response of the `arx` model rises at once and ends at the wrong level.](figure:discrete){#fig:discrete}
--
-- Without noise, `arx` and `d2c` reproduce the true system. With this noise, the result of `arx` is useless (@fig:discrete). `arx` minimizes the
-- error of predicting the *next sample* from the last two. From one sample to the next, the output changes so little that the noise is
-- `step_ratio`{.value} times larger. The best prediction is then close to an average of the last two samples, for any system: their weights are
-- `weight1`{.value} and `weight2`{.value}. One pole is negative. `d2c` refuses to convert it, because no differential equation of second order has
-- samples with a negative real pole.
-- END SOLUTION
--
-- **Question 15.** Is this bad luck in one data set? `montecarlo` also accepts functions of the data as estimators. What is the cause, the fast
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
print(string.format("d2c refused %d of the %d arx models", refused, discrete.runs))

-- the estimates of a1 by arx from 100 data sets, if d2c can convert them
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
    {"method", "$a_1$", "$a_2$", "$B$: factor of $p$", "$B$: constant"},
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
-- It is not bad luck. `d2c` refused `refused`{.value} of the 200 models of `arx`. Their poles are `arx_slow`{.value}\ ±\ `arx_slow_std`{.value} and
-- `arx_fast`{.value}\ ±\ `arx_fast_std`{.value} instead of `sampled_slow`{.value} and `sampled_fast`{.value}.
--
-- ::: {.table name=grid #tbl:grid}
-- `arx` with other sampling times and signal-to-noise ratios: mean and, in parentheses, standard deviation of $\hat a_1$ over 100 data sets, if at
-- least 90 of the models can be converted. Otherwise, the number of models that can be converted. The truth is 4.
-- :::
--
-- Both, but mainly the noise (@tbl:grid). At the 5 dB of our data, no sampling time helps: the noise of $y$ is in the regressors, as in LSSVF, and
-- here no filter attenuates it. At 25 dB, slower sampling makes the models convertible, but they remain strongly biased. Only with almost no noise
-- does the sampling time decide: at 45 dB, `arx` fails at 0.01 s and is nearly right from 0.2 s on. The important ratio is the noise compared with
-- the change of the output from one sample to the next. The remedy is the right noise model, not another sampling time.
--
-- ::: {.table name=discrete #tbl:discrete}
-- $\sigma = 0.2$: mean over 200 data sets and, in parentheses, the standard deviation.
-- :::
--
-- Like TFSRIVC, `oe` compares simulated with measured outputs, and finds the system. But a sampled second-order system always has two coefficients of
-- the input (@eq:sampled), even if the differential equation has no zero. A discrete-time model cannot express a constant numerator. It must estimate
-- the second coefficient, and the price is a scatter of $\hat a_1$ that is `oe_more`{.value} times as large (@tbl:discrete). In addition, faster
-- sampling moves the poles closer to $z = 1$, and the information about the time constants is in the last digits of the coefficients. A
-- continuous-time model has the same meaning for every sampling time.
-- END SOLUTION
--
-- # How many poles?
--
-- **Question 16.** So far the orders were known. `srivcstruc` tries several orders and recommends one. Would the data alone have led to two poles and
-- no zero?

-- %% id=orders
-- BEGIN SOLUTION
local orders = srivcstruc(data, {poles = {1, 3}, zeros = {0, 1}})
print(orders.recommendation)
-- END SOLUTION

-- %% id=orders_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local order_rows = {{"poles", "zeros", "fit (%)", "$R_T^2$", "YIC", "BIC", "not determined"}}
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
-- Transfer functions of several orders for the noisy data. A large fit and a large $R_T^2$, the explained share of the output's variance, are good. A
-- small YIC and a small BIC are good. The last column lists the parameters with a standard error larger than their value.
-- :::
--
-- Yes (@tbl:orders). The fit changes very little beyond two poles: further parameters follow the noise and not the system. BIC is the logarithm of
-- the error's variance plus $\ln N/N$ for each parameter. YIC (Young's information criterion) weighs the unexplained variance against the relative
-- variance of the parameters. YIC alone would choose one pole here, because the data determine two parameters best. Look at several measures, and at
-- validation data if you have them.
-- END SOLUTION

-- %% [markdown]
-- # Try it: λ by hand
--
-- On a page (`dynlab preview`, or `dynlab report` with an output that ends in `.html`) the slider under the next cell, or the marked point of
-- @fig:lambda_by_hand, changes the cut-off frequency $\lambda$ of the filter. Watch how the filter colors the equation error, and how the estimates
-- from sixty data sets change. For which $\lambda$ does the cloud of LSSVF miss the true value, and for which does the cloud of IVSVF miss it?

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
-- ![For the $\lambda$ of the cell above: left, the magnitude $|A/E|$ by which the filter colors the equation error; right, $\hat b_0$ over $\hat a_1$ from sixty data sets, and the ellipse that would contain 95 % of the estimates of the best unbiased method](figure:lambda_by_hand){#fig:lambda_by_hand}

-- %% [markdown]
-- ## Without typing
--
-- `dynlab app` opens an empty session in the workbench in the browser (@fig:workbench). Under **Known system**, press **Start study**: it has the
-- system of @eq:system, an input, noise, and SRIVC. Drag **noise** and watch the cloud and the ellipse grow together. Add `lssvf = {{2, 1, 0}, 3}` to
-- the list of **estimators** and drag again: its cloud moves away from the truth. The table below the figure compares the scatter with the bound.
-- `session.lua` contains your steps. With `dynlab app crane`, you can identify the crane in the same way.
--
-- ![A study of the known system in the workbench: controls, the cloud of estimates with the ellipse, and the script](workbench.png){#fig:workbench}

-- %% [markdown]
-- # What you have learned
--
-- BEGIN SOLUTION
-- * State-variable filters turn a differential equation into a linear regression without differentiation. LSSVF solves this regression by least
--   squares. It is good without noise and biased with noise, and the bias grows with the noise.
-- * Instruments that are independent of the noise remove the bias for long data: the estimates are consistent. The scatter of IVSVF still depends on
--   the filter that you choose. With a bad filter and short data, the scatter is so wide that even the mean is wrong.
-- * TFSRIVC finds the filter itself, in a few iterations. For these data, no bias is visible, its scatter is the Cramér–Rao bound, and its reported
--   standard errors are right.
-- * One data set says little about a method. Repeat the experiment in simulation, look at mean *and* scatter, and compare with the Cramér–Rao bound
--   [@ljung1999, section 7.4].
-- * `arx` assumes noise that passes through the poles. With noise added to the output, it is biased at every sampling time, and with faster sampling,
--   less noise is enough to make it useless. An output-error model, in discrete or continuous time, does not have this problem. In continuous time,
--   fast sampling only helps.
-- END SOLUTION
--
-- # What you submit
--
-- ::: {.note}
-- If this lesson is graded, submit results with `answer(name, value)`. `dynlab check` lists missing answers:
--
-- * `own_without_noise` and `own`: the estimates $a_1$, $a_2$, $b_0$ of your LSSVF from the data without and with noise;
-- * `record`: the data with noise;
-- * `G_lssvf` and `G_ivsvf`: the library's models of these data for $\lambda = 3$;
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
