-- What a session shows of its variables. This runs before the session's script, so that a script which gives these
-- names another meaning changes nothing here.
local compare, resid, step, impulse, bode, nyquist, pzmap = compare, resid, step, impulse, bode, nyquist, pzmap
local idplot, impulseest, fit, fit_measures, advice, spa = idplot, impulseest, fit, fit_measures, advice, spa
local figure, plot, delayest, selcstruc, stable = figure, plot, delayest, selcstruc, stable
local pcall, type, ipairs, pairs, tostring, math, string, table = pcall, type, ipairs, pairs, tostring, math, string, table
local sqrt, mean, std, vector = math.sqrt, mean, std, vector
local show = workbench.show

local CM_PER_PIXEL = 2.54/96

--- The field of an object or table, nil where it has none.
local function field(object, name)
  local there, value = pcall(function() return object[name] end)
  if there then return value end
end

local function is_data(value) return type(value) == "userdata" and field(value, "experiments") ~= nil end
local function is_model(value) return type(value) == "userdata" and field(value, "num") ~= nil or type(value) == "userdata" and field(value, "channels") ~= nil end

--- At the size in which the page shows it, in the printed figure's type.
local function sized(fig, settings, name)
  local size = settings.sizes and settings.sizes[name]
  if size then fig:set{width = size[1]*CM_PER_PIXEL, height = size[2]*CM_PER_PIXEL} end
  return fig
end

