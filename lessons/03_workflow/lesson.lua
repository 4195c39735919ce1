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
-- Estimating parameters is the short part of identification: one line of code. The long part is everything around it: which experiment, which part of
-- the data, which structure, and above all, can you believe the result? If you cannot, go back and change something. This is not a failure of the
-- work but the work itself [@ljung1999, chapter 17].
--
-- This lesson goes around the loop of @fig:workflow three times. @tbl:workflow lists the question that each step answers. The first process is a
-- simulated linear system. The second is a simulated heat-transfer plant, for which the obvious model fails twice. The third is a real hair dryer.
-- You can look up the truth of the two simulated processes at the end. The truth of the dryer is unknown. First watch Brian Douglas's video [*Linear
-- System Identification, Part 2*](https://www.youtube.com/watch?v=qC_C04SEV1E) (18 minutes). It goes around the same loop, with a simulated linear
-- system and with a heat exchanger.
--
-- The work is planned for two sessions of three hours:
--
-- | session | questions, with minutes | aim |
-- |--------------|-------------------------|------------------------|
-- | A structure that you can believe | 1 (15), 2 (30), 3 (20), 4 (20), 5 (30), 6 (20), 7 (15), 8 (15), 9 (15) | choose an order, validate, and use a failed validation to find what to change |
-- | What remains in the residuals | 10 (20), 11 (30), 12 (30), 13 (15), 14 (25), 15 (20), 16 (40) | find and remove a drift, assess parameters, and reach a conclusion without knowing the truth |
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
-- - validation |- b4: not believed
-- - b4 -> b3 -> b2 -> b1
-- - b4 -> structure
-- - b3 -> preparation
-- - b2 -> data
-- - b1 -> experiment
--
-- The identification loop: a model that you do not believe sends you back to the step that caused the problem. {#fig:workflow}
-- :::

-- %% id=workflow echo=false
report.table("workflow", {
    {"step", "question", "tools", "go back if"},
    {"experiment", "Does the input move the process at all frequencies of interest?", "prbs, multisine", "the data cannot answer a question"},
    {"data", "Rest, offset, drift, noise, dead time, faults?", "idplot, advice, delayest", "you see something unexpected"},
    {"preparation", "What remains without levels and drift?", "detrend, idfilt, split", "the model spends parameters on a level"},
    {"structure", "How many poles and zeros, which delay?", "srivcstruc, selcstruc", "two structures explain the data equally well"},
    {"estimation", "Which parameters, and how certain are they?", "srivc, tfsrivc, arx", "standard errors are as large as the values"},
    {"validation", "Does the model describe new data?", "compare, resid, step, bode", "it does not"},
})

-- %% [markdown]
-- ::: {.table name=workflow #tbl:workflow}
-- The identification loop: every step has a question, its tools, and a reason to go back to an earlier step.
-- :::
--
-- # A simulated system
--
-- ## Experiment and data
--
-- The first data set (@fig:linear_record) comes from a simulated system, sampled every 0.05 s from rest, with white noise on the output. The input is
-- a pseudo-random binary sequence of 127 bits of 0.4 s. A second data set with another sequence is reserved for validation.

-- %% id=linear_data
local record = load("linear_system")
local Ts = record.t[2] - record.t[1]
local names = {InputName = "u", OutputName = "y"}
local est = iddata(record.y, record.u, Ts, names)
local val = iddata(record.y_val, record.u_val, Ts, names)
report.figure("linear_record", idplot(est):set{height = 6}, "The first record")

-- %% [markdown]
-- ![The first data set: output (above) and binary input (below)](figure:linear_record){#fig:linear_record}
--
-- **Question 1.** Look at the data before you estimate, and run `advice`. Is there an offset or a drift? Over which frequencies does the input excite
-- the system? Is there a dead time (`delayest`)?

-- %% id=linear_look
-- BEGIN SOLUTION
advice(est)
local Td, delay_figure, delay = delayest(est)
-- for comparison: models with three poles and a zero and a fixed delay
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
-- The data start from rest at zero and oscillate around zero (mean `linear_mean`{.value}). Nothing has to be subtracted, and `advice` reports no
-- problem. A binary sequence has about the same power from its fundamental, `linear_low`{.value} rad/s, to about `linear_high`{.value} rad/s, where
-- its power has fallen to one half. The output oscillates with a period of about two seconds, well inside this band, so the experiment excites the
-- relevant dynamics. The estimated delay is `linear_td`{.value}\ ±\ `linear_td_std`{.value}\ s (@fig:linear_delay). It is not significantly different
-- from zero, so the model needs no delay parameter. The line and the separate points of @fig:linear_delay agree. Far from the minimum, the error of a
-- model with a wrong delay has several local minima over the other parameters. `delayest` follows the solutions of adjacent delays from both sides
-- until none gets lower.
--
-- ![Mean square error of a model at each delay. Line: `delayest`; separate points, for comparison: `srivc` with the delay fixed at whole samples; circle: the estimated delay.](figure:linear_delay){#fig:linear_delay}
-- END SOLUTION
--
-- ## Structure
--
-- **Question 2.** How many poles and zeros? Let `srivcstruc` estimate all structures up to five poles and three zeros from the first data set and
-- simulate them on the second. Which structure does each criterion choose, and which do you choose?

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
-- a row for every structure; where delays are estimated, delay_format writes them
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
-- the row that one criterion alone would choose; sign 1 where large is good, -1 where small is
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
-- All structures, with the fit to the first data set and to the second (validation). Large $R_T^2$ and fits are good, and small YIC and BIC are good.
-- A parameter is undetermined if its standard error is larger than its value.
-- :::
--
-- The measures are:
--
-- * The *fit* is $100\,(1 - \lVert y - \hat y\rVert/\lVert y - \bar y\rVert)$ % for the simulated output $\hat y$.
-- * $R_T^2 = 1 - \sigma_\varepsilon^2/\sigma_y^2$ is the explained share of the variance.
-- * BIC is $\ln V + d \ln(N)/N$ for the mean square $V$ of the errors, $d$ parameters and $N$ samples. AIC is the same with 2 instead of $\ln N$.
-- * YIC (Young's information criterion [@young2011]) is
--   $\ln(\sigma_\varepsilon^2/\sigma_y^2) + \ln\bigl(\tfrac1d\sum_i \hat\sigma_i^2/\hat\theta_i^2\bigr)$. It grows with the relative variance of the
--   parameters.
--
-- Read @tbl:linear_orders from simple to complicated, and look at the gain of each step. From one pole to two, and on to three poles and a zero, each
-- new parameter increases the fit to the validation data. After that, nothing is gained. The best model on the second data set, with
-- `linear_largest_poles`{.value} poles and `linear_largest_zeros`{.value} zeros, is ahead by `linear_largest_gain`{.value} points. Its parameters are
-- undetermined or cancel each other. The criteria do not agree:
--
-- * The fit to the estimation data almost never falls with another parameter. It chooses `linear_fit_poles`{.value} poles and
--   `linear_fit_zeros`{.value} zeros.
-- * AIC has a low price for a parameter. It chooses `linear_aic_poles`{.value} poles and `linear_aic_zeros`{.value}, but the next best structure is
--   only `linear_aic_gap`{.value} behind.
-- * BIC has a price that grows with the length of the data. It clearly stops at `linear_bic_poles`{.value} poles and `linear_bic_zeros`{.value} zero.
-- * YIC weighs the remaining error against the uncertainty of the parameters. It stops at `linear_yic_poles`{.value} poles, although this model
--   reaches only `linear_yic_fit`{.value} % on the second data set. YIC is for choosing among models that already have a good $R_T^2$.
--
-- The choice is `linear_poles`{.value} poles and `linear_zeros`{.value} zero: the simplest model that the second data set cannot distinguish from
-- more complicated ones.
-- END SOLUTION
--
-- **Question 3.** Was this luck? `rig("linear_system", {seed = k})` repeats both experiments with other noise. Count how often each
-- criterion chooses the same structure as you did.

-- %% id=linear_repeat
-- BEGIN SOLUTION
local repetitions = 30
local agreed, alarms = {recommended = 0}, 0
for seed = 1, repetitions do
    local again = rig("linear_system", {seed = seed})
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
local agreed_rows = {{"criterion", "same choice"},
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
-- Three poles and one zero, chosen from up to four poles and two zeros.
-- :::
--
-- @tbl:linear_agreed ranks the criteria. If the largest validation fit decides, you get this structure only `agreed_validation`{.value} times,
-- because one of the larger models is nearly always slightly ahead. If you choose the simplest model that is not clearly worse, you get this
-- structure `agreed_recommended`{.value} times out of `repetitions`{.value}.
-- END SOLUTION
--
-- ## Estimation
--
-- **Question 4.** Estimate the model of your structure by `srivc`, and for comparison the difference equation of the same order by `arx`. How well
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
-- The SRIVC model simulates the second data set with a fit of `linear_val`{.value} %, as well as the first (`linear_fit`{.value} %). The residuals
-- have a standard deviation of `linear_noise`{.value}. The `arx` model predicts the next sample with `arx_predict`{.value} % and simulates with
-- `arx_val`{.value} %. The order is right, but the assumption about the noise is wrong: `arx` assumes that the noise passes through the poles of the
-- system. Here it is added at the output. With `arx_long_order`{.value} poles, the bias shrinks and the simulation reaches `arx_long_val`{.value} %.
-- This is still less than a model of three poles with the right assumption. Check which fit a program reports: predicting one step ahead is easy, and
-- it hides this difference.
-- END SOLUTION
--
-- ## Validation
--
-- **Question 5.** Validate your model and a simpler one: the output on the second data set (`compare`), the residuals (`resid`), and the uncertainty
-- of the step and frequency responses (`step`, `bode`).

-- %% id=linear_compare
-- BEGIN SOLUTION
local simpler = srivc(est, {1, 2, 0})
local shown = compare(val:range(1, 400), G, simpler,
                      {labels = {"3 poles, 1 zero", "2 poles"}})
report.figure("linear_compare", shown:set{height = 6, x_range = {0, 20}},
              "Second data set")
local residuals = resid(val, G)
report.figure("linear_resid", residuals, "Residuals on the second record")
-- END SOLUTION

-- %% id=linear_tests echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local function structure(poles, zeros)
    local of_zeros = zeros == 0 and "no zero" or zeros == 1 and "1 zero" or zeros .. " zeros"
    return string.format("%d pole%s, %s", poles, poles > 1 and "s" or "", of_zeros)
end
local function p_text(p) return p < 0.001 and "< 0.001" or string.format("%.3f", p) end
local function tested(name, data, model)
    local _, test = resid(data, model, {quiet = true})
    local output = test.outputs[1]
    return {name, string.format("%.2f", fit(data, model)), p_text(output.p_value), p_text(output.inputs[1].p_value)}, output
end
local ladder = {{"structure", "fit (%)", "$p$ (error white)", "$p$ (free of the input)"}}
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
-- ![First 20 s of the second data set, and the simulated outputs of two models. The fits in the legend are for these 20 s. The simpler model rounds off the fast part of the response.](figure:linear_compare){#fig:linear_compare}
--
-- ::: {.table name=linear_ladder #tbl:linear_ladder}
-- The tests on the whole second data set. $p$ is the probability of such residuals if the error were white (Ljung–Box test on 25 autocorrelations),
-- and if it were independent of the input.
-- :::
--
-- ![Residuals of the model with three poles and a zero on the second data set: autocorrelation (above) and cross-correlation with the input (below). Shaded: the 99 % bounds. By chance, one lag in a hundred is outside them.](figure:linear_resid){#fig:linear_resid}
--
-- In @fig:linear_compare, the simpler model follows the oscillation and rounds off the rest. The tests are more sensitive than the eye
-- (@tbl:linear_ladder): for all simpler models, they find the input in the residuals. With three poles and a zero, the error is white, but the second
-- test still raises an alarm, $p =$ `linear_alarm`{.value} (@fig:linear_resid). Should we go back and add a pole? Another pole does not remove the
-- alarm, and on the first data set the same test gives $p =$ `linear_own`{.value}. The `repetitions`{.value} repetitions of question 3 include our
-- data as the first repetition. The number of alarms among them is `alarms`{.value}. A test at the 99 % level is wrong once in a hundred times even
-- for the true system. One alarm is a reason to look, not yet a reason to change the model.
-- END SOLUTION
--
-- **Question 6.** For this system the truth is known: `rig_truth("linear_system").G`. Do your estimates agree with it within their standard errors?

-- %% id=linear_truth
-- BEGIN SOLUTION
local truth = rig_truth("linear_system").G
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
-- The estimate (± one standard error) and the truth.
-- :::
--
-- ![Step response of the estimate minus that of the truth (line), and the 99 % band in which this difference should stay (shaded). The step response itself rises to 2.](figure:linear_step){#fig:linear_step}
--
-- ![Frequency responses of the estimate, with its 99 % band, and of the truth. Marked in the upper panel: the frequency at which the power of the input has fallen to one half, and the Nyquist frequency.](figure:linear_bode){#fig:linear_bode}
--
-- They do (@tbl:linear_truth): the largest error is `linear_worst`{.value} standard errors, which is not unusual for one of five parameters. The
-- truth is in the bands of @fig:linear_step and @fig:linear_bode. Far above `linear_high`{.value} rad/s, the input excites the system very little.
-- There, no data support the curve and its narrow band: they follow from the structure alone. The true system itself reaches no more than
-- `linear_true_val`{.value} % on the second data set. The rest is noise. The loop ends here.
-- END SOLUTION

-- %% [markdown]
-- # A heat-transfer plant
--
-- ## Experiment and data
--
-- ::: {.drawing name=heat_rig}
-- The heat-transfer plant: a fan blows air over a heater with the voltage $u$; the temperature $y$ is measured at the end of the tube {#fig:heat_rig}
-- :::
--
-- In this simulated plant (@fig:heat_rig), a fan blows air over an electric heater and through a tube. The input is the voltage of the heater, and
-- the output is the temperature at the end of the tube, one sample per second. There are two data sets around 4 V, for estimation and validation, and
-- one around 7 V (@fig:heat_record). Each begins with a minute of rest. A binary sequence of ±1 V follows, with bits of 15 s.

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
-- **Question 7.** What do you see, and what does `advice` report? How do you prepare the data?

-- %% id=heat_advice
-- BEGIN SOLUTION
advice(low)
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- The process is slow (@fig:heat_record): the temperature never settles within one bit, and its long lag smooths the sequence. The experiment is
-- therefore rich enough, and much shorter bits would be wasted. The process starts at rest at an operating point, and a transfer function describes
-- only changes. Subtract the level of the first minute from both signals (`detrend(data, "start")`). The mean is less suitable, because the data
-- begin away from it. (`advice` also gives a temperature at zero voltage and calls it an extrapolation: no sample is near it.) The temperature reacts
-- some seconds late. It is rounded to 0.1 °C. `advice` warns about the rounding, but according to its numbers, the noise is far larger. It also finds
-- that the temperature drifts by some tenths of a degree relative to the response to the heater. Finally, the same ±1 V has a larger effect on the
-- temperature around 7 V than around 4 V. This is unexpected, and no single data set can show it.
-- END SOLUTION
--
-- ## First round: voltage in, temperature out
--
-- **Question 8.** Estimate a model with two poles and a delay from the first data set. Because 60 noisy samples do not determine the level, also
-- estimate a constant (`Offset = "estimate"`). The process starts at rest (`InitialState = "none"`). How well does the model describe the two other
-- data sets?
--
-- First, enter a prediction: with which fit will the model simulate the data around 7 V? `outcome` prints your prediction next to the result.

-- %% id=heat_guess
-- BEGIN SOLUTION
-- STARTER: guess("fit about 7 V", nil, "%")
guess("fit about 7 V", 80, "%")
-- END SOLUTION

-- %% id=heat_first
-- BEGIN SOLUTION
local function start(data) return detrend(data, "start") end
local G1 = tfsrivc(start(low), 2, 0,
                   {TdMax = 20, InitialState = "none", Offset = "estimate"})
print(G1)
outcome("fit about 7 V", fit(start(high), G1))
-- END SOLUTION

-- %% id=heat_first_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local rounds = {{"round, input", "subtracted", "4 V", "4 V again", "7 V", "$p$ (white)", "$p$ (input)"}}
-- fits to the three prepared data sets and the residual tests on the second
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
-- On its estimation data, the model reaches `heat1_low`{.value} %, and you may be tempted to stop here. On the second data set it reaches
-- `heat1_val`{.value} %, and around 7 V only `heat1_high`{.value} %. The model fails, and the failure shows where to look. A model of the same form,
-- fitted around 7 V, has a gain of `heat_high_gain`{.value} °C/V instead of `heat1_gain`{.value} °C/V. No further pole or zero can fix a gain that
-- depends on the operating point. *Back to the step "data".*
-- END SOLUTION
--
-- ## Second round: think of the physics
--
-- **Question 9.** What heats the air? The heater gives 100 W at 10 V. Choose a better input and repeat the estimation.

-- %% id=heat_second
-- BEGIN SOLUTION
local function watts(data)            -- power goes with the square of the voltage
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
report.figure("heat_high", both, "Two models on the record about 7 V")
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
-- ![Two models, both estimated around 4 V, on the data around 7 V: measured temperature (gray), model from the voltage (dotted) and from the power (black). Both simulated curves are shifted to the mean of the measured curve, to compare only the shape. Therefore the curve from the voltage does not begin at zero.](figure:heat_high){#fig:heat_high}
--
-- A resistor turns $u^2/R$ into heat, so the power is the natural input, and this knowledge costs no parameter. The model estimated around 4 V now
-- reaches `heat2_high`{.value} % around 7 V (@fig:heat_high). But on the estimation data, the fit has fallen to `heat2_low`{.value} %, and on the
-- second data set it is `heat2_val`{.value} %. These data contain another effect.
-- END SOLUTION
--
-- ::: note
-- The second session begins here: *what remains in the residuals*. Run your script (`dynlab run -i analysis.lua`) and look at the fits of both models
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
-- correlation of the waves with what the input does
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
-- They show slow waves of up to `heat_drift`{.value} °C, different in each data set (@fig:heat_drift). Does the input cause them? The difference
-- proves nothing, because the inputs also differ. The correlation of the waves with the simulated response is `heat_corr_val`{.value} in the second
-- data set and `heat_corr_high`{.value} in the third. (In the first, least squares has removed it.) But with only one or two waves, chance easily
-- gives a correlation of one half, so these data cannot decide. The decisive experiment applies the same bits twice: effects of the input would
-- repeat. The likely cause is the air in the room, which warms and cools. Here the description of the simulated plant confirms it (an inlet
-- temperature that drifts by ±0.4 °C). Neither a constant nor a straight line describes such waves. *Back to the step "preparation".*
-- END SOLUTION
--
-- ## Third round: remove the drift
--
-- **Question 11.** Remove the slow waves with a high-pass filter. Why must both signals pass through the same filter? Which edge frequency do you
-- choose?

-- %% id=heat_third
-- BEGIN SOLUTION
local function prepared(data, edge)
    return idfilt(start(data), {edge, math.huge}, {order = 2})
end
local function second_order(edge)
    return procsrivc(prepared(watts(low), edge), "P2D",
                     {TdMax = 20, InitialState = "zero", Offset = "none"})
end
local edge = 0.015                    -- rad/s
local G3 = second_order(edge)
present(G3)
-- END SOLUTION

-- %% id=heat_third_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local edges = {{"edge (rad/s)", "gain (°C/W)", "slow lag (s)", "fast lag (s)", "delay (s)", "$p$ (error white)"}}
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
-- A filter on both signals does not change the relation between them: if $y = Gu$, then $Ly = G\,Lu$. A filter on the output alone would become a
-- part of the model.
--
-- ::: {.table name=heat_edges #tbl:heat_edges}
-- Estimates with four edge frequencies of the filter (± one standard error, robust if the residuals are not white). The last column is the test for
-- whiteness on the second data set.
-- :::
--
-- If the edge frequency is too low, drift remains. If it is too high, the filter removes the information about the slow lag and the gain, and their
-- errors grow (@tbl:heat_edges). At `edge`{.value} rad/s, close to the corner frequency of the slow lag, the residuals on the second data set are
-- white for the first time, $p =$ `heat_second_white`{.value}. (`present` reports on the first data set, from which the model was estimated. There, a
-- trace of the drift remains, $p =$ `heat_first_white`{.value}, so use the robust standard errors.)
--
-- ::: {.table name=heat_rounds #tbl:heat_rounds}
-- The three rounds: fit (%) on the three prepared data sets. The last columns are for the second data set: the probabilities $p$ of such residuals if
-- the error were white, and if it were independent of the input.
-- :::
--
-- @tbl:heat_rounds summarizes the three rounds. Different rows have differently prepared signals, so you cannot subtract their fits. But in the third
-- row all three data sets agree, unlike in the first two, and the tests do not reject the model. Note, however, that the test on the second data set
-- determined the edge frequency, so this data set is no longer independent evidence. The data around 7 V did not influence any choice: there the fit
-- is `heat3_high`{.value} %, and the test for whiteness gives $p =$ `heat_high_white`{.value}. The last row shows the filter without the physics. It
-- makes the two data sets around 4 V agree, and the fit to the third is `heat_filter_only`{.value} %. The first column of fits alone would favor the
-- first model.
-- END SOLUTION
--
-- **Question 12.** With the right input and preparation: are two poles enough? Which parameters can you believe? Compare with
-- `rig_truth("heat_transfer")`, which has a dead time and three lags.

-- %% id=heat_orders
-- BEGIN SOLUTION
local clean = prepared(watts(low), edge)
local W = srivcstruc(clean, {poles = {1, 4}, zeros = {0, 1}, TdMax = 20,
                             InitialState = "none", Offset = "none",
                             validate = prepared(watts(low_val), edge)})
print(W.recommendation)
local G3c = procsrivc(clean, "P3D",
                      {TdMax = 20, InitialState = "zero", Offset = "none"})
-- END SOLUTION

-- %% id=heat_orders_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
report.table("heat_orders", orders_table(W, "%.2f"))
local rig = rig_truth("heat_transfer")
local watts_per_volt = 2*rig.low.voltage
local true_gain = rig.low.gain/watts_per_volt
local true_lags = sort{rig.sensor_time, rig.low.fast}
local small = G3.Td + G3.Tp2
local C = G3.report.white and G3.covariance or G3.robust_covariance
local small_std = math.sqrt(C:at(3, 3) + C:at(4, 4) + 2*C:at(3, 4))
local true_small = rig.dead_time + rig.sensor_time + rig.low.fast
report.table("heat_truth", {
    {"lags", "gain (°C/W)", "slow (s)", "short (s)", "delay (s)", "sum (s)"},
    {"truth", string.format("%.3f", true_gain), string.format("%.1f", rig.low.slow),
     string.format("%.1f, %.1f", true_lags[2], true_lags[1]), string.format("%.1f", rig.dead_time), string.format("%.1f", true_small)},
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
report.value("heat_td_ratio", (G3.Td - rig.dead_time)/errors(G3)[4], "%.0f")
report.value("heat_poles", W.best.poles, "%d")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=heat_orders #tbl:heat_orders}
-- Structures for the prepared data; columns as in @tbl:linear_orders.
-- :::
--
-- ::: {.table name=heat_truth #tbl:heat_truth}
-- The truth and models with two and three lags (± one standard error): gain, slow lag, short lags, delay; last, the sum of the delay and the short lags.
-- :::
--
-- These data support `heat_poles`{.value} poles (@tbl:heat_orders): a third one does not change the fit, and its errors are as large as the lags
-- (@tbl:heat_truth). Gain and slow lag agree with the truth. The delay does not: its estimate is `heat_td`{.value}\ ±\ `heat_td_std`{.value}\ s, and
-- the true dead time is `heat_td_ratio`{.value} standard errors smaller. The arithmetic is right. But a standard error is valid only *if the
-- structure is right*. Here a third, short lag is missing, and the delay compensates for it. The data determine the sum of the delay and the short
-- lags well: `heat_small`{.value}\ ±\ `heat_small_std`{.value}\ s. For a controller, use the model with two poles. To find the true dead time, you
-- need a faster experiment.
-- END SOLUTION

-- %% [markdown]
-- # A real hair dryer
--
-- ## Experiment and data
--
-- The third process is real. The heating of a hair dryer was switched at random between two voltages, and a thermocouple measured the air at the
-- outlet. There are 1000 samples, one every 0.08 s (@fig:dryer_record). The truth is unknown, and there is no second experiment.

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
-- **Question 13.** Prepare the data: one half for estimation, one for validation, both without their means. Is there a dead time? (By default, the
-- estimators choose the initial state and the offset. Here every model starts from rest without an offset, `from_rest`, so that only the structures
-- differ.)

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
-- Both signals oscillate around an operating point (means `dryer_u`{.value} V and `dryer_y`{.value} V). As `advice` also reports, there is no rest at
-- the beginning, so subtract the means. The slight drift is far smaller than the effect of the input. The output responds late, by
-- `dryer_td`{.value}\ ±\ `dryer_td_std`{.value}\ s, which is `dryer_td_samples`{.value} samples (@fig:dryer_delay).
--
-- ![Mean square error of a model at each delay, with all other parameters estimated again. The minimum is flat from 0.1 to 0.2 s; marked: the estimate.](figure:dryer_delay){#fig:dryer_delay}
-- END SOLUTION
--
-- ## Structure and estimation
--
-- **Question 14.** Which structure? Estimate the delay for each structure. What happens to the delay if the model has too few poles?

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
-- Structures for the hair dryer, each with its own delay; columns as in @tbl:linear_orders, validation on the second half.
-- :::
--
-- With one pole, the estimated delay is `dryer_one_td`{.value} s: a longer delay compensates for a missing lag. YIC alone would choose this model,
-- but the second half of the data contradicts it. With `dryer_poles`{.value} poles, the delay is `dryer_two_td`{.value} s, two samples. You can fix
-- it there, which saves a parameter. With two poles, a zero gains nothing. BIC would prefer three poles and a zero (`dryer_bic_31`{.value} compared
-- with `dryer_bic_20`{.value}). But one of these poles is at `dryer_drift_pole`{.value} rad/s, with the zero next to it at `dryer_drift_zero`{.value}
-- rad/s. A time constant of `dryer_drift_time`{.value} s describes the slow drift of these data and not the dryer. On the second half, the fit is
-- lower: `dryer_val_31`{.value} compared with `dryer_val_20`{.value} %. The model
--
-- $$ G(s) = \frac{b_0}{s^2 + a_1 s + a_2}\,e^{-2T_s s} $$ {#eq:solution-dryer}
--
-- with $a_1 =$ `dryer_a1`{.value}\ ±\ `dryer_a1_std`{.value}, $a_2 =$ `dryer_a2`{.value}\ ±\ `dryer_a2_std`{.value} and $b_0 =$
-- `dryer_b0`{.value}\ ±\ `dryer_b0_std`{.value} (robust standard errors) has a gain of `dryer_gain`{.value} and lags of `dryer_slow`{.value} s and
-- `dryer_fast`{.value} s. It fits the first half with `dryer_fit`{.value} % ($R_T^2 =$ `dryer_rt2`{.value}) and the second with `dryer_val`{.value}
-- %. The model with one pole and three samples of delay, $a_1 =$ `dryer1_a1`{.value} and $b_0 =$ `dryer1_b0`{.value}, reaches `dryer1_fit`{.value} %
-- and `dryer1_val`{.value} %.
-- END SOLUTION
--
-- **Question 15.** Compare with difference equations found by `arx`, with delays of two and of three samples. What does the coefficient of $u(k-2)$
-- show?

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
    {"factor of $u(k-2)$", coefficient(A2, 3, "%.4f"), "none"},
    {"factor of $u(k-3)$", coefficient(A2, 4, "%.4f"), coefficient(A3, 3, "%.4f")},
    {"factor of $u(k-4)$", "none", coefficient(A3, 4, "%.4f")},
    {"fit predicting one step (%)", string.format("%.1f", A2.report.prediction_fit_percent),
     string.format("%.1f", A3.report.prediction_fit_percent)},
    {"fit simulating (%)", string.format("%.1f", A2.report.fit_percent), string.format("%.1f", A3.report.fit_percent)},
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
-- Two difference equations from all 1000 samples, with plain standard errors, and their fits.
-- :::
--
-- The coefficient of $u(k-2)$ is `arx_weight`{.value} % of the next one. Another sample of delay makes the model better with the same number of
-- parameters (@tbl:dryer_arx). Three samples here are the same delay as two in @eq:solution-dryer, because a held input affects a sampled output one
-- sample later at the earliest. The noise of this plant seems to pass through the air too, as `arx` assumes. Therefore, unlike in the first example,
-- the `arx` model is good: estimated from the first half, it simulates the second with `arx3_half`{.value} %. The `arx3_prediction`{.value} % for
-- one-step prediction says little.
-- END SOLUTION
--
-- ## Validation and conclusion
--
-- **Question 16.** Validate. Is a third pole worth its parameter? State which model you recommend and what it does not explain.

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
-- two poles again, with an autoregressive model of the noise (a CBJ structure)
local HN = rivc(first, {1, 0, 1, 2, 2}, from_rest)
local _, noise_test = resid(second, HN, {prediction = true, quiet = true})
-- END SOLUTION

-- %% id=dryer_validate_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local verdict = {{"model", "fit, second half (%)", "$p$ (error white)", "$p$ (free of the input)"}}
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
-- Fits on the second half, and the probabilities $p$ of such residuals if the error were white and if it were independent of the input.
-- :::
--
-- ![Residuals of the model with two poles on the second half: autocorrelation (above) and cross-correlation with the input (below); shaded: the 99 % bounds](figure:dryer_resid){#fig:dryer_resid}
--
-- ![Step responses of the models with two and with three poles, with 99 % bands. They differ only in the first tenths of a second.](figure:dryer_step){#fig:dryer_step}
--
-- *Evidence for two poles:* the fit to validation data is good, every parameter is well determined, and an independent `arx` confirms the delay of
-- whole samples. A third pole adds `dryer_three_more`{.value} points, and its delay is `dryer_three_td`{.value} s. The step responses are almost
-- identical (@fig:dryer_step).
--
-- *Evidence against two poles:* the residuals are far from white, and on the second half the input still explains a small part of them
-- (@tbl:dryer_verdict, @fig:dryer_resid). With three poles, this part is smaller but not zero: $p =$ `dryer_three_p`{.value}. A test at the 99 %
-- level does not reject the model, and a test at the 95 % level does. The disturbances are colored, so the plain standard errors are too small, by
-- factors up to `dryer_robust`{.value}. `present` therefore prints robust standard errors.
--
-- *A noise model:* `rivc` estimates two poles together with an autoregressive model of the noise, with a pole at
-- `dryer_ar`{.value}\ ±\ `dryer_ar_std`{.value}. It makes the one-step prediction error white ($p =$ `dryer_noise_white`{.value}). But the input is
-- still visible in this error ($p$ `dryer_noise_input`{.value}), and the simulation of the second half is no better (`dryer_noise_val`{.value}
-- compared with `dryer_val_short`{.value} %). A noise model describes the disturbance. It does not add missing dynamics. It is useful for prediction.
--
-- *Conclusion:* use two poles and `dryer_two_td`{.value} s for simulation and for controller design. To learn more about the first tenths of a
-- second, three poles are the hypothesis, and the next step is an experiment with faster switching and sampling. A fit alone would have hidden this
-- question.
-- END SOLUTION

-- %% [markdown]
-- # What you have learned
--
-- BEGIN SOLUTION
-- * Look before you estimate: levels, drift, dead time, and anything unexpected. The plot and the formula for the heat of a resistor, not a search
--   over orders, explained the heat-transfer plant.
-- * Go from simple to complicated, and stop at the simplest model that validation data cannot distinguish from larger ones. No single criterion is
--   right: the fit never stops, AIC stops late, and YIC stops early. Standard errors and canceling zeros reveal too many parameters.
-- * A good fit to the estimation data is not a validation. Data that influenced a choice are no longer independent. The first model of the
--   heat-transfer plant had the best fit and the wrong gain.
-- * Validation shows the step to go back to. A gain that depends on the operating point: data. Slow waves in the residuals: preparation. An input
--   that is still visible in the residuals: structure. One alarm among many tests may be chance. Repeat the test before you believe it.
-- * Standard errors are valid only for the right structure and noise. A missing lag changes the delay by many standard errors.
-- * The result is a recommendation with its limits, not the largest number in a table.
-- END SOLUTION
--
-- # What you submit
--
-- ::: {.note}
-- If this lesson is graded, submit a model and its quality for each round of the loop, with `answer(name, value)`:
--
-- * `linear_orders`: the numbers of poles and zeros that you chose;
-- * `G_linear`: the model from the first data set, and `linear_fit`: the fit in percent of its simulated output to the second;
-- * `G_heat`: your final model of the heat-transfer plant, from the heater's power in W to °C;
-- * `G_dryer`: the model from the first half, and `dryer_fit`: the fit of its simulated output to the second half.
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
