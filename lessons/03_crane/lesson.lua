-- ---
-- title: Identification of a trolley crane
-- subtitle: Lesson 3.2 – one input, two outputs, and a report
-- lesson: 03_crane
-- template: lab_report
-- language: en
-- seed: 1
-- answers:
--   discarded: vector
--   rest_angle: number
--   G_position: model
--   G_angle: model
--   fits: vector
--   free_swing: number
-- ---

-- %% [markdown]
-- A motor pulls a trolley along a rail, and a pendulum hangs from the trolley. One voltage moves the trolley and the load, so the model has two
-- outputs: the position of the trolley and the angle of the load (@fig:crane). You get five data sets. In one of them, no linear model can describe
-- part of the motion. The crane is *simulated*: a program solves its equations of motion and adds noise. Identify a model, assess its quality, and
-- describe your work so that a reader can repeat it.
--
-- ::: {.drawing name=crane}
-- The crane: the motor's voltage $u$, the position $x$ of the trolley and the angle $\theta$ of the rod, all positive as drawn {#fig:crane}
-- :::
--
-- Work in this script, cell by cell, and write your text in `report.md`. This file contains the required sections of a report, with notes on the
-- content of each section. You submit the report: at most six pages, seven with the appendix.
--
-- # The data
--
-- | data set | experiment |
-- |-----------|-----------------------|
-- | `estimation`, `validation` | rest, then a pseudo-random binary voltage of ±2 V, with a different sequence in each data set |
-- | `steps` | rest, then pulses of ±2 V and ±4 V with pauses between them |
-- | `free_swing` | motor at 0 V, the load released by hand |
-- | `limits` | pseudo-random binary voltage, then manual motion to both ends of the rail, then pseudo-random binary voltage again |
--
-- Each data set contains `t` (s), `u` (V), `x` (m) and `theta` (rad), sampled every 0.02 s. The voltage is constant between two samples.

-- %% id=records
local crane = load("crane")
local Ts = 0.02
local function say(english, french)
    return report.language() == "fr" and french or english
end
local signals = {InputName = say("voltage", "tension"), InputUnit = "V",
                 OutputName = {"position", "angle"}, OutputUnit = {"m", "rad"}}
local estimation = iddata(matrix{crane.estimation.x, crane.estimation.theta},
                          crane.estimation.u, Ts, signals)
print(estimation)
idplot(estimation)

-- %% [markdown]
-- **Question 1.** Plot the raw data. What can you see before you compute anything?

-- %% id=raw
-- BEGIN SOLUTION
local seconds = say("time (s)", "temps (s)")
local volts, meters = say("voltage (V)", "tension (V)"), "position (m)"
local radians = "angle (rad)"

local function panels(record, further)
    local list = {
        {ylabel = volts, curves = {{x = record.t, y = record.u, style = "stairs", color = 8}}},
        {ylabel = meters, curves = {{x = record.t, y = record.x, color = 0}}},
        {ylabel = radians, xlabel = seconds, curves = {{x = record.t, y = record.theta, color = 1, dash = 0}}},
    }
    for _, panel in ipairs(list) do
        for key, value in pairs(further or {}) do panel[key] = value end
    end
    return list
end

local purposes = {
    {"estimation", say("PRBS, ±2 V", "SBPA, ±2 V"), say("structure and parameters", "structure et paramètres")},
    {"validation", say("PRBS, ±2 V, other sequence", "SBPA, ±2 V, autres bits"), "validation"},
    {"steps", say("pulses of ±2 V and ±4 V", "impulsions de ±2 V et ±4 V"), say("effect of friction", "ce que coûte le frottement")},
    {"free_swing", say("0 V, load released by hand", "0 V, charge lâchée à la main"), say("pendulum only", "la charge seule")},
    {"limits", say("PRBS, ±12 V manually, PRBS", "SBPA, ±12 V à la main, SBPA"),
     say("saturation; discard in part", "à écarter en partie")}}
local experiments = {{say("data set", "enregistrement"), say("input", "entrée"), say("duration (s)", "durée (s)"),
                      say("used for", "utilité")}}
