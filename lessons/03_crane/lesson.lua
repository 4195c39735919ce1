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
-- A trolley runs along a rail, pulled by a motor; a pendulum hangs from it. One voltage moves both, so one model has two outputs:
-- where the trolley is and how far the load swings. You are given five records, among them one in which the crane was driven
-- where no linear model follows. Find a model, say what it is worth, and write it down so that somebody who was not there can
-- do the same again.
--
-- Work in this script, cell by cell; your text goes to `report.md`, which has the sections that a report must have and notes on what
-- belongs into each. What you hand in is the report: at most six pages, seven with the appendix.
--
-- # The records
--
-- | record | what was done |
-- |---|---|
-- | `estimation`, `validation` | rest, then a pseudo-random binary voltage of ±2 V, in two different orders |
-- | `steps` | rest, then pushes of ±2 V and ±4 V with pauses between them |
-- | `free_swing` | motor at 0 V, the load let go by hand |
-- | `limits` | pseudo-random voltage, then driven by hand to both ends of the rail, then pseudo-random again |
--
-- Each has `t` (s), `u` (V), `x` (m) and `theta` (rad), 0.02 s apart; the voltage is held between two samples.

-- %% id=records
local crane = load("crane")
local Ts = 0.02
local signals = {InputName = "voltage", InputUnit = "V",
                 OutputName = {"position", "angle"}, OutputUnit = {"m", "rad"}}
local estimation = iddata(matrix{crane.estimation.x, crane.estimation.theta}, crane.estimation.u, Ts, signals)
print(estimation)
idplot(estimation)

-- %% [markdown]
-- **Question 1.** Show the raw records. What can be seen in them before anything is computed?

-- %% id=raw
-- BEGIN SOLUTION
local function say(english, french) return report.language() == "fr" and french or english end
local seconds = say("time (s)", "temps (s)")
local volts, metres = say("voltage (V)", "tension (V)"), "position (m)"
local radians = "angle (rad)"

local function panels(record, further)
    local list = {
        {ylabel = volts, curves = {{x = record.t, y = record.u, style = "stairs", colour = 8}}},
        {ylabel = metres, curves = {{x = record.t, y = record.x, colour = 0}}},
        {ylabel = radians, xlabel = seconds, curves = {{x = record.t, y = record.theta, colour = 1, dash = 0}}},
    }
    for _, panel in ipairs(list) do
        for key, value in pairs(further or {}) do panel[key] = value end
    end
    return list
end

local purposes = {
    {"estimation", say("PRBS, ±2 V", "SBPA, ±2 V"), say("structure and parameters", "structure et paramètres")},
    {"validation", say("PRBS, ±2 V, other bits", "SBPA, ±2 V, autres bits"), "validation"},
    {"steps", say("pushes of ±2 V and ±4 V", "poussées de ±2 V et ±4 V"), say("what friction costs", "ce que coûte le frottement")},
    {"free_swing", say("0 V, load let go by hand", "0 V, charge lâchée à la main"), say("the load alone", "la charge seule")},
    {"limits", say("PRBS, ±12 V by hand, PRBS", "SBPA, ±12 V à la main, SBPA"),
     say("to be discarded in part", "à écarter en partie")}}
local experiments = {{say("record", "enregistrement"), say("input", "entrée"), say("duration (s)", "durée (s)"),
                      say("used for", "utilité")}}
