-- ---
-- title: Identification of an underwater thruster
-- subtitle: Lesson 5 – a static nonlinearity, two chirps, and twelve slides
-- lesson: 05_thruster
-- template: slides
-- language: en
-- seed: 1
-- answers:
--   ring_frequency: number
--   dead_band: vector
--   delay: number
--   thrust_300: vector
--   model: table
--   fit: number
-- ---

-- %% [markdown]
-- The width of electrical pulses controls an underwater thruster, which pushes or pulls on a load cell. There are two kinds of experiments: sine
-- chirps and square chirps, whose frequency increases with time (@fig:thruster). Thruster and load cell are *simulated*: a program solves their
-- equations and adds noise, so you can compare your results with the true system. Estimate a model from one kind of experiment and validate it on the
-- other kind. Then exchange estimation and validation data. State which model you recommend and why. Be prepared for questions about the other models
-- that you tried, and why you rejected them.
--
-- ::: {.drawing name=thruster}
-- The thruster hangs in the water on a beam that rotates about a pivot and presses on a load cell. The input is the width $p$ of the pulses, and the
-- output is the reading $F$ of the load cell. {#fig:thruster}
-- :::
--
-- Work in this script, cell by cell, and write your text in `report.md`. dynlab creates the slides from this file: at most twelve slides, for a talk
-- of ten minutes and five minutes of questions. The file contains the eight required points of a presentation, with notes on the content of each
-- point. Submit the slides as a PDF together with this script: `dynlab pack` creates one zip file with both.
--
-- The exercise is based on an exercise with a real T200 thruster: MathWorks Student Competitions Team, *MATLAB and Simulink Robotics Arena: From Data
-- to Model*, MATLAB Central File Exchange 65919. A [video](https://www.youtube.com/watch?v=RU_LOtrEOBo) shows one of the tests, starting at 17:25.
--
-- # The data
--
-- | data set | experiment |
-- |-------------|----------------|
-- | `sine_100`, `sine_200`, `sine_300` | sine chirp from 0.1 Hz to 3 Hz in 20 s; amplitude 100, 200 or 300 µs around 1500 µs; rests before and after |
-- | `square_100`, `square_200`, `square_300` | square chirp: the sign of the sine chirp, with the same amplitudes |
--
-- Each data set contains `t` (s), `pwm` (µs) and `force` (N), sampled every 0.002 s. The pulse width is constant between samples, and 1500 µs is
-- neutral.

-- %% id=records
local thruster = load("thruster")
local Ts = 0.002
local function say(english, french)
    return report.language() == "fr" and french or english
end
local signals = {InputName = say("pulse width", "largeur d'impulsion"),
                 InputUnit = "µs",
                 OutputName = say("thrust", "poussée"), OutputUnit = "N"}
local function raw(name)
    local record = thruster[name]
    return iddata(record.force, record.pwm, Ts, signals)
end
print(raw("sine_300"))
idplot(raw("sine_300")):set{height = 6}

-- %% [markdown]
-- **Question 1.** Plot raw data of both kinds. What can you see before you compute anything?
--
-- **Question 2.** Subtract the neutral width from the input, and the level at rest from the thrust. Then apply `advice` to a sine chirp (every fifth
-- sample is enough: `resample`). `advice` reports the standard deviation of the part that a linear model cannot explain. Compare it with the noise at
-- rest. What causes the difference? Why does a square chirp of one amplitude not show this difference?

-- %% id=raw
-- BEGIN SOLUTION
local seconds = say("time (s)", "temps (s)")
local width_axis, thrust_axis = say("width (µs)", "largeur (µs)"), say("thrust (N)", "poussée (N)")
local neutral, rest = 1500, 250  -- µs; samples before the first pulse
local shapes, amplitudes = {"sine", "square"}, {100, 200, 300}
local other = {sine = "square", square = "sine"}
local shape_word = {sine = say("sine", "sinus"), square = say("square", "carré")}

local function width(record) return record.pwm - neutral end
local function thrust(record) return record.force - mean(record.force:range(1, rest)) end
local function prepared(name)
    local record = thruster[name]
    return iddata(thrust(record), width(record), Ts, signals)
end

local experiments = {{say("data", "enregistrements"), say("shape", "forme"), say("amplitude (µs)", "amplitude (µs)"),
                      say("frequency (Hz)", "fréquence (Hz)"), say("duration (s)", "durée (s)")}}
for _, shape in ipairs(shapes) do
    local record = thruster[shape .. "_300"]
    experiments[#experiments + 1] = {shape .. "_100, " .. shape .. "_200, " .. shape .. "_300", shape_word[shape], "100, 200, 300",
                                     say("0.1 to 3", "0,1 à 3"), string.format("%.0f", record.t[#record.t])}
end
report.table("experiments", experiments)

local raw_panels = {}
for column, shape in ipairs(shapes) do
    local record = thruster[shape .. "_300"]
    raw_panels[column] = {ylabel = column == 1 and width_axis or nil, title = shape .. "_300",
                          curves = {{x = record.t, y = record.pwm, style = "stairs", color = 8, line_width = 0.6}}}
    raw_panels[2 + column] = {ylabel = column == 1 and thrust_axis or nil, xlabel = seconds, y_range = {-32, 32},
                              curves = {{x = record.t, y = record.force, color = 0, line_width = 0.6}}}
end
report.figure("raw", figure{rows = 2, columns = 2, width = 14.4, height = 5.4, panels = raw_panels},
              say("The data of the largest amplitude: pulse width (above) and thrust (below)",
                  "Les enregistrements de plus grande amplitude : largeurs (en haut) et poussée (en bas)"))

local at_rest = {}
for _, shape in ipairs(shapes) do
    for _, amplitude in ipairs(amplitudes) do at_rest[#at_rest + 1] = thruster[shape .. "_" .. amplitude].force:range(1, rest) end
end
local rest_readings = vector(at_rest)
report.value("rest_level", mean(rest_readings), "%.2f")
report.value("rest_noise", std(rest_readings), "%.2f")
-- END SOLUTION

-- %% id=advice
-- BEGIN SOLUTION
-- A sine covers all widths, so it shows that the thrust is nonlinear. A square wave has only three widths.
local reported = {}
for _, finding in ipairs(advice(resample(prepared("sine_300"), 1, 5))) do reported[finding.code] = finding.value end
-- END SOLUTION

-- %% id=advice_report echo=false
-- BEGIN SOLUTION
report.value("snr", reported.noise, "%.0f")
-- Signal-to-noise ratio if the only noise is the noise at rest.
report.value("snr_rest", 20*math.log(std(thrust(thruster.sine_300))/std(rest_readings), 10), "%.0f")
-- END SOLUTION

-- %% [markdown]
-- **Question 3.** The square chirp excites an oscillation. Determine the frequency of this oscillation (`etfe` with some smoothing, or an average
-- over many switchings). Is the thruster the cause? Choose a low-pass filter for the dynamics of the thruster. Which signal properties must the
-- filter preserve?
--
-- **Question 4.** Average the responses to many switchings. How long after a switching does the thrust not change? First, enter a prediction
-- (`predict_first`, `reveal`).

-- %% id=switchings_guess
-- BEGIN SOLUTION
-- STARTER: predict_first(say("time without a response", "temps sans réponse"), nil, "ms")
local guessed = 20
predict_first(say("time without a response", "temps sans réponse"), guessed, "ms")
-- END SOLUTION

-- %% id=switchings
-- BEGIN SOLUTION
local before, after, until_time = 50, 175, 12  -- samples around a switching; end of the slow switchings (s)
local quiet = 15                               -- number of samples before the switching for the mean level
local record = thruster.square_300
local sum, switchings = zeros(before + after + 1), 0
for k = 2, #record.t do
    local jump = record.pwm[k] - record.pwm[k - 1]
    if math.abs(jump) > 300 and record.t[k] < until_time then
        local piece = record.force:range(k - before, k + after)
        piece = piece - mean(piece:range(before - quiet, before))
        sum, switchings = sum + (jump > 0 and 1 or -1)*piece, switchings + 1
    end
end
local answer_mean = sum/switchings
local since = 1e3*Ts*range(-before, 1, after)  -- ms
local onset  -- time at which the response exceeds 1 % of its maximum
for k = before + 1, #since do
    if not onset and answer_mean[k] > 0.01*max(answer_mean) then onset = since[k] end
end

reveal(say("time without a response", "temps sans réponse"), onset)

local band = 8  -- Hz
local function low_pass(v) return idfilt(v, {0, 2*math.pi*band}, {zero_phase = true, Ts = Ts}) end
local _, response = etfe(prepared("square_300"), {smooth = 8})
local peak = 0
for k = 1, #response.w do
    local hertz = response.w[k]/(2*math.pi)
    if hertz > band and hertz < 40 and (peak == 0 or response.magnitude[k] > response.magnitude[peak]) then peak = k end
end
-- END SOLUTION

-- %% id=switchings_report echo=false
-- BEGIN SOLUTION
report.value("switchings", switchings, "%d")
report.value("onset", onset, "%.0f")
report.value("guessed", guessed, "%d")
report.value("ring_frequency", response.w[peak]/(2*math.pi), "%.1f")
report.value("band", band, "%d")
report.figure("switching", figure{width = 14.4, height = 4.6, columns = 2, panels = {
    {xlabel = say("time since the switching (ms)", "temps depuis la commutation (ms)"), ylabel = thrust_axis,
     references = {{x = 0, dash = 2}, {x = onset, label = say("answer", "réponse")}},
     curves = {{x = since, y = answer_mean, color = 0, line_width = 1.1}}},
    {xlabel = say("frequency (Hz)", "fréquence (Hz)"), ylabel = say("thrust per width (N/µs)", "poussée / largeur (N/µs)"),
     x_log = true, y_log = true, x_range = {0.5, 60},
     references = {{x = band, label = say("filter", "filtre")}},
     curves = {{x = response.w/(2*math.pi), y = response.magnitude, color = 1, dash = 0, line_width = 0.8}}}}},
    say("Mean response to a switching; frequency response of square_300", "Réponse moyenne à une commutation ; réponse fréquentielle de square_300"))
-- END SOLUTION

-- %% [markdown]
-- **Question 5.** Plot the thrust versus the pulse width: apply the same filter to both signals, use the slow part of the sine chirps, and average in
-- bins. Where does the dead band end? How do forward and reverse thrust differ? Also plot the square root of the thrust. Which shape does it have
-- outside the dead band, and how does physics explain this shape?

-- %% id=curve
-- BEGIN SOLUTION
local slow = 6        -- s: frequencies below 1 Hz
local bin_width = 10  -- µs
local sines = {}
for k, amplitude in ipairs(amplitudes) do
    local sine = thruster["sine_" .. amplitude]
    sines[k] = {u = low_pass(width(sine)), F = low_pass(thrust(sine))}
end
-- Mean thrust in bins of the pulse width `late` samples earlier, and the remaining variation within the bins.
local function by_bins(late)
    local bins = {}
    for _, sine in ipairs(sines) do
        local u, F = sine.u, sine.F
        for k = rest, math.floor(slow/Ts) do
            local place = math.floor(u[k - late]/bin_width + 0.5)
            local bin = bins[place] or {sum = 0, squares = 0, count = 0}
            bin.sum, bin.squares, bin.count = bin.sum + F[k], bin.squares + F[k]^2, bin.count + 1
            bins[place] = bin
        end
    end
    local left, curve = 0, {width = {}, thrust = {}}
    for place = -30, 30 do
        local bin = bins[place]
        if bin and bin.count > 50 then
            table.insert(curve.width, place*bin_width)
            table.insert(curve.thrust, bin.sum/bin.count)
            left = left + bin.squares - bin.sum^2/bin.count
        end
    end
    return curve, left
end
-- The thrust is delayed. With the correct delay, the curves for increasing and decreasing widths are closest.
local curve, lateness, least
for late = 0, 100, 5 do
    local tried, left = by_bins(late)
    if not least or left < least then curve, lateness, least = tried, late, left end
end

local function root(F) return F/sqrt(abs(F) + 1e-9) end
local function squared(s) return s*abs(s) end
-- Outside the dead band, the width is a quadratic function of the root of the thrust: the motor torque is linear in the
-- speed, and the torque of the water is quadratic. The dead band ends where the root is zero.
local dead_band_end = {}
for _, sign in ipairs{1, -1} do
    local x, y = {}, {}
    for k, w in ipairs(curve.width) do
        if sign*curve.thrust[k] > 0.5 then
            table.insert(x, sign*math.sqrt(math.abs(curve.thrust[k])))
            table.insert(y, w)
        end
    end
    local parabola = polyfit(vector(x), vector(y), 2)
    dead_band_end[sign] = parabola[3]
end
-- END SOLUTION

-- %% id=curve_report echo=false
-- BEGIN SOLUTION
local truth = true_model("thruster")
report.value("edge_forward", dead_band_end[1], "%.0f")
report.value("edge_reverse", dead_band_end[-1], "%.0f")
report.value("lateness", 1e3*Ts*lateness, "%.0f")
local at_width = {}
for k, w in ipairs(curve.width) do at_width[w] = curve.thrust[k] end
local forward, reverse = {}, {}
for _, w in ipairs(curve.width) do
    if w >= 150 and at_width[-w] then
        table.insert(forward, at_width[w])
        table.insert(reverse, at_width[-w])
    end
end
report.value("asymmetry", -mean(vector(forward))/mean(vector(reverse)), "%.2f")
report.value("true_asymmetry", -truth.forward_thrust/truth.reverse_thrust, "%.2f")
-- END SOLUTION

-- %% [markdown]
-- **Question 6.** Which structures do you compare, and which measure do you use? Use a linear model with a delay, a Hammerstein model (`hammerstein`:
-- a static curve followed by linear dynamics), and a structure derived from physics. Apply the same filter to the measured and the simulated thrust.
-- How does the delay change if you filter only one of them? How many poles does a structure need, and how does the delay change when you add poles?
-- If you know the static curve, use `tfsrivc` with the output of the curve as the input for a quick estimate. A square wave of one amplitude has
-- three values. What can it show about a static curve?

-- %% id=structure
-- BEGIN SOLUTION
local edges = {-300, -200, -100, -25, 25, 100, 200, 300}  -- breakpoints, including the ends of the dead band
local longest = 0.08                                      -- s, upper bound of the delay search

local function all_of(records, shape, sizes, make)
    local list = {}
    for k, amplitude in ipairs(sizes) do list[k] = make(records[shape .. "_" .. amplitude]) end
    return list
end
local function experiment(records, shape, sizes, output, input)
    return merge(table.unpack(all_of(records, shape, sizes, function(r)
        return iddata(output(r), input and input(width(r)) or width(r), Ts)
    end)))
end
local function characteristic(H)
    return function(u) return interp1(H.report.breakpoints, H.report.levels, u, {outside = "hold"}) end
end

-- Each function estimates one lag and a delay from the data of one shape, without filtering. It returns the model and a
-- function that simulates the thrust.
local kinds = {}
function kinds.linear(records, shape, sizes)
    local G = tfsrivc(experiment(records, shape, sizes, thrust), 1, 0, {TdMax = longest, InitialState = "none", Offset = "none"})
    return G, function(u) return lsim(G, u, Ts) end
end
local function static_curve_and_lag(records, shape, sizes, output)
    return hammerstein(experiment(records, shape, sizes, output), 1, 0, {Breakpoints = edges, TdMax = longest})
end
function kinds.hammerstein(records, shape, sizes)
    local H = static_curve_and_lag(records, shape, sizes, thrust)
    local f = characteristic(H)
    return H, function(u) return lsim(H, f(u), Ts) end
end
-- The propeller speed follows the pulse width with a lag, and the thrust is the squared speed: model the root of the thrust.
local function root_of_thrust(r) return root(thrust(r)) end
function kinds.root(records, shape, sizes)
    local H = static_curve_and_lag(records, shape, sizes, root_of_thrust)
    local f = characteristic(H)
    return H, function(u) return squared(lsim(H, f(u), Ts)) end
end

-- Fit of the simulated thrust over the data of one shape, below 8 Hz, or without a filter if `whole` is true.
local function agreement(records, shape, sizes, simulate, whole)
    local errors, variations = {}, {}
    all_of(records, shape, sizes, function(r)
        local y, model = thrust(r), simulate(width(r))
        if not whole then y, model = low_pass(y), low_pass(model) end
        table.insert(errors, y - model)
        table.insert(variations, y - mean(y))
    end)
    return 100*(1 - norm(vector(errors))/norm(vector(variations)))
end
-- END SOLUTION

-- %% id=orders echo=false
-- BEGIN SOLUTION
local kind_word = {linear = say("linear", "linéaire"), hammerstein = "Hammerstein", root = say("root model", "modèle racine")}
local order_list = {"linear", "hammerstein", "root"}
local fitted = {linear = {}, hammerstein = {}, root = {}}  -- indexed by kind and shape
for kind, estimate in pairs(kinds) do
    for _, shape in ipairs(shapes) do
        local G, simulate = estimate(thruster, shape, amplitudes)
        fitted[kind][shape] = {model = G, simulate = simulate}
    end
end

-- More poles, from the largest amplitude; the input is the width (linear) or the static curve of the Hammerstein model.
local largest = {300}
local pole_gain = 0  -- largest gain of additional poles, on the other shape
local orders = {{say("model", "modèle"), say("poles", "pôles"),
                 say("sine (%)", "sinus (%)"), say("→ square (%)", "→ carré (%)"), say("delay (ms)", "retard (ms)"),
                 say("square (%)", "carré (%)"), say("→ sine (%)", "→ sinus (%)"), say("delay (ms)", "retard (ms)")}}
for _, kind in ipairs{"linear", "hammerstein"} do
    local one_pole = {}  -- the fit on the other shape
    for poles = 1, kind == "linear" and 2 or 3 do
        local row = {poles == 1 and kind_word[kind] or "", poles}
        for _, shape in ipairs(shapes) do
            local f = kind == "hammerstein" and characteristic(fitted.hammerstein[shape].model) or function(u) return u end
            local G = tfsrivc(experiment(thruster, shape, largest, thrust, f), poles, 0,
                              {TdMax = longest, InitialState = "none", Offset = "none"})
            local function simulate(u) return lsim(G, f(u), Ts) end
            table.insert(row, string.format("%.1f", agreement(thruster, shape, largest, simulate)))
            local validated = agreement(thruster, other[shape], largest, simulate)
            one_pole[shape] = one_pole[shape] or validated
            pole_gain = math.max(pole_gain, validated - one_pole[shape])
            table.insert(row, string.format("%.1f", validated))
            table.insert(row, string.format("%.1f", 1e3*G.IODelay))
            if poles == 3 and shape == "square" then
                local frequency, damping = damp(G)
                local swing = damping[1] < 1 and 1 or 3  -- damp sorts by frequency; the third pole is real
                report.value("cell_frequency", frequency[swing]/(2*math.pi), "%.1f")
            end
        end
        table.insert(orders, row)
    end
end
report.table("orders", orders)
report.value("pole_gain", pole_gain, "%.1f")

-- The root model if the thrust is filtered before the square root, and the pulses are not.
local one_sided = static_curve_and_lag(thruster, "square", amplitudes, function(r) return root(low_pass(thrust(r))) end)
report.value("delay_one_sided", 1e3*one_sided.IODelay, "%.0f")
-- END SOLUTION

-- %% [markdown]
-- **Question 7.** Estimate your structures from the sine chirps and from the square chirps. Which parameters agree? Are the differences significant
-- compared with the standard errors?

-- %% id=estimate
-- BEGIN SOLUTION
local ham, rooted = fitted.hammerstein.sine.model, fitted.root.sine.model
present(ham)
present(rooted)
-- END SOLUTION

-- %% id=estimate_report echo=false
-- BEGIN SOLUTION
-- Formats a value with one decimal; the error is rounded up.
local function with_error(x, sigma) return string.format("%.1f ± %.1f", x, math.ceil(10*sigma)/10) end
local function last_error(G) return G.std[#G.std] end  -- standard error of the delay
local parameters = {{say("parameter", "paramètre"), say("unit", "unité"), say("sine", "sinus"), say("square", "carré")}}
local function parameter(text, unit, value)
    table.insert(parameters, {text, unit, value("sine"), value("square")})
end
for _, kind in ipairs(order_list) do
    local function of(shape) return fitted[kind][shape].model end
    local word = kind_word[kind]
    if kind == "linear" then
        parameter(word .. say(": gain", " : gain"), "mN/µs", function(shape) return string.format("%.1f", 1e3*dcgain(of(shape))) end)
    end
    parameter(word .. say(": lag", " : constante de temps"), "ms", function(shape)
        local a = of(shape).den[2]
        return with_error(1e3/a, 1e3*of(shape).std[1]/a^2)
    end)
    parameter(word .. say(": delay", " : retard"), "ms", function(shape)
        return with_error(1e3*of(shape).IODelay, 1e3*last_error(of(shape)))
    end)
    if kind ~= "linear" then
        for _, u in ipairs{300, -300} do
            parameter(word .. string.format(say(": thrust at %+d µs", " : poussée à %+d µs"), u):gsub("%-", "−"), "N", function(shape)
                local level = characteristic(of(shape))(vector{u})
                if kind == "root" then level = squared(level) end
                return string.format("%.1f", level[1])
            end)
        end
    end
end
report.table("parameters", parameters)

local function static_curve(kind, shape, u)
    local level = characteristic(fitted[kind][shape].model)(u)
    return kind == "root" and squared(level) or level
end
local fine = linspace(-300, 300, 241)
local true_curve = interp1(truth.pwm - truth.neutral, truth.thrust, fine)
local function curve_panel(more)
    local panel = {ylabel = thrust_axis, curves = {
        {x = curve.width, y = curve.thrust, style = "points", color = 8, marker = 4, label = say("bins", "classes")},
        {x = fine, y = static_curve("root", "sine", fine), color = 0, label = say("root model, sine", "modèle racine, sinus")},
        {x = fine, y = static_curve("hammerstein", "square", fine), color = 1, dash = 1, label = say("Hammerstein, square", "Hammerstein, carré")},
        {x = fine, y = true_curve, color = 2, dash = 2, label = say("truth", "vérité")}}}
    for key, value in pairs(more) do panel[key] = value end
    return panel
end
report.figure("curve", figure{rows = 2, width = 8.8, height = 6.7, panels = {
    curve_panel{legend = "above", x_range = {-300, 300}},
    curve_panel{legend = "none", x_range = {-120, 120}, y_range = {-4, 4}, references = {{x = -truth.dead_band}, {x = truth.dead_band}},
                xlabel = say("width, from neutral (µs)", "largeur, depuis le neutre (µs)")}}},
    say("Thrust versus pulse width, and an enlarged view around neutral", "Poussée selon la largeur d'impulsion, et autour du neutre"))

for _, shape in ipairs(shapes) do
    for _, kind in ipairs(order_list) do
        local G = fitted[kind][shape].model
        report.value("delay_" .. kind .. "_" .. shape, 1e3*G.IODelay, "%.1f")
        report.value("lag_" .. kind .. "_" .. shape, 1e3/G.den[2], "%.1f")
    end
end
report.value("true_delay", 1e3*truth.delay, "%.0f")
report.value("slow_lag", 1e3*truth.slow_time_constant, "%.0f")
report.value("fast_lag", 1e3*truth.fast_time_constant, "%.0f")
report.value("true_band", truth.dead_band, "%.0f")
local lags = {fitted.root.sine.model.den[2], fitted.root.square.model.den[2]}
report.value("lag_difference", 100*math.abs(lags[1] - lags[2])/math.max(lags[1], lags[2]), "%.0f")
-- Error of a static curve at both widths in percent: the larger of the two.
local function off_by(kind, size)
    local u = vector{size, -size}
    return 100*max(abs(static_curve(kind, "sine", u)/interp1(truth.pwm - truth.neutral, truth.thrust, u) - 1))
end
for _, kind in ipairs{"hammerstein", "root"} do
    for _, size in ipairs(amplitudes) do
        local off = off_by(kind, size)
        report.value("curve_off_" .. kind .. "_" .. size, off, off < 9.5 and "%.1f" or "%.0f")
    end
end
-- END SOLUTION

-- %% [markdown]
-- **Question 8.** Validate in both directions: models from the sine chirps on the square chirps, and models from the square chirps on the sine
-- chirps. At which times and amplitudes does each model fail? `motion` animates the thruster and the model side by side (on the page of
-- `dynlab preview analysis.lua`, not on the slides).

-- %% id=validation
-- BEGIN SOLUTION
local function piece_of(name, shape, from, to, title)
    local r = thruster[name]
    local first, last = math.floor(from/Ts) + 1, math.floor(to/Ts) + 1
    local t = r.t:range(first, last)
    local panel = {title = title, ylabel = thrust_axis, legend = "none", curves = {
        {x = t, y = thrust(r):range(first, last), label = say("measured", "mesuré"), color = 8, line_width = 0.8}}}
    for k, kind in ipairs{"linear", "hammerstein", "root"} do
        table.insert(panel.curves, {x = t, y = fitted[kind][shape].simulate(width(r)):range(first, last), label = kind_word[kind],
                                    color = ({2, 1, 0})[k], dash = ({2, 1, 0})[k], line_width = 1.1})
    end
    return panel
end
local upper = piece_of("square_300", "sine", 9, 10.6, say("models from sine chirps, on square_300", "modèles des sinus, sur square_300"))
local lower = piece_of("sine_200", "square", 9, 10.6, say("models from square chirps, on sine_200", "modèles des carrés, sur sine_200"))
upper.legend, lower.xlabel = "above", seconds
report.figure("validation", figure{rows = 2, width = 14.4, height = 5.9, panels = {upper, lower}},
              say("Validation in both directions", "Validation dans les deux sens"))
-- END SOLUTION

-- %% id=motion
-- BEGIN SOLUTION
-- STARTER: -- motion{plant = "thruster", t = thruster.square_300.t,
-- STARTER: --        measured = {force = thruster.square_300.force}, simulated = {force = ...}}
do
    local r = thruster.square_300
    motion{plant = "thruster", t = r.t, instants = {0.3, 6.5, 12.5, 18.5}, height = 7,
           measured = {force = thrust(r)}, simulated = {force = fitted.root.sine.simulate(width(r))}}
end
-- END SOLUTION

-- %% [markdown]
-- **Question 9.** You can run the simulated thruster again: `plant("thruster", {seed = 2})` repeats all experiments with different noise. Repeat your
-- procedure. Does the ranking of your models depend on the noise? How large is the scatter of the delay? Does noise explain the error of the delay?

-- %% id=repetition
-- BEGIN SOLUTION
local repetitions = 2
local study = {}
for k = 1, repetitions do
    local again = plant("thruster", {seed = k + 1})
    for kind, estimate in pairs(kinds) do
        for _, shape in ipairs(shapes) do
            local G, simulate = estimate(again, shape, amplitudes)
            local name = kind .. "_" .. shape
            study[name] = study[name] or {fit = {}, delay = {}}
            study[name].fit[k], study[name].delay[k] = agreement(again, other[shape], amplitudes, simulate), 1e3*G.IODelay
        end
    end
end
-- END SOLUTION

-- %% id=repetition_report echo=false
-- BEGIN SOLUTION
report.value("repetitions", repetitions, "%d")
local delay_change = 0  -- largest change from the first data sets
for _, shape in ipairs(shapes) do
    for kind, models in pairs(fitted) do
        local changes = vector(study[kind .. "_" .. shape].delay) - 1e3*models[shape].model.IODelay
        delay_change = math.max(delay_change, (max(abs(changes))))  -- only the maximum, without its index
    end
    -- Fits of all three experiments, rounded as in the table.
    local function shown_fits(kind)
        local first = agreement(thruster, other[shape], amplitudes, fitted[kind][shape].simulate)
        return round(10*vector{first, vector(study[kind .. "_" .. shape].fit)})/10
    end
    local function least_gain(better, than)
        return (min(shown_fits(better) - shown_fits(than)))
    end
    report.value("gain_" .. shape, least_gain("hammerstein", "linear"), "%.1f")
    report.value("root_gain_" .. shape, least_gain("root", "hammerstein"), "%.1f")
end
report.value("delay_change", delay_change, "%.1f")
-- END SOLUTION

-- %% id=verdict echo=false
-- BEGIN SOLUTION
local verdict = {{say("model", "modèle"), say("direction", "sens"), "100 µs", "200 µs", "300 µs",
                  say("all (%)", "tous (%)"), say("unfiltered (%)", "sans filtre (%)"), say("repeat 1 (%)", "répété 1 (%)"), say("repeat 2 (%)", "répété 2 (%)")}}
local each = {}
for _, kind in ipairs(order_list) do
    for _, shape in ipairs(shapes) do
        local simulate = fitted[kind][shape].simulate
        local row = {kind_word[kind], shape_word[shape] .. " → " .. shape_word[other[shape]]}
        for _, amplitude in ipairs(amplitudes) do
            local r = thruster[other[shape] .. "_" .. amplitude]
            local y, model = low_pass(thrust(r)), low_pass(simulate(width(r)))
            table.insert(row, string.format("%.1f", 100*(1 - norm(y - model)/norm(y - mean(y)))))
        end
        local all = agreement(thruster, other[shape], amplitudes, simulate)
        local unfiltered = agreement(thruster, other[shape], amplitudes, simulate, true)
        each[kind .. "_" .. shape] = row
        table.insert(row, string.format("%.1f", all))
        table.insert(row, string.format("%.1f", unfiltered))
        for _, again in ipairs(study[kind .. "_" .. shape].fit) do table.insert(row, string.format("%.1f", again)) end
        table.insert(verdict, row)
        report.value("val_" .. kind .. "_" .. shape, all, "%.1f")
        report.value("raw_" .. kind .. "_" .. shape, unfiltered, "%.1f")
    end
end
report.table("verdict", verdict)
-- Gain of the Hammerstein model over the linear model, in points as in the table.
local function gain_in_column(shape, column)
    return tonumber(each["hammerstein_" .. shape][column]) - tonumber(each["linear_" .. shape][column])
end
report.value("gain_200_sine", math.abs(gain_in_column("sine", 4)), "%.1f")
-- END SOLUTION

-- %% [markdown]
-- **Question 10.** Which model do you recommend, and for which purpose? For which purpose is it not suitable? Which experiment do you propose next?
--
-- # What you submit in addition to the slides
--
-- If the script is graded, too, submit results with `answer(name, value)`:
--
-- * `ring_frequency` (Hz): the frequency of question 3;
-- * `dead_band`: the forward end and the reverse end of the dead band (µs from neutral; the reverse end is negative);
-- * `delay` (s): the delay of the thruster;
-- * `thrust_300`: the steady thrust (N) at +300 µs and at −300 µs;
-- * `model`: your recommended model, estimated from the sine chirps;
-- * `fit` (%): the fit of this model to the thrust of all square chirps together, with both signals filtered below 8 Hz.
--
-- The model is a table with four fields. The vectors `width` (µs from neutral, increasing) and `level` are the breakpoints of the piecewise linear
-- static curve. `G` is the linear model after the static curve. `root` is true if the output is the signed square root of the thrust. Grading also
-- runs your script on data of another thruster, with hidden square chirps. The checks look for the figures `curve` and `validation`.

-- %% id=hand_in
-- BEGIN SOLUTION
answer("ring_frequency", response.w[peak]/(2*math.pi))
answer("dead_band", vector{dead_band_end[1], dead_band_end[-1]})
answer("delay", ham.IODelay)
answer("thrust_300", characteristic(ham)(vector{300, -300}))
answer("model", {width = rooted.report.breakpoints, level = rooted.report.levels, G = rooted, root = true})
answer("fit", agreement(thruster, "square", amplitudes, fitted.root.sine.simulate))
-- END SOLUTION