for k, row in ipairs(purposes) do
    local t = crane[row[1]].t
    experiments[k + 1] = {row[1], row[2], string.format("%.0f", t[#t]), row[3]}
end
report.table("experiments", experiments)

report.figure("raw", figure{rows = 3, height = 6.4, panels = panels(crane.estimation)},
              say("The measured estimation data. The position drifts like the integral of the voltage, and the load swings at its natural frequency.",
                  "L'enregistrement d'estimation tel que mesuré : la position dérive comme l'intégrale de la tension ; la charge oscille à sa pulsation propre."))
-- END SOLUTION

-- %% [markdown]
-- **Question 2.** What do the first second of the data and the differences between samples show about noise, resolution, and levels at rest?
--
-- **Question 3.** Which part of `limits` can no linear model describe, and why? Find its start and end times, and compare them with the output of
-- `advice` and its field `discard`.

-- %% id=preparation
-- BEGIN SOLUTION
local rest = 50  -- samples before the input changes
local function smallest_step(v)
    local smallest = math.huge
    for _, d in ipairs(abs(diff(v)):table()) do
        if d > 1e-9 and d < smallest then smallest = d end
    end
    return smallest
end
report.value("samples", #crane.estimation.t, "%d")
report.value("duration", crane.estimation.t[#crane.estimation.t], "%.0f")
report.value("rest_angle", 1e3*mean(crane.estimation.theta:range(1, rest)), "%.0f")  -- 2 mrad of noise in 50 samples: ± 0.3
report.value("angle_noise", 1e3*std(crane.estimation.theta:range(1, rest)), "%.1f")
report.value("angle_step", 1e3*smallest_step(crane.estimation.theta), "%.1f")
report.value("position_step", 1e3*smallest_step(crane.estimation.x), "%.1f")
report.value("way", max(crane.estimation.x) - min(crane.estimation.x), "%.2f")
report.value("largest_angle", max(abs(crane.estimation.theta)), "%.2f")

local amplifier, buffers = 10, 0.495  -- V, m: limit of the amplifier, and a position just before the rubber buffers
local limits = crane.limits
local first, last
for k = 1, #limits.t do
    if abs(limits.u[k]) > amplifier or abs(limits.x[k]) > buffers then
        first, last = first or k, k
    end
end
report.value("discard_from", limits.t[first], "%.1f")
report.value("discard_to", limits.t[last], "%.1f")

local advised = advice(iddata(matrix{limits.x, limits.theta}, limits.u, Ts, signals)).discard
if #advised > 0 then
    report.value("advised_from", limits.t[advised[1][1]], "%.1f")
    report.value("advised_to", limits.t[advised[#advised][2]], "%.1f")
else  -- on some cranes, this part is too short for advice to detect
    report.value("advised_from", "–")
    report.value("advised_to", "–")
end

local limit_panels = panels(limits)
for k, panel in ipairs(limit_panels) do
    panel.references = {{x = limits.t[first], dash = 2}, {x = limits.t[last], dash = 2}}
end
limit_panels[2].references[3] = {y = 0.5}
limit_panels[2].references[4] = {y = -0.5}
report.figure("limits", figure{rows = 3, height = 6.4, panels = limit_panels},
              say("The data `limits`. Between the vertical lines, the commanded voltage exceeds ±10 V and the trolley reaches the buffers at ±0.5 m (horizontal lines).",
                  "L'enregistrement `limits`. Entre les traits verticaux, on commande plus de ±10 V et le chariot rencontre les butées à ±0,5 m (traits horizontaux)."))
-- END SOLUTION

-- %% [markdown]
-- **Question 4.** Which element in the path from voltage to position cannot be fully identified from a finite data set? Derive the equations of
-- motion of the crane. Which poles and zeros do the transfer functions of position and angle have in common?
--
-- **Question 5.** Compare structures for each output on estimation and validation data (`srivcstruc`).

-- %% id=structure
-- BEGIN SOLUTION
-- The integral of a zero-order-hold voltage is piecewise linear, so this data object is exact.
local function integrated(record, y)
    local integral = Ts*(cumsum(record.u) - record.u)
    return detrend(iddata(y, integral, Ts, {InterSample = "foh"}), "start", {samples = rest})
end
local function direct(record, y)
    return detrend(iddata(y, record.u, Ts), "start", {samples = rest})
end
local from, against = crane.estimation, crane.validation
local tried = {
    {"position", "$F$", direct(from, from.x), direct(against, against.x), say("integrator inexact", "intégr. inexact")},
    {"position", "$sF$", integrated(from, from.x), integrated(against, against.x), say("chosen", "retenu")},
    {"angle", "$F$", direct(from, from.theta), direct(against, against.theta), say("chosen", "retenu")},
}
local shown = {{{1, 0}, {2, 0}, {4, 2}}, {{1, 0}, {3, 2}, {4, 3}}, {{2, 1}, {3, 0}, {3, 1}, {4, 2}}}
local function remark(row)
    if not row.converged then return say("not converged", "non stabilisé") end
    if row.cancellation then return say("zero cancels pole", "zéro sur pôle") end
    if #row.undetermined > 0 then
        local several = #row.undetermined > 1 and "s" or ""
        local which = #row.undetermined > 3 and #row.undetermined or table.concat(row.undetermined, ", ")
        return which .. say(" uncertain", " incertain" .. several)
    end
    return ""
end
local orders = {{say("output", "sortie"), say("denom.", "dénom."), say("poles of $F$", "pôles de $F$"),
                 say("zeros", "zéros"), "YIC", "BIC", say("fit (%)", "adéq. (%)"), say("val. (%)", "valid. (%)"),
                 say("remark", "remarque")}}
for k, case in ipairs(tried) do
    local V = srivcstruc(case[3], {poles = {1, 4}, zeros = {0, 3}, InitialState = "none", Offset = "none", validate = case[4]})
    for _, order in ipairs(shown[k]) do
        for _, row in ipairs(V.rows) do
            if row.poles == order[1] and row.zeros == order[2] then
                local chosen = row.poles == V.best.poles and row.zeros == V.best.zeros
                orders[#orders + 1] = {
                    case[1], case[2], row.poles, row.zeros, string.format("%.1f", row.yic), string.format("%.2f", row.bic),
                    string.format("%.2f", row.fit_percent), string.format("%.2f", row.validation_fit),
                    chosen and case[5] or remark(row)}
            end
        end
    end
end
report.table("orders", orders)
local delayed = tfsrivc(direct(from, from.theta), 3, 1, {TdMax = 0.1, NumTd = 6, InitialState = "none", Offset = "none"})
report.value("delay", 1e3*delayed.IODelay, "%.1f")
report.value("delay_fit", fit(direct(against, against.theta), delayed), "%.2f")
-- END SOLUTION

-- %% [markdown]
-- **Question 6.** Estimate the model that you chose. If you estimate the two outputs separately, do the models agree on the common dynamics? Compare
-- them with the joint estimate (`CommonDenominator`). You cannot add millimeters and milliradians. By what factor do you scale the errors of each
-- output (`OutputWeights`)?

-- %% id=estimate
-- BEGIN SOLUTION
local function both(record) return integrated(record, matrix{record.x, record.theta}) end
local options = {TdMax = 0, InitialState = "none", Offset = "none"}
local position = tfsrivc(integrated(from, from.x), 3, 2, options)
local angle = tfsrivc(direct(from, from.theta), 3, 1, options)
-- Divide the errors of each output by their standard deviation, known from a first estimate.
local function joint_model(data, more)
    local chosen = {TdMax = 0, CommonDenominator = true, InitialState = "none", Offset = "none"}
    for name, value in pairs(more or {}) do chosen[name] = value end
    local first = tfsrivc(data, 3, 2, chosen)
    local _, tests = resid(data, first, {InitialState = chosen.InitialState, Offset = chosen.Offset, quiet = true})
    chosen.OutputWeights = {1/math.sqrt(tests.outputs[1].variance), 1/math.sqrt(tests.outputs[2].variance)}
    return tfsrivc(data, 3, 2, chosen), chosen.OutputWeights
end
-- The recommended model: the two numerator coefficients of the angle that are zero in the physical model are set to zero.
local function recommended(joint)
    local p = joint.param
    local F = {1, p[1], p[2], p[3]}
    local frequency, damping = damp(tf({1}, F))
    local swing = damping[1] < 1 and 1 or 3  -- damp sorts by frequency; the pole of the motor is real
    return {F = F, x = tf({p[4], p[5], p[6]}, F), theta = tf({p[7], 0}, F), swing = frequency[swing],
            damping = damping[swing], motor = frequency[4 - swing], pendulum = math.sqrt(p[6]/p[4])}
end
local joint, output_weights = joint_model(both(from))
present(joint)
-- END SOLUTION

-- %% id=estimate_report echo=false
-- BEGIN SOLUTION
local model = recommended(joint)
-- Formats a value with its error. The error has one significant digit, or two if they are below 20.
local function rounded(value, error)
    local digits = math.floor(math.log(error, 10) + 1e-9)
    if error/10^digits < 1.95 then digits = digits - 1 end
    local unit, format = 10^digits, "%." .. math.max(0, -digits) .. "f"
    local function written(x) return string.format(format, unit*math.floor(x/unit + 0.5)) end
    return written(value) .. " ± " .. written(error)
end
local function with_error(G, name)
    for k, n in ipairs(G.names) do
        if n == name then return rounded(G.param[k], G.robust_std[k]) end
    end
    return ""
end
-- Rows of the parameter table; question 9 adds the scatter of each parameter.
local rows = {}
for k, name in ipairs{"a1", "a2", "a3"} do
    rows[k] = {"$a_" .. k .. "$", with_error(position, name), with_error(angle, name), with_error(joint, name)}
end
for k, name in ipairs{"b0", "b1", "b2"} do
    rows[3 + k] = {"$b_" .. k - 1 .. "$", with_error(position, name), "", with_error(joint, name .. "_y1")}
    rows[6 + k] = {"$c_" .. k - 1 .. "$", "", k < 3 and with_error(angle, name) or "", with_error(joint, name .. "_y2")}
end
report.value("weight_x", 1e3/output_weights[1], "%.1f")
report.value("weight_theta", 1e3/output_weights[2], "%.1f")
report.value("swing", model.swing, "%.3f")
report.value("swing_damping", model.damping, "%.3f")
report.value("pendulum", model.pendulum, "%.3f")
report.value("motor_pole", model.motor, "%.1f")
report.value("motor_time", 1e3/model.motor, "%.0f")
report.value("speed_gain", 1e3*dcgain(model.x), "%.1f")
report.value("length", -joint.param[4]/joint.param[7], "%.3f")
report.value("length_from_swing", 9.81/model.pendulum^2, "%.3f")
report.value("passes", position.report.iterations, "%d")
-- END SOLUTION

-- %% [markdown]
-- **Question 7.** What else did you try, and why did you reject it? Compare the simulation of an ARX model. Also estimate your model from `limits`:
-- first from all of it, then without the part that you discarded. How does the model change?

-- %% id=discarded
-- BEGIN SOLUTION
local resting = {InitialState = "none", Offset = "none"}
local x_val, theta_val = integrated(against, against.x), direct(against, against.theta)
local function facts(name, G)
    return {name, string.format("%.2f", fit(x_val, G.x, resting)), string.format("%.2f", fit(theta_val, G.theta, resting)),
            string.format("%.3f", G.swing), string.format("%.1f", 1e3*dcgain(G.x))}
end
local whole = recommended(joint_model(both(limits)))
local parts = both(limits):keep{{1, first - 1}, {last + math.floor(1/Ts), #limits.t}}
local kept = recommended(joint_model(parts, {InitialState = "estimate", Offset = "estimate"}))
local held = arx(direct(from, from.theta), {3, 3, 1})
report.value("arx_fit", fit(theta_val, held, resting), "%.0f")
report.value("arx_prediction", held.report.prediction_fit_percent, "%.1f")
report.table("sources", {
    {say("estimated from", "estimé sur"), "position (%)", "angle (%)",
     say("swing (rad/s)", "oscill. (rad/s)"), "gain (mm/s/V)"},
    facts("estimation", model), facts(say("limits, both linear parts", "limits, parties linéaires"), kept),
    facts(say("limits, all data", "limits, en entier"), whole)})
-- END SOLUTION

-- %% [markdown]
-- **Question 8.** Validate your model: compare the simulated outputs with the validation data, and test the residuals. How well does the model
-- describe the pulses of `steps`, and what does the free swing show about the pendulum? `motion` animates the crane and the model side by side (on
-- the page of `dynlab preview analysis.lua`, not in the report).

-- %% id=validation
-- BEGIN SOLUTION
local measured, simulated = say("measured", "mesuré"), say("simulated", "simulé")
local fit_of = {x = fit(x_val, model.x, resting), theta = fit(theta_val, model.theta, resting)}
report.value("fit_x", fit_of.x, "%.1f")
report.value("fit_theta", fit_of.theta, "%.1f")
report.value("fit_x_est", fit(integrated(from, from.x), model.x, resting), "%.1f")
report.value("fit_theta_est", fit(direct(from, from.theta), model.theta, resting), "%.1f")

local function response(record)
    local integral = Ts*(cumsum(record.u) - record.u)
    return lsim(model.x, integral, Ts, {hold = "foh"}), lsim(model.theta, record.u, Ts)
end
local function against_model(record, height, with_differences)
    local x, theta = response(record)
    local measured_x, measured_theta = record.x - record.x[1], record.theta - mean(record.theta:range(1, rest))
    local function pair(label, y, model_y, more)
        local panel = {ylabel = label, curves = {
            {x = record.t, y = y, label = measured, color = 8, line_width = 1.8},
            {x = record.t, y = model_y, label = simulated, color = 0, dash = 0, line_width = 0.7}}}
        for key, value in pairs(more or {}) do panel[key] = value end
        return panel
    end
    local function difference(label, error, more)
        local panel = {ylabel = label, legend = "none", curves = {{x = record.t, y = error, color = 1, dash = 0}}}
        for key, value in pairs(more or {}) do panel[key] = value end
        return panel
    end
    local x_error, theta_error = measured_x - x, measured_theta - theta
    local panels = {pair(with_differences and meters or "x (m)", measured_x, x),
                    pair(with_differences and radians or "θ (rad)", measured_theta, theta, {legend = "none"})}
    if with_differences then
        table.insert(panels, 2, difference(say("error (mm)", "écart (mm)"), 1e3*x_error))
        table.insert(panels, difference(say("error (mrad)", "écart (mrad)"), 1e3*theta_error))
    end
    panels[#panels].xlabel = seconds
    return figure{rows = #panels, height = height, panels = panels}, x_error, theta_error
end
local validation_figure, x_error, theta_error = against_model(against, 8.8, true)
report.figure("validation", validation_figure,
              say("The validation data: measured outputs, outputs simulated from the voltage only, and the errors. The error of the angle is largest when the swing of the load is largest.",
                  "L'enregistrement de validation, qui n'a pas servi à l'estimation : mesuré, simulé à partir de la seule tension, et l'écart. C'est aux grands angles que l'erreur de l'angle est la plus forte."))
report.value("x_error", 1e3*std(x_error), "%.1f")
report.value("theta_error", 1e3*std(theta_error), "%.1f")
report.value("start_error", 1e3*math.abs(mean(x_error:range(rest + 10, rest + 50))), "%.1f")

local residuals_theta, theta_tests = resid(theta_val, model.theta, resting)
local residuals_x, x_tests = resid(x_val, model.x, resting)
for name, tests in pairs{x = x_tests, theta = theta_tests} do
    report.value("colored_" .. name, tests.outputs[1].outside, "%d")
    report.value("input_p_" .. name, tests.outputs[1].inputs[1].p_value, "%.2f")
    report.value("input_lags_" .. name, tests.outputs[1].inputs[1].outside, "%d")
end
-- END SOLUTION

-- %% id=motion
-- BEGIN SOLUTION
-- STARTER: -- motion{plant = "crane", t = crane.validation.t,
-- STARTER: --        measured = {position = crane.validation.x,
-- STARTER: --                    angle = crane.validation.theta},
-- STARTER: --        simulated = {position = ..., angle = ...}}
do
    local x, theta = response(against)
    motion{plant = "crane", t = against.t,
           measured = {position = against.x - against.x[1], angle = against.theta - mean(against.theta:range(1, rest))},
           simulated = {position = x, angle = theta}}
end
-- END SOLUTION

-- %% id=friction
-- BEGIN SOLUTION
local steps = crane.steps
local steps_figure, steps_x_error, steps_theta_error = against_model(steps, 4.7)
report.figure("steps", steps_figure,
              say("The data `steps`: after pulses of ±2 V and ±4 V, friction holds the trolley at rest. In the simulation, the load moves the trolley.",
                  "L'enregistrement `steps` : après des impulsions de ±2 V et ±4 V, le frottement tient le chariot ; le chariot simulé, lui, est entraîné par sa charge."))
report.value("steps_fit_x", fit(integrated(steps, steps.x), model.x, resting), "%.1f")
report.value("steps_fit_theta", fit(direct(steps, steps.theta), model.theta, resting), "%.1f")
report.value("steps_error", 1e3*max(abs(steps_x_error)), "%.0f")

-- Speed in the last half second of each push, averaged over both directions.
local window = math.floor(0.5/Ts)
local speed = {}
for k = 2, #steps.t do
    local pushed = steps.u[k - 1]
    if pushed ~= 0 and steps.u[k] == 0 then
        local volts_applied = math.abs(pushed)
        local v = math.abs(steps.x[k] - steps.x[k - window])/(window*Ts)
        speed[volts_applied] = (speed[volts_applied] or 0) + v/2
    end
end
local free_gain = (speed[4] - speed[2])/2          -- trolley without dry friction, m/s per volt
local dry_voltage = 2 - speed[2]/free_gain         -- voltage lost to dry friction
report.value("speed2", 1e3*speed[2]/2, "%.1f")
report.value("speed4", 1e3*speed[4]/4, "%.1f")
report.value("free_gain", 1e3*free_gain, "%.1f")
report.value("dry_voltage", dry_voltage, "%.2f")

-- Free swing: the upward zero crossings give the frequency, the amplitudes at both ends give the decay.
local swing = crane.free_swing
local swing_angle = swing.theta - mean(swing.theta:range(#swing.theta - 489, #swing.theta))
local crossings = {}
for k = 2, #swing_angle do
    local before, after = swing_angle[k - 1], swing_angle[k]
    if before < 0 and after >= 0 and (#crossings == 0 or swing.t[k] - crossings[#crossings] > 0.6) then
        crossings[#crossings + 1] = swing.t[k] - Ts*after/(after - before)
    end
end
local cycles = #crossings - 1
local swing_frequency = 2*math.pi*cycles/(crossings[#crossings] - crossings[1])
local period = math.floor(2*math.pi/swing_frequency/Ts + 0.5)
local function amplitude(first_sample) return math.sqrt(2)*std(swing_angle:range(first_sample, first_sample + 2*period - 1)) end
local last_sample = #swing_angle - 2*period
local decay = math.log(amplitude(1)/amplitude(last_sample))/((last_sample - 1)*Ts)
report.value("free_frequency", swing_frequency, "%.3f")
report.value("free_damping", decay/swing_frequency, "%.3f")
report.value("free_cycles", cycles, "%d")
report.value("free_first", amplitude(1), "%.2f")
report.value("free_last", amplitude(last_sample), "%.2f")
report.value("free_moved", 1e3*(max(swing.x) - min(swing.x)), "%.1f")
-- END SOLUTION

-- %% [markdown]
-- **Question 9.** One data set is one realization. You can run the simulated crane again: `plant("crane", {seed = 2})` repeats all five experiments
-- with a different binary sequence and different noise. First, enter a prediction (`predict_first`, `reveal`): which fit do you expect for the angle? Then
-- repeat your whole procedure forty times. How large is the scatter of the fit, the parameters and the frequency? Do the standard errors agree with
-- this scatter? How close is your model to the best linear model of this structure?

-- %% id=repetition_guess
-- BEGIN SOLUTION
-- STARTER: predict_first(say("angle: mean fit", "angle : adéquation moyenne"), nil, "%")
local guessed = 96
predict_first(say("angle: mean fit", "angle : adéquation moyenne"), guessed, "%")
-- END SOLUTION

-- %% id=repetition
-- BEGIN SOLUTION
local repetitions = 40
local study = {x = {}, theta = {}, swing = {}, pendulum = {}, own_x = {}, own_theta = {}}
local validations_x, validations_theta, scattered, a3_alone = {}, {}, {}, {position = {}, angle = {}}
for k = 1, repetitions do
    local again = plant("crane", {seed = k + 1})
    local repeated_joint = joint_model(both(again.estimation))
    local repeated = recommended(repeated_joint)
    for i = 1, #rows do
        scattered[i] = scattered[i] or {}
        scattered[i][k] = repeated_joint.param[i]
    end
    a3_alone.position[k] = tfsrivc(integrated(again.estimation, again.estimation.x), 3, 2, options).param[3]
    a3_alone.angle[k] = tfsrivc(direct(again.estimation, again.estimation.theta), 3, 1, options).param[3]
    local record = again.validation
    local record_x, record_theta = integrated(record, record.x), direct(record, record.theta)
    validations_x[k], validations_theta[k] = record_x, record_theta
    study.x[k], study.theta[k] = fit(record_x, repeated.x, resting), fit(record_theta, repeated.theta, resting)
    study.swing[k], study.pendulum[k] = repeated.swing, repeated.pendulum
    study.own_x[k] = fit(record_x, tfcoe(record_x, 3, 2, options), resting)
    study.own_theta[k] = fit(record_theta, tfcoe(record_theta, 3, 1, options), resting)
end
-- Next to each standard error: the standard deviation over the repetitions, with two significant digits.
local parameter_rows = {{"", say("position alone", "position seule"), say("angle alone", "angle seul"),
                         say("both together", "les deux ensemble"), say("scatter", "dispersion")}}
for i, row in ipairs(rows) do
    parameter_rows[i + 1] = {row[1], row[2], row[3], row[4], string.format("%.2g", std(vector(scattered[i])))}
end
report.table("parameters", parameter_rows)
report.value("scatter_a3", std(vector(scattered[3])), "%.1f")
report.value("scatter_a3_position", std(vector(a3_alone.position)), "%.1f")
report.value("scatter_a3_angle", std(vector(a3_alone.angle)), "%.0f")
-- The best single linear model: output-error estimate from all validation data sets together.
local best_x = tfcoe(merge(table.unpack(validations_x)), 3, 2, options)
local best_theta = tfcoe(merge(table.unpack(validations_theta)), 3, 1, options)
study.best_x, study.best_theta = {}, {}
for k = 1, repetitions do
    study.best_x[k] = fit(validations_x[k], best_x, resting)
    study.best_theta[k] = fit(validations_theta[k], best_theta, resting)
end
local truth = true_model("crane")
local function spread(list, format)
    local v = vector(list)
    return {string.format(format, mean(v)), string.format(format, std(v)), string.format(format, min(v)), string.format(format, max(v))}
end
local repeated_rows = {{"", say("mean", "moyenne"), say("std. dev.", "écart type"), say("min", "min."), say("max", "max.")}}
local function add(text, list, format)
    repeated_rows[#repeated_rows + 1] = {text, table.unpack(spread(list, format))}
end
add(say("position: recommended model, fit (%)", "position : modèle recommandé, adéquation (%)"), study.x, "%.2f")
add(say("position: best single linear model (%)", "position : meilleur modèle linéaire unique (%)"), study.best_x, "%.2f")
add(say("position: estimated from the same data (%)", "position : ajusté à l'enregistrement même (%)"), study.own_x, "%.2f")
add(say("angle: recommended model, fit (%)", "angle : modèle recommandé, adéquation (%)"), study.theta, "%.2f")
add(say("angle: best single linear model (%)", "angle : meilleur modèle linéaire unique (%)"), study.best_theta, "%.2f")
add(say("angle: estimated from the same data (%)", "angle : ajusté à l'enregistrement même (%)"), study.own_theta, "%.2f")
add(say("swing frequency, from the poles (rad/s)", "oscillation, pôles du modèle (rad/s)"), study.swing, "%.3f")
add(say("pendulum frequency, from the zeros of the position (rad/s)", "pendule, zéros de la position (rad/s)"), study.pendulum, "%.3f")
report.table("repetition", repeated_rows)
reveal(say("angle: mean fit", "angle : adéquation moyenne"), mean(vector(study.theta)))
report.value("repetitions", repetitions, "%d")
report.value("guessed_theta", guessed, "%d")
report.value("expected_theta", mean(vector(study.theta)), "%.0f")
report.value("expected_theta_std", std(vector(study.theta)), "%.0f")
report.value("most_theta", max(vector(study.theta)), "%.1f")
report.value("worst_theta", min(vector(study.theta)), "%.0f")
report.value("worst_best_theta", min(vector(study.best_theta)), "%.0f")
report.value("gap_x", mean(vector(study.best_x)) - mean(vector(study.x)), "%.1f")
report.value("gap_theta", mean(vector(study.best_theta)) - mean(vector(study.theta)), "%.1f")
report.value("own_gap_theta", mean(vector(study.own_theta)) - mean(vector(study.theta)), "%.1f")

-- Frequencies of the simulated crane for small swings without dry friction, from its parameters (data/crane/SOURCE.md): the pendulum with the
-- trolley fixed (zeros) and with the trolley moving (poles).
local constant = 0.05*5/0.02                               -- motor and gear: V s/m, and N/A
local mass, viscous = 1 + 0.23 + 2e-5*(5/0.02)^2, constant^2/5 + 2 + 3
local lever, inertia, pivot = 0.23*0.36, 1e-3 + 0.23*0.36^2, 3e-3
local rigid = vector{mass*inertia - lever^2, mass*pivot + viscous*inertia, mass*lever*9.81 + viscous*pivot, viscous*lever*9.81}
local true_swing = damp(tf({1}, rigid))[1]
report.value("true_swing", true_swing, "%.3f")
report.value("true_pendulum", truth.natural_frequency, "%.3f")
local function largest_error(list, true_value) return 100*max(abs(vector(list)/true_value - 1)) end
report.value("swing_error", largest_error(study.swing, true_swing), "%.1f")
report.value("pendulum_error", largest_error(study.pendulum, truth.natural_frequency), "%.1f")
-- END SOLUTION

-- %% [markdown]
-- **Question 10.** Which nonlinearity remains? Simulate the equations of question 4 with dry friction, with $\sin\theta$ instead of $\theta$ (and air
-- drag), and with both. Estimate the parameters by minimizing the simulation error, as for the linear model. Which nonlinearity explains the
-- position, which explains the angle, and which errors remain?

-- %% id=nonlinear
-- BEGIN SOLUTION
-- Equations of motion of trolley and load, divided by their masses. s, c and w^2 are sin, cos and the centrifugal term;
-- for small swings, they are the angle, 1 and 0:
--     v' + coupling c w' = gain u - viscous v - dry sign(v) + coupling s w^2,    w' + c v'/length = -(g/length) s - (pivot + air |w|) w.
-- Fourth-order Runge-Kutta steps. A step ends when the trolley stops; friction then holds or releases the trolley.
local function drive(p, wide, record)
    local sine, cosine, size = math.sin, math.cos, math.abs
    local gain, viscous, dry, coupling, length, pivot, air = p.gain, p.viscous, p.dry, p.coupling, p.length, p.pivot, p.air
    local x, v, phi, w = 0, 0, 0, 0
    -- Acceleration of the trolley without friction, acceleration of the load, and c.
    local function drives(u, speed, angle, rate)
        local s, c, square = angle, 1, 0
        if wide then s, c, square = sine(angle), cosine(angle), rate^2 end
        return gain*u - viscous*speed + coupling*s*square, -(9.81/length)*s - (pivot + air*size(rate))*rate, c
    end
    local function rates(u, side, speed, angle, rate)
        local force, torque, c = drives(u, speed, angle, rate)
        if side == 0 then return 0, torque end
        local acceleration = (force - dry*side - coupling*c*torque)/(1 - coupling*c^2/length)
        return acceleration, torque - c*acceleration/length
    end
    local function advance(u, h)
        local side = v > 0 and 1 or v < 0 and -1 or 0
        if side == 0 then
            local force, torque, c = drives(u, 0, phi, w)
            local pushed = force - coupling*c*torque
            if size(pushed) > dry then side = pushed > 0 and 1 or -1 end
        end
        local a1, b1 = rates(u, side, v, phi, w)
        local a2, b2 = rates(u, side, v + h/2*a1, phi + h/2*w, w + h/2*b1)
        local a3, b3 = rates(u, side, v + h/2*a2, phi + h/2*w + h^2/4*b1, w + h/2*b2)
        local a4, b4 = rates(u, side, v + h*a3, phi + h*w + h^2/2*b2, w + h*b3)
        local speed = v + h/6*(a1 + 2*a2 + 2*a3 + a4)
        if speed*v < 0 then  -- the trolley stops within the step, after about this fraction of the step
            local part = h*v/(v - speed)
            x, phi, w, v = x + part*v/2, phi + part*w + part^2/2*b1, w + part*b1, 0
            return advance(u, h - part)
        end
        x, phi = x + h*v + h^2/6*(a1 + a2 + a3), phi + h*w + h^2/6*(b1 + b2 + b3)
        v, w = speed, w + h/6*(b1 + 2*b2 + 2*b3 + b4)
    end
    local positions, angles = {}, {}
    for k, u in ipairs(record.u:table()) do
        positions[k], angles[k] = x, phi
        for _ = 1, 4 do advance(u, Ts/4) end
    end
    return vector(positions), vector(angles)
end
local function left_over(p, wide, record)
    local x, theta = drive(p, wide, record)
    return record.x - record.x[1] - x, record.theta - mean(record.theta:range(1, rest)) - theta
end

-- Gauss-Newton search from the values `p`: finite differences of the errors, then a linear regression.
local function grey_box(p, names, wide)
    local function errors()
        local x, theta = left_over(p, wide, from)
        return vector{output_weights[1]*x, output_weights[2]*theta}
    end
    local now = errors()
    for _ = 1, 5 do
        local columns, before = {}, {}
        for k, name in ipairs(names) do
            local value = p[name]
            local change = 1e-3*math.abs(value) + 1e-5
            p[name] = value + change
            columns[k], before[name] = (now - errors())/change, value
            p[name] = value
        end
        local correction = lsq(matrix(columns), now).theta
        for k, name in ipairs(names) do p[name] = p[name] + correction[k] end
        local changed = errors()
        if not (norm(changed) < norm(now)) then  -- minimum reached, apart from rounding errors
            for name, value in pairs(before) do p[name] = value end
            break
        end
        now = changed
    end
    return p
end
local function variant(start, changes)
    local p = {}
    for _, source in ipairs{start, changes} do
        for name, value in pairs(source) do p[name] = value end
    end
    return p
end
-- Rough initial values from the linear model, for a load that is light compared with the trolley.
local first_length = -joint.param[4]/joint.param[7]
local linear = grey_box({gain = joint.param[4]*0.9, viscous = 0.9*joint.param[1], dry = 0, coupling = 0.1*first_length,
                         length = first_length, pivot = 0.1, air = 0},
                        {"gain", "viscous", "coupling", "length", "pivot"}, false)
local friction = grey_box(variant(linear, {dry = 0.1}), {"gain", "viscous", "dry", "coupling", "length", "pivot"}, false)
local wide = grey_box(variant(linear, {}), {"gain", "viscous", "coupling", "length", "pivot", "air"}, true)
local physical = grey_box(variant(friction, {}), {"gain", "viscous", "dry", "coupling", "length", "pivot", "air"}, true)

local nonlinear_rows = {{say("model", "modèle"), say("parameters", "paramètres"), "$x$ (%)", "$\\theta$ (%)", say("error of $\\theta$ (mrad)", "erreur de $\\theta$ (mrad)"),
                         say("steps $x$ (%)", "impulsions $x$ (%)"), say("steps $\\theta$ (%)", "impulsions $\\theta$ (%)")}}
local left_in_angle = {}
for k, case in ipairs{{linear, false, 5, say("linear", "linéaire")}, {friction, false, 6, say("+ dry friction", "+ frottement sec")},
                      {wide, true, 6, say("+ large swings, air", "+ grands angles, air")},
                      {physical, true, 7, say("+ both", "+ les deux")}} do
    local row = {case[4], case[3]}
    for _, record in ipairs{against, crane.steps} do
        local x, theta = left_over(case[1], case[2], record)
        table.insert(row, string.format("%.1f", 100*(1 - norm(x)/norm(record.x - mean(record.x)))))
        table.insert(row, string.format("%.1f", 100*(1 - norm(theta)/norm(record.theta - mean(record.theta)))))
        if record == against then
            left_in_angle[k] = 1e3*std(theta)
            table.insert(row, string.format("%.1f", left_in_angle[k]))
        end
    end
    nonlinear_rows[k + 1] = row
end
report.table("nonlinear", nonlinear_rows)
for k, name in ipairs{"linear", "friction", "wide", "physical"} do report.value("left_" .. name, left_in_angle[k], "%.1f") end
report.value("start_left", 1e3*math.abs(mean((left_over(friction, false, against)):range(rest + 10, rest + 50))), "%.1f")
report.value("grey_dry", physical.dry/physical.gain, "%.2f")
report.value("true_dry", truth.dry_voltage, "%.2f")
report.value("grey_gain", 1e3*physical.gain/physical.viscous, "%.0f")
report.value("true_gain", 1e3*truth.speed_gain, "%.0f")
report.value("grey_length", physical.length, "%.3f")
-- END SOLUTION

-- %% [markdown]
-- **Question 11 (appendix).** Propose a controller that moves the trolley quickly to a given position with little swing of the load. Draw a block
-- diagram, design the controller from your model (`lqr`, `place`), and simulate the closed loop with the nonlinear crane (`drive_crane`).

-- %% id=control
-- BEGIN SOLUTION
-- State-space form of the recommended model, denominator s F(s) = s^4 + a1 s^3 + a2 s^2 + a3 s.
local a1, a2, a3 = joint.param[1], joint.param[2], joint.param[3]
local b0, b1, b2, c0 = joint.param[4], joint.param[5], joint.param[6], joint.param[7]
local A = matrix{{-a1, -a2, -a3, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}
local B = matrix{{1}, {0}, {0}, {0}}
local C = matrix{{0, b0, b1, b2}, {0, c0, 0, 0}}

-- Scales of the weights: a position of 5 cm, an angle of 0.05 rad and a voltage of 4 V count as large.
local large = {x = 0.05, theta = 0.05, u = 4}
local weight = matrix{{1/large.x^2, 0}, {0, 1/large.theta^2}}
local K, loop_poles = lqr(A, B, C:t()*weight*C, {{1/large.u^2}})
-- The observer by duality: disturbances (friction) act at the input, and the residuals give the measurement noise.
local L = lqr(A:t(), C:t(), B*B:t()*0.5^2 + 1e-9*eye(4), {{(1e-3)^2, 0}, {0, (5e-3)^2}}):t()

-- Observer and feedback, discretized exactly: d/dt z = (A - L C) z + [B L] [u; x; theta].
local LC = A - L*C
local inputs = matrix{{1, L[{1, 1}], L[{1, 2}]}, {0, L[{2, 1}], L[{2, 2}]}, {0, L[{3, 1}], L[{3, 2}]}, {0, L[{4, 1}], L[{4, 2}]}}
local observer = c2d(ss(LC, inputs, eye(4), zeros(4, 3)), Ts)

local goal, begin, duration = 0.3, 1, 11
local function state_controller()
    local z = vector{0, 0, 0, 0}
    return function(t, x, theta)
        local target = t >= begin and goal or 0
        local u = -(K*(z - vector{0, 0, 0, target/b2}))[1]
        u = math.max(-amplifier, math.min(amplifier, u))
        z = observer.A*z + observer.B*vector{u, x, theta}
        return u
    end
end
local kp = 30  -- V/m
local function proportional(t, x) return kp*((t >= begin and goal or 0) - x) end

local function settling(run)
    local last_out = begin
    for k = 1, #run.t do
        if math.abs(run.x[k] - goal) > 0.02 or math.abs(run.theta[k]) > 0.02 then last_out = run.t[k] end
    end
    return last_out - begin
end
-- Rise time: the time until the trolley has covered 90 % of the distance.
local function rise(run)
    for k = 1, #run.t do
        if run.x[k] > 0.9*goal then return run.t[k] - begin end
    end
    return duration
end
local with_state, with_p = drive_crane(state_controller(), {duration = duration}), drive_crane(proportional, {duration = duration})
report.value("goal", goal, "%.1f")
report.value("kp", kp, "%.0f")
report.value("after", duration - begin, "%.0f")
for name, run in pairs{lqr = with_state, p = with_p} do
    report.value("settling_" .. name, settling(run), "%.1f")
    report.value("rise_" .. name, rise(run), "%.1f")
    report.value("left_" .. name, max(abs(run.theta:range(#run.theta - 99, #run.theta))), "%.2f")
    report.value("largest_angle_" .. name, max(abs(run.theta)), "%.2f")
    report.value("final_error_" .. name, 1e3*math.abs(run.x[#run.x] - goal), "%.1f")
    report.value("largest_voltage_" .. name, max(abs(run.u)), "%.1f")
end
report.value("large_x", 100*large.x, "%.0f")
report.value("large_theta", large.theta, "%.2f")
report.value("large_u", large.u, "%.0f")
print(K)
print(loop_poles)
for k = 1, 4 do report.value("gain" .. k, K[{1, k}], "%.4g") end
for name, pole in pairs{fast = loop_poles[1], slow = loop_poles[3]} do
    report.value(name .. "_re", -pole.re, "%.3g")
    report.value(name .. "_im", math.abs(pole.im), "%.3g")
end

local function compared(label, key, more)
    local panel = {ylabel = label, curves = {
        {x = with_state.t, y = with_state[key], label = say("state feedback", "retour d'état"), color = 0},
        {x = with_p.t, y = with_p[key], label = say("proportional", "proportionnel"), color = 1}}}
    for name, value in pairs(more or {}) do panel[name] = value end
    return panel
end
report.figure("closed_loop", figure{rows = 3, height = 8.4, panels = {
    compared(meters, "x", {references = {{y = goal}}}), compared(radians, "theta", {legend = "none"}),
    compared(volts, "u", {legend = "none", xlabel = seconds})}},
    say("The nonlinear crane moves to 0.3 m. With state feedback, the load comes to rest together with the trolley. With proportional control, the load continues to swing.",
        "La grue non linéaire en route vers 0,3 m : le retour d'état arrête la charge avec le chariot ; sous commande proportionnelle elle oscille encore."))
-- END SOLUTION

-- %% [markdown]
-- # Peer review
--
-- After the deadline of the first version, you receive the anonymous report of another group, and write a review of one to two pages. Your names
-- appear neither in your report nor in your review. `dynlab new review my-review` creates the form with five questions:
--
-- 1. Are the data and their collection described clearly enough for a reader to repeat the experiments?
-- 2. Does the report describe the solution of every step of the workflow?
-- 3. Do the conclusions follow from data, experiments and results? Do you agree with them, and which changes do you propose?
-- 4. What is the greatest strength of the content?
-- 5. How can the authors improve clarity, readability and technical accuracy?
--
-- Write your answers as a discussion: give reasons, and propose other methods. Criticize constructively, keep a friendly tone, specify exactly which
-- changes you propose, and avoid hurtful remarks. Vague or harsh comments are ignored. Your instructor sets three deadlines: the first version of the
-- report, the review, and the final version, which takes the reviews into account.
--
-- # What you submit in addition to the report
--
-- Readers assess the report. If the script is graded, too, submit results with `answer(name, value)`:
--
-- * `discarded`: the start and end times (s) of the part of `limits` that no linear model can describe;
-- * `rest_angle`: the reading of the potentiometer (rad) when the load is at rest;
-- * `G_position` and `G_angle`: your recommended models from voltage to position, including the integrator, and from voltage to angle;
-- * `fits`: the fits (%) of the simulated position and angle to the validation data;
-- * `free_swing`: the swing frequency (rad/s) of the load while the motor is off.
--
-- Grading also runs your script on data of another crane, and compares the resulting models with hidden experiments. The checks look for the figures
-- `raw` and `validation`.

-- %% id=hand_in
-- BEGIN SOLUTION
answer("discarded", vector{limits.t[first], limits.t[last]})
answer("rest_angle", mean(crane.estimation.theta:range(1, rest)))
answer("G_position", tf({b0, b1, b2}, {1, a1, a2, a3, 0}))
answer("G_angle", model.theta)
answer("fits", vector{fit_of.x, fit_of.theta})
answer("free_swing", swing_frequency)
-- END SOLUTION