local function labelled(settings, values)
  local models, labels = {}, {}
  for _, name in ipairs(settings.models or {}) do
    if is_model(values[name]) then
      models[#models + 1] = values[name]
      labels[#labels + 1] = name
    end
  end
  return models, labels
end

--- Arguments f(first..., models..., {labels = ...}).
local function with_models(f, first, models, labels, options)
  local arguments = {}
  for _, value in ipairs(first) do arguments[#arguments + 1] = value end
  for _, value in ipairs(models) do arguments[#arguments + 1] = value end
  local given = {labels = labels}
  for key, value in pairs(options or {}) do given[key] = value end
  arguments[#arguments + 1] = given
  return f(table.unpack(arguments))
end

local views = {}

function views.record(settings, values)
  local data = values[settings.raw]
  if not is_data(data) then return end
  local first, last = 1, data.N
  if settings.range then
    local t = data.t
    local start, step = t[1], (t[data.N] - t[1])/math.max(1, data.N - 1)
    first = math.max(1, math.floor((settings.range[1] - start)/step))
    last = math.min(data.N, math.ceil((settings.range[2] - start)/step) + 2)
    if last - first < 2 then first, last = math.max(1, first - 1), math.min(data.N, first + 2) end
  end
  return {figure = (first == 1 and last == data.N) and idplot(data) or idplot(data, first, last)}
end

function views.prepared(settings, values)
  local data = values[settings.prepared]
  if is_data(data) then return {figure = idplot(data)} end
end


function views.spectrum(settings, values)
  local raw, prepared = values[settings.raw], values[settings.prepared]
  if not is_data(raw) then return end
  local curves = {}
  local function add(data, label, colour)
    local x = data.y:col(1)
    local X = fft(x - mean(x))
    local half = math.floor(#x/2)
    local power, w = vector(half), vector(half)
    for k = 1, half do
      power[k] = (X[k + 1]:abs())^2/#x*data.Ts
      w[k] = 2*math.pi*k/(#x*data.Ts)
    end
    curves[#curves + 1] = {x = w, y = power, label = label, colour = colour}
  end
  add(raw, settings.raw, 8)
  if prepared ~= raw and is_data(prepared) then add(prepared, settings.prepared, 0) end
  return {figure = figure{curves = curves, x_log = true, y_log = true, xlabel = "frequency (rad/s)",
                          ylabel = "power of the output"}}
end

function views.compare(settings, values)
  local models, labels = labelled(settings, values)
  local data = values[settings.validation] or values[settings.estimation]
  if not is_data(data) or #models == 0 then return end
  local told = fit_measures(data, models[#models]).message
  return {figure = with_models(compare, {data}, models, labels), words = told}
end

function views.residuals(settings, values)
  local models, labels = labelled(settings, values)
  local data = values[settings.validation] or values[settings.estimation]
  if not is_data(data) or #models == 0 then return end
  local fig, tests = resid(data, models[#models])
  return {figure = fig, words = labels[#labels] .. ": " .. tests.verdict}
end

for name, f in pairs{step = step, impulse = impulse, bode = bode, nyquist = nyquist, poles = pzmap} do
  views[name] = function(settings, values)
    local models, labels = labelled(settings, values)
    local options = {}
    if settings.bands == false and name ~= "nyquist" and name ~= "impulse" then options.confidence = false end
    if #models > 0 then return {figure = with_models(f, {}, models, labels, options)} end
  end
end

function views.correlation(settings, values)
  local data = values[settings.estimation]
  if not is_data(data) then return end
  local models, labels = labelled(settings, values)
  local fig, seen = with_models(impulseest, {data}, models, labels)
  return {figure = fig, words = seen.message}
end

--- Estimates with their intervals, as rows: a picture of numbers of several sizes says little.
function views.parameters(settings, values)
  local models, labels = labelled(settings, values)
  if #models == 0 then return end
  local rows = {}
  for k, model in ipairs(models) do
    local names, param, errors = field(model, "names"), field(model, "param"), field(model, "std")
    for i, name in ipairs(names or {}) do
      rows[#rows + 1] = {labels[k], name, param and param[i], errors and errors[i]}
    end
  end
  return {rows = rows}
end

function views.delay(settings, values)
  local models, labels = labelled(settings, values)
  local model = models[#models]
  local report = model and field(model, "report")
  local delays, losses = report and field(report, "delay_grid"), report and field(report, "delay_loss")
  if not delays or #delays < 2 then return end
  local fig = plot(delays, losses, {xlabel = "delay (s)", ylabel = "mean square error", style = "line_points"})
  fig:vline(field(model, "IODelay"), labels[#labels])
  return {figure = fig}
end

function views.orders(settings, values)
  local found = values[settings.orders]
  if found == nil or not field(found, "rows") then return end
  local rows = {}
  for i, row in ipairs(found.rows) do
    rows[i] = {poles = row.poles, zeros = row.zeros, delay = row.delay, fit = row.fit_percent,
               validation = row.validation_fit, yic = row.yic, bic = row.bic, failure = row.failure,
               best = row == found.best, doubt = row.cancellation and true or (#(row.undetermined or {}) > 0)}
  end
  return {rows = rows, words = found.recommendation}
end

function views.study(settings, values)
  local study = values[settings.study]
  if study == nil then return end
  local labels, rows = field(study, "labels"), {}
  if not labels then return end
  for _, label in ipairs(labels) do
    local one = study[label]
    for i, name in ipairs(one.names) do
      rows[#rows + 1] = {label, name, one.truth and one.truth[i], one.mean[i], one.std[i],
                         field(one, "cramer_rao_std") and one.cramer_rao_std[i], one.reported_std[i]}
    end
  end
  local first = study[labels[1]]
  local across, up = first.names[1], first.names[2]
  for _, name in ipairs(first.names) do
    if name == settings.across then across = name end
    if name == settings.up then up = name end
  end
  local fig
  if up then fig = study:scatter(across, up) else fig = study:histograms() end
  return {figure = fig, rows = rows, runs = field(study, "runs")}
end

--- Of which kind each variable is, and what controls ask about it.
local function describe(values)
  local seen = {}
  for name, value in pairs(values) do
    if is_data(value) then
      local t = value.t
      seen[name] = {kind = "data", N = value.N, Ts = value.Ts, start = t[1], last = t[value.N], inputs = value.nu,
                    outputs = value.ny, experiments = value.experiments, hold = value.InterSample}
    elseif is_model(value) then
      local num, den = field(value, "num"), field(value, "den")
      local proper = type(num) ~= "userdata" or type(den) ~= "userdata" or #num <= #den
      seen[name] = {kind = proper and "model" or "other", text = tostring(value)}
    elseif type(value) ~= "number" and field(value, "rows") then
      seen[name] = {kind = "orders"}
    elseif type(value) ~= "number" and field(value, "labels") then
      seen[name] = {kind = "study", runs = value.runs}
    elseif type(value) == "number" or type(value) == "string" then
      seen[name] = {kind = type(value), value = value}
    elseif type(value) == "table" then
      seen[name] = {kind = "table"}
    elseif value ~= nil then
      seen[name] = {kind = "other", text = tostring(value):sub(1, 200)}
    end
  end
  return seen
end

--- A line of the table of models.
local function measured(name, model, settings, values)
  local row = {name = name, text = tostring(model)}
  local report = field(model, "report")
  local function of(key) return report and field(report, key) end
  row.message, row.condition, row.white = of("message"), of("condition_number"), of("white")
  row.delay = field(model, "IODelay")
  local names, errors = field(model, "names"), field(model, "std")
  if names and errors then
    row.parameters = #names
    local last = names[#names]
    if last == "IODelay" or last == "Td" or last == "delay" then row.delay_std = errors[#names] end
  end
  local poles, zeros = field(model, "den"), field(model, "num")
  if type(poles) == "userdata" and type(zeros) == "userdata" then row.poles, row.zeros = #poles - 1, #zeros - 1 end
  local function measure(part, key)
    local data = values[part]
    if not is_data(data) then return end
    local done, seen = pcall(fit_measures, data, model)
    if done then row[key] = {fit = seen.fit_percent, r_squared = seen.r_squared_simulation, yic = seen.yic} end
  end
  measure(settings.estimation, "estimation")
  if settings.validation ~= settings.estimation then measure(settings.validation, "validation") end
  local data = values[settings.validation] or values[settings.estimation]
  if is_data(data) then
    local done, _, tests = pcall(resid, data, model, {quiet = true})
    if done then row.verdict, row.is_white, row.independent = tests.verdict, tests.white, tests.independent end
  end
  return row
end

local function findings(settings, values)
  local data = values[settings.prepared] or values[settings.raw]
  if not is_data(data) then return end
  local list = {}
  for i, one in ipairs(advice(data)) do
    list[i] = {code = one.code, warning = one.warning, message = one.message, sections = one.sections}
  end
  return list
end

function draw_workbench(settings, values)
  show("variables", describe(values))
  if settings.advice then
    local done, list = pcall(findings, settings, values)
    show("advice", {list = done and list or {}, of = settings.prepared})
  end
  local rows = {}
  for _, name in ipairs(settings.all_models or {}) do
    if is_model(values[name]) then rows[#rows + 1] = measured(name, values[name], settings, values) end
  end
  show("models", {rows = rows})
  for _, name in ipairs(settings.views or {}) do
    local view = views[name]
    if view then
      local done, seen = pcall(view, settings, values)
      if not done then seen = {error = tostring(seen)} end
      seen = seen or {}
      if seen.figure then sized(seen.figure, settings, name) end
      show("view " .. name, seen)
    end
  end
end
