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
-- A step is the simplest experiment one can make with a process: move the input from one level to another, wait, and record. The shape of
-- the response suggests a model, and a ruler and a pencil are enough to read its parameters. This lesson does it for two processes,
-- a heat exchanger and a mechanical suspension, first by hand on the figure and then by optimisation on all the samples, and asks
-- what the second way buys.
--
-- # A heat exchanger
--
-- ## The record
--
-- Water flows through a heat exchanger; the input $u$ is the opening of the heating valve and the output $y$ the temperature of the
-- water at the outlet. The process rests at a working point when the valve is opened a little further.

-- %% id=exchanger_data
local exchanger = load("heat_exchanger")
local Ts = exchanger.t[2] - exchanger.t[1]
local data = iddata(exchanger.y, exchanger.u, Ts, {InputName = "valve opening", InputUnit = "%",
                    OutputName = "outlet temperature", OutputUnit = "°C"})
print(data)
idplot(data)

-- %% [markdown]
-- ## Which model?
--
-- **Question 1.** Propose a form of transfer function $G(s)$ for the heat exchanger and explain your choice.
--
-- BEGIN SOLUTION
-- The temperature leaves its resting value at once and with its steepest slope, then approaches a new level without overshoot and
-- without a turning point. That is how a first-order system answers a step, and no dead time can be seen:
--
-- $$ G(s) = \frac{K}{1 + T s} . $$ {#eq:first}
--
-- Two things of the record are *not* in @eq:first: the response starts from a temperature that is not zero, and the valve was not closed
-- before the step. A transfer function describes changes around the working point, so both levels have to be taken off or estimated.
-- END SOLUTION
--
-- ## The graphical method
--
-- **Question 2.** Determine the parameters from the figure. The gain is the ratio of the two changes,
--
-- $$ K = \frac{y(\infty) - y(0)}{u(\infty) - u(0)} , $$ {#eq:gain}
--
-- and the 5 % settling time $T_r$, the instant after which the response stays within 5 % of its total change around the final
-- value, gives $T = T_r/3$, because $e^{-3} \approx 0.05$.

-- %% id=exchanger_reading
-- BEGIN SOLUTION
local reading = step_first_order(data)
present(reading)
report.figure("exchanger_construction",
              step_construction(reading, {xlabel = "time (s)", ylabel = "outlet temperature (°C)"}),
              "Reading the gain and the 5 % settling time off the response")
-- END SOLUTION

-- %% id=exchanger_reading_report echo=false
-- BEGIN SOLUTION
report.value("K_read", reading.K, "%.3f")
report.value("T_read", reading.T, "%.2f")
report.value("Tr_read", 3*reading.T, "%.1f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ![Reading the gain and the 5 % settling time off the response](figure:exchanger_construction){#fig:exchanger_construction}
--
-- @fig:exchanger_construction shows the construction. The levels before the step and at the end are averages, because single samples are noisy. The
-- reading is $K =$ `K_read`{.value} °C/% and, from $T_r =$ `Tr_read`{.value} s, $T =$ `T_read`{.value} s.
-- END SOLUTION
--
-- **Question 3.** Compute the response of your model to the recorded input and compare it with the measured one (`test_your_model`).

-- %% id=exchanger_test
-- BEGIN SOLUTION
report.figure("exchanger_test", test_your_model(reading, data),
              "The model read off the figure against the measurement")
-- END SOLUTION

-- %% id=exchanger_test_report echo=false
-- BEGIN SOLUTION
report.value("fit_read", fit(data, reading), "%.1f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ![The model read off the figure against the measurement](figure:exchanger_test){#fig:exchanger_test}
--
-- The simulated response follows the measurement (@fig:exchanger_test) with a fit of `fit_read`{.value} %.
-- END SOLUTION
--
-- ## Estimation by optimisation
--
-- **Question 4.** Estimate the parameters of your model from all the samples, by minimising the sum of squared differences between the measured
-- and the simulated output (`procsrivc`), and compare with the reading.

-- %% id=exchanger_estimate
-- BEGIN SOLUTION
local G1 = procsrivc(data, "P1", {InitialState = "estimate", Offset = "estimate"})
present(G1)
-- END SOLUTION

-- %% id=exchanger_estimate_report echo=false
-- BEGIN SOLUTION
report.table("exchanger", {
    {"method", "K (°C/%)", "T (s)", "fit (%)"},
    {"read off the figure", string.format("%.4f", reading.K), string.format("%.2f", reading.T),
     string.format("%.2f", fit(data, reading))},
    {"estimated", string.format("%.4f ± %.4f", G1.Kp, G1.std[1]), string.format("%.2f ± %.2f", G1.Tp1, G1.std[2]),
     string.format("%.2f", fit(data, G1))},
})
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=exchanger #tbl:exchanger}
-- The heat exchanger: parameters by both methods, with one standard error.
-- :::
--
-- Both methods agree (@tbl:exchanger). The reading uses two levels and one instant of the record, the estimate all the samples, and only the
-- estimate comes with standard errors that say which digits may be believed.
-- END SOLUTION

-- %% [markdown]
-- # A mechanical suspension
--
-- ## The record
--
-- The second process is a mass on a spring with a damper, pushed by an electric actuator. The input is a unit step of the
-- actuator's voltage at time zero, the output the position of the mass.

-- %% id=suspension_data
local suspension = load("suspension")
local Ts2 = suspension.t[2] - suspension.t[1]
local data2 = iddata(suspension.y, suspension.u, Ts2, {InputName = "voltage", InputUnit = "V",
                     OutputName = "position", OutputUnit = "mm"})
idplot(data2)

-- %% [markdown]
-- **Question 5.** Propose a form of transfer function and explain your choice.
--
-- BEGIN SOLUTION
-- The response starts with a horizontal slope, overshoots its final value and swings around it with shrinking amplitude: a second-order system
-- with a pair of complex poles,
--
-- $$ G(s) = \frac{K\,\omega_0^2}{s^2 + 2 z \omega_0 s + \omega_0^2}, \qquad 0 < z < 1 . $$ {#eq:second}
-- END SOLUTION
--
-- **Question 6.** Determine the parameters from the figure. The gain follows from @eq:gain. The relative height of the first overshoot,
-- reached at the instant $T_{D}$ after the step,
--
-- $$ D_1 = \frac{y(T_{D}) - y(\infty)}{y(\infty) - y(0)}, \qquad z = \sqrt{\frac{(\ln D_1)^2}{(\ln D_1)^2 + \pi^2}}, \qquad
--    \omega_0 = \frac{\pi}{T_{D}\sqrt{1 - z^2}} , $$ {#eq:overshoot}
--
-- gives the damping ratio and the undamped natural frequency.

-- %% id=suspension_reading
-- BEGIN SOLUTION
local reading2 = step_second_order(data2)
present(reading2)
report.figure("suspension_construction",
              step_construction(reading2, {xlabel = "time (s)", ylabel = "position (mm)"}),
              "Reading the first overshoot off the response")
-- END SOLUTION

-- %% id=suspension_reading_report echo=false
-- BEGIN SOLUTION
report.value("K2", reading2.K, "%.2f")
report.value("D1", 100*math.exp(-math.pi*reading2.z/math.sqrt(1 - reading2.z^2)), "%.1f")
report.value("z2", reading2.z, "%.3f")
report.value("w2", reading2.w0, "%.2f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ![Reading the first overshoot off the response](figure:suspension_construction){#fig:suspension_construction}
--
-- From @fig:suspension_construction: $K =$ `K2`{.value} mm/V, a first overshoot of `D1`{.value} %, hence $z =$ `z2`{.value} and
-- $\omega_0 =$ `w2`{.value} rad/s.
-- END SOLUTION
--
-- **Question 7.** Compare the response of your model with the measured one.

-- %% id=suspension_test
-- BEGIN SOLUTION
report.figure("suspension_test", test_your_model(reading2, data2),
              "The second-order model against the measurement")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ![The second-order model against the measurement](figure:suspension_test){#fig:suspension_test}
--
-- The simulated response follows every swing (@fig:suspension_test).
-- END SOLUTION
--
-- **Question 8.** Estimate the parameters from all the samples and compare.

-- %% id=suspension_estimate
-- BEGIN SOLUTION
local G2 = procsrivc(data2, "P2U")
present(G2)
-- END SOLUTION

-- %% id=suspension_estimate_report echo=false
-- BEGIN SOLUTION
report.table("suspension", {
    {"method", "K (mm/V)", "z", "ω₀ (rad/s)", "fit (%)"},
    {"read off the figure", string.format("%.4f", reading2.K), string.format("%.4f", reading2.z),
     string.format("%.3f", reading2.w0), string.format("%.2f", fit(data2, reading2))},
    {"estimated", string.format("%.4f", G2.Kp), string.format("%.4f", G2.Zeta), string.format("%.3f", 1/G2.Tw),
     string.format("%.2f", fit(data2, G2))},
})
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- ::: {.table name=suspension #tbl:suspension}
-- The suspension: parameters by both methods.
-- :::
--
-- @tbl:suspension: again both agree. The reading stands on one sample, the top of the first overshoot, where the response is flat and its
-- instant hard to see; the estimate uses every swing.
-- END SOLUTION
--
-- # What you hand in
--
-- Where this lesson is graded, `answer(name, value)` hands your results in; `dynlab check .` tells what is missing. What you read off the figures may
-- be typed in as you read it: `settling_time`, $T_r$ in seconds after the step; `exchanger_reading`, the vector $K$, $T$; `overshoot`, $D_1$ as a
-- ratio; `suspension_reading`, the vector $K$, $z$, $\omega_0$. The two estimated models, `G_exchanger` and `G_suspension`, are to be computed from the
-- record, because your script will be run on records of other exchangers and suspensions as well. Call the figures that hold your
-- readings against the measurements `exchanger_test` and `suspension_test`, as in `report.figure("exchanger_test", fig, "caption")`.

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
-- # What was learnt
--
-- BEGIN SOLUTION
-- * The shape decides the structure: steepest at once and no overshoot, first order; horizontal start and overshoot, second order with complex poles.
-- * Working points are not part of a transfer function: take the levels before the step off, or let the method estimate them.
-- * Reading a figure gives good values in a minute and start values for everything else. Optimisation uses all samples, is more exact and
--   tells how exact it is.
-- * A model is believed after its simulated output was laid over the measured one, not before.
-- END SOLUTION
