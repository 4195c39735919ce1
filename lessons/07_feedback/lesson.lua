-- ---
-- title: Identification in the loop and over time
-- subtitle: Lesson 7 – feedback, three cures, and a process that drifts
-- lesson: 07_feedback
-- template: lesson
-- language: en
-- seed: 1
-- bibliography: references.bib
-- answers:
--   G_direct: model
--   own_instruments: vector
--   G_two_stage: model
--   G_final: model
--   before_cleaning: vector
--   after_cleaning: vector
-- ---

-- %% [markdown]
-- Most processes cannot be taken out of their control loop for an experiment: the product would be spoilt, or the process would run away. So the record is made while
-- a controller works, and the input is no longer what somebody chose. And most processes are not the same next month. This lesson has a record for each:
-- a drive under speed control (@fig:drive), and a water heater that furs up (@fig:heater). Both are *simulated*, so that what you find can be held against the truth.
--
-- ::: {.drawing name=drive}
-- The drive: the computer compares the reference $r$ with the speed $y$ that the tachometer reads and sets the motor's voltage $u$; a torque of the load disturbs {#fig:drive}
-- :::
--
-- The work is planned for two sittings of three hours:
--
-- | sitting | questions, with minutes | aim |
-- |--------------|-------------------------|------------------------|
-- | In the loop | 1 (15), 2 (25), 3 (25), 4 (15), 5 (40), 6 (20), 7 (30) | see the bias of the direct route, say where it comes from, cure it three times |
-- | How sure, and over time | 8 (40), 9 (25), 10 (60), 11 (45) | compare the routes over many records; follow a process that drifts |
--
-- # A drive under speed control
--
-- | record | what was done |
-- |-------------|----------------|
-- | `tracking`, `validation` | the loop is closed, the reference jumps between ±8 rad/s, in two different orders |
-- | `regulation` | the loop is closed, the reference rests at zero |
-- | `open_loop` | the loop is opened and the voltage jumps between ±1.2 V |
--
-- Each has `t` (s), `r` (rad/s), `u` (V) and `y` (rad/s), 0.01 s apart; the voltage is held between samples. The controller is known:
--
-- $$ u_k = 0.12\,e_{k-1} + 0.6\,T_s \sum_{i<k} e_i , \qquad e = r - y . $$ {#eq:controller}
--
-- It computes for one sample, hence $e_{k-1}$ and not $e_k$. From voltage to speed physics expects two poles, of the current and of the speed, and no zero,
--
-- $$ G(p) = \frac{b_0}{p^2 + a_1 p + a_2} . $$ {#eq:plant}

-- %% id=records
local drive = load("drive")
local Ts = 0.01
local function pair(record, input, output)
    return iddata(record[output or "y"], record[input or "u"], Ts)
end
local track, opened = drive.tracking, drive.open_loop
local function say(english, french)
    return report.language() == "fr" and french or english
end
print(pair(track))

-- %% [markdown]
-- **Question 1.** Show reference, voltage and speed of `tracking` beside the voltage and the speed of `regulation`. In `regulation` nobody excites anything: what moves the voltage?

-- %% id=signals
-- BEGIN SOLUTION
local last = 800
local function strip(record, name, column, label)
    local style = name == "y" and "line" or "stairs"
    return {ylabel = column == 1 and label or nil, y_range = {-20, 20},
            curves = {{x = record.t:range(1, last), y = record[name]:range(1, last),
                       colour = 8, style = style}}}
end
local panels = {}
for column, record in ipairs{track, drive.regulation} do
    panels[column] = strip(record, "r", column, "r (rad/s)")
    panels[2 + column] = strip(record, "u", column, "u (V)")
    panels[4 + column] = strip(record, "y", column, "y (rad/s)")
    panels[2 + column].y_range = {-5, 5}
    panels[4 + column].xlabel = "time (s)"
end
panels[1].title, panels[2].title = "tracking", "regulation"
report.figure("signals", figure{rows = 3, columns = 2, height = 8, panels = panels},
              "The first eight seconds of two records")
-- END SOLUTION

-- %% id=signals_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- This cell runs, but its code is not printed (echo=false). Hand over here what your text shows; in a text cell
-- STARTER: --   report.value("gain", K, "%.2f")          is shown by  `gain`{.value}
-- STARTER: --   report.figure("name", fig, "caption")    by  ![caption](figure:name){#fig:name}  on a line of its own, and @fig:name refers to it
-- STARTER: --   report.table("name", {{"head"}, {"cell"}})  by  ::: {.table name=name #tbl:name}  then a line with the caption, then  :::
report.value("regulation_y", std(drive.regulation.y), "%.1f")
report.value("regulation_u", std(drive.regulation.u), "%.2f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ![The first eight seconds of `tracking` (left) and `regulation` (right): reference, voltage, speed](figure:signals){#fig:signals}
--
-- @fig:signals shows them. In `regulation` the load's torque moves the speed, by `regulation_y`{.value} rad/s (standard deviation), and the controller answers with
-- `regulation_u`{.value} V. The voltage is made of the disturbance: this is what is different in a loop. In `tracking` it is a mixture of what the reference asks for and of what the disturbance provokes.
-- END SOLUTION
--
-- ## The direct route
--
-- The simplest thing to do is to take $u$ and $y$ as if there were no loop.
--
-- **Question 2.** Estimate @eq:plant with LSSVF, $\lambda = 10$ rad/s, and with SRIVC, each from `open_loop` and from `tracking`. Compare gain and parameters with the truth, `rig_truth("drive").G`.
-- Guess first: by how much is the gain that SRIVC finds in the loop wrong?

-- %% id=direct_guess
-- BEGIN SOLUTION
-- STARTER: guess(say("error of the gain", "erreur du gain"), nil, "%")
guess(say("error of the gain", "erreur du gain"), -10, "%")
-- END SOLUTION

-- %% id=direct
-- BEGIN SOLUTION
local lambda = 10
local truth = rig_truth("drive")
local routes = {}
for name, record in pairs{open_loop = opened, tracking = track} do
    routes[name] = {lssvf = lssvf(pair(record), {2, 1, 0}, lambda),
                    srivc = srivc(pair(record), {1, 2, 0})}
end
present(routes.tracking.srivc)
local function off(G) return 100*(dcgain(G)/dcgain(truth.G) - 1) end
outcome(say("error of the gain", "erreur du gain"),
        off(routes.tracking.srivc))
-- END SOLUTION

-- %% id=direct_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local function cells(name, p)
    return {name, string.format("%.2f", p[1]), string.format("%.2f", p[2]), string.format("%.0f", p[3]),
            string.format("%.2f", p[3]/p[2])}
end
local true_p = vector{truth.G.den[2], truth.G.den[3], truth.G.num[#truth.G.num]}
report.table("direct", {{"method, record", "$a_1$", "$a_2$", "$b_0$", "gain"},
    cells("truth", true_p),
    cells("LSSVF, open loop", routes.open_loop.lssvf.param), cells("LSSVF, in the loop", routes.tracking.lssvf.param),
    cells("SRIVC, open loop", routes.open_loop.srivc.param), cells("SRIVC, in the loop", routes.tracking.srivc.param)})
report.value("srivc_off", math.abs(off(routes.tracking.srivc)), "%.0f")
report.value("srivc_errors", math.abs(routes.tracking.srivc.param[3] - true_p[3])/routes.tracking.srivc.std[3], "%.0f")
report.value("direct_fit", fit(pair(drive.validation), routes.tracking.srivc), "%.1f")
report.value("true_fit", fit(pair(drive.validation), truth.G), "%.1f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=direct #tbl:direct}
-- The direct route: parameters of @eq:plant and the gain $b_0/a_2$ (rad/s per volt)
-- :::
--
-- LSSVF is biased in both records (@tbl:direct), as lesson 4 leads one to expect of a noisy output. SRIVC is close to the truth when the loop is open, but in the loop
-- its gain is `srivc_off`{.value} % too small, and $b_0$ misses the truth by `srivc_errors`{.value} of its own standard errors: they know nothing of it. Validation in the loop does not help: on `validation` this model simulates the
-- speed from the voltage with a fit of `direct_fit`{.value} %, the truth itself with `true_fit`{.value} %. The wrong model wins, for it is wrong in the way that this
-- loop rewards.
-- END SOLUTION
--
-- **Question 3.** Where does this come from? Take the true $G$ and compute what it leaves over in `tracking` and in `open_loop`, $v = y - G u$. Correlate $v$ with earlier and
-- with later voltages. Which side is not zero, and what would it look like without feedback?

-- %% id=correlation
-- BEGIN SOLUTION
local function left_over(record)
    return record.y - lsim(truth.G, record.u, Ts)
end
-- Correlation of v(k) with u(k + lag), for lags from -most to most.
local function correlation(v, u, most)
    local a, b = v - mean(v), u - mean(u)
    local n, lags, values = #a, {}, {}
    for lag = -most, most, 2 do
        local first, last = math.max(1, 1 - lag), math.min(n, n - lag)
        table.insert(lags, lag*Ts)
        local product = dot(a:range(first, last), b:range(first + lag, last + lag))
        table.insert(values, product/(norm(a)*norm(b)))
    end
    return vector(lags), vector(values)
end
local lags, in_loop = correlation(left_over(track), track.u, 150)
local _, without = correlation(left_over(opened), opened.u, 150)
local picture = plot(lags, in_loop, "in the loop", lags, without, "open loop",
                     {height = 5, dash = {0, 2}, ylabel = "correlation",
                      xlabel = "time by which the voltage is later (s)"})
report.figure("correlation", picture:vline(0), "What is left over, and the voltage")
-- END SOLUTION

-- %% id=correlation_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local deepest = 1
for k = 1, #lags do
    if math.abs(in_loop[k]) > math.abs(in_loop[deepest]) then deepest = k end
end
report.value("deepest", math.abs(in_loop[deepest]), "%.2f")
report.value("deepest_lag", lags[deepest], "%.2f")
report.value("open_most", max(abs(without)), "%.2f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ![Correlation of what the right model leaves over with the voltage at other times: right of zero, the voltage is later](figure:correlation){#fig:correlation}
--
-- With the loop open chance leaves up to `open_most`{.value} (@fig:correlation). In the loop what is left over is correlated with the voltage of the same instant and of later ones, by up to `deepest`{.value}, and hardly with earlier ones: the
-- disturbance pushes the speed, and the controller pushes back. In between it lasts, so that the reaction to its past meets its present. With $u$ on the right-hand side of the regression the error is no longer independent of the regressors,
-- whether they hold the measured or the simulated output: both are made of $u$.
-- With a right model of the noise as well, as `rivc` has it, the direct route would be consistent; with a wrong one it is not [@ljung1999, section 13.4].
-- END SOLUTION
--
-- **Question 4.** What does the direct route find in `regulation`, where nothing but the disturbance moves the loop? Estimate the frequency response (`etfe` with smoothing, or `spa`) from $u$ to $y$ and compare with
-- $G$ and with what remains of the loop's equation when $r = 0$.

-- %% id=regulation
-- BEGIN SOLUTION
local w = 10^linspace(0, 2, 60)
local function decibels(magnitude) return 20*log(magnitude)/log(vector{10})[1] end
local responses = etfe(pair(drive.regulation), truth.G,
                       {smooth = 20, labels = {"G"}})
responses:add(w, decibels(1/freqresp(truth.controller, w).abs),
              {label = "1/C", colour = 2, dash = 2})
report.figure("regulation", responses:set{height = 8},
              "Frequency responses from voltage to speed")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ![From voltage to speed: estimated from `regulation`, the truth $G$, and the magnitude of the controller's inverse $1/C$](figure:regulation){#fig:regulation}
--
-- With $r = 0$ the record obeys two equations, $y = G u + v$ and $u = -C y$. The second one has no error, so it is the one that is found: $y/u = -1/C$ (@fig:regulation), the
-- inverse of the controller with its sign turned. No method can find $G$ here, whatever it is called. A record of ordinary operation is therefore not a free experiment: somebody must move the reference.
-- END SOLUTION
--
-- ## First cure: instruments made of the reference
--
-- The reference is what somebody chose. It moves the voltage and the speed, and it is independent of the disturbance: that is all that is asked of an instrument.
--
-- **Question 5.** Write the regression of lesson 4, $Z^T Y = Z^T \Phi\,\theta$, with the columns $p^2 r_f$, $p\,r_f$, $r_f$ of the filtered reference as the instruments (`svf`, `solve`; $\lambda = 10$ rad/s). A voltage
-- has no second derivative: `svf(r, 4, lambda, ...)` gives enough columns of a smoother filter. Then try `clivsvf`.

-- %% id=instruments
-- BEGIN SOLUTION
local function own_instruments(record, lambda)
    local Y = svf(record.y, 2, lambda, {Ts = Ts, hold = "foh"})
    local U = svf(record.u, 2, lambda, {Ts = Ts, hold = "zoh"})
    local R = svf(record.r, 4, lambda, {Ts = Ts, hold = "zoh"})
    local Phi = matrix{-Y:col(2), -Y:col(3), U:col(3)}
    local Z = matrix{R:col(3), R:col(4), R:col(5)}
    return solve(Z:t()*Phi, Z:t()*Y:col(1))
end
-- STARTER: local function own_instruments(record, lambda)
-- STARTER:     return zeros(3)
-- STARTER: end
local own = own_instruments(track, lambda)
print("a1, a2, b0:", own)
-- END SOLUTION

-- %% id=clivsvf
-- BEGIN SOLUTION
local loop = iddata(track.y, track.u, Ts, {Reference = track.r})
local Giv = clivsvf(loop, {2, 1, 0}, lambda)
present(Giv)
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- The own program finds a gain of `own_gain`{.value}, CLIVSVF of `iv_gain`{.value}; the truth is `true_gain`{.value}, and the direct route found `direct_gain`{.value}. CLIVSVF projects the voltage on the reference and its past and lets
-- a first model answer that: such instruments resemble the noise-free regressors more than filtered references do. Neither program knows the controller. All cures are above the truth in this record: it is one throw of the dice (@sec:which).
-- END SOLUTION
--
-- ## Second cure: the loop as auxiliary model
--
-- **Question 6.** The controller is known. Then a model of the plant gives a model of the whole loop, whose simulated, noise-free voltage $\hat u$ and speed $\hat x$ make better instruments, and its denominator
-- makes the filter. That is CLSRIVC [@gilson2008]: `clsrivc(data, {nb, nf, nk}, {controller = C})`. Write @eq:controller as a transfer function in $z$, and estimate.

-- %% id=clsrivc
-- BEGIN SOLUTION
local z = tf("z", Ts)
local C = (0.12 + 0.6*Ts*z/(z - 1))/z
local Gcl = clsrivc(loop, {1, 2, 0}, {controller = C})
present(Gcl)
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- Its gain is `cl_gain`{.value}. The message tells that the given controller explains the recorded voltage; were it not so, a warning would say it. Instruments that come out of a simulated loop resemble the noise-free signals as
-- far as the model is right, and the filter is that of SRIVC: there is no $\lambda$ to choose.
-- END SOLUTION
--
-- ## Third cure: two stages
--
-- **Question 7.** Nothing needs to be known of the controller: estimate first how the reference moves the voltage, $\hat u = S r$ (an open-loop problem: what orders does it need?), then the plant from
-- $\hat u$ to $y$ with an ordinary method. Why is that one right now? Compare with `clsrivc` and its `route = "two-stage"`.

-- %% id=two_stage
-- BEGIN SOLUTION
local function two_stage(record)
    local S = srivc(pair(record, "r", "u"), {4, 3, 1})
    local voltage = lsim(S, record.r, Ts)
    return srivc(iddata(record.y, voltage, Ts), {1, 2, 0})
end
local Gtwo = two_stage(track)
present(Gtwo)
local Glib = clsrivc(loop, {1, 2, 0}, {route = "two-stage"})
-- END SOLUTION

-- %% id=two_stage_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local function with_error(p, std, i, format) return string.format(format, p[i]):gsub("^%-", "−") .. " ± " .. string.format(format, std[i]) end
local cures = {{"cure", "$a_1$", "$a_2$", "$b_0$", "gain"}, cells("truth", true_p), cells("instruments from $r$, own program", own)}
for _, case in ipairs{{"instruments from $r$, CLIVSVF", Giv}, {"loop as auxiliary model, CLSRIVC", Gcl}, {"two stages", Gtwo}} do
    local p, e = case[2].param, case[2].std
    table.insert(cures, {case[1], with_error(p, e, 1, "%.1f"), with_error(p, e, 2, "%.1f"), with_error(p, e, 3, "%.0f"), string.format("%.2f", p[3]/p[2])})
end
report.table("cures", cures)
report.value("own_gain", own[3]/own[2], "%.2f")
report.value("true_gain", dcgain(truth.G), "%.2f")
report.value("direct_gain", dcgain(routes.tracking.srivc), "%.2f")
for name, G in pairs{iv = Giv, cl = Gcl, library = Glib} do report.value(name .. "_gain", dcgain(G), "%.2f") end
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=cures #tbl:cures}
-- The three cures on `tracking`: parameters ± one reported standard error, and the gain
-- :::
--
-- From $r$ to $u$ nothing is fed back: $r$ knows nothing of the disturbance, so any open-loop method is right. $S = C/(1 + C G)$ has three poles, two of the plant and one of the controller's integrator, as many zeros, for the controller passes a jump of $r$ on, and one sample of delay. The second stage takes
-- all of the disturbance and what the first one missed for noise, and its standard errors do not know of the first stage. The library projects the voltage on the past of the reference instead of modelling $S$ by few
-- parameters, and finds `library_gain`{.value}.
-- END SOLUTION
--
-- ## Which cure? {#sec:which}
--
-- ::: note
-- Here the second sitting begins: *how sure, and over time*.
-- :::
--
-- **Question 8.** One record is one throw of the dice. `rig("drive", {seed = 2})` repeats the experiments with another order of bits and another load. Repeat all routes forty
-- times. Which are biased, by how many of their own standard deviations? Which cure scatters least, and why?

-- %% id=repetition
-- BEGIN SOLUTION
local repetitions = 40
local names = {"LSSVF", "SRIVC", "own instruments", "CLIVSVF", "CLSRIVC",
               "two stages"}
local gains, parameters = {}, {}
for _, name in ipairs(names) do gains[name], parameters[name] = {}, {} end
for k = 1, repetitions do
    local record = rig("drive", {seed = k + 1}).tracking
    local data = iddata(record.y, record.u, Ts, {Reference = record.r})
    local found = {lssvf(data, {2, 1, 0}, lambda).param,
                   srivc(data, {1, 2, 0}).param,
                   own_instruments(record, lambda),
                   clivsvf(data, {2, 1, 0}, lambda).param,
                   clsrivc(data, {1, 2, 0}, {controller = C}).param,
                   clsrivc(data, {1, 2, 0}, {route = "two-stage"}).param}
    for i, name in ipairs(names) do
        gains[name][k], parameters[name][k] = found[i][3]/found[i][2], found[i][1]
    end
end
-- END SOLUTION

-- %% id=repetition_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local true_gain = dcgain(truth.G)
local repeated = {{"route", "$a_1$", "scatter", "bias", "gain", "scatter", "bias"}}
for _, name in ipairs(names) do
    local row = {name}
    for _, case in ipairs{{parameters[name], true_p[1], "%.2f"}, {gains[name], true_gain, "%.3f"}} do
        local v = vector(case[1])
        local sigma = std(v)
        table.insert(row, string.format(case[3], mean(v)))
        table.insert(row, string.format(case[3], sigma))
        table.insert(row, (string.format("%.1f", (mean(v) - case[2])/(sigma/math.sqrt(repetitions))):gsub("^%-", "−")))
    end
    table.insert(repeated, row)
end
report.table("repeated", repeated)
report.value("repetitions", repetitions, "%d")
report.value("cl_scatter", std(vector(gains.CLSRIVC)), "%.2f")
report.value("own_scatter", std(vector(gains["own instruments"])), "%.2f")
report.value("wrong_scatter", std(vector(gains.SRIVC)), "%.2f")
for i, name in ipairs{"ls", "srivc", "own", "clivsvf", "clsrivc", "two_stage"} do
    local v = vector(gains[names[i]])
    report.value("bias_" .. name, (mean(v) - true_gain)/(std(v)/math.sqrt(repetitions)), "%.1f")
end
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=repeated #tbl:repeated}
-- All routes on forty repetitions of `tracking`: mean and standard deviation of $a_1$ and of the gain, and how far the mean is from the truth, in standard errors of a mean
-- :::
--
-- The direct routes are off by many standard errors of their means (@tbl:repeated), LSSVF most; more records would only make that surer. The cures are not: their means agree with the truth. That is paid for by scatter, `own_scatter`{.value} for the own instruments against `wrong_scatter`{.value} for the wrong SRIVC: an instrument uses only that part of the record which the
-- reference moved. Among the cures none is the best by much. CLSRIVC, which knows most, scatters by `cl_scatter`{.value}: its filter $1/F$ is the best one for white noise on the output, and this load is far from white; a plain filter happens to suit it as well. Without a model of the noise no filter is the best one.
-- END SOLUTION
--
-- # A process that drifts
--
-- Water flows through an electric heater on which scale grows; once the heater was descaled (@fig:heater). The input is the heating power $u$ (%), the output the rise $y$ of the water's temperature (K),
-- one sample a second. At any time the heater is of first order,
--
-- $$ \dot y = -a\,y + b\,u , \qquad T = 1/a , \qquad K = b/a , $$ {#eq:heater}
--
-- but gain $K$ and time constant $T$ change over the hour and a half of the record.
--
-- ::: {.drawing name=drifting_process}
-- The heater: scale takes from its power and makes it slower {#fig:heater}
-- :::

-- %% id=heater
local heater = load("drifting_process")
local slow = iddata(heater.y, heater.u, 1, {InputUnit = "%", OutputUnit = "K"})
report.figure("heater", idplot(slow),
              say("The record of the heater", "L'enregistrement du chauffe-eau"))

-- %% [markdown]
-- ![The record of the heater](figure:heater){#fig:heater_record}
--
-- The level of the output falls and jumps once (@fig:heater_record).
--
-- **Question 9.** Estimate one model of @eq:heater from the whole record, and one from each piece of 850 s (`data[{i, j}]`). What does the single model describe? When was the heater descaled?

-- %% id=pieces
-- BEGIN SOLUTION
local still = {InitialState = "estimate"}
local function gain_and_time(G) return dcgain(G), 1/G.den[2] end
local whole = srivc(slow, {1, 1, 0}, still)
local pieces = {}
for k = 1, 6 do
    pieces[k] = srivc(slow[{850*(k - 1) + 1, 850*k}], {1, 1, 0}, still)
    print(k, gain_and_time(pieces[k]))
end
-- END SOLUTION

-- %% id=pieces_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local piece_rows = {{"samples", "gain (K/%)", "time constant (s)"}}
local function add(text, G)
    local K, T = gain_and_time(G)
    table.insert(piece_rows, {text, string.format("%.3f", K), string.format("%.1f", T)})
end
add("all", whole)
for k, piece in ipairs(pieces) do add(string.format("%d to %d", 850*(k - 1) + 1, 850*k), piece) end
report.table("pieces", piece_rows)
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=pieces #tbl:pieces}
-- One model for the whole record, and one for each sixth of it
-- :::
--
-- The single model is an average in time (@tbl:pieces) and wrong at nearly every instant. The pieces show the gain falling and the time constant rising, and both returning between the fourth and the fifth: there the heater was descaled. Within
-- a piece everything still moves, and the fourth mixes before and after.
-- END SOLUTION
--
-- ## An estimate at every sample
--
-- Recursive least squares corrects the estimate with each sample. With the regressors $\varphi_k = (-y_f, u_f)^T$ and the left-hand side $d_k = p\,y_f$ at sample $k$,
--
-- $$ L_k = \frac{P_{k-1} z_k}{f + \varphi_k^T P_{k-1} z_k} , \quad \hat\theta_k = \hat\theta_{k-1} + L_k\,(d_k - \varphi_k^T\hat\theta_{k-1}) , \quad
-- P_k = \frac{1}{f}\,(P_{k-1} - L_k \varphi_k^T P_{k-1}) , $$ {#eq:recursion}
--
-- where $z_k = \varphi_k$ for least squares, and an instrument otherwise. The *forgetting factor* $f$, a little below one, weighs a sample that is $n$ samples old by $f^n$; what
-- counts are the last $1/(1 - f)$ samples.
--
-- **Question 10.** Write the recursion for @eq:heater ($\lambda = 0.05$ rad/s, $f = 0.99$). Then take as instrument the output of the single model of question 9 in place of $y$. Draw gain and time constant over
-- time beside the truth, `rig_truth("drifting_process")`. What is the difference between the two?

-- %% id=recursion
-- BEGIN SOLUTION
local pole, forgetting = 0.05, 0.99
local function recursion(instrument, f)
    local Y = svf(heater.y, 1, pole, {Ts = 1, hold = "foh"})
    local U = svf(heater.u, 1, pole, {Ts = 1, hold = "zoh"})
    local X = svf(instrument, 1, pole, {Ts = 1, hold = "foh"})
    local d, y_f = Y:col(1):table(), Y:col(2):table()
    local u_f, x_f = U:col(2):table(), X:col(2):table()
    local a, b = 0.05, 0.02
    local p11, p12, p21, p22 = 1, 0, 0, 1
    local gain, time = {}, {}
    for k = 1, #d do
        local phi1, phi2, z1, z2 = -y_f[k], u_f[k], -x_f[k], u_f[k]
        local v1, v2 = p11*z1 + p12*z2, p21*z1 + p22*z2          -- P z
        local w1, w2 = phi1*p11 + phi2*p21, phi1*p12 + phi2*p22  -- phi' P
        local divisor = f + phi1*v1 + phi2*v2
        local miss = (d[k] - phi1*a - phi2*b)/divisor
        a, b = a + v1*miss, b + v2*miss
        p11, p12 = (p11 - v1*w1/divisor)/f, (p12 - v1*w2/divisor)/f
        p21, p22 = (p21 - v2*w1/divisor)/f, (p22 - v2*w2/divisor)/f
        gain[k], time[k] = b/a, 1/a
    end
    return vector(gain), vector(time)
end
local ls_gain, ls_time = recursion(heater.y, forgetting)
local iv_gain, iv_time = recursion(lsim(whole, heater.u, 1), forgetting)
-- STARTER: local function recursion(instrument, f)
-- STARTER:     return zeros(#heater.t), zeros(#heater.t)
-- STARTER: end
-- END SOLUTION

-- %% id=recursion_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local scale = rig_truth("drifting_process")
local shown = range(201, 10, #heater.t)  -- behind the start
local function pick(v)
    local list = {}
    for k, i in ipairs(shown:table()) do list[k] = v[math.floor(i)] end
    return vector(list)
end
local hours = pick(heater.t)/60
local function tracked(label, true_value, by_ls, by_iv, more)
    local panel = {ylabel = label, curves = {
        {x = hours, y = pick(by_ls), label = "least squares", colour = 8, dash = 1, line_width = 0.8},
        {x = hours, y = pick(by_iv), label = "instruments", colour = 0, line_width = 1.1},
        {x = hours, y = pick(true_value), label = "truth", colour = 2, dash = 2, line_width = 1.6}}}
    for key, value in pairs(more) do panel[key] = value end
    return panel
end
report.figure("tracking", figure{rows = 2, height = 8.5, panels = {
    tracked("gain (K/%)", scale.gain, ls_gain, iv_gain, {legend = "above", y_range = {0.15, 0.5}}),
    tracked("time constant (s)", scale.time_constant, ls_time, iv_time, {legend = "none", y_range = {0, 80}, xlabel = "time (min)"})}},
    "Gain and time constant of the heater over time")
local function behind_start(v) return v:range(501, #v) end
local function spread_of(found, true_value) return std(behind_start(found - true_value)) end
local function bias_of(found, true_value) return mean(behind_start(found - true_value)) end
report.value("ls_time_bias", bias_of(ls_time, scale.time_constant), "%.1f")
report.value("iv_time_bias", math.abs(bias_of(iv_time, scale.time_constant)), "%.1f")
report.value("iv_time_spread", spread_of(iv_time, scale.time_constant), "%.1f")
report.value("iv_gain_spread", spread_of(iv_gain, scale.gain), "%.3f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ![Gain and time constant of the heater, tracked with $f = 0.99$ by least squares and with instruments; dotted: the truth](figure:tracking){#fig:tracking}
--
-- Both follow the gain (@fig:tracking). Least squares finds a time constant that is `ls_time_bias`{.value} s too large on average: within the hundred samples that count, the drift itself acts as a slow disturbance, and $y_f$ is
-- correlated with it, as it is with the noise. The instrument contains the input only; with it the mean error is `iv_time_bias`{.value} s, with a scatter of `iv_time_spread`{.value} s. The single model from
-- which the instrument was made is wrong at nearly every instant; it need not be right.
-- END SOLUTION
--
-- **Question 11.** Which forgetting factor is best? Try $f =$ 0.98, 0.99, 0.995, 0.998, 0.999 and 1. Then use the library's `rlssvf`, `rivsvf` and `rsrivc` [@young2011]: they keep the whole history in `G.history`, with standard errors. After how long has
-- each forgotten the scale that was taken off?

-- %% id=forgetting
-- BEGIN SOLUTION
local factors = {0.98, 0.99, 0.995, 0.998, 0.999, 1}
local by_factor = {}
for k, f in ipairs(factors) do
    local gain, time = recursion(lsim(whole, heater.u, 1), f)
    by_factor[k] = {gain = gain, time = time}
end
-- END SOLUTION

-- %% id=library
-- BEGIN SOLUTION
local settings = {forgetting = 0.99, HistoryPoints = #heater.t}
local walk = {drift = {1e-6, 1e-6}, HistoryPoints = #heater.t}
local followers = {{"RLSSVF", rlssvf(slow, {1, 1, 0}, pole, settings)},
                   {"RIVSVF", rivsvf(slow, {1, 1, 0}, pole, settings)},
                   {"RIVSVF, walk", rivsvf(slow, {1, 1, 0}, pole, walk)},
                   {"RSRIVC, walk", rsrivc(slow, {1, 1, 0}, pole, walk)}}
print("a, b at the end:", followers[2][2].param)
-- END SOLUTION

-- %% id=forgetting_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local function signed(format, x) return (string.format(format, x):gsub("^%-", "−")) end
-- How long after the cleaning the gain comes within 5 % of the truth, s.
local function back_after(gain)
    local first = math.floor(scale.cleaning_time) + 2
    for k = first, #gain do
        if math.abs(gain[k]/scale.gain[k] - 1) < 0.05 then return k - first end
    end
    return #gain - first
end
local forgetting_rows = {{"method", "$f$", "memory", "gain (K/%)", "$T$ (s)", "mean $T$ (s)", "back (s)"}}
local function follow(method, f, gain, time)
    table.insert(forgetting_rows, {method, f and string.format("%g", f) or "", f and (f < 1 and string.format("%.0f", 1/(1 - f)) or "all") or "",
        string.format("%.3f", spread_of(gain, scale.gain)), string.format("%.1f", spread_of(time, scale.time_constant)),
        signed("%.1f", bias_of(time, scale.time_constant)), string.format("%d", back_after(gain))})
end
for k, f in ipairs(factors) do follow("own, instruments", f, by_factor[k].gain, by_factor[k].time) end
for k, follower in ipairs(followers) do
    local theta = follower[2].history.theta
    follow(follower[1], k < 3 and 0.99, theta:col(2)/theta:col(1), 1/theta:col(1))
end
report.table("forgetting", forgetting_rows)
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=forgetting #tbl:forgetting}
-- Forgetting factors and methods: samples that count; standard deviation of the errors of gain and time constant after the first 500 samples; mean error of the time constant; time after the cleaning until the gain is within 5 % of the truth
-- :::
--
-- There is no best one (@tbl:forgetting). A short memory follows quickly and scatters, a long one is smooth and late: with $f = 1$ the scale is remembered to the end. The gain, which every sample tells, wants a shorter memory than the time constant, which
-- only the switchings tell. A forgetting factor has to serve both; a random walk of the parameters (`drift`, here $10^{-6}$ for the variance of a step of each) says how far they may move from one sample to the next. RLSSVF has the bias of least squares, RIVSVF less. The walk
-- follows the cleaning within half a minute, and pays by a time constant that is too small on the average. RSRIVC lets its filter follow the estimate: with a memory of a hundred samples a bad moment of the estimate makes a bad filter, and it may lose its way; it wants a longer memory or the walk.
-- END SOLUTION
--
-- # What was learnt
--
-- BEGIN SOLUTION
-- * In the loop the input contains the disturbance. Methods that are right in the open loop are biased there, by many standard errors, and neither these errors nor a validation record of the same loop tells.
-- * Without a reference that moves, a record of the loop holds the inverse of the controller and nothing of the process.
-- * The reference is what cures: as an instrument, through a model of the whole loop (CLSRIVC), or in two stages. All are right on the average and scatter more than the wrong model does; which filter is the best depends on the noise.
-- * Recursive estimates follow what changes. Their memory is a compromise between scatter and delay that no data decide for the user; bias is cured by instruments here as well.
-- END SOLUTION
--
-- # What you hand in
--
-- ::: {.note}
-- Where this lesson is graded, `answer(name, value)` hands your results in, and `dynlab check` tells what is missing: `G_direct`, the biased model that SRIVC finds in `tracking` as if there were no loop; `own_instruments`, what your own instruments find
-- there ($a_1$, $a_2$, $b_0$; $\lambda = 10$ rad/s); `G_two_stage`, the model of the third cure; `G_final`, the model of the drive that you would recommend; `before_cleaning` and `after_cleaning`, gain (K/%) and time constant (s) of the heater at
-- 2600 s and at 4500 s. Your script will be run on the records of another drive and of another heater. The figures that are looked for are `correlation` and `tracking`.
-- :::

-- %% id=hand_in
-- BEGIN SOLUTION
answer("G_direct", routes.tracking.srivc)
answer("own_instruments", own)
answer("G_two_stage", Gtwo)
answer("G_final", Glib)
answer("before_cleaning", vector{iv_gain[2601], iv_time[2601]})
answer("after_cleaning", vector{iv_gain[4501], iv_time[4501]})
-- END SOLUTION

-- %% [markdown]
-- # Appendix: literature
--
-- ::: references
-- :::
