-- ---
-- title: From data to a model, and back again
-- subtitle: Lesson 3.1 – the workflow of identification on two simulated processes and a real one
-- lesson: 03_workflow
-- template: lesson
-- language: en
-- seed: 1
-- bibliography: references.bib
-- answers:
--   linear_orders: vector
--   G_linear: model
--   linear_fit: number
--   G_heat: model
--   G_dryer: model
--   dryer_fit: number
-- ---

-- %% [markdown]
-- Parameter estimation is the short part of identification: it takes one line of code. The other steps take longer. You choose the experiment, the
-- part of the data and the structure, and decide whether you can trust the result. If you cannot trust it, go back to an earlier step. Such
-- iterations are a normal part of identification [@ljung1999, chapter 17].
--
-- This lesson runs through the loop of @fig:workflow three times. @tbl:workflow lists the question that each step answers. The first process is a
-- simulated linear system. The second is a simulated heat-transfer plant, for which the obvious model fails twice. The third is a real hair dryer. At
-- the end, you can look up the true parameters of the two simulated processes. The true system of the dryer is unknown. First watch Brian Douglas's
-- video [*Linear System Identification, Part 2*](https://www.youtube.com/watch?v=qC_C04SEV1E) (18 minutes). The video shows the same loop for a
-- simulated linear system and for a heat exchanger.
--
-- The work is planned for two sessions of three hours:
--
-- | session | questions, with minutes | aim |
-- |--------------|-------------------------|------------------------|
-- | A structure that you can trust | 1 (15), 2 (30), 3 (20), 4 (20), 5 (30), 6 (20), 7 (15), 8 (15), 9 (15) | choose an order, validate the model, and use a failed validation to find the step to change |
-- | What remains in the residuals | 10 (20), 11 (30), 12 (30), 13 (15), 14 (25), 15 (20), 16 (40) | detect and remove a drift, assess parameters, and draw a conclusion without knowing the true system |
--
-- ::: block-diagram
-- - experiment = block 1 1: experiment
-- - data = block 2 1: data
-- - preparation = block 3 1: preparation
-- - structure = block 4 1: structure
-- - estimation = block 5 1: estimation
-- - validation = block 6 1: validation
-- - b1 = branch 1 2
-- - b2 = branch 2 2
-- - b3 = branch 3 2
-- - b4 = branch 4 2
-- - experiment -> data -> preparation -> structure -> estimation -> validation
-- - validation |- b4: not trusted
-- - b4 -> b3 -> b2 -> b1
-- - b4 -> structure
-- - b3 -> preparation
-- - b2 -> data
-- - b1 -> experiment
--
-- The identification loop: if you do not trust the model, go back to the step that caused the problem. {#fig:workflow}
-- :::

-- %% id=workflow echo=false
report.table("workflow", {
    {"step", "question", "tools", "go back if"},
    {"experiment", "Does the input excite the process at all frequencies of interest?", "prbs, multisine", "the data cannot answer a question"},
    {"data", "Are there offsets, drift, noise, dead time or faults?", "idplot, advice, delayest", "you see something unexpected"},
    {"preparation", "What remains without levels and drift?", "detrend, idfilt, split", "parameters of the model describe a level"},
    {"structure", "How many poles and zeros, and which delay?", "srivcstruc, selcstruc", "two structures explain the data equally well"},
    {"estimation", "Which parameters, and how certain are they?", "srivc, tfsrivc, arx", "standard errors are as large as the values"},
    {"validation", "Does the model describe new data?", "compare, resid, step, bode", "the model does not describe new data"},
})

-- %% [markdown]
-- ::: {.table name=workflow #tbl:workflow}
-- The identification loop: the question of each step, the tools, and the reason to go back to an earlier step.
-- :::
--
-- # A simulated system
--
-- ## Experiment and data
--
-- The first data set (@fig:linear_record) comes from a simulated system, which starts at rest. The sampling time is 0.05 s, and the output contains
-- white noise. The input is a pseudo-random binary sequence of 127 bits, each 0.4 s long. A second data set with another sequence is reserved for
-- validation.

-- %% id=linear_data
local record = load("linear_system")
local Ts = record.t[2] - record.t[1]
local names = {InputName = "u", OutputName = "y"}
local est = iddata(record.y, record.u, Ts, names)
local val = iddata(record.y_val, record.u_val, Ts, names)
report.figure("linear_record", idplot(est):set{height = 6}, "The first data set")

-- %% [markdown]
-- ![The first data set: output (above) and binary input (below)](figure:linear_record){#fig:linear_record}
--
-- **Question 1.** Plot the data before you estimate, and run `advice`. Is there an offset or a drift? At which frequencies does the input excite the
-- system? Is there a dead time (`delayest`)?

-- %% id=linear_look
-- BEGIN SOLUTION
advice(est)
local Td, delay_figure, delay = delayest(est)
-- for comparison: models with three poles, one zero and a fixed delay
local at, held = {}, {}
for samples = 0, 12 do
    local left = est.y - lsim(srivc(est, {2, 3, samples}), est.u, Ts)
    table.insert(at, samples*Ts)
    table.insert(held, mean(left^2))
end
delay_figure:add(at, held, {label = "srivc, fixed delay", style = "points"})
report.figure("linear_delay", delay_figure:set{height = 5.5}, "Error by delay")
-- END SOLUTION

-- %% id=linear_look_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- This cell runs, but its code is not printed (echo=false). Pass the values, figures and tables of your text to the report here; in a text cell
-- STARTER: --   report.value("gain", K, "%.2f")          is shown by  `gain`{.value}
-- STARTER: --   report.figure("name", fig, "caption")    by  ![caption](figure:name){#fig:name}  on a line of its own, and @fig:name refers to it
-- STARTER: --   report.table("name", {{"head"}, {"cell"}})  by  ::: {.table name=name #tbl:name}  then a line with the caption, then  :::
local bit = 0.4
report.value("linear_low", 2*math.pi/(est.N*Ts), "%.2f")
report.value("linear_high", 0.886*math.pi/bit, "%.0f")
report.value("linear_mean", mean(est.y), "%.2f")
report.value("linear_td", delay.delay, "%.3f")
report.value("linear_td_std", delay.std, "%.3f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- The data start from rest at zero and oscillate around zero (mean `linear_mean`{.value}). You do not have to subtract a level, and `advice` reports
-- no problem. The power spectrum of the binary sequence is nearly flat above the fundamental frequency `linear_low`{.value} rad/s. At about
-- `linear_high`{.value} rad/s, the power is reduced to one half. The output oscillates with a period of about two seconds, well inside this band, so
-- the experiment excites the relevant dynamics. The estimated delay is `linear_td`{.value}\ ±\ `linear_td_std`{.value}\ s (@fig:linear_delay). It is
-- not significantly different from zero, so the model needs no delay parameter. The line and the separate points of @fig:linear_delay agree. If the
-- delay is far from the minimum, the error has several local minima over the other parameters. `delayest` therefore starts the search at each delay
-- from the solutions of the adjacent delays, until the error no longer decreases.
--
-- ![Mean square error of a model at each delay. Line: `delayest`; separate points, for comparison: `srivc` with the delay fixed at whole samples; circle: the estimated delay.](figure:linear_delay){#fig:linear_delay}
-- END SOLUTION
--
-- ## Structure
--
-- **Question 2.** How many poles and zeros does the system have? Use `srivcstruc` to estimate all structures with up to five poles and three zeros
-- from the first data set. Specify the second data set for validation. Which structure does each criterion select, and which structure do you select?

-- %% id=linear_orders
-- BEGIN SOLUTION
local range_of_orders = {poles = {1, 5}, zeros = {0, 3}, validate = val}
local V = srivcstruc(est, range_of_orders)
print(V.recommendation)
-- END SOLUTION

-- %% id=linear_orders_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local function objections(row)
    local list = {}
    if row.cancellation then table.insert(list, "zero cancels a pole") end
    if #row.undetermined > 0 then
        table.insert(list, string.format("%d of %d undetermined", #row.undetermined, #row.model.param))
    end
    if not row.converged then table.insert(list, "not converged") end
    return table.concat(list, ", ")
end
-- one row per structure; delay_format is the format of estimated delays
local function orders_table(V, delay_format)
    local third = delay_format and "delay (s)" or "$R_T^2$"
    local rows = {{"poles", "zeros", third, "YIC", "BIC", "fit (%)", "validation (%)", "objections"}}
    for _, row in ipairs(V.rows) do
        table.insert(rows, {string.format("%d", row.poles), string.format("%d", row.zeros),
                     delay_format and string.format(delay_format, row.delay) or string.format("%.4f", row.r_squared),
                     string.format("%.2f", row.yic), string.format("%.3f", row.bic), string.format("%.2f", row.fit_percent),
                     string.format("%.2f", row.validation_fit), objections(row)})
    end
    return rows
end
-- the row that a single criterion selects; the sign is 1 if large values are better, and -1 if small values are better
local function choice(V, key, sign)
    local best
    for _, row in ipairs(V.rows) do
        if not row.failure and (best == nil or sign*row[key] > sign*best[key]) then best = row end
    end
    return best
end
local criteria = {{"fit, first data set", "fit_percent", 1}, {"fit, second data set", "validation_fit", 1}, {"AIC", "aic", -1},
                  {"FPE", "fpe", -1}, {"BIC", "bic", -1}, {"YIC", "yic", -1}}
report.table("linear_orders", orders_table(V))
report.value("linear_poles", V.best.poles, "%d")
report.value("linear_zeros", V.best.zeros, "%d")
local largest = choice(V, "validation_fit", 1)
report.value("linear_largest_gain", largest.validation_fit - V.best.validation_fit, "%.2f")
report.value("linear_largest_poles", largest.poles, "%d")
report.value("linear_largest_zeros", largest.zeros, "%d")
local of_fit, of_aic = choice(V, "fit_percent", 1), choice(V, "aic", -1)
report.value("linear_fit_poles", of_fit.poles, "%d")
report.value("linear_fit_zeros", of_fit.zeros, "%d")
report.value("linear_aic_poles", of_aic.poles, "%d")
report.value("linear_aic_zeros", of_aic.zeros == 1 and "1 zero" or of_aic.zeros .. " zeros", "%s")
local aic = {}
for _, row in ipairs(V.rows) do table.insert(aic, row.aic) end
table.sort(aic)
report.value("linear_aic_gap", aic[2] - aic[1], "%.4f")
report.value("linear_bic_poles", choice(V, "bic", -1).poles, "%d")
report.value("linear_bic_zeros", choice(V, "bic", -1).zeros, "%d")
report.value("linear_yic_poles", choice(V, "yic", -1).poles, "%d")
report.value("linear_yic_fit", choice(V, "yic", -1).validation_fit, "%.1f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=linear_orders #tbl:linear_orders}
-- All structures, with the fit to the first data set and to the second data set (validation). Large values of $R_T^2$ and fit are better, and small
-- values of YIC and BIC are better. A parameter is undetermined if its standard error is larger than its absolute value.
-- :::
--
-- The measures are:
--
-- * The *fit* is $100\,(1 - \lVert y - \hat y\rVert/\lVert y - \bar y\rVert)$ % for the simulated output $\hat y$.
-- * $R_T^2 = 1 - \sigma_\varepsilon^2/\sigma_y^2$ is the fraction of the variance that the model explains, where $\sigma_\varepsilon^2$ and
--   $\sigma_y^2$ are the variances of the residuals and of the output.
-- * BIC is $\ln V + d \ln(N)/N$ for the mean square $V$ of the errors, $d$ parameters and $N$ samples. AIC has the factor 2 instead of $\ln N$.
-- * YIC (Young's information criterion [@young2011]) is
--   $\ln(\sigma_\varepsilon^2/\sigma_y^2) + \ln\bigl(\tfrac1d\sum_i \hat\sigma_i^2/\hat\theta_i^2\bigr)$. It grows with the relative variance of the
--   parameters.
--
-- Read @tbl:linear_orders from simple to complex structures, and compare the fits. From one pole to two poles, and then to three poles and one zero,
-- each new parameter increases the fit to the validation data. More parameters do not increase it noticeably. The best model on the second data set,
-- with `linear_largest_poles`{.value} poles and `linear_largest_zeros`{.value} zeros, is better by `linear_largest_gain`{.value} points. Its
-- parameters are undetermined, or a zero cancels a pole. The criteria select different structures:
--
-- * The fit to the estimation data almost never decreases with an additional parameter. It selects `linear_fit_poles`{.value} poles and
--   `linear_fit_zeros`{.value} zeros.
-- * AIC has a small penalty per parameter. It selects `linear_aic_poles`{.value} poles and `linear_aic_zeros`{.value}, but the AIC of the next best
--   structure is only `linear_aic_gap`{.value} larger.
-- * The BIC penalty grows with the logarithm of the number of samples. BIC clearly selects `linear_bic_poles`{.value} poles and
--   `linear_bic_zeros`{.value} zero.
-- * YIC combines the remaining error with the uncertainty of the parameters. It selects `linear_yic_poles`{.value} poles, although this model reaches
--   only `linear_yic_fit`{.value} % on the second data set. Use YIC to choose among models that already have a high $R_T^2$.
--
-- The choice is `linear_poles`{.value} poles and `linear_zeros`{.value} zero: the simplest model that the second data set cannot distinguish from
-- more complex models.
-- END SOLUTION
--
-- **Question 3.** Does the choice depend on the noise? `plant("linear_system", {seed = k})` repeats both experiments with different noise. Count how
-- often each criterion selects your structure.

-- %% id=linear_repeat
-- BEGIN SOLUTION
local repetitions = 30
local agreed, alarms = {recommended = 0}, 0
for seed = 1, repetitions do
    local again = plant("linear_system", {seed = seed})
    local e, v = iddata(again.y, again.u, Ts), iddata(again.y_val, again.u_val, Ts)
    local W = srivcstruc(e, {poles = {1, 4}, zeros = {0, 2}, validate = v})
    local function count(name, row)
        local same = row.poles == V.best.poles and row.zeros == V.best.zeros
        agreed[name] = (agreed[name] or 0) + (same and 1 or 0)
    end
    count("recommended", W.best)
    for _, c in ipairs(criteria) do count(c[1], choice(W, c[2], c[3])) end
    local _, test = resid(v, srivc(e, {2, 3, 0}), {quiet = true})
    if not test.independent then alarms = alarms + 1 end
end
-- END SOLUTION

-- %% id=linear_repeat_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local agreed_rows = {{"criterion", "same structure"},
                     {"selcstruc's recommendation", string.format("%d of %d", agreed.recommended, repetitions)}}
for _, c in ipairs(criteria) do
    table.insert(agreed_rows, {c[1] .. " alone", string.format("%d of %d", agreed[c[1]], repetitions)})
end
report.table("linear_agreed", agreed_rows)
report.value("repetitions", repetitions, "%d")
report.value("agreed_recommended", agreed.recommended, "%d")
report.value("agreed_bic", agreed["BIC"], "%d")
report.value("agreed_validation", agreed["fit, second data set"], "%d")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=linear_agreed #tbl:linear_agreed}
-- How often each criterion selects three poles and one zero, among structures with up to four poles and two zeros.
-- :::
--
-- @tbl:linear_agreed compares the criteria. If you choose the model with the largest validation fit, you get this structure only
-- `agreed_validation`{.value} times. The fit of one of the larger models is nearly always slightly higher. If you choose the simplest model that is
-- not significantly worse, you get this structure `agreed_recommended`{.value} times out of `repetitions`{.value}.
-- END SOLUTION
--
-- ## Estimation
--
-- **Question 4.** Estimate the model of your structure with `srivc`. For comparison, estimate an ARX model of the same order with `arx`. How well
-- does each model simulate the second data set, and how well does it predict the next sample?

-- %% id=linear_estimate
-- BEGIN SOLUTION
local G = srivc(est, {2, 3, 0})
present(G)
local Garx = arx(est, {3, 3, 1})
-- END SOLUTION

-- %% id=linear_estimate_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
report.value("linear_fit", fit(est, G), "%.1f")
report.value("linear_val", fit(val, G), "%.1f")
report.value("linear_noise", sqrt(G.report.noise_variance), "%.3f")
report.value("arx_val", fit(val, Garx), "%.0f")
report.value("arx_predict", Garx.report.prediction_fit_percent, "%.0f")
local long_order = 10
report.value("arx_long_order", long_order, "%d")
report.value("arx_long_val", fit(val, arx(est, {long_order, long_order, 1})), "%.0f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- The SRIVC model simulates the second data set with a fit of `linear_val`{.value} %, close to the fit to the first data set (`linear_fit`{.value}
-- %). The residuals have a standard deviation of `linear_noise`{.value}. The fit of the `arx` model is `arx_predict`{.value} % for one-step-ahead
-- prediction and `arx_val`{.value} % for simulation. The order is correct, but the noise model is not: `arx` assumes that the noise passes through
-- the poles of the system. In this system, white noise is added to the output. With `arx_long_order`{.value} poles, the bias is smaller, and the fit
-- of the simulation is `arx_long_val`{.value} %. This fit is still lower than the fit of a model with three poles and the correct noise model. Check
-- which fit a program reports: one-step-ahead prediction is easy, and it hides this difference.
-- END SOLUTION
--
-- ## Validation
--
-- **Question 5.** Validate your model and a simpler model. Inspect the simulated output on the second data set (`compare`), the residuals (`resid`),
-- and the uncertainty of the step and frequency responses (`step`, `bode`).

-- %% id=linear_compare
-- BEGIN SOLUTION
local simpler = srivc(est, {1, 2, 0})
local shown = compare(val:range(1, 400), G, simpler,
                      {labels = {"3 poles, 1 zero", "2 poles"}})
report.figure("linear_compare", shown:set{height = 6, x_range = {0, 20}},
              "Second data set")
local residuals = resid(val, G)
report.figure("linear_resid", residuals, "Residuals on the second data set")
-- END SOLUTION

-- %% id=linear_tests echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local function structure(poles, zeros)
    local of_zeros = zeros == 0 and "no zeros" or zeros == 1 and "1 zero" or zeros .. " zeros"
    return string.format("%d pole%s, %s", poles, poles > 1 and "s" or "", of_zeros)
end
local function p_text(p) return p < 0.001 and "< 0.001" or string.format("%.3f", p) end
local function tested(name, data, model)
    local _, test = resid(data, model, {quiet = true})
    local output = test.outputs[1]
    return {name, string.format("%.2f", fit(data, model)), p_text(output.p_value), p_text(output.inputs[1].p_value)}, output
end
local ladder = {{"structure", "fit (%)", "$p$ (whiteness)", "$p$ (independence)"}}
for _, orders in ipairs{{1, 1}, {1, 2}, {2, 2}, {1, 3}, {2, 3}, {2, 4}} do
    local cells, output = tested(structure(orders[2], orders[1] - 1), val, srivc(est, {orders[1], orders[2], 0}))
    table.insert(ladder, cells)
    if orders[1] == 2 and orders[2] == 3 then report.value("linear_alarm", output.inputs[1].p_value, "%.3f") end
end
report.table("linear_ladder", ladder)
local _, own = tested("", est, G)
report.value("linear_own", own.inputs[1].p_value, "%.2f")
report.value("alarms", alarms, "%d")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ![First 20 s of the second data set, and the simulated outputs of two models. The fits in the legend are for these 20 s. The simpler model smooths the fast part of the response.](figure:linear_compare){#fig:linear_compare}
--
-- ::: {.table name=linear_ladder #tbl:linear_ladder}
-- The residual tests on the whole second data set: $p$-values of the whiteness test (Ljung–Box test with 25 autocorrelations) and of the test for
-- independence from the input.
-- :::
--
-- ![Residuals of the model with three poles and a zero on the second data set: autocorrelation (above) and cross-correlation with the input (below). Shaded: the 99 % bounds. For a correct model, one lag in a hundred is outside these bounds by chance.](figure:linear_resid){#fig:linear_resid}
--
-- In @fig:linear_compare, the simpler model follows the oscillation, but smooths the faster parts of the response. The tests are more sensitive than
-- the plot (@tbl:linear_ladder): for all simpler models, they detect a correlation of the residuals with the input. With three poles and one zero,
-- the residuals are white, but the independence test still rejects the model, $p =$ `linear_alarm`{.value} (@fig:linear_resid). Should you go back
-- and add a pole? An additional pole does not change this result, and on the first data set, the same test has $p =$ `linear_own`{.value}. The
-- `repetitions`{.value} repetitions of question 3 include these data as the first repetition. The number of rejections among them is
-- `alarms`{.value}. A test at the 99 % level rejects even the true system once in a hundred times. One rejection is a reason to inspect the
-- residuals, not yet a reason to change the model.
-- END SOLUTION
--
-- **Question 6.** For this system, the true model is known: `true_model("linear_system").G`. Do your estimates agree with the true parameters within
-- the standard errors?

-- %% id=linear_truth
-- BEGIN SOLUTION
local truth = true_model("linear_system").G
local labels = {labels = {"estimate", "truth"}}
local instants = linspace(0, 8, 321)
local y, _, sd = step(G, instants)
local apart = plot(instants, y - step(truth, instants), "estimate − truth",
                   {height = 5, curves = {{x = instants, y = -2.576*sd,
                    y_upper = 2.576*sd, label = "99 % band"}},
                    xlabel = "time (s)", ylabel = "difference"})
report.figure("linear_step", apart, "Step")
local nyquist = math.pi/Ts
local both = bode(G, truth, labels):set{height = 8.5}
both:vline(7, "7 rad/s", 1):vline(nyquist, "Nyquist", 1)
report.figure("linear_bode", both, "Bode")
-- END SOLUTION

-- %% id=linear_truth_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local truth_rows = {{"parameter", "truth", "estimate", "error / standard error"}}
local symbols = {"$a_1$", "$a_2$", "$a_3$", "$b_0$", "$b_1$"}
local true_values = {truth.den[2], truth.den[3], truth.den[4], truth.num[#truth.num - 1], truth.num[#truth.num]}
local worst = 0
for i, name in ipairs(symbols) do
    local ratio = (G.param[i] - true_values[i])/G.std[i]
    worst = math.max(worst, math.abs(ratio))
    table.insert(truth_rows, {name, string.format("%.4g", true_values[i]),
                 string.format("%.2f ± %.2f", G.param[i], G.std[i]), string.format("%.1f", ratio)})
    report.value("linear_" .. G.names[i], G.param[i], "%.3f")
    report.value("linear_" .. G.names[i] .. "_std", G.std[i], "%.3f")
end
report.table("linear_truth", truth_rows)
report.value("linear_worst", worst, "%.1f")
report.value("linear_true_val", fit(val, truth), "%.1f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=linear_truth #tbl:linear_truth}
-- The estimates (± one standard error) and the true values.
-- :::
--
-- ![Difference between the step responses of the estimate and of the true system (line), with the 99 % band of the estimate (shaded). The step response rises to 2.](figure:linear_step){#fig:linear_step}
--
-- ![Frequency responses of the estimate, with its 99 % band, and of the true system. The vertical lines mark the frequency at which the power of the input is reduced to one half, and the Nyquist frequency.](figure:linear_bode){#fig:linear_bode}
--
-- The estimates agree with the true parameters (@tbl:linear_truth). The largest error is `linear_worst`{.value} standard errors, which is not unusual
-- for one of five parameters. The true responses are within the bands of @fig:linear_step and @fig:linear_bode. Far above `linear_high`{.value}
-- rad/s, the input has little power. In this range, the curve and its narrow band follow from the structure and not from the data. On the second data
-- set, even the true system has a fit of only `linear_true_val`{.value} %. The remaining error is noise. The loop ends here.
-- END SOLUTION

-- %% [markdown]
-- # A heat-transfer plant
--
-- ## Experiment and data
--
-- ::: {.drawing name=heat_rig}
-- The heat-transfer plant: a fan blows air over a heater with the voltage $u$, and a sensor measures the temperature $y$ at the end of the tube
-- {#fig:heat_rig}
-- :::
--
-- In this simulated plant (@fig:heat_rig), a fan blows air over an electric heater and through a tube. The input is the voltage of the heater, and
-- the output is the temperature at the end of the tube. The sampling time is 1 s. There are two data sets around 4 V, for estimation and validation,
-- and one around 7 V (@fig:heat_record). Each data set begins with a minute of rest, followed by a binary sequence of ±1 V with bits of 15 s.

-- %% id=heat_data
local heat = load("heat_transfer")
local function volts(y, u)
    return iddata(y, u, 1, {InputName = "heater", InputUnit = "V",
                  OutputName = "air", OutputUnit = "°C"})
end
local low, low_val = volts(heat.y, heat.u), volts(heat.y_val, heat.u_val)
local high = volts(heat.y_high, heat.u_high)
local two_records = idplot(low, high, {labels = {"about 4 V", "about 7 V"}})
report.figure("heat_record", two_records:set{height = 7, legend = "direct"},
              "Two of the data sets")

-- %% [markdown]
-- ![Two of the three data sets: temperature (above) and heater voltage (below)](figure:heat_record){#fig:heat_record}
--
-- **Question 7.** Describe the data. Which problems does `advice` report? How do you prepare the data?

-- %% id=heat_advice
-- BEGIN SOLUTION
advice(low)
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- The process is slow (@fig:heat_record): the temperature never settles within one bit, so the experiment contains enough information about the slow
-- dynamics. Much shorter bits would have little effect on the temperature. The process starts at rest at an operating point, and a transfer function
-- describes only changes around this point. Subtract the level of the first minute from both signals (`detrend(data, "start")`). Do not subtract the
-- mean, because the data do not begin at the mean. (`advice` also reports a temperature at zero voltage. This value is an extrapolation, because no
-- sample is near zero voltage.) The temperature responds after some seconds of delay. The temperature is rounded to 0.1 °C. `advice` warns about the
-- rounding, but its numbers show that the noise is far larger. `advice` also reports that the temperature drifts by some tenths of a degree relative
-- to the response to the heater. Finally, a change of ±1 V has a larger effect on the temperature around 7 V than around 4 V. This is unexpected, and
-- a single data set cannot show it.
-- END SOLUTION
--
-- ## First round: from voltage to temperature
--
-- **Question 8.** Estimate a model with two poles and a delay from the first data set. Because 60 noisy samples do not determine the level
-- accurately, also estimate a constant offset (`Offset = "estimate"`). The process starts at rest (`InitialState = "none"`). How well does the model
-- describe the two other data sets?
--
-- First, enter a prediction: which fit will the model have on the data around 7 V? `reveal` prints your prediction next to the result.

-- %% id=heat_guess
-- BEGIN SOLUTION
-- STARTER: predict_first("fit about 7 V", nil, "%")
predict_first("fit about 7 V", 80, "%")
-- END SOLUTION

-- %% id=heat_first
-- BEGIN SOLUTION
local function start(data) return detrend(data, "start") end
local G1 = tfsrivc(start(low), 2, 0,
                   {TdMax = 20, InitialState = "none", Offset = "estimate"})
print(G1)
reveal("fit about 7 V", fit(start(high), G1))
-- END SOLUTION

-- %% id=heat_first_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local rounds = {{"round, input", "subtracted", "4 V", "4 V again", "7 V", "$p$ (whiteness)", "$p$ (independence)"}}
-- fits to the three prepared data sets, and the residual tests on the second data set
local function add_round(name, preparation, model, records)
    local cells = tested(name, records[2], model)
    table.insert(rounds, {name, preparation, string.format("%.1f", fit(records[1], model)),
                 string.format("%.1f", fit(records[2], model)), string.format("%.1f", fit(records[3], model)), cells[3], cells[4]})
end
add_round("1, voltage", "level", G1, {start(low), start(low_val), start(high)})
report.value("heat1_low", fit(start(low), G1), "%.0f")
report.value("heat1_val", fit(start(low_val), G1), "%.0f")
report.value("heat1_high", fit(start(high), G1), "%.0f")
report.value("heat1_gain", dcgain(G1), "%.2f")
report.value("heat_high_gain", dcgain(tfsrivc(start(high), 2, 0, {TdMax = 20, InitialState = "none", Offset = "estimate"})), "%.2f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- On the estimation data, the fit is `heat1_low`{.value} %, and you may be tempted to stop here. On the second data set, the fit is
-- `heat1_val`{.value} %, and around 7 V, it is only `heat1_high`{.value} %. The validation fails, and it shows the cause. A model with the same
-- structure, estimated around 7 V, has a gain of `heat_high_gain`{.value} °C/V instead of `heat1_gain`{.value} °C/V. An additional pole or zero
-- cannot describe a gain that depends on the operating point. *Back to the step "data".*
-- END SOLUTION
--
-- ## Second round: use the physics
--
-- **Question 9.** Which physical quantity heats the air? The power of the heater is 100 W at 10 V. Choose a better input and repeat the estimation.

-- %% id=heat_second
-- BEGIN SOLUTION
local function watts(data)            -- the power is proportional to u^2
    return iddata(data.y, 100*(data.u/10)^2, 1,
                  {InputName = "heater", InputUnit = "W",
                   OutputName = "air", OutputUnit = "°C"})
end
local G2 = tfsrivc(start(watts(low)), 2, 0,
                   {TdMax = 20, InitialState = "none", Offset = "estimate"})

local measured = start(high).y        -- both models on the data around 7 V
local function simulated(G, data)
    local y = lsim(G, start(data).u, 1)
    return y + mean(measured - y)
end
local t = high.t
local both = plot(t, measured, "measured",
                  t, simulated(G1, high), "from the voltage",
                  t, simulated(G2, watts(high)), "from the power",
                  {height = 5.5, color = {8, 1, 2}, dash = {0, 2, 0},
                   xlabel = "time (s)", ylabel = "change (°C)"})
report.figure("heat_high", both, "Two models on the data around 7 V")
-- END SOLUTION

-- %% id=heat_second_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local w_records = {start(watts(low)), start(watts(low_val)), start(watts(high))}
add_round("2, power", "level", G2, w_records)
report.value("heat2_low", fit(w_records[1], G2), "%.0f")
report.value("heat2_val", fit(w_records[2], G2), "%.0f")
report.value("heat2_high", fit(w_records[3], G2), "%.0f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ![Two models, both estimated around 4 V, on the data around 7 V: measured temperature (gray), model from the voltage (dotted) and from the power (black). Both simulated curves are shifted to the mean of the measured curve, so that you can compare the shapes. The curve from the voltage therefore does not begin at zero.](figure:heat_high){#fig:heat_high}
--
-- The power of a resistor is $u^2/R$, so the power is the natural input. This prior knowledge does not need an additional parameter. The fit of the
-- model estimated around 4 V is now `heat2_high`{.value} % around 7 V (@fig:heat_high). However, the fit has decreased to `heat2_low`{.value} % on
-- the estimation data, and it is `heat2_val`{.value} % on the second data set. The data contain another effect.
-- END SOLUTION
--
-- ::: note
-- The second session begins here: *what remains in the residuals*. Run your script (`dynlab run -i analysis.lua`) and compare the fits of both models
-- on all three data sets before you continue.
-- :::
--
-- **Question 10.** Plot the residuals of the model for all three data sets, smoothed by a low-pass filter without phase shift (`idfilt` with
-- `zero_phase`). What do they show?

-- %% id=heat_drift
-- BEGIN SOLUTION
local function smooth(v)
    return idfilt(v - mean(v), {0, 0.1}, {zero_phase = true, Ts = 1})
end
local function left_over(data)
    local changes = start(watts(data))
    return smooth(changes.y - lsim(G2, changes.u, 1))
end
local drift = plot(t, left_over(low), "4 V", t, left_over(low_val), "4 V again",
                   t, left_over(high), "7 V",
                   {height = 5, dash = {0, 1, 2}, legend = "direct",
                    xlabel = "time (s)", ylabel = "error (°C)"})
report.figure("heat_drift", drift, "Smoothed errors of the second model")
-- END SOLUTION

-- %% id=heat_drift_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local size = 0
for _, data in ipairs{low, low_val, high} do
    size = math.max(size, (max(abs(left_over(data)))))
end
report.value("heat_drift", size, "%.1f")
-- correlation of the waves with the simulated response to the input
for name, data in pairs{val = low_val, high = high} do
    local e, response = left_over(data), smooth(lsim(G2, start(watts(data)).u, 1))
    local r = mean((e - mean(e))*(response - mean(response)))/(std(e)*std(response))
    report.value("heat_corr_" .. name, r, "%.1f")
end
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ![Measured temperature minus simulated output of the second model, smoothed by a low-pass filter without phase shift, for all three data sets](figure:heat_drift){#fig:heat_drift}
--
-- The residuals show slow waves of up to `heat_drift`{.value} °C, which differ between the data sets (@fig:heat_drift). Does the input cause these
-- waves? The differences do not answer this question, because the inputs also differ. The correlation of the waves with the simulated response is
-- `heat_corr_val`{.value} in the second data set and `heat_corr_high`{.value} in the third data set. (In the first data set, the estimation has
-- removed this correlation.) With only one or two waves, however, a correlation of one half can occur by chance, so these data do not answer the
-- question. In a decisive experiment, you would apply the same input twice: effects of the input would repeat. The likely cause is the changing
-- temperature of the air in the room. The description of the simulated plant confirms this (an inlet temperature that drifts by ±0.4 °C). Neither a
-- constant nor a linear trend describes such waves. *Back to the step "preparation".*
-- END SOLUTION
--
-- ## Third round: remove the drift
--
-- **Question 11.** Remove the slow waves with a high-pass filter. Why must you apply the same filter to both signals? Which cutoff frequency do you
-- choose?

-- %% id=heat_third
-- BEGIN SOLUTION
local function prepared(data, edge)
    return idfilt(start(data), {edge, math.huge}, {order = 2})
end
local function second_order(edge)
    return procsrivc(prepared(watts(low), edge), "P2D",
                     {TdMax = 20, InitialState = "none", Offset = "none"})
end
local edge = 0.015                    -- rad/s
local G3 = second_order(edge)
present(G3)
-- END SOLUTION

-- %% id=heat_third_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local edges = {{"cutoff (rad/s)", "gain (°C/W)", "slow lag (s)", "fast lag (s)", "delay (s)", "$p$ (whiteness)"}}
local function errors(G) return G.report.white and G.std or G.robust_std end
local function spread(G, i, format)
    return string.format(format .. " ± " .. format, G.param[i], errors(G)[i])
end
for _, w in ipairs{0.005, 0.01, 0.015, 0.03} do
    local G = second_order(w)
    local cells = tested("", prepared(watts(low_val), w), G)
    table.insert(edges, {string.format("%g", w), spread(G, 1, "%.3f"), spread(G, 2, "%.1f"), spread(G, 3, "%.1f"),
                 spread(G, 4, "%.1f"), cells[3]})
end
report.table("heat_edges", edges)
local f_records = {prepared(watts(low), edge), prepared(watts(low_val), edge), prepared(watts(high), edge)}
add_round("3, power", "level, drift", G3, f_records)
local v_records = {prepared(low, edge), prepared(low_val, edge), prepared(high, edge)}
add_round("3, voltage", "level, drift", tfsrivc(v_records[1], 2, 0, {TdMax = 20, InitialState = "none", Offset = "none"}), v_records)
report.table("heat_rounds", rounds)
local high_cells = tested("", f_records[3], G3)
report.value("heat_high_white", high_cells[3], "%s")
report.value("heat_first_white", (tested("", f_records[1], G3))[3], "%s")
report.value("heat_second_white", (tested("", f_records[2], G3))[3], "%s")
report.value("heat_filter_only", fit(v_records[3], tfsrivc(v_records[1], 2, 0, {TdMax = 20, InitialState = "none", Offset = "none"})), "%.0f")
report.value("edge", edge, "%.3f")
report.value("heat3_val", fit(f_records[2], G3), "%.0f")
report.value("heat3_high", fit(f_records[3], G3), "%.0f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- A filter on both signals does not change the relation between them: if $y = Gu$, then $Ly = G\,Lu$. If you filter only the output, the model
-- also describes the filter.
--
-- ::: {.table name=heat_edges #tbl:heat_edges}
-- Estimates for four cutoff frequencies of the filter (± one standard error, robust if the residuals are not white). The last column is the $p$-value
-- of the whiteness test on the second data set.
-- :::
--
-- If the cutoff frequency is too low, drift remains. If the cutoff frequency is too high, the filter removes the information about the slow lag and
-- the gain, and their standard errors grow (@tbl:heat_edges). At `edge`{.value} rad/s, close to the corner frequency of the slow lag, the residuals
-- on the second data set are white for the first time, $p =$ `heat_second_white`{.value}. (`present` reports the test on the first data set, from
-- which the model was estimated. Some drift remains in these data, $p =$ `heat_first_white`{.value}, so use the robust standard errors.)
--
-- ::: {.table name=heat_rounds #tbl:heat_rounds}
-- The three rounds: fit (%) on the three prepared data sets. The last columns are the $p$-values of the whiteness test and of the independence test
-- on the second data set.
-- :::
--
-- @tbl:heat_rounds summarizes the three rounds. The signals of different rows are prepared differently, so you cannot compare their fits directly. In
-- the third row, however, the fits to all three data sets agree, and the tests do not reject the model. Note that the test on the second data set
-- determined the cutoff frequency, so this data set is no longer independent evidence. The data around 7 V did not influence any choice. On these
-- data, the fit is `heat3_high`{.value} %, and the whiteness test has $p =$ `heat_high_white`{.value}. The last row uses the filter, but the voltage
-- as input. The fits to the two data sets around 4 V then agree, but the fit to the third data set is `heat_filter_only`{.value} %. If you compared
-- only the fits to the estimation data, you would choose the first model.
-- END SOLUTION
--
-- **Question 12.** With the correct input and preparation, are two poles enough? Which parameters can you trust? Compare them with
-- `true_model("heat_transfer")`. The true system has a dead time and three lags.

-- %% id=heat_orders
-- BEGIN SOLUTION
local clean = prepared(watts(low), edge)
local W = srivcstruc(clean, {poles = {1, 4}, zeros = {0, 1}, TdMax = 20,
                             InitialState = "none", Offset = "none",
                             validate = prepared(watts(low_val), edge)})
print(W.recommendation)
local G3c = procsrivc(clean, "P3D",
                      {TdMax = 20, InitialState = "none", Offset = "none"})
-- END SOLUTION

-- %% id=heat_orders_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
report.table("heat_orders", orders_table(W, "%.2f"))
local heat_truth = true_model("heat_transfer")
local watts_per_volt = 2*heat_truth.low.voltage
local true_gain = heat_truth.low.gain/watts_per_volt
local true_lags = sort{heat_truth.sensor_time, heat_truth.low.fast}
local small = G3.Td + G3.Tp2
local C = G3.report.white and G3.covariance or G3.robust_covariance
local small_std = math.sqrt(C:at(3, 3) + C:at(4, 4) + 2*C:at(3, 4))
local true_small = heat_truth.dead_time + heat_truth.sensor_time + heat_truth.low.fast
report.table("heat_truth", {
    {"lags", "gain (°C/W)", "slow (s)", "short (s)", "delay (s)", "sum (s)"},
    {"truth", string.format("%.3f", true_gain), string.format("%.1f", heat_truth.low.slow),
     string.format("%.1f, %.1f", true_lags[2], true_lags[1]), string.format("%.1f", heat_truth.dead_time), string.format("%.1f", true_small)},
    {"two", spread(G3, 1, "%.3f"), spread(G3, 2, "%.1f"), spread(G3, 3, "%.1f"), spread(G3, 4, "%.1f"),
     string.format("%.1f ± %.1f", small, small_std)},
    {"three", spread(G3c, 1, "%.3f"), spread(G3c, 2, "%.1f"), spread(G3c, 3, "%.1f") .. ", " .. spread(G3c, 4, "%.1f"),
     spread(G3c, 5, "%.1f"), string.format("%.1f", G3c.Td + G3c.Tp2 + G3c.Tp3)},
})
report.value("heat_gain", G3.Kp, "%.4f")
report.value("heat_gain_std", errors(G3)[1], "%.4f")
report.value("heat_slow", G3.Tp1, "%.1f")
report.value("heat_slow_std", errors(G3)[2], "%.1f")
report.value("heat_small", small, "%.2f")
report.value("heat_small_std", small_std, "%.2f")
report.value("heat_td", G3.Td, "%.2f")
report.value("heat_td_std", errors(G3)[4], "%.2f")
report.value("heat_td_ratio", (G3.Td - heat_truth.dead_time)/errors(G3)[4], "%.0f")
report.value("heat_poles", W.best.poles, "%d")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=heat_orders #tbl:heat_orders}
-- Structures for the prepared data. @tbl:linear_orders explains the columns.
-- :::
--
-- ::: {.table name=heat_truth #tbl:heat_truth}
-- The true values, and the models with two and three lags (± one standard error): gain, slow lag, short lags, delay, and the sum of the delay and the
-- short lags.
-- :::
--
-- These data support `heat_poles`{.value} poles (@tbl:heat_orders): a third pole does not change the fit, and the standard errors of the lags are
-- then as large as the lags (@tbl:heat_truth). Gain and slow lag agree with the true values. The delay does not agree: its estimate is
-- `heat_td`{.value}\ ±\ `heat_td_std`{.value}\ s, and the true dead time is `heat_td_ratio`{.value} standard errors smaller. The computation is
-- correct, but a standard error is valid only *if the structure is correct*. The model lacks a third, short lag, and the delay compensates for this
-- lag. The data determine the sum of the delay and the short lags well: `heat_small`{.value}\ ±\ `heat_small_std`{.value}\ s. For a controller, use
-- the model with two poles. To determine the true dead time, you need a faster experiment.
-- END SOLUTION

-- %% [markdown]
-- # A real hair dryer
--
-- ## Experiment and data
--
-- The third process is real. The heating of a hair dryer was switched at random between two voltages, and a thermocouple measured the temperature of
-- the air at the outlet. There are 1000 samples, one every 0.08 s (@fig:dryer_record). The true system is unknown, and there is no second experiment.

-- %% id=dryer_data
local dryer = load("hairdryer")
local raw = iddata(dryer.y, dryer.u, dryer.Ts,
                   {InputName = "heating", InputUnit = "V",
                    OutputName = "thermocouple", OutputUnit = "V"})
report.figure("dryer_record", idplot(raw:range(1, 251)):set{height = 6.5},
              "The hair dryer")

-- %% [markdown]
-- ![The first 20 s of the hair dryer data: voltage of the thermocouple (above) and of the heating (below)](figure:dryer_record){#fig:dryer_record}
--
-- **Question 13.** Prepare the data: use one half for estimation and one half for validation, and subtract the mean of each half. Is there a dead
-- time? (By default, the estimators select the treatment of the initial state and the offset. In this section, every model starts from rest without
-- an offset, `from_rest`, so that only the structures differ.)

-- %% id=dryer_prepare
-- BEGIN SOLUTION
advice(raw)
local first, second = raw:split(0.5)
first, second = first:remove_mean(), second:remove_mean()
local from_rest = {InitialState = "none", Offset = "none"}
local dryer_td, valley, D = delayest(first, from_rest)
report.figure("dryer_delay", valley:set{height = 5}, "Error for every delay")
-- END SOLUTION

-- %% id=dryer_prepare_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
report.value("dryer_u", mean(raw.u), "%.2f")
report.value("dryer_y", mean(raw.y), "%.2f")
report.value("dryer_td", D.delay, "%.3f")
report.value("dryer_td_std", D.std, "%.3f")
report.value("dryer_td_samples", D.samples, "%.2f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- Both signals oscillate around an operating point (means `dryer_u`{.value} V and `dryer_y`{.value} V). As `advice` also reports, the process does
-- not start at rest, so subtract the means. The slight drift is far smaller than the effect of the input. The output responds late, by
-- `dryer_td`{.value}\ ±\ `dryer_td_std`{.value}\ s, which is `dryer_td_samples`{.value} samples (@fig:dryer_delay).
--
-- ![Mean square error of a model at each delay, with all other parameters estimated again. The minimum is flat from 0.1 to 0.2 s. The circle marks the estimate.](figure:dryer_delay){#fig:dryer_delay}
-- END SOLUTION
--
-- ## Structure and estimation
--
-- **Question 14.** Which structure do you choose? Estimate the delay for each structure. How does the delay change if the model has too few poles?

-- %% id=dryer_orders
-- BEGIN SOLUTION
local X = srivcstruc(first, {poles = {1, 4}, zeros = {0, 1}, TdMax = 0.5,
                             InitialState = "none", Offset = "none",
                             validate = second})
print(X.recommendation)
local H1 = srivc(first, {1, 1, 3}, from_rest)    -- one pole, three samples of delay
local H2 = srivc(first, {1, 2, 2}, from_rest)    -- two poles, two samples
print(H2.param, H2.robust_std)
-- END SOLUTION

-- %% id=dryer_orders_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
report.table("dryer_orders", orders_table(X, "%.3f"))
local function row_of(V, poles, zeros)
    for _, row in ipairs(V.rows) do
        if row.poles == poles and row.zeros == zeros then return row end
    end
end
report.value("dryer_one_td", row_of(X, 1, 0).delay, "%.2f")
report.value("dryer_two_td", row_of(X, 2, 0).delay, "%.2f")
report.value("dryer_three_td", row_of(X, 3, 0).delay, "%.3f")
report.value("dryer_bic_31", row_of(X, 3, 1).bic, "%.3f")
report.value("dryer_bic_20", row_of(X, 2, 0).bic, "%.3f")
local H31 = row_of(X, 3, 1).model
local drift_pole = -max(pole(H31).re)
report.value("dryer_drift_pole", drift_pole, "%.3f")
report.value("dryer_drift_zero", -zero(H31).re[1], "%.3f")
report.value("dryer_drift_time", 1/drift_pole, "%.0f")
report.value("dryer_val_31", row_of(X, 3, 1).validation_fit, "%.2f")
report.value("dryer_val_20", row_of(X, 2, 0).validation_fit, "%.2f")
report.value("dryer_poles", X.best.poles, "%d")
report.value("dryer_a1", H2.den[2], "%.1f")
report.value("dryer_a2", H2.den[3], "%.1f")
report.value("dryer_b0", H2.num[#H2.num], "%.1f")
report.value("dryer_a1_std", H2.robust_std[1], "%.1f")
report.value("dryer_a2_std", H2.robust_std[2], "%.1f")
report.value("dryer_b0_std", H2.robust_std[3], "%.1f")
report.value("dryer_fit", H2.report.fit_percent, "%.2f")
report.value("dryer_rt2", srivcstruc(first, {{1, 2, 2}}, from_rest).best.r_squared, "%.4f")
report.value("dryer_val", fit(second, H2), "%.2f")
report.value("dryer1_a1", H1.den[2], "%.3f")
report.value("dryer1_b0", H1.num[#H1.num], "%.3f")
report.value("dryer1_fit", H1.report.fit_percent, "%.2f")
report.value("dryer1_val", fit(second, H1), "%.2f")
local corner = sort((damp(H2)))
report.value("dryer_slow", 1/corner[1], "%.2f")
report.value("dryer_fast", 1/corner[2], "%.2f")
report.value("dryer_gain", dcgain(H2), "%.3f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=dryer_orders #tbl:dryer_orders}
-- Structures for the hair dryer, each with an estimated delay. @tbl:linear_orders explains the columns. The validation data are the second half.
-- :::
--
-- With one pole, the estimated delay is `dryer_one_td`{.value} s: a longer delay compensates for a missing lag. YIC alone would choose this model,
-- but the second half of the data contradicts it. With `dryer_poles`{.value} poles, the delay is `dryer_two_td`{.value} s, which is two samples. If
-- you fix the delay at this value, the model has one parameter less. With two poles, a zero does not improve the fit. BIC would prefer three poles
-- and a zero (`dryer_bic_31`{.value} compared with `dryer_bic_20`{.value}). However, one of these poles is at `dryer_drift_pole`{.value} rad/s, close
-- to the zero at `dryer_drift_zero`{.value} rad/s. A time constant of `dryer_drift_time`{.value} s describes the slow drift of these data and not the
-- dryer. On the second half, the fit is lower: `dryer_val_31`{.value} % compared with `dryer_val_20`{.value} %. The model
--
-- $$ G(s) = \frac{b_0}{s^2 + a_1 s + a_2}\,e^{-2T_s s} $$ {#eq:solution-dryer}
--
-- with $a_1 =$ `dryer_a1`{.value}\ ±\ `dryer_a1_std`{.value}, $a_2 =$ `dryer_a2`{.value}\ ±\ `dryer_a2_std`{.value} and $b_0 =$
-- `dryer_b0`{.value}\ ±\ `dryer_b0_std`{.value} (robust standard errors) has a gain of `dryer_gain`{.value} and lags of `dryer_slow`{.value} s and
-- `dryer_fast`{.value} s. The fit is `dryer_fit`{.value} % on the first half ($R_T^2 =$ `dryer_rt2`{.value}) and `dryer_val`{.value} % on the second
-- half. The fits of the model with one pole and three samples of delay, $a_1 =$ `dryer1_a1`{.value} and $b_0 =$ `dryer1_b0`{.value}, are
-- `dryer1_fit`{.value} % and `dryer1_val`{.value} %.
-- END SOLUTION
--
-- **Question 15.** Compare your model with ARX models (`arx`) with delays of two and three samples. What does the coefficient of $u(k-2)$ show?

-- %% id=dryer_arx
-- BEGIN SOLUTION
local whole = raw:remove_mean()
local A2, A3 = arx(whole, {2, 2, 2}), arx(whole, {2, 2, 3})
-- END SOLUTION

-- %% id=dryer_arx_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local function coefficient(G, i, format)
    return (string.format(format .. " ± " .. format, G.param[i], G.std[i]):gsub("^%-", "−"))
end
report.table("dryer_arx", {
    {"", "delay of 2 samples", "delay of 3 samples"},
    {"$a_1$", coefficient(A2, 1, "%.3f"), coefficient(A3, 1, "%.3f")},
    {"$a_2$", coefficient(A2, 2, "%.3f"), coefficient(A3, 2, "%.3f")},
    {"coefficient of $u(k-2)$", coefficient(A2, 3, "%.4f"), "none"},
    {"coefficient of $u(k-3)$", coefficient(A2, 4, "%.4f"), coefficient(A3, 3, "%.4f")},
    {"coefficient of $u(k-4)$", "none", coefficient(A3, 4, "%.4f")},
    {"fit, one-step-ahead prediction (%)", string.format("%.1f", A2.report.prediction_fit_percent),
     string.format("%.1f", A3.report.prediction_fit_percent)},
    {"fit, simulation (%)", string.format("%.1f", A2.report.fit_percent), string.format("%.1f", A3.report.fit_percent)},
})
for name, G in pairs{arx2 = A2, arx3 = A3} do
    for i = 1, 4 do report.value(name .. "_" .. i, G.param[i], "%.4f") end
end
report.value("arx3_prediction", A3.report.prediction_fit_percent, "%.1f")
report.value("arx3_simulation", A3.report.fit_percent, "%.1f")
report.value("arx3_half", fit(second, arx(first, {2, 2, 3})), "%.2f")
report.value("arx_weight", 100*A2.param[3]/A2.param[4], "%.0f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=dryer_arx #tbl:dryer_arx}
-- Two ARX models from all 1000 samples, with standard errors (not robust), and their fits.
-- :::
--
-- The coefficient of $u(k-2)$ is `arx_weight`{.value} % of the next coefficient. With an additional sample of delay, the model is better and has the
-- same number of parameters (@tbl:dryer_arx). Three samples in the ARX model correspond to two samples in @eq:solution-dryer. The reason is that a
-- zero-order-hold input affects the sampled output one sample later at the earliest. The noise of this plant seems to be white noise that is filtered
-- by $1/A$, as `arx` assumes. Therefore, unlike in the first example, the `arx` model is good: estimated from the first half, its simulation fit on
-- the second half is `arx3_half`{.value} %. The fit of `arx3_prediction`{.value} % for one-step-ahead prediction contains little information.
-- END SOLUTION
--
-- ## Validation and conclusion
--
-- **Question 16.** Validate your models. Does a third pole justify its additional parameter? State which model you recommend and which effects it
-- does not explain.

-- %% id=dryer_validate
-- BEGIN SOLUTION
local H3 = tfsrivc(first, 3, 0, {TdMax = 0.5, InitialState = "none",
                                Offset = "none"})
local beside = compare(second:range(1, 250), H2, H1,
                       {labels = {"2 poles", "1 pole"}})
report.figure("dryer_compare", beside:set{height = 6}, "Second half")
local dryer_residuals = resid(second, H2)
report.figure("dryer_resid", dryer_residuals, "Residuals, two poles")
local steps = step(H2, H3, {labels = {"2 poles", "3 poles"}})
report.figure("dryer_step", steps:set{height = 5, x_range = {0, 1}}, "Step")
-- two poles with an autoregressive noise model (a CBJ structure)
local HN = rivc(first, {1, 0, 1, 2, 2}, from_rest)
local _, noise_test = resid(second, HN, {prediction = true, quiet = true})
-- END SOLUTION

-- %% id=dryer_validate_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local verdict = {{"model", "fit, second half (%)", "$p$ (whiteness)", "$p$ (independence)"}}
for _, entry in ipairs{{"1 pole, 3 samples", H1}, {"2 poles, 2 samples", H2}, {"3 poles, free delay", H3}} do
    local cells = tested(entry[1], second, entry[2])
    table.insert(verdict, cells)
    if entry[2] == H3 then report.value("dryer_three_p", cells[4], "%s") end
end
report.table("dryer_verdict", verdict)
report.value("dryer_ar", -HN.D[2], "%.2f")
report.value("dryer_ar_std", HN.report.D_std[2], "%.2f")
report.value("dryer_noise_val", fit(second, HN), "%.1f")
report.value("dryer_noise_white", p_text(noise_test.outputs[1].p_value), "%s")
report.value("dryer_noise_input", p_text(noise_test.outputs[1].inputs[1].p_value), "%s")
report.value("dryer_val_short", fit(second, H2), "%.1f")
report.value("dryer_three_more", fit(second, H3) - fit(second, H2), "%.2f")
report.value("dryer_robust", max(H2.robust_std/H2.std), "%.1f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ![First 20 s of the second half, and the simulated outputs of two models. The fits in the legend are for these 20 s.](figure:dryer_compare){#fig:dryer_compare}
--
-- ::: {.table name=dryer_verdict #tbl:dryer_verdict}
-- Fits on the second half, and the $p$-values of the whiteness test and of the test for independence from the input.
-- :::
--
-- ![Residuals of the model with two poles on the second half: autocorrelation (above) and cross-correlation with the input (below); shaded: the 99 % bounds](figure:dryer_resid){#fig:dryer_resid}
--
-- ![Step responses of the models with two and with three poles, with 99 % bands. They differ only in the first tenths of a second.](figure:dryer_step){#fig:dryer_step}
--
-- *Evidence for two poles:* the fit to validation data is good, every parameter is well determined, and an independent `arx` estimate confirms the
-- delay in samples. A third pole increases the fit by `dryer_three_more`{.value} points, and the delay is then `dryer_three_td`{.value} s. The step
-- responses are almost identical (@fig:dryer_step).
--
-- *Evidence against two poles:* the residuals are far from white, and on the second half, the residuals are still slightly correlated with the input
-- (@tbl:dryer_verdict, @fig:dryer_resid). With three poles, the correlation is smaller, $p =$ `dryer_three_p`{.value}. A test at the 99 % level does
-- not reject this model, but a test at the 95 % level does. The disturbances are colored, so the standard errors that assume white noise are too
-- small, by factors of up to `dryer_robust`{.value}. `present` therefore prints robust standard errors.
--
-- *A noise model:* `rivc` estimates two poles together with an autoregressive model of the noise, with a pole at
-- `dryer_ar`{.value}\ ±\ `dryer_ar_std`{.value}. With this noise model, the one-step-ahead prediction error is white ($p =$
-- `dryer_noise_white`{.value}). However, the prediction error is still correlated with the input ($p$ `dryer_noise_input`{.value}). The simulation of
-- the second half is not better (`dryer_noise_val`{.value} % compared with `dryer_val_short`{.value} %). A noise model describes the disturbance and
-- improves predictions. It does not add missing dynamics.
--
-- *Conclusion:* use two poles and a delay of `dryer_two_td`{.value} s for simulation and for controller design. The first tenths of a second may
-- require three poles. To test this hypothesis, do an experiment with faster switching and sampling. The fit alone does not reveal this question.
-- END SOLUTION

-- %% [markdown]
-- # What you have learned
--
-- BEGIN SOLUTION
-- * Inspect the data before you estimate: levels, drift, dead time, and anything unexpected. The plots and the formula for the power of a resistor
--   explained the heat-transfer plant, not a search over orders.
-- * Go from simple to complex models, and stop at the simplest model that validation data cannot distinguish from larger models. No single criterion
--   is always correct: the fit to the estimation data prefers the largest model, AIC tends to large models, and YIC tends to small models. Large
--   standard errors and zeros that cancel poles indicate too many parameters.
-- * A good fit to the estimation data is not a validation. Data that influenced a choice are no longer independent. The first model of the
--   heat-transfer plant had the best fit and the wrong gain.
-- * Validation shows the step to go back to. If the gain depends on the operating point, go back to the data. If the residuals contain slow waves, go
--   back to the preparation. If the residuals are correlated with the input, go back to the structure. One rejection among many tests can occur by
--   chance, so repeat the test.
-- * Standard errors are valid only if the structure and the noise model are correct. A missing lag changes the delay by many standard errors.
-- * The result is a recommendation with its limitations, not the largest number in a table.
-- END SOLUTION
--
-- # What you submit
--
-- ::: {.note}
-- If this lesson is graded, submit a model and its fit for each round of the loop, with `answer(name, value)`:
--
-- * `linear_orders`: the numbers of poles and zeros that you chose;
-- * `G_linear`: the model from the first data set, and `linear_fit`: the fit (%) of its simulated output to the second data set;
-- * `G_heat`: your final model of the heat-transfer plant, from the heater power in W to the temperature in °C;
-- * `G_dryer`: the model from the first half, and `dryer_fit`: the fit (%) of its simulated output to the second half.
--
-- Grading also runs your script on data of another system and of another heat-transfer plant. The checks look for the figures `linear_resid`,
-- `heat_high` and `dryer_compare`.
-- :::

-- %% id=hand_in
-- BEGIN SOLUTION
answer("linear_orders", vector{V.best.poles, V.best.zeros})
answer("G_linear", G)
answer("linear_fit", fit(val, G))
answer("G_heat", G3)
answer("G_dryer", H2)
answer("dryer_fit", fit(second, H2))
-- END SOLUTION

-- %% [markdown]
-- # Appendix: measures and literature
--
-- ::: measures
-- fit, RT2, YIC, AIC, BIC, FPE, Ljung-Box
-- :::
--
-- ::: references
-- :::
