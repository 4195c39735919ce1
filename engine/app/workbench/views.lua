-- What a session shows of its variables. This runs before the session's script, so that a script which gives these
-- names another meaning changes nothing here.
local compare, resid, step, impulse, bode, nyquist, pzmap = compare, resid, step, impulse, bode, nyquist, pzmap
local idplot, impulseest, fit, fit_measures, advice, spa = idplot, impulseest, fit, fit_measures, advice, spa
local figure, plot, delayest, selcstruc, stable = figure, plot, delayest, selcstruc, stable
local pcall, type, ipairs, pairs, tostring, math, string, table = pcall, type, ipairs, pairs, tostring, math, string, table
local mean, std, vector, exp, sqrt, cos, sin, abs, fft = mean, std, vector, exp, math.sqrt, cos, sin, abs, fft
local range, slider, save, save_mat, save_csv = range, slider, save, save_mat, save_csv
local step_first_order, step_second_order, step_delayed = step_first_order, step_second_order, step_delayed
local show, figure_label, reading_words, language = workbench.show, workbench.label, workbench.reading_words, report.language

local CM_PER_PIXEL = 2.54/96

--- The field of an object or table, nil where it has none.
local function field(object, name)
  local there, value = pcall(function() return object[name] end)
  if there then return value end
end

local function is_data(value) return type(value) == "userdata" and field(value, "experiments") ~= nil end
local function is_linear(value) return type(value) == "userdata" and (field(value, "num") ~= nil or field(value, "channels") ~= nil) end
--- Linear, or simulated by its own equations (greyest, narx, sindy).
local function is_model(value) return is_linear(value) or type(value) == "userdata" and field(value, "param") ~= nil and field(value, "report") ~= nil end

--- How many inputs and outputs a model has, and its transfer function from the chosen input to the chosen output.
local function seen_channel(model, settings)
  local list = field(model, "channels")
  if list == nil then return model, 1, 1 end
  local several = type(list[1]) == "table"
  local outputs, inputs = several and #list or 1, several and #list[1] or #list
  if outputs*inputs == 1 then return model, 1, 1 end
  local i, j = math.min(settings.output or 1, outputs), math.min(settings.input or 1, inputs)
  return several and list[i][j] or list[j], outputs, inputs
end

--- At the size in which the page shows it, in the printed figure's type.
local function sized(fig, settings, name)
  local size = settings.sizes and settings.sizes[name]
  if size then fig:set{width = size[1]*CM_PER_PIXEL, height = size[2]*CM_PER_PIXEL} end
  return fig
end

--- The chosen models that a view can show, and their names.
local function labelled(settings, values, is_shown)
  local models, labels = {}, {}
  for _, name in ipairs(settings.models or {}) do
    if is_shown(values[name]) then
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

--- Behind a name, as the script's language sets it.
local function colon() return language() == "fr" and "\u{202F}: " or ": " end

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

function views.second(settings, values)
  local data = values[settings.second]
  if is_data(data) then return {figure = idplot(data)} end
end

function views.prepared(settings, values)
  local data = values[settings.prepared]
  if is_data(data) then return {figure = idplot(data)} end
end


