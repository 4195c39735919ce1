-- Makes data/step_response: four samples of a first-order step response, exact and noisy (engine/numerics/plants/first_order_step.h).
local about, record = plant().step_response, plant("step_response")
save_csv("step_response.csv", record, {units = about.units, columns = about.signals, Ts = about.Ts, title = about.title})
save_mat("step_response.mat", record, {digits = 7})
