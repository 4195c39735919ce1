-- ---
-- title: First- and second-order models from step responses
-- subtitle: Lesson 1 – a heat exchanger and a suspension
-- lesson: 01_process_models
-- template: lesson
-- language: en
-- seed: 1
-- answers:
--   settling_time: number
--   exchanger_reading: vector
--   G_exchanger: model
--   overshoot: number
--   suspension_reading: vector
--   G_suspension: model
-- ---

-- %% [markdown]
-- A step is the simplest experiment you can run on a process: move the input from one level to another, wait, and measure. The shape of the response
-- suggests a model. A ruler and a pencil are sufficient to read its parameters. This lesson models two processes, a heat exchanger and a mechanical
-- suspension. You first read the parameters from the figure by hand. Then you estimate them from all samples by optimization, and compare the
-- accuracy of both methods. At the end, the lesson adds a dead time, repeats the experiment two hundred times, and moves to another operating point.
--
-- Both data sets are simulated, with the noise and the rounding of real sensors. You can therefore repeat the experiment, and look up the true
-- parameters at the end.
--
-- # A heat exchanger
--
-- ## The data
--
-- In the simulated heat exchanger, water flows through a heated vessel. The input $u$ is the opening of the heating valve, and the output $y$ is the
-- temperature of the water at the outlet (@fig:heat_exchanger). The process is at rest at an operating point. The valve opens a little further 60 s
-- after the measurement begins (@fig:exchanger_record).
--
-- ::: {.drawing name=heat_exchanger}
-- The heat exchanger: the valve is opened by $u$, and the temperature $y$ is measured where the water leaves the vessel {#fig:heat_exchanger}
-- :::

-- %% id=exchanger_data
local exchanger = load("heat_exchanger")
local Ts = exchanger.t[2] - exchanger.t[1]
local data = iddata(exchanger.y, exchanger.u, Ts,
                    {InputName = "valve opening", InputUnit = "%",
                     OutputName = "outlet temperature", OutputUnit = "°C"})
print(data)
report.figure("exchanger_record", idplot(data), "The data of the heat exchanger")

-- %% id=exchanger_paper echo=false
local low, high = math.floor(min(exchanger.y)), math.ceil(max(exchanger.y))
local paper = plot(exchanger.t, exchanger.y,
                   {style = "points", marker = 0, color = 2, line_width = 0.7, height = 13,
                    x_range = {0, 600}, y_range = {low, high},
                    xlabel = "time (s)", ylabel = "outlet temperature (°C)"})
report.figure("exchanger_paper", paper:rule(10, 0.2), "The response on graph paper")

-- %% [markdown]
-- ![The data of the heat exchanger: outlet temperature (above) and opening of the valve (below). Neither begins at zero.](figure:exchanger_record){#fig:exchanger_record}
--
-- ## Which model?
--
-- **Question 1.** Propose a form of transfer function $G(s)$ for the heat exchanger and explain your choice.
--
-- BEGIN SOLUTION
-- The temperature changes immediately after the step, and its slope is steepest at the start. Then the temperature approaches a new level without
-- overshoot and without an inflection point (@fig:exchanger_record). A first-order system responds to a step in this way, and no dead time is
-- visible:
--
-- $$ G(s) = \frac{K}{1 + T s} . $$ {#eq:solution-first}
--
-- Two features of the data are *not* in @eq:solution-first: the response starts from a temperature other than zero, and the valve was open before the
-- step. A transfer function describes changes around the operating point, so you must subtract or estimate both levels.
-- END SOLUTION
--
-- ## The graphical method
--
-- **Question 2.** Determine the parameters with ruler and pencil on @fig:exchanger_paper. The gain is the ratio of the two changes,
--
-- $$ K = \frac{y(\infty) - y(0)}{u(\infty) - u(0)} , $$ {#eq:gain}
--
-- and the 5 % settling time $T_r$ determines $T = T_r/3$, because $e^{-3} \approx 0.05$. $T_r$ is the time *from the step* until the response stays
-- within 5 % of its total change around the final value. Because of the noise, single samples leave the 5 % band long after the response has settled.
-- Therefore, first draw a smooth curve through the samples. `step_first_order` smooths the response with a moving average.
--
-- ![The response of the heat exchanger, sample by sample, on graph paper: small squares are 10 s wide and 0.2 °C high, and large squares are 50 s wide and 1 °C high. The valve moves at 60 s.](figure:exchanger_paper){#fig:exchanger_paper}

-- %% id=exchanger_reading
-- BEGIN SOLUTION
local reading = step_first_order(data)
print(string.format("K = %.3f °C/%%, T_r = %.0f s, T = %.0f s",
                    reading.K, 3*reading.T, reading.T))
local drawn = step_construction(reading, {xlabel = "time (s)",
                                          ylabel = "outlet temperature (°C)"})
report.figure("exchanger_construction", drawn, "Reading K and T_r off the response")
-- END SOLUTION

-- %% id=exchanger_reading_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- This cell runs, but its code is not printed (echo=false). Pass the values, figures and tables of your text to the report here; in a text cell
-- STARTER: --   report.value("gain", K, "%.2f")          is shown by  `gain`{.value}
-- STARTER: --   report.figure("name", fig, "caption")    by  ![caption](figure:name){#fig:name}  on a line of its own, and @fig:name refers to it
-- STARTER: --   report.table("name", {{"head"}, {"cell"}})  by  ::: {.table name=name #tbl:name}  then a line with the caption, then  :::
report.value("K_read", reading.K, "%.3f")
report.value("T_read", reading.T, "%.0f")
report.value("Tr_read", 3*reading.T, "%.0f")
report.value("instant_read", 60 + 3*reading.T, "%.0f")
-- time of the last sample outside the band, without smoothing
local final = mean(data.y:range(251, 301))
local first = mean(data.y:range(1, 30))
local last_outside
for k = 1, #data.y do
    if math.abs(data.y[k] - final) > 0.05*(final - first) then last_outside = exchanger.t[k] - 60 end
end
report.value("Tr_raw", last_outside, "%.0f")
report.value("T_raw", last_outside/3, "%.0f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ![Reading the gain and the 5 % settling time. The figure shows the measured and the smoothed response, and the levels before the step and at the end, which are $K\,\Delta u$ apart. It also shows the band of ±5 % of the change, and the time $T_r$ from the step until the smoothed response stays in this band.](figure:exchanger_construction){#fig:exchanger_construction}
--
-- @fig:exchanger_construction shows the construction. The levels before the step and at the end are averages, because single samples are noisy. The
-- result is $K =$ `K_read`{.value}\ °C/% and, from $T_r =$ `Tr_read`{.value}\ s (at `instant_read`{.value}\ s of the measurement), $T =$
-- `T_read`{.value}\ s. Without smoothing, the last sample outside the band is `Tr_raw`{.value}\ s after the step, which would give $T =$
-- `T_raw`{.value}\ s.
-- END SOLUTION
--
-- **Question 3.** Compute the response of your model to the recorded input and compare it with the measured response (`test_your_model`).

-- %% id=exchanger_test
-- BEGIN SOLUTION
-- response of a model at rest with the input u0, at the level of the data
local function simulated(G, data, u0)
    local y = lsim(G, data.u - u0, data.Ts)
    return y + mean(data.y - y)
end
-- plots every fifth sample as a dot and the model as a line, and the error below
local function test_figure(G, data, u0, label)
    local t, y = data.t, simulated(G, data, u0)
    local some, span = linspace(t[1], t[#t], #t//5 + 1), {t[1], t[#t]}
    local above = plot(some, interp1(t, data.y, some), "measured", t, y, "model",
                       {style = {"points", "line"}, marker = 0,
                        color = {2, 0}, x_range = span, ylabel = label})
    local below = plot(t, data.y - y, {x_range = span,
                                       xlabel = "time (s)", ylabel = "error"})
    return subplot(2, 1, {above, below}):set{height = 8.5}
end
local held_against = test_figure(reading, data, exchanger.u[1], "temperature (°C)")
report.figure("exchanger_test", held_against, "The reading and the measurement")
-- END SOLUTION

-- %% id=exchanger_test_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
report.value("fit_read", fit(data, reading), "%.1f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ![Above: the measured temperature (dots, every fifth sample) and the simulated response of the model read off the figure (line). Below: the error, measured minus simulated, in °C.](figure:exchanger_test){#fig:exchanger_test}
--
-- The simulated response follows the measurement (@fig:exchanger_test) with a fit of `fit_read`{.value} %. The fit is
-- $100\,(1 - \lVert y - \hat y\rVert / \lVert y - \bar y\rVert)$, where $\hat y$ is the simulated output and $\bar y$ is the mean of the measured
-- output. A fit of 100 % means perfect agreement, and the constant output $\bar y$ has a fit of 0 %. The error looks like noise.
-- END SOLUTION
--
-- ## Estimation by optimization
--
-- **Question 4.** Estimate the parameters of your model from all samples with `procsrivc`, which minimizes the sum of squared differences between the
-- measured and the simulated output. Compare the estimates with your readings. The process is at rest before the step, so set
-- `InitialState = "steady"`.

-- %% id=exchanger_estimate
-- BEGIN SOLUTION
local G1 = procsrivc(data, "P1", {InitialState = "steady", Offset = "estimate"})
present(G1)
local free = {InitialState = "estimate", Offset = "estimate"}
local G1_free = procsrivc(data, "P1", free)
-- END SOLUTION

-- %% id=exchanger_estimate_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
report.table("exchanger", {
    {"method", "$K$ (°C/%)", "$T$ (s)", "fit (%)"},
    {"read off the figure", string.format("%.3f", reading.K), string.format("%.0f", reading.T),
     string.format("%.1f", fit(data, reading))},
    {"estimated", string.format("%.4f ± %.4f", G1.Kp, G1.std[1]), string.format("%.1f ± %.1f", G1.Tp1, G1.std[2]),
     string.format("%.1f", fit(data, G1))},
})
report.value("T_apart", math.abs(reading.T - G1.Tp1), "%.1f")
report.value("T_apart_errors", math.abs(reading.T - G1.Tp1)/G1.std[2], "%.0f")
report.value("K_any_std", G1_free.std[1], "%.4f")
report.value("K_std", G1.std[1], "%.4f")
report.value("K_any_ratio", G1_free.std[1]/G1.std[1], "%.1f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=exchanger #tbl:exchanger}
-- The heat exchanger: parameters by both methods (± one standard error, available only for the estimate).
-- :::
--
-- The time constants of @tbl:exchanger differ by `T_apart`{.value} s, which is `T_apart_errors`{.value} standard errors of the estimate. The
-- difference is due to the reading, which uses only two levels and one instant. One experiment does not show the error of a reading. Section "How
-- accurate is a reading?" determines this error from repeated experiments. The estimate uses all samples, and its standard errors show which digits
-- are significant.
--
-- Do not estimate known quantities. With `InitialState = "estimate"`, the method would also estimate the initial temperature. The standard error of
-- $K$ would then be `K_any_std`{.value} instead of `K_std`{.value}, which is `K_any_ratio`{.value} times as large. The reason is that a slow return
-- from a wrong initial temperature looks like a different gain.
-- END SOLUTION

-- %% [markdown]
-- ## The same steps in the workbench
--
-- `dynlab app heat_exchanger` opens the data in a workbench in the browser (@fig:workbench). Under **Read by hand**, press **First order**. The
-- response of a model appears over the measured response. Drag the two marked points; the formulas below the figure show the current values. Then
-- select `procsrivc` as **Method** and press **New model**. Select one pole, `P1`, remove the delay `D`, and under **Options** select `steady` for
-- `InitialState`. Each click adds or changes a line of the script `heat_exchanger_session.lua`, which is displayed next to the figures. You can run
-- the script with `dynlab run` or `dynlab report`.
--
-- ![The workbench after these clicks: the controls, the figures, and the resulting script](workbench.png){#fig:workbench}

-- %% [markdown]
-- # A mechanical suspension
--
-- ## The data
--
-- The second process is also simulated: a mass on a spring with a damper, pushed by an electric actuator. The input is a unit step of the actuator's
-- voltage at time zero, and the output is the position of the mass (@fig:suspension, @fig:suspension_record).
--
-- ::: {.drawing name=suspension}
-- The suspension: the voltage $u$ drives the actuator, and a sensor measures the position $y$ of the mass {#fig:suspension}
-- :::

-- %% id=suspension_data
local suspension = load("suspension")
local Ts2 = suspension.t[2] - suspension.t[1]
local data2 = iddata(suspension.y, suspension.u, Ts2,
                     {InputName = "voltage", InputUnit = "V",
                      OutputName = "position", OutputUnit = "mm"})
-- the data begin at the step; also plot the levels before the step
local before = vector{-0.2, 0}
local position = plot(data2.t, data2.y, before, zeros(2),
                      {color = 0, ylabel = "position (mm)"})
local voltage = plot(data2.t, data2.u, before, zeros(2), {0, 0}, {0, 1},
                     {color = 0, y_range = {-0.1, 1.2},
                      xlabel = "time (s)", ylabel = "voltage (V)"})
report.figure("suspension_record", subplot(2, 1, {position, voltage}),
              "The data of the suspension")

-- %% id=suspension_paper echo=false
local top = math.ceil(max(data2.y) + 0.2)
local paper2 = plot(data2.t, data2.y,
                    {style = "points", marker = 0, color = 2, line_width = 0.7, height = 13,
                     x_range = {0, 1.6}, y_range = {0, top},
                     xlabel = "time (s)", ylabel = "position (mm)"})
report.figure("suspension_paper", paper2:rule(0.02, 0.2), "The suspension on graph paper")

-- a second-order system with a damping ratio of 0.2, in normalized units
local wave = range(0, 0.05, 20)
local height = lsim(tf({1}, {1, 0.4, 1}), ones(#wave), 0.05)
local peak, at = max(height)
report.figure("second_order", figure{
    height = 6, xlabel = "ω_{0} t", ylabel = "(y − y(0)) / (u(∞) − u(0))",
    x_range = {-1, 20}, y_range = {0, 1.7}, legend = "none",
    curves = {{x = wave, y = height, color = 0}},
    references = {{y = 1.05, dash = 2}, {y = 0.95, dash = 2}, {y = 1, dash = 1}, {x = 0, dash = 1}},
    annotations = {{x = 17, y = 1.05, text = "5 % band", marker = false}},
    arrows = {{x0 = wave[at], y0 = 1, x1 = wave[at], y1 = peak, text = "K D_{1}", both_heads = true},
              {x0 = 0, y0 = 0.3, x1 = wave[at], y1 = 0.3, text = "T_{1}", both_heads = true},
              {x0 = 12, y0 = 0, x1 = 12, y1 = 1, text = "K", both_heads = true}}},
    "A second-order step response")

-- %% [markdown]
-- ![The data of the suspension: position of the mass (above) and voltage of the actuator, a unit step at time zero (below)](figure:suspension_record){#fig:suspension_record}
--
-- **Question 5.** Propose a form of transfer function and explain your choice.
--
-- BEGIN SOLUTION
-- The response starts with zero slope, overshoots its final value and oscillates around it with decreasing amplitude. A second-order system with a
-- pair of complex conjugate poles responds in this way:
--
-- $$ G(s) = \frac{K\,\omega_0^2}{s^2 + 2 z \omega_0 s + \omega_0^2}, \qquad 0 < z < 1 . $$ {#eq:solution-second}
-- END SOLUTION
--
-- **Question 6.** Determine the parameters from the figure. The gain follows from @eq:gain. The relative height of the first overshoot, which the
-- response reaches at the time $T_1$ after the step,
--
-- $$ D_1 = \frac{y(T_1) - y(\infty)}{y(\infty) - y(0)}, \qquad z = \sqrt{\frac{(\ln D_1)^2}{(\ln D_1)^2 + \pi^2}}, \qquad
--    \omega_0 = \frac{\pi}{T_1\sqrt{1 - z^2}} , $$ {#eq:overshoot}
--
-- determines the damping ratio and the undamped natural frequency. @fig:second_order shows where to read each number. Read them from
-- @fig:suspension_paper.
--
-- ![Numbers to read from the step response of a second-order system, here with $z = 0.2$. The two levels give the gain $K$, and the height of the first maximum gives the first overshoot $D_1$. $T_1$ is the time of this maximum. The dotted lines are the band of ± 5 % in which the response has settled.](figure:second_order){#fig:second_order}
--
-- ![The beginning of the response of the suspension, sample by sample, on graph paper: small squares are 0.02 s wide and 0.2 mm high, and large squares are 0.1 s wide and 1 mm high. The voltage steps at time zero.](figure:suspension_paper){#fig:suspension_paper}

-- %% id=suspension_reading
-- BEGIN SOLUTION
local reading2 = step_second_order(data2)
print(string.format("K = %.2f mm/V, z = %.3f, w0 = %.2f rad/s",
                    reading2.K, reading2.z, reading2.w0))
local drawn2 = step_construction(reading2, {xlabel = "time (s)",
                                            ylabel = "position (mm)"})
report.figure("suspension_construction", drawn2, "Reading the first overshoot")
-- END SOLUTION

-- %% id=suspension_reading_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
report.value("K2", reading2.K, "%.2f")
report.value("T1", math.pi/(reading2.w0*math.sqrt(1 - reading2.z^2)), "%.3f")
report.value("D1", 100*math.exp(-math.pi*reading2.z/math.sqrt(1 - reading2.z^2)), "%.1f")
report.value("z2", reading2.z, "%.3f")
report.value("w2", reading2.w0, "%.2f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ![Reading the first overshoot: the measured and the smoothed response, the two levels, and the height $D_1$ and the time $T_1$ of the first maximum](figure:suspension_construction){#fig:suspension_construction}
--
-- @fig:suspension_construction shows a gain of $K =$ `K2`{.value}\ mm/V, and a first overshoot of `D1`{.value}\ % at $T_1 =$ `T1`{.value}\ s. These
-- values correspond to $z =$ `z2`{.value} and $\omega_0 =$ `w2`{.value}\ rad/s.
-- END SOLUTION
--
-- **Question 7.** Compare the response of your model with the measured response.

-- %% id=suspension_test
-- BEGIN SOLUTION
report.figure("suspension_test", test_figure(reading2, data2, 0, "position (mm)"),
              "The second-order model and the measurement")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ![Above: the measured position (dots, every fifth sample) and the simulated response of the second-order model read off the figure (line). Below: the error in mm.](figure:suspension_test){#fig:suspension_test}
--
-- The simulated response follows every oscillation (@fig:suspension_test). The error is little more than the noise of the sensor.
-- END SOLUTION
--
-- **Question 8.** Estimate the parameters from all samples and compare them with your readings. (In the workbench, `dynlab app suspension`, use
-- **Second order** to read by hand, and `P2` with `U` to estimate an underdamped pair of poles.)

-- %% id=suspension_estimate
-- BEGIN SOLUTION
local G2 = procsrivc(data2, "P2U")
present(G2)
-- END SOLUTION

-- %% id=suspension_estimate_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local function with_error(format, x, error)
    return string.format(format .. " ± " .. format, x, error)
end
report.table("suspension", {
    {"method", "$K$ (mm/V)", "$z$", "$\\omega_0$ (rad/s)", "fit (%)"},
    {"read off the figure", string.format("%.2f", reading2.K), string.format("%.3f", reading2.z),
     string.format("%.2f", reading2.w0), string.format("%.2f", fit(data2, reading2))},
    {"estimated", with_error("%.4f", G2.Kp, G2.std[1]), with_error("%.4f", G2.Zeta, G2.std[3]),
     with_error("%.3f", 1/G2.Tw, G2.std[2]/G2.Tw^2), string.format("%.2f", fit(data2, G2))},
})
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=suspension #tbl:suspension}
-- The suspension: parameters by both methods (± one standard error).
-- :::
--
-- The methods agree within the error of the reading (@tbl:suspension). The reading uses a single point, the maximum of the first overshoot. The
-- response is flat there, so the time of the maximum is difficult to determine. The estimate uses the complete response.
-- END SOLUTION
--
-- # A dead time
--
-- **Question 9.** Suppose that the thermometer of the heat exchanger is farther down the pipe, so that the water takes 20 s to reach it. Simulate
-- these data and read the parameters with `step_delayed`. This function uses the times $t_1$ and $t_2$ from the step until the response has covered
-- 28.3 % and 63.2 % of its change. For
--
-- $$ G(s) = \frac{K\,e^{-Ds}}{1 + Ts} , \qquad T = \tfrac{3}{2}\,(t_2 - t_1), \qquad D = t_2 - T . $$ {#eq:delayed}
--
-- Derive these formulas. What happens if the model has no dead time?

-- %% id=dead_time
-- BEGIN SOLUTION
local far = tf({G1.Kp}, {G1.Tp1, 1}, {IODelay = 20})
local change = exchanger.u - exchanger.u[1]
local y_far = exchanger.y[1] + lsim(far, change, Ts) + 0.1*randn(#change)
local data_far = iddata(y_far, exchanger.u, Ts)
local two_points, one_point = step_delayed(data_far), step_first_order(data_far)
local steady = {InitialState = "steady", Offset = "estimate"}
local G1D = procsrivc(data_far, "P1D", steady)
local G1F = procsrivc(data_far, "P1", steady)
local none = procsrivc(data, "P1D", steady)    -- dead time of the first data set
local t, u0 = data_far.t, exchanger.u[1]
local far_figure = plot(t, y_far, "measured",
                        t, simulated(G1D, data_far, u0), "with a dead time",
                        t, simulated(G1F, data_far, u0), "without",
                        {style = {"points", "line", "line"}, marker = 0,
                         color = {2, 0, 1}, dash = {0, 0, 1},
                         x_range = {40, 200}, height = 6,
                         xlabel = "time (s)", ylabel = "temperature (°C)"})
report.figure("dead_time", far_figure, "A heat exchanger with a dead time")
-- END SOLUTION

-- %% id=dead_time_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local function row(name, T, D, G) return {name, T, D, string.format("%.1f", fit(data_far, G))} end
report.table("dead_time", {
    {"method", "$T$ (s)", "$D$ (s)", "fit (%)"},
    {"truth", string.format("%.1f", G1.Tp1), "20.0", string.format("%.1f", fit(data_far, far))},
    row("two points", string.format("%.0f", two_points.T), string.format("%.0f", two_points.D), two_points),
    row("estimated", with_error("%.1f", G1D.Tp1, G1D.std[2]), with_error("%.1f", G1D.Td, G1D.std[3]), G1D),
    row("settling time, no dead time", string.format("%.0f", one_point.T), "none", one_point),
    row("estimated, no dead time", with_error("%.1f", G1F.Tp1, G1F.std[2]), "none", G1F),
})
report.value("Td_none", none.Td, "%.1f")
report.value("Td_none_std", none.std[3], "%.1f")
report.value("T_far", one_point.T, "%.0f")
report.value("T_extra", 20/3, "%.0f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- A first-order response has risen to $1 - e^{-1/3} = 28.3$ % after $T/3$ and to $1 - e^{-1} = 63.2$ % after $T$. The dead time delays both times, so
-- $t_1 = D + T/3$ and $t_2 = D + T$. @eq:delayed is the solution of these two equations.
--
-- ::: {.table name=dead_time #tbl:dead_time}
-- The data with a dead time of 20 s: models with and without a dead time.
-- :::
--
-- ![The beginning of the response with a dead time (dots), and the estimated models with (solid) and without (dashed) a dead time. Without a dead time, the model starts too early and rises too slowly.](figure:dead_time){#fig:dead_time}
--
-- A model without a dead time compensates with a larger time constant (@tbl:dead_time, @fig:dead_time). The settling time becomes $3T + D$, so the
-- reading of $T$ grows by $D/3$, here `T_extra`{.value} s. The estimate also increases. Its standard error does not indicate this bias, because it is
-- valid only if the model structure is correct. Could the first data set contain a hidden dead time? The estimated dead time is
-- `Td_none`{.value}\ ±\ `Td_none_std`{.value}\ s, which is not significantly different from zero.
-- END SOLUTION
--
-- # How accurate is a reading?
--
-- **Question 10.** `plant("heat_exchanger", {seed = k})` repeats the experiment with different noise, on the heat exchanger shared by the whole class.
-- If your group has its own data, the file `SOURCE.md` next to the data contains the number of your unit. Pass this number as the option `variant`.
-- Read and estimate the time constant of two hundred data sets. How large is the error of the reading? Are the standard errors of the estimate
-- correct? Now look up the true values with `true_model`.
--
-- First, enter a prediction: how many times larger is the standard deviation of the readings than the standard deviation of the estimates? `reveal`
-- prints your prediction next to the result.

-- %% id=noise_guess
-- BEGIN SOLUTION
-- STARTER: predict_first("scatter, reading over estimate", nil)
predict_first("scatter, reading over estimate", 3)
-- END SOLUTION

-- %% id=noise_study
-- BEGIN SOLUTION
local runs = 200
local T_reading, T_estimate, reported = zeros(runs), zeros(runs), zeros(runs)
for k = 1, runs do
    local again = plant("heat_exchanger", {seed = k})
    local d = iddata(again.y, again.u, Ts)
    local G = procsrivc(d, "P1", steady)
    T_reading[k], T_estimate[k] = step_first_order(d).T, G.Tp1
    reported[k] = G.std[2]
end
local true_T = true_model("heat_exchanger").time_constant
local function bars(values, name)
    local drawn = histogram(values, {truth = true_T, xlabel = name})
    return drawn:set{x_range = {70, 81}}
end
local study = subplot(2, 1, {bars(T_reading, "T, read off the figure (s)"),
                             bars(T_estimate, "T, estimated (s)")})
report.figure("noise_study", study:set{height = 9}, "Two hundred experiments")
reveal("scatter, reading over estimate", std(T_reading)/std(T_estimate))
-- END SOLUTION

-- %% id=noise_study_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
report.value("runs", runs, "%d")
report.value("true_T", true_T, "%.2f")
report.value("reading_mean", mean(T_reading), "%.1f")
report.value("reading_std", std(T_reading), "%.1f")
report.value("reading_off", true_T - mean(T_reading), "%.1f")
report.value("estimate_mean", mean(T_estimate), "%.2f")
report.value("estimate_std", std(T_estimate), "%.2f")
report.value("estimate_mean_std", std(T_estimate)/math.sqrt(runs), "%.2f")
report.value("reported", mean(reported), "%.2f")
report.value("sharper", std(T_reading)/std(T_estimate), "%.0f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ![The time constants of two hundred repeated experiments, read off the figure (above) and estimated (below). The dashed line is the true value. Both time axes have the same limits.](figure:noise_study){#fig:noise_study}
--
-- The true time constant is `true_T`{.value}\ s. The readings have a mean of `reading_mean`{.value}\ s and a standard deviation of
-- `reading_std`{.value}\ s (@fig:noise_study). The estimates have a mean of `estimate_mean`{.value}\ ±\ `estimate_mean_std`{.value}\ s and a standard
-- deviation of `estimate_std`{.value}\ s. This standard deviation agrees with the reported standard errors (`reported`{.value}\ s on average). The
-- standard deviation of the readings is `sharper`{.value} times the standard deviation of the estimates. The readings are also too short by
-- `reading_off`{.value}\ s on average, because noise and smoothing make the response enter the band early. The difference between reading and
-- estimate in @tbl:exchanger is within this error, so both methods agree.
-- END SOLUTION

-- %% [markdown]
-- # Another operating point
--
-- **Question 11.** If you neglect the losses to the room, the heat balance of the vessel is
--
-- $$ C\,\frac{\mathrm{d}y}{\mathrm{d}t} = \dot m\,c\,(y_\text{in} - y) + \frac{P}{100}\,u , $$ {#eq:balance}
--
-- where $C$ is the heat capacity of the vessel and $P$ is the power of the open valve. The water has the flow $\dot m$ (kg/s), the specific heat $c$
-- and the inlet temperature $y_\text{in}$. How do $K$, $T$ and $K/T$ change if the same step goes from 50 % to 70 %? How do they change if the flow
-- is halved? Simulate the second case until four time constants after the step, and read the response. Why is the reading now too small, while the
-- estimate is not?

-- %% id=half_flow
-- BEGIN SOLUTION
local K, T = 2*G1.Kp, 2*G1.Tp1    -- at half the flow
local opened = find(gt(change, 0))[1]    -- first sample after the step
local N = opened + math.ceil(4*T/Ts)
local longer = step_signal(N, opened, {0, change[#change]})
local entering = mean(exchanger.y:range(1, 30)) - G1.Kp*u0
local risen = lsim(tf({K}, {T, 1}), longer, Ts)
local y_half = entering + K*u0 + risen + 0.1*randn(N)
local data_half = iddata(y_half, u0 + longer, Ts)
local read_half = step_first_order(data_half)
local G1_half = procsrivc(data_half, "P1", steady)
-- END SOLUTION

-- %% id=half_flow_report echo=false
-- BEGIN SOLUTION
-- STARTER: -- Not printed: report.value, report.figure and report.table for the text below.
local function of_flow(name, K, T) return {name, string.format("%.2f", K), string.format("%.0f", T), string.format("%.4f", K/T)} end
report.table("half_flow", {
    {"flow", "$K$ (°C/%)", "$T$ (s)", "$K/T$ (°C/(% s))"},
    of_flow("original, estimated", G1.Kp, G1.Tp1),
    of_flow("half, from the heat balance", K, T),
    of_flow("half, read off the figure", read_half.K, read_half.T),
    of_flow("half, estimated", G1_half.Kp, G1_half.Tp1),
})
report.value("half_span", 4*T, "%.0f")
report.value("half_missing", 100*math.exp(-4), "%.0f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- Compared with @eq:solution-first, @eq:balance has $K = P/(100\,\dot m\,c)$ and $T = C/(\dot m\,c)$. The balance is linear in $u$. For a step from
-- 50 % to 70 %, the temperature is at a higher level. The size of the change and the time constant are the same. The balance is not linear in
-- $\dot m$, which multiplies $y$. At half the flow, $K$ and $T$ are twice as large. $K/T = P/(100\,C)$ does not change, because the slope just after
-- the step depends only on power and heat capacity. A model is valid only at the operating point of its data.
--
-- ::: {.table name=half_flow #tbl:half_flow}
-- The heat exchanger with the original flow and with half the flow.
-- :::
--
-- Four time constants are now `half_span`{.value} s. When the data end, the response still lacks `half_missing`{.value} % of its change. The reading
-- uses the last samples as the final level, so its gain and time constant are too small (@tbl:half_flow). The estimate does not need the final level,
-- because the curvature of the response determines it.
-- END SOLUTION

-- %% [markdown]
-- # Try it: parameters by hand
--
-- On a page (`dynlab preview`, or `dynlab report` with an output that ends in `.html`), you can change the two models below. Drag the marked points,
-- or move the sliders under the cells. Which parameter moves which part of the curve? How well can you fit the measurement by eye?

-- %% id=first_order_by_hand
do
    local K = slider("K", 0.4, 0.3, 0.66, {step = 0.02, unit = "°C/%"})
    local T = slider("T", 50, 30, 110, {step = 5, unit = "s"})
    local rest = mean(exchanger.y:range(1, 30))
    local change = exchanger.u[#exchanger.u] - exchanger.u[1]
    local function response(t)                -- the step comes at 60 s
        local since = (t - 60 + abs(t - 60))/2
        return rest + K*change*(1 - exp(-since/T))
    end
    local misfit = norm(exchanger.y - response(exchanger.t))
    local name = string.format("model: fit %.1f %%",
        100*(1 - misfit/norm(exchanger.y - mean(exchanger.y))))
    local t = linspace(0, 600, 101)
    local by_hand = plot(t, interp1(exchanger.t, exchanger.y, t), "measured",
                         t, response(t), name,
                         {style = {"points", "line"}, marker = 0,
                          color = {2, 0}, height = 7,
                          x_range = {0, 600},
                          y_range = {math.floor(rest),
                                     math.ceil(rest + 0.66*change)},
                          xlabel = "time (s)", ylabel = "outlet temperature (°C)"})
    by_hand:handle{x = 560, y = function(K) return rest + K*change end,
                   y_slider = "K", text = "final level"}
    by_hand:handle{x = function(T) return 60 + T end, x_slider = "T",
                   y = function(K) return rest + 0.632*K*change end,
                   y_slider = "K", text = "63 %"}
    report.figure("first_by_hand", by_hand, "A first-order model by hand")
end

-- %% [markdown]
-- ![The heat exchanger (dots) and a first-order model (line) with the $K$ and $T$ of the cell above: the final level moves with $K$, the point of 63 % of the change moves with $T$ and $K$.](figure:first_by_hand){#fig:first_by_hand}
--
-- In @fig:first_by_hand, the gain stretches the curve vertically, and the time constant stretches it horizontally. In @fig:second_by_hand, the height
-- of the first peak relative to the final level depends only on the damping ratio. The time of the first peak depends on the natural frequency and,
-- slightly, on the damping ratio.

-- %% id=second_order_by_hand
do
    local K = slider("K2", 9, 8, 13, {step = 1, unit = "mm/V", label = "K"})
    local z = slider("z", 0.3, 0.1, 0.4, {step = 0.05})
    local w0 = slider("omega_0", 11, 10, 16,
                      {step = 1, unit = "rad/s", label = "ω₀"})
    local function response(t)
        local root = math.sqrt(1 - z^2)
        local swing = cos(w0*root*t) + z/root*sin(w0*root*t)
        return K*(1 - exp(-z*w0*t)*swing)
    end
    local function overshoot(z) return math.exp(-math.pi*z/math.sqrt(1 - z^2)) end
    local misfit = norm(suspension.y - response(suspension.t))
    local name = string.format("model: fit %.1f %%",
        100*(1 - misfit/norm(suspension.y - mean(suspension.y))))
    local t = linspace(0, 2.5, 101)
    local by_hand = plot(t, interp1(suspension.t, suspension.y, t), "measured",
                         t, response(t), name,
                         {style = {"points", "line"}, marker = 0,
                          color = {2, 0}, height = 7,
                          x_range = {0, 2.5}, y_range = {0, 23},
                          xlabel = "time (s)", ylabel = "position (mm)"})
    by_hand:handle{x = 2.3, y = function(K) return K end,
                   y_slider = "K2", text = "final level"}
    local function peak(w0) return math.pi/(w0*math.sqrt(1 - z^2)) end
    by_hand:handle{x = peak, x_slider = "omega_0",
                   y = function(z) return K*(1 + overshoot(z)) end,
                   y_slider = "z", text = "first peak"}
    report.figure("second_by_hand", by_hand, "A second-order model by hand")
end

-- %% [markdown]
-- ![The suspension (dots) and a second-order model (line) with the $K$, $z$ and $\omega_0$ of the cell above: the final level moves with $K$, the first peak with $z$ (up and down) and $\omega_0$ (sideways).](figure:second_by_hand){#fig:second_by_hand}

-- %% [markdown]
-- # What you have learned
--
-- BEGIN SOLUTION
-- * The shape of the response determines the structure. A response with its steepest slope at the start and no overshoot indicates a first-order
--   system. A response with zero slope at the start and an overshoot indicates a second-order system with complex conjugate poles. If the output does
--   not change at first, the system has a dead time.
-- * Operating points are not part of a transfer function: subtract the levels before the step, or let the method estimate them. Specify known facts,
--   such as an initial state at rest, instead of estimating them.
-- * Reading a figure takes a minute and provides initial values for other methods. Optimization uses all samples, is more accurate, and returns
--   standard errors, which are valid if the model structure is correct.
-- * Trust a model only after comparing its simulated output with the measured output. Repeating the experiment shows how far you can trust a number.
-- END SOLUTION
--
-- # What you submit
--
-- ::: {.note}
-- If this lesson is graded, submit results with `answer(name, value)`. `dynlab check` lists missing answers. You can type in the values that you read
-- off the figures:
--
-- * `settling_time`: $T_r$ in seconds after the step;
-- * `exchanger_reading`: the vector $K$, $T$;
-- * `overshoot`: $D_1$ as a ratio;
-- * `suspension_reading`: the vector $K$, $z$, $\omega_0$.
--
-- Compute the two estimated models, `G_exchanger` and `G_suspension`, from the data, because grading runs your script on data of other exchangers and
-- suspensions as well. Pass the figures that compare your readings with the measurements to `report.figure`, under the names `exchanger_test` and
-- `suspension_test`.
-- :::

-- %% id=hand_in
-- BEGIN SOLUTION
answer("settling_time", 3*reading.T)
answer("exchanger_reading", vector{reading.K, reading.T})
answer("G_exchanger", G1)
answer("overshoot", math.exp(-math.pi*reading2.z/math.sqrt(1 - reading2.z^2)))
answer("suspension_reading", vector{reading2.K, reading2.z, reading2.w0})
answer("G_suspension", G2)
-- END SOLUTION

-- %% [markdown]
-- # Appendix: measures
--
-- ::: measures
-- fit
-- :::