--- Power over frequency (rad/s) of a signal, of long ones the mean over stretches.
local function power_of(x, Ts)
  local length = math.min(#x, 8192)
  local half, stretches, sum = math.floor(length/2), math.floor(#x/length), nil
  for k = 0, stretches - 1 do
    local part = x:range(k*length + 1, (k + 1)*length)
    local size = fft(part - mean(part)).abs:range(2, half + 1)
    sum = sum and sum + size^2 or size^2
  end
  return range(1, 1, half)*(2*math.pi/(length*Ts)), sum*(Ts/(length*stretches))
end

function views.spectrum(settings, values)
  local raw, prepared = values[settings.raw], values[settings.prepared]
  if not is_data(raw) or raw.N < 8 then return end
  local curves = {}
  local function add(data, label, colour)
    local w, power = power_of(data.ny > 1 and data.y:col(math.min(settings.output or 1, data.ny)) or data.y, data.Ts)
    curves[#curves + 1] = {x = w, y = power, label = label, colour = colour}
  end
  add(raw, settings.raw, 8)
  if prepared ~= raw and is_data(prepared) then add(prepared, settings.prepared, 0) end
  return {figure = figure{curves = curves, x_log = true, y_log = true, xlabel = figure_label("frequency"), ylabel = figure_label("power")}}
end

function views.compare(settings, values)
  local models, labels = labelled(settings, values, is_model)
  local data = values[settings.validation] or values[settings.estimation]
  if not is_data(data) or #models == 0 then return end
  local told = {}
  for k, model in ipairs(models) do
    local done, measures = pcall(fit_measures, data, model)
    if done then told[#told + 1] = labels[k] .. colon() .. measures.message end
  end
  return {figure = with_models(compare, {data}, models, labels), words = table.concat(told, "\n")}
end

function views.residuals(settings, values)
  local models, labels = labelled(settings, values, is_model)
  local data = values[settings.validation] or values[settings.estimation]
  if not is_data(data) or #models == 0 then return end
  local fig, tests = resid(data, models[#models])
  return {figure = fig, words = labels[#labels] .. colon() .. tests.verdict}
end

for name, f in pairs{step = step, impulse = impulse, bode = bode, nyquist = nyquist, poles = pzmap} do
  views[name] = function(settings, values)
    local models, labels = labelled(settings, values, is_linear)
    local options = {}
    if settings.bands == false and name ~= "nyquist" and name ~= "impulse" then options.confidence = false end
    for k, model in ipairs(models) do models[k] = seen_channel(model, settings) end
    if #models > 0 then return {figure = with_models(f, {}, models, labels, options)} end
  end
end

function views.correlation(settings, values)
  local data = values[settings.estimation]
  if not is_data(data) then return end
  local models, labels = labelled(settings, values, is_linear)
  if data.ny*data.nu > 1 then data = data:select(math.min(settings.output or 1, data.ny), math.min(settings.input or 1, data.nu)) end
  for k, model in ipairs(models) do models[k] = seen_channel(model, settings) end
  local fig, seen = with_models(impulseest, {data}, models, labels)
  return {figure = fig, words = seen.message}
end

--- The i-th of a list that may be shorter, or not there.
local function entry(list, i)
  if list and i <= #list then return list[i] end
end

--- Estimates with their intervals, as rows: a picture of numbers of several sizes says little.
function views.parameters(settings, values)
  local models, labels = labelled(settings, values, is_model)
  if #models == 0 then return end
  local rows = {}
  for k, model in ipairs(models) do
    local names, param, errors = field(model, "names"), field(model, "param"), field(model, "std")
    for i, name in ipairs(names or {}) do
      rows[#rows + 1] = {labels[k], name, entry(param, i), entry(errors, i)}
    end
  end
  return {rows = rows}
end

function views.delay(settings, values)
  local models, labels = labelled(settings, values, is_linear)
  local model = models[#models]
  local report = model and field(model, "report")
  local delays, losses = report and field(report, "delay_grid"), report and field(report, "delay_loss")
  if not delays or #delays < 2 then return end
  local fig = plot(delays, losses, {xlabel = figure_label("delay"), ylabel = figure_label("mean_square_error"), style = "line_points"})
  fig:vline(field(model, "IODelay"), labels[#labels])
  return {figure = fig}
end

function views.orders(settings, values)
  local found = values[settings.orders]
  if found == nil or not field(found, "rows") then return end
  local rows, best = {}, found.best
  for i, row in ipairs(found.rows) do
    rows[i] = {poles = row.poles, zeros = row.zeros, delay = row.delay, fit = row.fit_percent,
               validation = row.validation_fit, yic = row.yic, bic = row.bic, failure = row.failure,
               best = best and row.poles == best.poles and row.zeros == best.zeros and row.delay == best.delay, doubt = row.cancellation and true or (#(row.undetermined or {}) > 0)}
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

--- What a table of readings says of the response: its curve, its handles and the numbers of its formulas.
local shapes = {}

function shapes.first(r)
  return function(since) return r.K*(1 - exp(-since/r.T)) end,
    {{parameter = "K", x = "end", y = function(K) return K end, text = figure_label("final_level")},
     {parameter = "T", x = function(T) return T end, y = 0.632*r.K, text = "63 %"}},
    {r.K*r.change, r.change, r.K, r.T, 3*r.T}
end

function shapes.delayed(r)
  local function curve(since)
    local t = since - r.Td
    return r.K*(1 - exp(-(t + abs(t))/(2*r.T)))
  end
  local t28, t63 = r.Td + r.T/3, r.Td + r.T
  return curve,
    {{parameter = "K", x = "end", y = function(K) return K end, text = figure_label("final_level")},
     {parameter = "Td", x = function(Td) return Td + r.T/3 end, y = 0.283*r.K, text = "28 %"},
     {parameter = "T", x = function(T) return r.Td + T end, y = 0.632*r.K, text = "63 %"}},
    {t28, t63, r.T, r.Td, r.K}
end

function shapes.second(r)
  local root = sqrt(1 - r.z^2)
  local function overshoot(z) return math.exp(-math.pi*z/sqrt(1 - z^2)) end
  local D, T1 = overshoot(r.z), math.pi/(r.w0*root)
  return function(since)
      return r.K*(1 - exp(-r.z*r.w0*since)*(cos(r.w0*root*since) + r.z/root*sin(r.w0*root*since)))
    end,
    {{parameter = "K", x = "end", y = function(K) return K end, text = figure_label("final_level")},
     {parameter = "w0", x = function(w0) return math.pi/(w0*root) end, other = "z", y = function(z) return r.K*(1 + overshoot(z)) end, text = figure_label("first_peak")}},
    {100*D, T1, r.z, r.w0, r.K, 3/(r.z*r.w0)}
end

local function ranged(name, value)
  local low, high = value/4, value*4
  if name == "z" then low, high = math.min(0.02, value), math.max(0.95, value) end
  if value == 0 then low, high = -1, 1 end
  if low > high then low, high = high, low end
  return slider("reading-" .. name, value, low, high)
end

function views.reading(settings, values)
  local r, data = values[settings.reading], values[settings.raw]
  if type(r) ~= "table" or not is_data(data) or not shapes[r.kind] then return end
  local curve, handles, numbers = shapes[r.kind](r)
  local t = data.t
  local since = t - r.start
  local y = r.rest + r.change*curve((since + abs(since))/2)
  local fig = plot(t, data.y, figure_label("measured"), t, y, figure_label("by_hand"), {style = {"points", "line"}, marker = 0, colour = {8, 0}, xlabel = figure_label("time")})
  for _, name in ipairs{"K", "T", "Td", "z", "w0"} do
    if r[name] then ranged(name, r[name]) end
  end
  for _, handle in ipairs(handles) do
    local at = handle.x
    if at == "end" then
      fig:handle{x = t[#t] - 0.03*(t[#t] - t[1]), y = function(K) return r.rest + r.change*K end, y_slider = "reading-K", text = handle.text}
    elseif handle.other then
      fig:handle{x = function(v) return r.start + at(v) end, x_slider = "reading-" .. handle.parameter,
                 y = function(v) return r.rest + r.change*handle.y(v) end, y_slider = "reading-" .. handle.other, text = handle.text}
    else
      fig:handle{x = function(v) return r.start + at(v) end, x_slider = "reading-" .. handle.parameter, y = r.rest + r.change*handle.y, text = handle.text}
    end
  end
  local error = data.y - y
  return {figure = fig, words = reading_words(r.kind, numbers, 100*(1 - std(error)/std(data.y)))}
end

--- What the functions for step tests read off a record, to begin with.
local function readings(data)
  local list = {}
  for kind, read in pairs{first = step_first_order, second = step_second_order, delayed = step_delayed} do
    local done, G = pcall(read, data)
    if done then
      local u, y, t, at = data.u, data.y, data.t, 1  -- the step comes behind sample `at`
      while at < #u and u[at + 1] == u[1] do at = at + 1 end
      local from_first = at == #u
      list[kind] = {K = G.K, T = field(G, "T"), Td = field(G, "D"), z = field(G, "z"), w0 = field(G, "w0"),
                    start = from_first and t[1] or t[at + 1], rest = from_first and 0 or mean(y:range(1, at)),
                    change = from_first and u[1] or u[#u] - u[1]}
    end
  end
  return list
end

--- The names of a record's channels, u1, u2 ... where they have none.
local function names_of(data, key, count, letter)
  local given, names = field(data, key), {}
  for i = 1, count do
    local name = type(given) == "table" and given[i] or i == 1 and type(given) == "string" and given or ""
    names[i] = name ~= "" and name or letter .. i
  end
  return names
end

--- Of which kind each variable is, and what controls ask about it.
local function describe(values)
  local seen = {}
  for name, value in pairs(values) do
    if is_data(value) then
      local t = value.t
      seen[name] = {kind = "data", N = value.N, Ts = value.Ts, start = t[1], last = t[value.N], inputs = value.nu,
                    outputs = value.ny, experiments = value.experiments, hold = value.InterSample,
                    input_names = names_of(value, "InputName", value.nu, "u"), output_names = names_of(value, "OutputName", value.ny, "y")}
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
  if names and errors and #errors == #names then
    row.parameters = #names
    local last = names[#names]
    if last == "IODelay" or last == "Td" or last == "delay" then row.delay_std = errors[#names] end
  end
  local poles, zeros = field(model, "den"), field(model, "num")
  local channel, outputs, inputs = seen_channel(model, settings)
  row.outputs, row.inputs = outputs, inputs
  if outputs*inputs > 1 then poles, zeros, row.delay = field(channel, "den"), field(channel, "num"), field(channel, "IODelay") end
  if type(poles) == "userdata" and type(zeros) == "userdata" then row.poles, row.zeros = #poles - 1, #zeros - 1 end
  local function measure(part, key)
    local data = values[part]
    if not is_data(data) then return end
    local done, seen = pcall(fit_measures, data, model)
    if done then
      row[key] = {fit = seen.fit_percent, r_squared = seen.r_squared_simulation, yic = seen.yic}
      return
    end
    local fits = {pcall(fit, data, model)}
    if fits[1] then row[key] = {fit = fits[1 + math.min(settings.output or 1, #fits - 1)]} end
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

function views.advice(settings, values)
  local data = values[settings.prepared] or values[settings.raw]
  if not is_data(data) then return {list = {}} end
  local list = {}
  for i, one in ipairs(advice(data)) do
    list[i] = {code = one.code, warning = one.warning, message = one.message, sections = one.sections}
  end
  local read, kinds = pcall(readings, values[settings.raw])
  return {list = list, readings = read and kinds or {}}
end

function views.variables(settings, values) return describe(values) end

function views.models(settings, values)
  local rows = {}
  for _, name in ipairs(settings.all_models or {}) do
    if is_model(values[name]) then rows[#rows + 1] = measured(name, values[name], settings, values) end
  end
  return {rows = rows}
end

--- Files for whoever wants to go on elsewhere, by what is saved.
local saving = {}

function saving.figure(order, settings, values, file)
  local name = order.view
  save(sized(views[name](settings, values).figure, settings, name), file)
end

function saving.models(order, settings, values, file)
  local structs, columns = {}, {model = {}, parameter = {}, value = {}, std = {}}
  for _, name in ipairs(settings.all_models) do
    local model = values[name]
    if is_model(model) then
      structs[name] = is_linear(model) and {num = field(model, "num"), den = field(model, "den"), IODelay = field(model, "IODelay"), Ts = field(model, "Ts")}
                      or {param = field(model, "param")}
      local names, param, errors = field(model, "names"), field(model, "param"), field(model, "std")
      for i, parameter in ipairs(names or {}) do
        local n = #columns.model + 1
        columns.model[n], columns.parameter[n], columns.value[n] = name, parameter, param[i]
        columns.std[n] = entry(errors, i) or math.huge
      end
    end
  end
  if order.format == "mat" then save_mat(file, structs) else save_csv(file, columns, {columns = {"model", "parameter", "value", "std"}, digits = 17}) end
end

function saving.data(order, settings, values, file)
  local data = values[order.name]
  if order.format == "mat" then save_mat(file, {t = data.t, y = data.y, u = data.u, Ts = data.Ts}) else save_csv(file, data, {digits = 17}) end
end

--- Of a variable that the script may not have come to.
function value_or_nil(read)
  local there, value = pcall(read)
  if there then return value end
end

local function saved(order, settings, values)
  local file = string.format("%s-%d.%s", order.name or order.view or order.what, order.number, order.format)
  saving[order.what](order, settings, values, file)
  return {number = order.number, file = file}
end

local function seen_in(view, settings, values, name)
  local seen = view(settings, values) or {}
  if seen.figure then sized(seen.figure, settings, name) end
  return seen
end

function draw_workbench(settings, values)
  local order = settings.save
  if order then
    local done, told = pcall(saved, order, settings, values)
    if not done then told = {number = type(order) == "table" and order.number or nil, error = tostring(told)} end
    show("saved", told)
  end
  for _, name in ipairs(settings.views or {}) do
    local view = views[name]
    if view then
      local done, seen = pcall(seen_in, view, settings, values, name)
      show(name, done and seen or {error = tostring(seen)})
    end
  end
end
