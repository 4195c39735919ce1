-- ---
-- title: Continuous-time models from noisy records
-- subtitle: Lesson 4 – LSSVF, IVSVF and TFSRIVC on a system that is known
-- lesson: 04_estimators
-- template: lesson
-- language: en
-- seed: 1
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
-- Three methods estimate a differential equation straight from samples: least squares on filtered signals (LSSVF), the same
-- regression with instruments (IVSVF), and the refined instrumental variables of TFSRIVC. Which of them can be believed? With a
-- real plant nobody knows the answer. This lesson therefore plays the plant itself: the system is given, the noise is made, and
-- every estimate can be held against the truth, once and then two hundred times.
--
-- `dynlab demo` shows the methods in short guided tours; take one before you start or when you want to see more.
--
-- # The system and its record
--
-- ## The true system
--
-- The input $u$ drives a second-order system; its output $x$ is sampled every $T_s$ seconds and measured with an error,
--
-- $$ x(t) = \frac{B_o(p)}{F_o(p)}\,u(t), \qquad y(t_k) = x(t_k) + e(t_k), $$ {#eq:system}
--
-- with $B_o(p) = 2$ and $F_o(p) = p^2 + 4p + 3$, where $p$ stands for $\mathrm{d}/\mathrm{d}t$ and the $e(t_k)$ are independent, Gaussian,
-- of mean zero and standard deviation $\sigma$.
--
-- **Question 1.** Which model structure does @eq:system have: CARX, COE or CBJ?
--
-- BEGIN SOLUTION
-- COE, a continuous-time output-error structure. The disturbance is added to the output behind the system; it passes neither through
-- $1/F_o$, as it would in CARX, nor through a noise model of its own, as in CBJ.
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
report.value("gain", dcgain(Go), "%.3f")
report.value("slow_corner", min(corner), "%.0f")
report.value("fast_corner", max(corner), "%.0f")
report.value("slow_constant", max(time_constant), "%.0f")
report.value("fast_constant", min(time_constant), "%.2f")
report.value("band", bandwidth(Go), "%.2f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- The steady-state gain is $B_o(0)/F_o(0) =$ `gain`{.value}. Two real poles at $-$`slow_corner`{.value} and $-$`fast_corner`{.value} mean
-- time constants of `slow_constant`{.value} s and `fast_constant`{.value} s, and corner frequencies of `slow_corner`{.value} and
-- `fast_corner`{.value} rad/s. The slow pole rules: the gain has fallen by 3 dB at `band`{.value} rad/s already, a little below its corner.
-- END SOLUTION
--
-- ## The record
--
-- The input is a pseudo-random binary sequence whose value may change once per second. One period of it is recorded, with
-- $\sigma = 0.2$, and kept in two data objects: without noise and with it.

-- %% id=record
local Ts, N = 0.01, 1500
local sigma = 0.2
local u = prbs(4, 100)
local x = lsim(Go, u, Ts)                 -- the noise-free output
local y = x + sigma*randn(N)              -- the measured one
local signals = {InputName = "input u", OutputName = "output y"}
local data0, data = iddata(x, u, Ts, signals), iddata(y, u, Ts, signals)
idplot(data, {labels = {"measured"}}):add(data.t, x, {label = "without noise"})
local snr = 20*math.log(std(x)/sigma, 10)
print(string.format("signal-to-noise ratio: %.1f dB", snr))

-- %% [markdown]
-- This is a poor record on purpose. Between two samples the output moves by far less than the noise does, and the ratio of
-- signal to noise is that of a bad day in a factory. We assume that the orders are known, two poles and no zero, and come back to
-- this assumption at the end.
--
-- # Least squares on filtered signals, by hand
--
-- ## The regression
--
-- Take the CARX model $A(p)\,y(t) = B(p)\,u(t) + e(t)$ with $A(p) = p^2 + a_1 p + a_2$ and $B(p) = b_0$. Its derivatives are not
-- measured, and differentiating noisy samples is hopeless. So every signal is sent through the same filter first,
--
-- $$ y_f(t) = \frac{1}{E(p)}\,y(t), \qquad u_f(t) = \frac{1}{E(p)}\,u(t), \qquad E(p) = (p + \lambda)^2 , $$ {#eq:filter}
--
-- whose state holds $y_f$, $p\,y_f$ and $p^2 y_f$ without any differentiation: the *state-variable filter*.
--
-- **Question 3.** Write the model for the $N$ samples as a linear regression in matrix form, with the sizes of the matrices. What is its
-- least-squares solution?
--
-- BEGIN SOLUTION
-- The filtered signals obey the same equation, sample by sample,
--
-- $$ p^2 y_f(t_k) = -a_1\,p\,y_f(t_k) - a_2\,y_f(t_k) + b_0\,u_f(t_k) + \varepsilon(t_k) , $$ {#eq:sample}
--
-- and stacked over $k = 1, \dots, N$ they become $Y = \Phi\theta + \varepsilon$ with
--
-- $$ Y = \begin{pmatrix} p^2 y_f(t_1) \\ \vdots \\ p^2 y_f(t_N) \end{pmatrix}, \quad
--    \Phi = \begin{pmatrix} -p\,y_f(t_1) & -y_f(t_1) & u_f(t_1) \\ \vdots & \vdots & \vdots \\
--    -p\,y_f(t_N) & -y_f(t_N) & u_f(t_N) \end{pmatrix}, \quad
--    \theta = \begin{pmatrix} a_1 \\ a_2 \\ b_0 \end{pmatrix} , $$ {#eq:matrices}
--
-- where $Y$ and $\varepsilon$ are columns of $N$ values, $\Phi$ has $N$ rows and 3 columns, and $\theta$ holds 3 values. The sum of squares $\lVert Y - \Phi\theta \rVert^2$ is smallest for $\hat\theta = (\Phi^T\Phi)^{-1}\Phi^T Y$, which a program computes by an
-- orthogonal factorisation of $\Phi$, without forming an inverse.
-- END SOLUTION
--
-- ## Your own estimator
--
-- **Question 4.** Write your own LSSVF. `svf(x, 2, lambda, {Ts = Ts})` gives a matrix with the columns $p^2 x_f$, $p\,x_f$ and $x_f$,
-- and `solve(Phi, Y)` the least-squares solution. Between the samples the input is held, `hold = "zoh"`; the measured output runs in
-- straight lines, `hold = "foh"`, which is what `svf` takes unless told. Set $\lambda = 3$ rad/s and try it on the record without noise.

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
-- The estimates are right within `own0_miss`{.value} %. What is left is no error of the program but the price of sampling: the filter sees the
-- output as straight lines between the samples while in truth it is curved. Sampled twice as fast, the same system is missed
-- by `fine_ratio`{.value} times less, as a quadratic error should be.
-- END SOLUTION
--
-- **Question 5.** Now the record with noise. Are the estimates still close to the truth? Repeat with other noise and get a feeling for it: is
-- each miss another one, or always the same? (`dynlab run analysis.lua --seed random` runs everything with other noise.)

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
local function cells(name, theta)
    return {name, string.format("%.3f", theta[1]), string.format("%.3f", theta[2]), string.format("%.3f", theta[3])}
end
local rows = {{"record", "a₁", "a₂", "b₀"}, cells("truth", truth), cells("this record", own)}
for repetition, theta in ipairs(others) do
    table.insert(rows, cells(string.format("repetition %d", repetition), theta))
end
report.table("repetitions", rows)
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=repetitions #tbl:repetitions}
-- Own LSSVF, λ = 3 rad/s: the record with noise and five repetitions with other noise.
-- :::
--
-- They are not (@tbl:repetitions), and the misses have a system: chance would put some estimates above the truth and some below it, but all three
-- parameters come out too small, in one repetition after the other. Least squares is *biased* here. The noise of $y$ stands on both
-- sides of @eq:sample. For the true parameters, what is left over is
--
-- $$ \varepsilon(t) = \frac{A(p)}{E(p)}\,e(t) , $$ {#eq:colour}
--
-- and the columns $p\,y_f$ and $y_f$ of $\Phi$ contain the same $e$, filtered another way. Regressors and error are correlated,
-- as they were with four samples in lesson 2, and no longer record would cure that.
-- END SOLUTION
--
-- ## The library's LSSVF
--
-- **Question 6.** `lssvf(data, {na, nb, nk}, lambda)` does the same for a data object: `na` poles, `nb` coefficients of $B$, `nk` samples
-- of delay. Apply it to both records and compare it with your own program.

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
report.value("agreement", math.max(largest_relative(own0, Glssvf0.param), largest_relative(own, Glssvf.param)), "%.0e")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- Both programs give the same numbers: the largest relative difference, `agreement`{.value}, is rounding. The library's is only faster,
-- because it sums the few products it needs while it filters and never stores $\Phi$.
-- END SOLUTION

-- %% [markdown]
-- # Instruments
--
-- ## IVSVF
--
-- The cure keeps the regression of question 3 and changes how it is solved. Instead of $\Phi^T Y = \Phi^T\Phi\,\theta$ one solves
--
-- $$ Z^T Y = Z^T\Phi\,\theta , $$ {#eq:iv}
--
-- where the *instruments* $Z$ look like $\Phi$ but know nothing of the noise. IVSVF makes them in two steps: LSSVF gives a first
-- model, the first model is simulated with the input $u$, and its output takes the place of $y$ in the regressors.
--
-- **Question 7.** Estimate the model by `ivsvf` and compare it with LSSVF. As a bonus, write it yourself: three lines added to your own LSSVF
-- will do.

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
report.value("iv_agreement", largest_relative(own_iv, Givsvf.param), "%.0e")
report.value("ls_miss", 100*largest_relative(Glssvf.param, truth), "%.0f")
report.value("iv_miss", 100*largest_relative(Givsvf.param, truth), "%.0f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- The worst parameter of LSSVF misses the truth by `ls_miss`{.value} %, that of IVSVF by `iv_miss`{.value} %. It does not matter that the
-- instruments come from a biased model: they need not be right, they must be independent of the noise and resemble the regressors. The own
-- three lines agree with the library (`iv_agreement`{.value} relative difference).
-- END SOLUTION
--
-- ## The choice of λ
--
-- Both methods want a number from the user, the cut-off frequency $\lambda$ of the filter. It is usually chosen a bit above the bandwidth of
-- the system, which for a real plant one would like to know first.
--
-- **Question 8.** How sensitive is IVSVF to this choice? Compare $\lambda = 0.3$, 3 and 30 rad/s. One record says little; `montecarlo`
-- repeats the experiment with fresh noise as often as you like (`dynlab help montecarlo`).

-- %% id=lambda
-- BEGIN SOLUTION
local function study(sigma, estimators)
    return montecarlo{system = Go, input = u, Ts = Ts, sigma = sigma,
                      runs = 200, estimators = estimators}
end
local filters = study(sigma, {{"ivsvf", {2, 1, 0}, 30, label = "λ = 30"},
                              {"ivsvf", {2, 1, 0}, 0.3, label = "λ = 0.3"},
                              {"ivsvf", {2, 1, 0}, 3, label = "λ = 3"}})
report.figure("lambda", filters:scatter("a1", "a2"), "IVSVF with three filters")
-- END SOLUTION

-- %% id=lambda_report echo=false
-- BEGIN SOLUTION
local function mean_and_std(result, i)
    return string.format("%.3f (%.3f)", result.mean[i], result.std[i])
end
local lambda_rows = {{"λ (rad/s)", "a₁", "a₂", "b₀", "largest a₁"},
                     {"truth", true_cell(1), true_cell(2), true_cell(3), ""}}
for _, value in ipairs{"0.3", "3", "30"} do
    local result = filters["λ = " .. value]
    table.insert(lambda_rows, {value, mean_and_std(result, 1), mean_and_std(result, 2), mean_and_std(result, 3),
                               string.format("%.1f", result.max[1])})
end
report.table("lambda", lambda_rows)
local best_std = filters["λ = 3"].std[1]
report.value("runs", filters.runs, "%d")
report.value("low_ratio", filters["λ = 0.3"].std[1]/best_std, "%.0f")
report.value("high_ratio", filters["λ = 30"].std[1]/best_std, "%.0f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=lambda #tbl:lambda}
-- IVSVF with three filters: mean over all records and, in brackets, the standard deviation.
-- :::
--
-- ![IVSVF with three filters: two parameters of 200 estimates each](figure:lambda){#fig:lambda}
--
-- Very sensitive (@tbl:lambda, @fig:lambda). Over `runs`{.value} records the scatter of $\hat a_1$ is `low_ratio`{.value} times larger with $\lambda = 0.3$ and
-- `high_ratio`{.value} times larger with $\lambda = 30$ than with $\lambda = 3$; some records give nonsense. The ellipse in
-- the middle is what the best possible method could reach.
-- END SOLUTION
--
-- **Question 9.** Why? Put the true parameters into the regression: how does the filter colour the noise that is left over, and which filter
-- would be the best one? (`freqresp(G, w).abs` gives the magnitude of a transfer function.)

-- %% id=colour
-- BEGIN SOLUTION
local w = 10^linspace(-2, 3, 300)
local function colour(lambda)
    return freqresp((s^2 + 4*s + 3)/(s + lambda)^2, w).abs
end
local weights = plot(w, colour(0.3), "λ = 0.3", w, colour(3), "λ = 3",
                     w, colour(30), "λ = 30", w, ones(#w), "E = A",
                     {x_log = true, y_log = true, height = 5.5, dash = {0, 0, 0, 1},
                      xlabel = "frequency (rad/s)", ylabel = "weight |A/E|"})
report.figure("colour", weights, "How the filter colours the equation error")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ![How the filter colours the equation error](figure:colour){#fig:colour}
--
-- Least squares treats all samples of $\varepsilon$ alike, which is best when they are white. By @eq:colour $\varepsilon$ is the white
-- noise $e$ seen through $A/E$ (@fig:colour). With $\lambda = 0.3$ the slow part of the noise is raised far above all the rest, and the filter
-- remembers for so long that the record hardly holds more than its transient. With $\lambda = 30$ nearly all of the noise lies where the system
-- does not answer any more, and the little that the record tells of the slow pole is drowned. $\lambda = 3$ comes closest to a level line,
-- and the level line itself is $E = A$: the best filter is $1/A$, the system's own denominator. Nobody knows it beforehand, but
-- one can get there in steps.
-- END SOLUTION
--
-- # Refined instrumental variables
--
-- TFSRIVC estimates the output-error model
--
-- $$ y(t_k) = \frac{B(p)}{F(p)}\,u(t_k) + e(t_k) $$ {#eq:coe}
--
-- in steps: it filters with $1/F$ of the model it has, makes instruments with the same model, solves @eq:iv, and begins again
-- with the new model until nothing changes. There is no $\lambda$ to choose.
--
-- **Question 10.** Estimate the model by `tfsrivc(data, np, nz, {TdMax = 0})`, where `np` and `nz` count poles and zeros and the largest
-- delay is zero, so that none is looked for. Compare all methods with the truth.

-- %% id=tfsrivc
-- BEGIN SOLUTION
local Gtf = tfsrivc(data, 2, 0, {TdMax = 0})
present(Gtf)

local function miss(G) return lsim(G, u, Ts) - x end
local misses = plot(data.t, miss(Glssvf), "LSSVF", data.t, miss(Givsvf), "IVSVF",
                    data.t, miss(Gtf), "TFSRIVC",
                    {height = 5.5, xlabel = "time (s)", ylabel = "output less x"})
report.figure("errors", misses, "Simulated outputs less the noise-free output")
-- END SOLUTION

-- %% id=tfsrivc_report echo=false
-- BEGIN SOLUTION
local function with_error(G, i)
    return string.format("%.3f ± %.3f", G.param[i], G.std[i])
end
local function model_row(name, G)
    return {name, with_error(G, 1), with_error(G, 2), with_error(G, 3),
            string.format("%.1f", fit(data, G)), string.format("%.1f", fit(data0, G))}
end
report.table("methods", {
    {"method", "a₁", "a₂", "b₀", "fit to y", "fit to x"},
    {"truth", true_cell(1), true_cell(2), true_cell(3), string.format("%.1f", fit(data, Go)), "100"},
    model_row("LSSVF", Glssvf), model_row("IVSVF", Givsvf), model_row("TFSRIVC", Gtf),
})
report.value("iterations", Gtf.report.iterations, "%d")
report.value("possible_fit", fit(data, Go), "%.1f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=methods #tbl:methods}
-- The three methods on the record (± one reported standard error). The fit, in %, is of the simulated output, to the measured and to the noise-free output.
-- :::
--
-- ![Simulated outputs of the three models less the noise-free output](figure:errors){#fig:errors}
--
-- TFSRIVC needed `iterations`{.value} iterations. Two things in @tbl:methods deserve a thought. A fit near `possible_fit`{.value} % is not a
-- bad model: the true system itself reaches no more, because the rest is noise. And judged by the fit to the measured output all three models look alike, although
-- their parameters do not. The noise-free output, which only a simulation has, tells them apart (@fig:errors). Which of the two unbiased
-- methods comes closer to it on one single record is a matter of luck.
-- END SOLUTION
--
-- # Two hundred records
--
-- **Question 11.** One record can flatter a method. Repeat the experiment 200 times with $\sigma = 0.2$ for the three methods, with
-- $\lambda = 3$ where one is wanted. Which are biased? Which scatter least? Do the standard errors that they report tell the truth?

-- %% id=monte_carlo
-- BEGIN SOLUTION
local methods = {lssvf = {{2, 1, 0}, 3}, ivsvf = {{2, 1, 0}, 3},
                 tfsrivc = {2, 0, {TdMax = 0}}}
local low = study(0.2, methods)
report.figure("histograms", low:histograms(), "200 records with σ = 0.2")
-- END SOLUTION

-- %% id=monte_carlo_report echo=false
-- BEGIN SOLUTION
local function study_rows(study)
    local function with_bound(i)
        return string.format("%g (%.3f)", truth[i], study.tfsrivc.cramer_rao_std[i])
    end
    local list = {{"method", "a₁", "a₂", "b₀", "reported, a₁"},
                  {"truth, bound", with_bound(1), with_bound(2), with_bound(3), ""}}
    for _, name in ipairs{"lssvf", "ivsvf", "tfsrivc"} do
        local result = study[name]
        table.insert(list, {name:upper(), mean_and_std(result, 1), mean_and_std(result, 2), mean_and_std(result, 3),
                            string.format("(%.3f)", result.reported_std[1])})
    end
    return list
end
report.table("low", study_rows(low))
report.value("ls_bias", abs(low.lssvf.bias[1])/low.lssvf.std[1], "%.1f")
report.value("ls_over", low.lssvf.reported_std[1]/low.lssvf.std[1], "%.1f")
report.value("iv_over", low.ivsvf.reported_std[1]/low.ivsvf.std[1], "%.1f")
report.value("tf_over", low.tfsrivc.reported_std[1]/low.tfsrivc.std[1], "%.2f")
report.value("tf_bound", low.tfsrivc.std[1]/low.tfsrivc.cramer_rao_std[1], "%.2f")
report.value("iv_more", 100*(low.ivsvf.std[1]/low.tfsrivc.std[1] - 1), "%.0f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=low #tbl:low}
-- σ = 0.2: mean over 200 records and, in brackets, the standard deviation. First row: the truth and the Cramér–Rao bound. Last column: the mean of the standard errors that the method reported for a₁.
-- :::
--
-- ![200 records with σ = 0.2; dashed: the truth](figure:histograms){#fig:histograms}
--
-- * LSSVF scatters little around the wrong place: on average it misses $a_1$ by `ls_bias`{.value} times its own scatter. A narrow histogram is
--   no merit by itself.
-- * IVSVF sits at the truth. Its scatter is `iv_more`{.value} % above that of TFSRIVC, since its filter is not quite the best.
-- * TFSRIVC sits at the truth too and scatters `tf_bound`{.value} times as much as the Cramér–Rao bound, below which no unbiased method can
--   go. There is nothing left to gain from this record.
-- * Only TFSRIVC's reported errors may be taken at their word: they are `tf_over`{.value} times the true scatter, against `iv_over`{.value}
--   times for IVSVF and `ls_over`{.value} times for LSSVF. Their formulas suppose a white equation error, and @fig:colour shows that it is not.
-- END SOLUTION
--
-- **Question 12.** Double the noise to $\sigma = 0.4$. What happens to the three methods?

-- %% id=more_noise
-- BEGIN SOLUTION
local high = study(0.4, methods)
report.figure("scatter", high:scatter("a1", "b0"), "200 records with σ = 0.4")
-- END SOLUTION

-- %% id=more_noise_report echo=false
-- BEGIN SOLUTION
report.table("high", study_rows(high))
local function offset(study)
    return abs(study.lssvf.bias[1])
end
report.value("ls_low", 100*offset(low)/truth[1], "%.0f")
report.value("ls_high", 100*offset(high)/truth[1], "%.0f")
report.value("tf_growth", high.tfsrivc.std[1]/low.tfsrivc.std[1], "%.2f")
report.value("tf_failures", high.tfsrivc.failed + high.tfsrivc.not_converged, "%d")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=high #tbl:high}
-- σ = 0.4: mean and standard deviation, the columns as in @tbl:low.
-- :::
--
-- ![200 records with σ = 0.4: two parameters of each estimate](figure:scatter){#fig:scatter}
--
-- The bias of LSSVF grows from `ls_low`{.value} % of $a_1$ to `ls_high`{.value} % (@tbl:high). IVSVF and TFSRIVC stay where they belong;
-- their scatter grows with the noise, for TFSRIVC by a factor of `tf_growth`{.value}, and the number of records on which its iterations
-- did not settle is `tf_failures`{.value}. @fig:scatter shows one thing more: the errors of $\hat a_1$ and $\hat b_0$ are not independent. A model that is too fast gets too large a $b_0$, so that the gain
-- $b_0/a_2$, which the record shows plainly, comes out right.
-- END SOLUTION
--
-- **Question 13.** LSSVF has to suppose how the measured output goes on between its samples: in straight lines (`hold_y = "foh"`,
-- which is what you did) or held (`hold_y = "zoh"`). Does its bias depend on this?

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
local hold_rows = {{"output between samples", "a₁", "a₂", "b₀"}, {"truth", true_cell(1), true_cell(2), true_cell(3)}}
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
-- LSSVF with two ideas of the output between its samples, σ = 0.2: mean and, in brackets, standard deviation.
-- :::
--
-- It does, and even its sign changes (@tbl:holds). White noise exists at the samples only; what the filter makes of it depends on how it
-- is continued between them. The held output is wrong even without noise, because it lags half a sample behind; that part of the
-- miss is small here. Two programs can therefore disagree about LSSVF on the same noisy record and both be right. TFSRIVC does not mind: where
-- its iterations end, the error of the simulated output is smallest, and no hold of $y$ appears in that error.
-- END SOLUTION
--
-- # Why not discrete time?
--
-- A computer works with samples, so why not estimate a difference equation, as most programs do, and convert it afterwards?
-- For an input that is held, sampling the true system gives
--
-- $$ x(t_k) + \alpha_1 x(t_{k-1}) + \alpha_2 x(t_{k-2}) = \beta_1 u(t_{k-1}) + \beta_2 u(t_{k-2}) , $$ {#eq:sampled}
--
-- and `c2d` and `d2c` go there and back.
--
-- **Question 14.** Estimate the difference equation by `arx(data, {2, 1, 1})`, two poles, one coefficient of the input, and one sample of
-- delay, and convert it. Do the same with the noise-free record (there with two coefficients of the input, as @eq:sampled has).
-- Compare with `oe(data, {2, 2, 1})`, which minimises the error of the simulated output.

-- %% id=discrete
-- BEGIN SOLUTION
print("poles of the sampled truth:", pole(c2d(Go, Ts)))
print("arx without noise, converted:")
print(d2c(arx(data0, {2, 2, 1})))

local Garx, Goe = arx(data, {2, 1, 1}), oe(data, {2, 2, 1})
print("poles found by arx:", pole(Garx))
print("poles found by oe: ", pole(Goe))
print(pcall(d2c, Garx))                   -- pcall goes on after an error
local t = linspace(0, 6, 601)
local answers = plot(t, step(Go, t), "truth", t, step(Garx, t), "arx",
                     t, step(Goe, t), "oe",
                     {height = 5.5, dash = {0, 0, 1}, colour = {0, 1, 3},
                      xlabel = "time (s)", ylabel = "step response"})
report.figure("discrete", answers, "Step responses of the discrete-time models")
-- END SOLUTION

-- %% id=discrete_one_report echo=false
-- BEGIN SOLUTION
report.value("step_ratio", sigma/std(diff(x)), "%.0f")
report.value("weight1", -Garx.A[2], "%.2f")
report.value("weight2", -Garx.A[3], "%.2f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ![Step responses of the difference equations found from the noisy record](figure:discrete){#fig:discrete}
--
-- Without noise `arx` and `d2c` give back the true system. With noise `arx` is useless at this sampling (@fig:discrete). It
-- minimises the error of predicting the *next sample* from the last two. From one sample to the next the output moves so little
-- that the noise is `step_ratio`{.value} times larger, and the best prediction is not far from an average of the last two samples, whatever the system
-- is: their weights are `weight1`{.value} and `weight2`{.value}. One pole comes out negative, and `d2c` refuses, because no
-- differential equation of second order has samples with a negative real pole.
-- END SOLUTION
--
-- **Question 15.** Is this one record's bad luck? `montecarlo` takes functions of the data as estimators, too.

-- %% id=discrete_study
-- BEGIN SOLUTION
local refused = 0
local discrete = study(sigma, {
    {"arx", function(d)
        local G = arx(d, {2, 1, 1})
        if not pcall(d2c, G) then refused = refused + 1 end
        return sort(pole(G).re)
    end},
    {"oe", function(d) return d2c(oe(d, {2, 2, 1})) end},
})
print(string.format("d2c refused %d of the %d arx models", refused, discrete.runs))
-- END SOLUTION

-- %% id=discrete_report echo=false
-- BEGIN SOLUTION
report.value("sampled_slow", max(pole(c2d(Go, Ts)).re), "%.3f")
report.value("sampled_fast", min(pole(c2d(Go, Ts)).re), "%.3f")
report.value("arx_slow", discrete.arx.mean[2], "%.3f")
report.value("arx_fast", discrete.arx.mean[1], "%.3f")
report.value("arx_slow_std", discrete.arx.std[2], "%.3f")
report.value("arx_fast_std", discrete.arx.std[1], "%.3f")
report.value("refused", refused, "%d")
report.table("discrete", {
    {"method", "a₁", "a₂", "B: factor of p", "B: constant"},
    {"truth", true_cell(1), true_cell(2), "0", true_cell(3)},
    {"OE, converted", mean_and_std(discrete.oe, 1), mean_and_std(discrete.oe, 2), mean_and_std(discrete.oe, 3),
     mean_and_std(discrete.oe, 4)},
    {"TFSRIVC", mean_and_std(low.tfsrivc, 1), mean_and_std(low.tfsrivc, 2), "none", mean_and_std(low.tfsrivc, 3)},
})
report.value("oe_more", discrete.oe.std[1]/low.tfsrivc.std[1], "%.1f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- It is not. `d2c` refused `refused`{.value} of the 200 models of `arx`, whose poles lie at `arx_slow`{.value}\ ±\ `arx_slow_std`{.value}
-- and `arx_fast`{.value}\ ±\ `arx_fast_std`{.value} instead of `sampled_slow`{.value} and `sampled_fast`{.value}.
--
-- ::: {.table name=discrete #tbl:discrete}
-- σ = 0.2: mean over 200 records and, in brackets, the standard deviation.
-- :::
--
-- `oe` compares simulated with measured outputs, as TFSRIVC does, and finds the system. But a sampled second-order system always has two
-- coefficients of the input (@eq:sampled), even when the differential equation has no zero. That the numerator is a
-- constant cannot be said in discrete time; the data have to find it out, and the price is a scatter of $\hat a_1$ that is
-- `oe_more`{.value} times as large (@tbl:discrete). Besides, the poles crowd at $z = 1$ the more the faster one samples, and all the
-- information about the time constants sits in the last digits of the coefficients. A continuous-time model keeps its meaning whatever the sampling.
-- END SOLUTION
--
-- # How many poles?
--
-- **Question 16.** So far the orders were known. `srivcstruc` tries several and recommends one. Would the record alone have led to two
-- poles and no zero?

-- %% id=orders
-- BEGIN SOLUTION
local orders = srivcstruc(data, {poles = {1, 3}, zeros = {0, 1}})
print(orders.recommendation)
-- END SOLUTION

-- %% id=orders_report echo=false
-- BEGIN SOLUTION
local order_rows = {{"poles", "zeros", "fit (%)", "R²", "YIC", "BIC", "not determined"}}
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
-- Transfer functions of several orders for the noisy record.
-- :::
--
-- It would (@tbl:orders). The fit hardly changes beyond two poles: further
-- parameters follow the noise and no longer the system. Measures that charge for parameters (BIC) or for their uncertainty (YIC) say where to stop. YIC
-- alone would be content with one pole here, because a single parameter pair is determined best of all; look at several measures, and at a
-- second record when there is one.
-- END SOLUTION
--
-- # What you hand in
--
-- Where this lesson is graded, `answer(name, value)` hands your results in, and `dynlab check .` tells what is missing: `own_without_noise` and
-- `own`, what your own LSSVF finds in the record without and with noise, $a_1$, $a_2$, $b_0$ each; `record`, the data with noise; `G_lssvf` and
-- `G_ivsvf`, the library's models of it for $\lambda = 3$; `G_final`, the model you would recommend; and `scatter`, the standard deviations of
-- $a_1$, $a_2$ and $b_0$ that your Monte Carlo study found for the recommended method.

-- %% id=hand_in
-- BEGIN SOLUTION
answer("own_without_noise", own0)
answer("own", own)
answer("record", data)
answer("G_lssvf", Glssvf)
answer("G_ivsvf", Givsvf)
answer("G_final", Gtf)
answer("scatter", low.tfsrivc.std)
-- END SOLUTION

-- %% [markdown]
-- # What was learnt
--
-- BEGIN SOLUTION
-- * State-variable filters make a linear regression of a differential equation without differentiating anything. LSSVF is that
--   regression solved by least squares: fine without noise, biased with it, and the bias grows with the noise.
-- * Instruments that are independent of the noise take the bias away. How far IVSVF scatters still depends on the filter that the user chose.
-- * TFSRIVC chooses the filter itself, in a few iterations. It is unbiased, as exact as the record allows, and its reported
--   standard errors are right.
-- * One record says little about a method. Repeat the experiment in simulation, look at mean *and* scatter, and compare with
--   the Cramér–Rao bound.
-- * With fast sampling and measurement noise a difference equation fitted by `arx` fails altogether. Direct continuous-time
--   estimation profits from fast sampling instead of suffering from it.
-- END SOLUTION