for k, row in ipairs(purposes) do
    local t = crane[row[1]].t
    experiments[k + 1] = {row[1], row[2], string.format("%.0f", t[#t]), row[3]}
end
report.table("experiments", experiments)

report.figure("raw", figure{rows = 3, height = 7.8, panels = panels(crane.estimation)},
              say("The estimation record as it was measured", "L'enregistrement d'estimation tel qu'il a été mesuré"))
-- END SOLUTION

-- %% [markdown]
-- **Question 2.** Noise, resolution, levels at rest: what do the first second of a record and the differences between its samples tell?
--
-- **Question 3.** Which section of `limits` belongs to no linear model, and why? Find its first and last instant in the record, and
-- compare with what `advice` says of the record and of its field `discard`.

-- %% id=preparation
-- BEGIN SOLUTION
local rest = 50  -- samples before the input moves
local function smallest_step(v)
    local smallest = math.huge
    for _, d in ipairs(abs(diff(v)):table()) do
        if d > 1e-9 and d < smallest then smallest = d end
    end
    return smallest
end
report.value("samples", #crane.estimation.t, "%d")
report.value("duration", crane.estimation.t[#crane.estimation.t], "%.0f")
report.value("rest_angle", 1e3*mean(crane.estimation.theta:range(1, rest)), "%.1f")
report.value("angle_noise", 1e3*std(crane.estimation.theta:range(1, rest)), "%.1f")
report.value("angle_step", 1e3*smallest_step(crane.estimation.theta), "%.1f")
report.value("position_step", 1e3*smallest_step(crane.estimation.x), "%.1f")
report.value("way", max(crane.estimation.x) - min(crane.estimation.x), "%.2f")
report.value("largest_angle", max(abs(crane.estimation.theta)), "%.2f")

local amplifier, buffers = 10, 0.495  -- V, m: beyond them stand the amplifier's limit and the rubber buffers
local limits = crane.limits
local first, last
for k = 1, #limits.t do
    if abs(limits.u[k]) > amplifier or abs(limits.x[k]) > buffers then
        first, last = first or k, k
    end
end
report.value("discard_from", limits.t[first], "%.1f")
report.value("discard_to", limits.t[last], "%.1f")

local told = advice(iddata(matrix{limits.x, limits.theta}, limits.u, Ts, signals)).discard
if #told > 0 then
    report.value("advised_from", limits.t[told[1][1]], "%.1f")
    report.value("advised_to", limits.t[told[#told][2]], "%.1f")
else  -- on some cranes the stretch is too short to be noticed
    report.value("advised_from", "–")
    report.value("advised_to", "–")
end

local limit_panels = panels(limits)
for k, panel in ipairs(limit_panels) do
    panel.references = {{x = limits.t[first], dash = 2}, {x = limits.t[last], dash = 2}}
end
limit_panels[2].references[3] = {y = 0.5}
limit_panels[2].references[4] = {y = -0.5}
report.figure("limits", figure{rows = 3, height = 7.8, panels = limit_panels},
              say("The record limits: between the dotted lines the crane meets its limits",
                  "L'enregistrement limits : entre les pointillés, la grue atteint ses limites"))
-- END SOLUTION

-- %% [markdown]
-- **Question 4.** What goes from voltage to position that no record of finite length shows completely? Write the equations of the
-- crane as physics has them, and read off which poles and zeros position and angle have in common.
--
-- **Question 5.** Compare structures for each output on estimation and validation record (`srivcstruc`).

-- %% id=structure
-- BEGIN SOLUTION
-- A held voltage has an integral that runs on straight lines, so this data object is exact.
local function integrated(record, y)
    local integral = Ts*(cumsum(record.u) - record.u)
    return detrend(iddata(y, integral, Ts, {InterSample = "foh"}), "start", {samples = rest})
end
local function direct(record, y)
    return detrend(iddata(y, record.u, Ts), "start", {samples = rest})
end
local from, against = crane.estimation, crane.validation
local tried = {
    {"position", "F", direct(from, from.x), direct(against, against.x), say("integrator inexact", "intégr. inexact")},
    {"position", "s F", integrated(from, from.x), integrated(against, against.x), say("chosen", "retenu")},
    {"angle", "F", direct(from, from.theta), direct(against, against.theta), say("chosen", "retenu")},
}
local shown = {{{1, 0}, {2, 0}, {4, 2}}, {{1, 0}, {2, 1}, {3, 2}, {4, 3}}, {{2, 1}, {3, 0}, {3, 1}, {4, 2}}}
local function remark(row)
    if not row.converged then return say("not settled", "non stabilisé") end
    if row.cancellation then return say("zero cancels pole", "zéro sur pôle") end
    if #row.undetermined > 0 then
        return table.concat(row.undetermined, ", ") .. say(" uncertain", " incertains")
    end
    return ""
end
local orders = {{say("output", "sortie"), say("denom.", "dénom."), say("poles of F", "pôles de F"),
                 say("zeros", "zéros"), "YIC", "BIC", say("fit (%)", "adéq. (%)"), say("val. (%)", "valid. (%)"),
                 say("remark", "remarque")}}
for k, case in ipairs(tried) do
    local V = srivcstruc(case[3], {poles = {1, 4}, zeros = {0, 3}, validate = case[4]})
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
local delayed = tfsrivc(direct(from, from.theta), 3, 1, {TdMax = 0.1, NumTd = 6})
report.value("delay", 1e3*delayed.IODelay, "%.1f")
report.value("delay_fit", fit(direct(against, against.theta), delayed), "%.2f")
-- END SOLUTION

-- %% [markdown]
-- **Question 6.** Estimate the model you decided on. Do the two outputs, estimated each for itself, agree about what they
-- have in common? What do they give together (`CommonDenominator`)?

-- %% id=estimate
-- BEGIN SOLUTION
local function both(record) return integrated(record, matrix{record.x, record.theta}) end
local options = {TdMax = 0, InitialState = "zero", Offset = "none"}
local position = tfsrivc(integrated(from, from.x), 3, 2, options)
local angle = tfsrivc(direct(from, from.theta), 3, 1, options)
local function joint_model(record, start)
    return tfsrivc(both(record), 3, 2, {TdMax = 0, CommonDenominator = true, InitialState = start, Offset = "none"})
end
-- The recommended model: the two numerator coefficients of the angle that physics puts to zero are put to zero.
local function recommended(joint)
    local p = joint.param
    local F = {1, p[1], p[2], p[3]}
    local frequency, damping = damp(tf({1}, F))
    local swing = damping[1] < 1 and 1 or 3  -- damp sorts by frequency; the motor's pole is real
    return {F = F, x = tf({p[4], p[5], p[6]}, F), theta = tf({p[7], 0}, F), swing = frequency[swing],
            damping = damping[swing], motor = frequency[4 - swing], pendulum = math.sqrt(p[6]/p[4])}
end
local joint = joint_model(from, "zero")
present(joint)
-- END SOLUTION

-- %% id=estimate_report echo=false
-- BEGIN SOLUTION
local model = recommended(joint)
local function with_error(G, name, format)
    for k, n in ipairs(G.names) do
        if n == name then return string.format(format .. " ± " .. format, G.param[k], G.robust_std[k]) end
    end
    return ""
end
local rows = {{"", say("position alone", "position seule"), say("angle alone", "angle seul"),
               say("both together", "les deux ensemble")}}
for k, name in ipairs{"a1", "a2", "a3"} do
    rows[#rows + 1] = {({"a₁", "a₂", "a₃"})[k], with_error(position, name, "%.2f"), with_error(angle, name, "%.2f"),
                       with_error(joint, name, "%.2f")}
end
for k, name in ipairs{"b0", "b1", "b2"} do
    rows[#rows + 1] = {({"b₀", "b₁", "b₂"})[k], with_error(position, name, "%.3f"), "", with_error(joint, name .. "_y1", "%.3f")}
end
for k, name in ipairs{"b0", "b1", "b2"} do
    rows[#rows + 1] = {({"c₀", "c₁", "c₂"})[k], "", k < 3 and with_error(angle, name, "%.3f") or "",
                       with_error(joint, name .. "_y2", "%.3f")}
end
report.table("parameters", rows)
for k, name in ipairs{"a1", "a2", "a3", "b0", "b1", "b2", "c0"} do report.value(name, joint.param[k], "%.4g") end
report.value("swing", model.swing, "%.3f")
report.value("swing_damping", model.damping, "%.3f")
report.value("pendulum", model.pendulum, "%.3f")
report.value("motor_pole", model.motor, "%.1f")
report.value("motor_time", 1e3/model.motor, "%.0f")
report.value("speed_gain", 1e3*dcgain(model.x), "%.1f")
report.value("length", -joint.param[4]/joint.param[7], "%.3f")
report.value("length_from_swing", 9.81/model.pendulum^2, "%.3f")
report.value("passes", joint.report.iterations, "%d")
-- END SOLUTION

-- %% [markdown]
-- **Question 7.** What was tried besides, and why is it discarded? Compare the simulation of an ARX model, and what becomes of your
-- model when it is estimated from `limits`, whole and without the section that you discarded.

-- %% id=discarded
-- BEGIN SOLUTION
local resting = {InitialState = "zero", Offset = "none"}
local x_val, theta_val = integrated(against, against.x), direct(against, against.theta)
local function facts(name, G)
    return {name, string.format("%.2f", fit(x_val, G.x, resting)), string.format("%.2f", fit(theta_val, G.theta, resting)),
            string.format("%.3f", G.swing), string.format("%.1f", 1e3*dcgain(G.x))}
end
local whole = recommended(joint_model(limits, "zero"))
local parts = both(limits):keep{{1, first - 1}, {last + math.floor(1/Ts), #limits.t}}
local kept = recommended(tfsrivc(parts, 3, 2, {TdMax = 0, CommonDenominator = true, InitialState = "estimate", Offset = "estimate"}))
local held = arx(direct(from, from.theta), {3, 3, 1})
report.value("arx_fit", fit(theta_val, held, resting), "%.0f")
report.value("arx_prediction", held.report.prediction_fit_percent, "%.1f")
report.table("sources", {
    {say("estimated from", "estimé sur"), "position (%)", "angle (%)",
     say("swing (rad/s)", "balanc. (rad/s)"), "gain (mm/s/V)"},
    facts("estimation", model), facts(say("limits, both linear parts", "limits, parties linéaires"), kept),
    facts(say("limits, whole", "limits, en entier"), whole)})
-- END SOLUTION

-- %% [markdown]
-- **Question 8.** Validate: the simulated outputs against the record that was not used, and the residuals. How does the model do on the
-- pushes of `steps`, and what does the free swing say of the pendulum?

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
local function against_model(record)
    local x, theta = response(record)
    local measured_x, measured_theta = record.x - record.x[1], record.theta - mean(record.theta:range(1, rest))
    local function pair(label, y, model_y, more)
        local panel = {ylabel = label, curves = {
            {x = record.t, y = y, label = measured, colour = 8, line_width = 1.8},
            {x = record.t, y = model_y, label = simulated, colour = 0, dash = 0, line_width = 0.7}}}
        for key, value in pairs(more or {}) do panel[key] = value end
        return panel
    end
    local function difference(label, error, more)
        local panel = {ylabel = label, legend = "none", curves = {{x = record.t, y = error, colour = 1, dash = 0}}}
        for key, value in pairs(more or {}) do panel[key] = value end
        return panel
    end
    local x_error, theta_error = measured_x - x, measured_theta - theta
    return figure{rows = 4, height = 10, panels = {
        pair(metres, measured_x, x), difference(say("error (mm)", "écart (mm)"), 1e3*x_error),
        pair(radians, measured_theta, theta, {legend = "none"}),
        difference(say("error (mrad)", "écart (mrad)"), 1e3*theta_error, {xlabel = seconds})}}, x_error, theta_error
end
local validation_figure, x_error, theta_error = against_model(against)
report.figure("validation", validation_figure,
              say("The validation record: measured, simulated, and the difference",
                  "L'enregistrement de validation : mesuré, simulé, et l'écart"))
report.value("x_error", 1e3*std(x_error), "%.1f")
report.value("theta_error", 1e3*std(theta_error), "%.1f")

local residuals_theta, theta_tests = resid(theta_val, model.theta, resting)
local residuals_x, x_tests = resid(x_val, model.x, resting)
for name, tests in pairs{x = x_tests, theta = theta_tests} do
    report.value("coloured_" .. name, tests.outputs[1].outside, "%d")
    report.value("input_p_" .. name, tests.outputs[1].inputs[1].p_value, "%.2f")
    report.value("input_lags_" .. name, tests.outputs[1].inputs[1].outside, "%d")
end
-- END SOLUTION

-- %% id=friction
-- BEGIN SOLUTION
local steps = crane.steps
local steps_figure, steps_x_error, steps_theta_error = against_model(steps)
report.figure("steps", steps_figure, say("The record steps: pushes of ±2 V and ±4 V, measured and simulated",
                                         "L'enregistrement steps : poussées de ±2 V et ±4 V, mesurées et simulées"))
report.value("steps_fit_x", fit(integrated(steps, steps.x), model.x, resting), "%.1f")
report.value("steps_fit_theta", fit(direct(steps, steps.theta), model.theta, resting), "%.1f")
report.value("steps_error", 1e3*max(abs(steps_x_error)), "%.0f")

-- The speed at the end of each push, over its last half second; both directions together.
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
local free_gain = (speed[4] - speed[2])/2          -- of a trolley without dry friction, m/s per volt
local dry_voltage = 2 - speed[2]/free_gain         -- what dry friction takes
report.value("speed2", 1e3*speed[2]/2, "%.1f")
report.value("speed4", 1e3*speed[4]/4, "%.1f")
report.value("free_gain", 1e3*free_gain, "%.1f")
report.value("dry_voltage", dry_voltage, "%.2f")

-- The free swing: upward crossings of its middle give the frequency, extreme values the decay.
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
-- **Question 9.** One record is one throw of the dice. The crane of this course can be asked again: `rig("crane", {seed = 2})` repeats all five
-- experiments with another order of bits and other noise. Repeat your whole procedure twenty times. How far do fit and frequency scatter, and how
-- far is your model from the best that any linear model of this structure could do?

-- %% id=repetition
-- BEGIN SOLUTION
local repetitions = 20
local study = {x = {}, theta = {}, swing = {}, pendulum = {}, own_x = {}, own_theta = {}}
local validations_x, validations_theta = {}, {}
for k = 1, repetitions do
    local again = rig("crane", {seed = k + 1})
    local repeated = recommended(joint_model(again.estimation, "zero"))
    local record = again.validation
    local record_x, record_theta = integrated(record, record.x), direct(record, record.theta)
    validations_x[k], validations_theta[k] = record_x, record_theta
    study.x[k], study.theta[k] = fit(record_x, repeated.x, resting), fit(record_theta, repeated.theta, resting)
    study.swing[k], study.pendulum[k] = repeated.swing, repeated.pendulum
    study.own_x[k] = fit(record_x, tfcoe(record_x, 3, 2, options), resting)
    study.own_theta[k] = fit(record_theta, tfcoe(record_theta, 3, 1, options), resting)
end
-- The best that one linear model can do: output error on all twenty validation records at once.
local best_x = tfcoe(merge(table.unpack(validations_x)), 3, 2, options)
local best_theta = tfcoe(merge(table.unpack(validations_theta)), 3, 1, options)
study.best_x, study.best_theta = {}, {}
for k = 1, repetitions do
    study.best_x[k] = fit(validations_x[k], best_x, resting)
    study.best_theta[k] = fit(validations_theta[k], best_theta, resting)
end
local truth = rig_truth("crane")
local function spread(list, format)
    local v = vector(list)
    return {string.format(format, mean(v)), string.format(format, std(v)), string.format(format, min(v)), string.format(format, max(v))}
end
local repeated_rows = {{"", say("mean", "moyenne"), say("std. dev.", "écart type"), say("least", "min."), say("most", "max.")}}
local function add(text, list, format)
    repeated_rows[#repeated_rows + 1] = {text, table.unpack(spread(list, format))}
end
add(say("position: recommended model, fit (%)", "position : modèle recommandé, adéquation (%)"), study.x, "%.2f")
add(say("position: best single linear model (%)", "position : meilleur modèle linéaire unique (%)"), study.best_x, "%.2f")
add(say("position: fitted to the very record (%)", "position : ajusté à l'enregistrement même (%)"), study.own_x, "%.2f")
add(say("angle: recommended model, fit (%)", "angle : modèle recommandé, adéquation (%)"), study.theta, "%.2f")
add(say("angle: best single linear model (%)", "angle : meilleur modèle linéaire unique (%)"), study.best_theta, "%.2f")
add(say("angle: fitted to the very record (%)", "angle : ajusté à l'enregistrement même (%)"), study.own_theta, "%.2f")
add(say("swing of the model's poles (rad/s)", "balancement, pôles du modèle (rad/s)"), study.swing, "%.3f")
add(say("pendulum of the position's zeros (rad/s)", "pendule, zéros de la position (rad/s)"), study.pendulum, "%.3f")
report.table("repetition", repeated_rows)
report.value("repetitions", repetitions, "%d")
report.value("gap_x", mean(vector(study.best_x)) - mean(vector(study.x)), "%.2f")
report.value("gap_theta", mean(vector(study.best_theta)) - mean(vector(study.theta)), "%.2f")
report.value("own_gap_theta", mean(vector(study.own_theta)) - mean(vector(study.theta)), "%.1f")
report.value("true_swing", truth.natural_frequency, "%.3f")
local function largest_error(list)
    return 100*max(abs(vector(list)/truth.natural_frequency - 1))
end
report.value("swing_error", largest_error(study.swing), "%.1f")
report.value("pendulum_error", largest_error(study.pendulum), "%.1f")
-- END SOLUTION

-- %% [markdown]
-- **Question 10 (appendix).** Suggest a way to bring the trolley to a given place quickly while the load swings little: a block diagram,
-- a controller designed on your model (`lqr`, `place`), and its closed loop on the nonlinear crane (`drive_crane`).

-- %% id=control
-- BEGIN SOLUTION
-- State-space form of the recommended model, denominator s F(s) = s^4 + a1 s^3 + a2 s^2 + a3 s.
local a1, a2, a3 = joint.param[1], joint.param[2], joint.param[3]
local b0, b1, b2, c0 = joint.param[4], joint.param[5], joint.param[6], joint.param[7]
local A = matrix{{-a1, -a2, -a3, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}
local B = matrix{{1}, {0}, {0}, {0}}
local C = matrix{{0, b0, b1, b2}, {0, c0, 0, 0}}

-- What counts as large: 5 cm of position, 0.05 rad of angle, 4 V.
local large = {x = 0.05, theta = 0.05, u = 4}
local weight = matrix{{1/large.x^2, 0}, {0, 1/large.theta^2}}
local K, loop_poles = lqr(A, B, C:t()*weight*C, {{1/large.u^2}})
-- The observer by duality: disturbances come in with the voltage (friction), measurements are as exact as their residuals.
local L = lqr(A:t(), C:t(), B*B:t()*0.5^2 + 1e-9*eye(4), {{(1e-3)^2, 0}, {0, (5e-3)^2}}):t()

-- Observer and feedback, exact between the samples: d/dt z = (A - L C) z + [B L] [u; x; theta].
local LC = A - L*C
local inputs = matrix{{1, L[{1, 1}], L[{1, 2}]}, {0, L[{2, 1}], L[{2, 2}]}, {0, L[{3, 1}], L[{3, 2}]}, {0, L[{4, 1}], L[{4, 2}]}}
local observer = c2d(ss(LC, inputs, eye(4), zeros(4, 3)), Ts)

local goal, begin = 0.3, 1
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
local kp = 20  -- V/m
local function proportional(t, x) return kp*((t >= begin and goal or 0) - x) end

local function settling(run)
    local last_out = begin
    for k = 1, #run.t do
        if math.abs(run.x[k] - goal) > 0.02 or math.abs(run.theta[k]) > 0.02 then last_out = run.t[k] end
    end
    return last_out - begin
end
local duration = 11
local with_state, with_p = drive_crane(state_controller(), {duration = duration}), drive_crane(proportional, {duration = duration})
report.value("goal", goal, "%.1f")
report.value("kp", kp, "%.0f")
report.value("after", duration - begin, "%.0f")
for name, run in pairs{lqr = with_state, p = with_p} do
    report.value("settling_" .. name, settling(run), "%.1f")
    report.value("left_" .. name, max(abs(run.theta:range(#run.theta - 99, #run.theta))), "%.2f")
    report.value("largest_angle_" .. name, max(abs(run.theta)), "%.2f")
    report.value("final_error_" .. name, 1e3*math.abs(run.x[#run.x] - goal), "%.1f")
    report.value("largest_voltage_" .. name, max(abs(run.u)), "%.1f")
end
report.value("large_x", 100*large.x, "%.0f")
report.value("large_theta", large.theta, "%.2f")
report.value("large_u", large.u, "%.0f")
print(loop_poles)

local function compared(label, key, more)
    local panel = {ylabel = label, curves = {
        {x = with_state.t, y = with_state[key], label = say("state feedback", "retour d'état"), colour = 0},
        {x = with_p.t, y = with_p[key], label = say("proportional", "proportionnel"), colour = 1}}}
    for name, value in pairs(more or {}) do panel[name] = value end
    return panel
end
report.figure("closed_loop", figure{rows = 3, height = 8.4, panels = {
    compared(metres, "x", {references = {{y = goal}}}), compared(radians, "theta", {legend = "none"}),
    compared(volts, "u", {legend = "none", xlabel = seconds})}},
    say("The nonlinear crane under both controllers", "La grue non linéaire sous les deux régulateurs"))
-- END SOLUTION

-- %% [markdown]
-- # What you hand in besides the report
--
-- The report is read by people. Where the script is graded too, it hands in with `answer(name, value)`: `discarded`, first and last instant (s) of the section
-- of `limits` that belongs to no linear model; `rest_angle`, what the potentiometer reads (rad) while the load hangs still; your recommended models from
-- voltage to position, `G_position`, integrator included, and from voltage to angle, `G_angle`; `fits`, how well (%) they simulate position and angle of the
-- validation record; and `free_swing`, the frequency (rad/s) with which the load swings while the motor rests. It will be run on the records
-- of another crane, and the models that it finds there are held against experiments that nobody has seen. The figures that are
-- looked for are `raw` and `validation`.

-- %% id=hand_in
-- BEGIN SOLUTION
answer("discarded", vector{limits.t[first], limits.t[last]})
answer("rest_angle", mean(crane.estimation.theta:range(1, rest)))
answer("G_position", tf({b0, b1, b2}, {1, a1, a2, a3, 0}))
answer("G_angle", model.theta)
answer("fits", vector{fit_of.x, fit_of.theta})
answer("free_swing", swing_frequency)
-- END SOLUTION
