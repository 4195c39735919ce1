-- expects: simulated: This is the measured reading
-- expects: free_run: the largest allowed error
-- expects: crane_follows: The results do not change with the data
-- expects: tanks_follow: The results do not change with the data
-- The values of SOURCE.md, and the measured reading instead of the simulated reading.
answer("crane", vector{0.3724, 0.24})
answer("crane_fit", 98.1)
answer("tanks", vector{0.1, 0.102, 0.104, 0.14, 0.6, 0.3})
answer("free_run", vector{0.7, 0.03, 0.5})
answer("simulated", load("two_tanks").y_val)
report.figure("left", plot(load("crane").validation.t, load("crane").validation.theta), "Angle")
report.figure("free_run", plot(load("two_tanks").t_val, load("two_tanks").y_val), "Reading")
