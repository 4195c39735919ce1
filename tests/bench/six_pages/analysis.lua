-- ---
-- title: Six pages to measure the speed of reports
-- seed: 3
-- ---

-- %% id=all
local s = tf("s")
local truth = 2/(s^2 + 4*s + 3)
local u = prbs(4, 100)
local Ts = 0.01
local x = lsim(truth, u, Ts)
local y = x + 0.1*randn(#u)
local data = iddata(y, u, Ts)
local slow, fast = 2/(s^2 + 3.2*s + 3), 2/(s^2 + 5*s + 3)

report.figure("raw", idplot(data), "Input and output")
report.figure("step", step(truth, slow, fast), "Step responses")
report.figure("bode", bode(truth, slow, fast), "Frequency responses")
report.figure("poles", pzmap(truth, slow, fast), "Poles")
report.figure("compare", compare(data, truth, slow, fast), "Comparison")
report.figure("residuals", plot(linspace(0, 15, #u), y - x, {xlabel = "time (s)", ylabel = "residual"}), "Residuals")
for k, name in ipairs{"models", "fits", "settings"} do
    local rows = {{"quantity", "model 1", "model 2", "model 3"}}
    for row = 1, 6 do
        rows[row + 1] = {"entry " .. row, string.format("%.3f", row*k), string.format("%.3f", row + k),
                         string.format("%.3f", row/k)}
    end
    report.table(name, rows)
end
report.value("fit", fit(data, truth), "%.1f")
