-- ---
-- title: A dead time that is not a whole number of samples
-- template: lesson
-- ---

-- %% [markdown]
-- Pipes, conveyor belts and networks delay an output. This process waits 0.735 s,
-- then oscillates at 10 rad/s with little damping. With samples every 10 ms, the
-- delay is 73.5 samples: no shift by whole samples can express it.

-- %% id=data
local process = tf({100}, {1, 2, 100}, {IODelay = 0.735})
local Ts = 0.01
local u = prbs(7, 10)
local data = iddata(lsim(process, u, Ts) + 0.3*randn(#u), u, Ts)
print(process)
idplot(data:range(1, 500))

-- %% [markdown]
-- tfsrivc(data, poles, zeros) finds the delay as a real number, together with the
-- other parameters. Look at Td: its standard error is far below the sampling time.

-- %% id=estimate
local G = tfsrivc(data, 2, 0)
present(G)

-- %% [markdown]
-- How? For every delay of a grid, it found the best other parameters. The figure
-- shows the remaining mean square error. It has several valleys, because an
-- oscillation shifted by half a period looks like its negative. A search that
-- starts in the wrong valley stays there. The grid covers them all.

-- %% id=loss
plot(G.report.delay_grid, G.report.delay_loss,
     {xlabel = "delay (s)", ylabel = "mean square error", title = "What remains at each delay"}):vline(0.735, "true")

-- %% [markdown]
-- Let us search only the wrong valley, on purpose. The other parameters try to
-- compensate for the wrong delay: even the sign of the gain is wrong now. The
-- figure shows the first five seconds, and its fits are for these.

-- %% id=caught
local caught = tfsrivc(data, 2, 0, {TdMin = 0.3, TdMax = 0.55})
print(caught)
print(string.format("fit with Td = %.3f s: %.1f %%, with Td = %.3f s: %.1f %%",
                    G.IODelay, fit(data, G), caught.IODelay, fit(data, caught)))
compare(data:range(1, 500), G, caught, {labels = {"right valley", "wrong valley"}})

-- %% [markdown]
-- Estimate a delay instead of assuming it, and let the search start everywhere.
