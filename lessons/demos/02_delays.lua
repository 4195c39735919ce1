-- ---
-- title: A dead time that is not a whole number of samples
-- template: lesson
-- ---

-- %% [markdown]
-- Pipes, conveyor belts and networks delay an output. This process has a delay of
-- 0.735 s and oscillates at 10 rad/s with little damping. With a sampling time of
-- 10 ms, the delay is 73.5 samples, which is not a whole number.

-- %% id=data
local process = tf({100}, {1, 2, 100}, {IODelay = 0.735})
local Ts = 0.01
local u = prbs(7, 10)
local data = iddata(lsim(process, u, Ts) + 0.3*randn(#u), u, Ts)
print(process)
idplot(data:range(1, 500))

-- %% [markdown]
-- tfsrivc(data, poles, zeros) estimates the delay Td together with the other
-- parameters. Td does not have to be a multiple of the sampling time. The standard
-- error of Td is far below the sampling time.

-- %% id=estimate
local G = tfsrivc(data, 2, 0)
present(G)

-- %% [markdown]
-- For every delay of a grid, tfsrivc estimates the other parameters. The figure
-- shows the remaining mean square error. The error has several local minima,
-- because an oscillation shifted by half a period changes its sign. A local search
-- can end at the wrong minimum, but the grid covers all minima.

-- %% id=loss
plot(G.report.delay_grid, G.report.delay_loss,
     {xlabel = "delay (s)", ylabel = "mean square error", title = "Error at each delay"}):vline(0.735, "true")

-- %% [markdown]
-- Now restrict the search to a wrong minimum on purpose. The other parameters
-- compensate for the wrong delay: even the sign of the gain is wrong. The figure
-- and its fits are for the first five seconds.

-- %% id=caught
local caught = tfsrivc(data, 2, 0, {TdMin = 0.3, TdMax = 0.55})
print(caught)
print(string.format("fit with Td = %.3f s: %.1f %%, with Td = %.3f s: %.1f %%",
                    G.IODelay, fit(data, G), caught.IODelay, fit(data, caught)))
compare(data:range(1, 500), G, caught, {labels = {"right valley", "wrong valley"}})

-- %% [markdown]
-- Estimate the delay instead of assuming it, and search over the complete range.
