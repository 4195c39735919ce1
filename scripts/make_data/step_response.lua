-- Makes data/step_response: four samples of a first-order step response, exact and noisy (engine/numerics/rigs/first_order_step.h).
local record = rig("step_response", {seed = 1})
save_csv("step_response.csv", record, {units = {t = "s", ydot = "1/s", ydot_noisy = "1/s"}, Ts = record.t[2] - record.t[1],
         columns = {"t", "u", "y", "ydot", "y_noisy", "ydot_noisy"}, title = "Step response of a first-order system"})
save_mat("step_response.mat", record, {digits = 7})
