-- What a session shows of its variables. This runs before the session's script, so that a script which gives these
-- names another meaning changes nothing here.
local compare, resid, step, impulse, bode, nyquist, pzmap = compare, resid, step, impulse, bode, nyquist, pzmap
local idplot, impulseest, fit, fit_measures, advice, spa = idplot, impulseest, fit, fit_measures, advice, spa
local figure, plot, subplot, zero, tfsrivc = figure, plot, subplot, zero, tfsrivc
local pcall, type, ipairs, pairs, tostring, math, string, table = pcall, type, ipairs, pairs, tostring, math, string, table
local mean, std, vector, exp, sqrt, cos, sin, abs, fft = mean, std, vector, exp, math.sqrt, cos, sin, abs, fft
local range, linspace, slider, save, save_mat, save_csv = range, linspace, slider, save, save_mat, save_csv
local step_first_order, step_second_order, step_delayed = step_first_order, step_second_order, step_delayed
local show, figure_label, language = workbench.show, workbench.label, report.language

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

--- A model's transfer functions by output and input.
local function channels_of(model)
  local list = field(model, "channels")
  if list == nil then return {{model}} end
  return type(list[1]) == "table" and list or {list}
end

--- The transfer function of a model for one of all_channels(); nothing where the model has none. A model that was estimated
--- from selected channels (`settings.channel_of`) has these, others all or none of the data's.
local function channel(settings, name, model, one)
  local list, own = channels_of(model), settings.channel_of and settings.channel_of[name] or {}
  if one.of_data and not own.output and (#list ~= one.outputs or #list[1] ~= one.inputs) then return end
  local row = list[own.output and (own.output == one.output and 1 or 0) or one.output]
  return row and row[own.input and (own.input == one.input and 1 or 0) or one.input]
end

--- At the size in which the page shows it, in the printed figure's type.
local function sized(fig, settings, name)
  local size = settings.sizes and settings.sizes[name]
  if size then fig:set{width = size[1]*CM_PER_PIXEL, height = size[2]*CM_PER_PIXEL} end
  return fig
end

--- The chosen models that a view can show, and their names.
local function labeled(settings, values, is_shown)
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

--- The names of a record's channels, u1, u2 ... where they have none.
local function names_of(data, key, count, letter)
  local given, names = field(data, key), {}
  for i = 1, count do
    local name = type(given) == "table" and given[i] or i == 1 and type(given) == "string" and given or ""
    names[i] = name ~= "" and name or letter .. i
  end
  return names
end

--- The channels that a view shows: those of the data, or of the models where there are none.
local function all_channels(settings, values, models)
  local data, channels, outputs, inputs = values[settings.estimation], {}, 1, 1
  if is_data(data) then
    outputs, inputs = data.ny, data.nu
  else
    for _, model in ipairs(models) do
      local list = channels_of(model)
      outputs, inputs = math.max(outputs, #list), math.max(inputs, #list[1])
    end
  end
  local y = is_data(data) and names_of(data, "OutputName", outputs, "y") or {}
  local u = is_data(data) and names_of(data, "InputName", inputs, "u") or {}
  for i = 1, outputs do
    for j = 1, inputs do
      local from, to = u[j] or "u" .. j, y[i] or "y" .. i
      channels[#channels + 1] = {output = i, input = j, outputs = outputs, inputs = inputs, of_data = is_data(data), title = outputs*inputs > 1 and (inputs > 1 and from .. " → " .. to or to) or nil}
    end
  end
  return channels, outputs, inputs
end

--- One figure of several, each under its title; `across`: panels of each stand side by side.
local function small_multiples(figures, titles, columns, across)
  if #figures == 1 then return titles[1] and figures[1]:set{title = titles[1]} or figures[1] end
  local panels, first = figures[1].panels, {}
  for k = 1, #figures do first[k] = (k - 1)*panels + 1 end
  local fig = (across or columns == 1) and subplot(across and #figures or #figures*panels, across and panels or 1, figures)
              or subplot(math.ceil(#figures/columns), columns, figures)
  for k, title in ipairs(titles) do fig:set{panel = first[k], title = title} end
  return fig
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
  local figures, titles = {}, names_of(raw, "OutputName", raw.ny, "y")
  for i = 1, raw.ny do
    local curves = {}
    local function add(data, label, color)
      local w, power = power_of(data.ny > 1 and data.y:col(i) or data.y, data.Ts)
      curves[#curves + 1] = {x = w, y = power, label = label, color = color}
    end
    add(raw, settings.raw, 8)
    if prepared ~= raw and is_data(prepared) and prepared.ny == raw.ny then add(prepared, settings.prepared, 0) end
    figures[i] = figure{curves = curves, x_log = true, y_log = true, xlabel = figure_label("frequency"), ylabel = figure_label("power")}
  end
  return {figure = small_multiples(figures, titles, 1)}
end

--- A line for each model that has no part of these data, in the page's words.
local function left_out(settings, values, models, labels)
  local names = {}
  local channels = all_channels(settings, values, models)
  for k, model in ipairs(models) do
    local some = false
    for _, one in ipairs(channels) do some = some or channel(settings, labels[k], model, one) ~= nil end
    if not some then names[#names + 1] = labels[k] end
  end
  return names
end

--- The channels of the data that a model is of; nothing where it has others.
local function own_part(settings, name, model, data)
  if not is_data(data) then return end
  local list, own = channels_of(model), settings.channel_of and settings.channel_of[name] or {}
  if own.output and data.ny*data.nu > 1 then data = data:select(own.output, own.input) end
  if not is_linear(model) or #list == data.ny and #list[1] == data.nu then return data end
end

--- What simulates output i of the data: the model where it has this output alone, else its transfer function.
local function simulates(settings, name, model, data, i)
  local list, own = channels_of(model), settings.channel_of and settings.channel_of[name] or {}
  if not own_part(settings, name, model, data) then return end
  if own.output then return own.output == i and (own.input == nil or data.nu == 1) and model or nil end
  if data.ny == 1 then return model end
  return data.nu == 1 and list[i][1] or nil
end

function views.compare(settings, values)
  local models, labels = labeled(settings, values, is_model)
  local data = values[settings.validation] or values[settings.estimation]
  if not is_data(data) or #models == 0 then return end
  local figures, told = {}, {}
  for _, model in ipairs(models) do
    if data.ny > 1 and not is_linear(model) then return {figure = with_models(compare, {data}, models, labels)} end
  end
  for i = 1, data.ny do
    local part, some, names = data.ny > 1 and data:select(i) or data, {}, {}
    for k, model in ipairs(models) do
      local one = simulates(settings, labels[k], model, data, i)
      if one then
        some[#some + 1], names[#names + 1] = one, labels[k]
        local done, measures = pcall(fit_measures, part, one)
        if done then told[#told + 1] = labels[k] .. (data.ny > 1 and ", " .. names_of(data, "OutputName", data.ny, "y")[i] or "") .. colon() .. measures.message end
      end
    end
    if #some > 0 then figures[#figures + 1] = with_models(compare, {part}, some, names) end
  end
  return {figure = #figures > 0 and small_multiples(figures, {}, 1) or nil, words = table.concat(told, "\n"), left_out = left_out(settings, values, models, labels)}
end

function views.residuals(settings, values)
  local models, labels = labeled(settings, values, is_model)
  local data = values[settings.validation] or values[settings.estimation]
  if not is_data(data) or #models == 0 then return end
  local figures, told = {}, {}
  local function test(name, part, model)
    local fig, tests = resid(part, model)
    figures[#figures + 1], told[#told + 1] = fig, name .. colon() .. tests.verdict
  end
  if own_part(settings, labels[#labels], models[#models], data) == data then  -- the last model has all outputs
    test(labels[#labels], data, models[#models])
  else
    for i = 1, data.ny do
      for k = #models, 1, -1 do
        local one = simulates(settings, labels[k], models[k], data, i)
        if one then test(labels[k], data.ny > 1 and data:select(i) or data, one) break end
      end
    end
  end
  if #told > 0 then return {figure = #figures > 0 and small_multiples(figures, {}, 1, true) or nil, words = table.concat(told, "\n")} end
  return {left_out = labels}
end

--- Where a pole so slow that the data do not show it makes a figure of times or frequencies far from theirs, those of the data.
local kFar = 50
local function near_data(fig, name, data, models, labels, f, title)
  if not is_data(data) then return fig end
  local duration, low, last = data.t[data.N] - data.t[1], math.huge, 0
  for _, curve in ipairs(fig.curves) do low, last = math.min(low, curve.x[1]), math.max(last, curve.x[#curve.x]) end
  if name == "bode" and low < 1/(kFar*duration) then
    for k = 1, fig.panels do fig:set{panel = k, x_range = {1/duration, 10^math.ceil(math.log(last, 10))}} end
  elseif (name == "step" or name == "impulse") and last > kFar*duration then
    local t, curves = linspace(0, duration, 400), {}
    for k, model in ipairs(models) do curves[k] = {x = t, y = f(model, t), label = labels[k]} end
    return figure{curves = curves, xlabel = figure_label("time"), ylabel = title}
  end
  return fig
end

for name, f in pairs{step = step, impulse = impulse, bode = bode, nyquist = nyquist, poles = pzmap} do
  views[name] = function(settings, values)
    local models, labels = labeled(settings, values, is_linear)
    local options, figures, titles = {}, {}, {}
    if #models == 0 then return end
    if settings.bands == false and name ~= "nyquist" and name ~= "impulse" then options.confidence = false end
    local channels, _, inputs = all_channels(settings, values, models)
    for _, one in ipairs(channels) do
      local some, names = {}, {}
      for k, model in ipairs(models) do
        local part = channel(settings, labels[k], model, one)
        if part then some[#some + 1], names[#names + 1] = part, labels[k] end
      end
      if #some > 0 then
        local fig = with_models(f, {}, some, names, options)
        figures[#figures + 1], titles[#titles + 1] = near_data(fig, name, values[settings.estimation], some, names, f, one.title), one.title
      end
    end
    if #figures == 0 then return end
    local size = settings.sizes and settings.sizes[name]
    local across = name == "bode" and size and size[1] > 480
    return {figure = small_multiples(figures, titles, name == "bode" and 1 or inputs, across), left_out = left_out(settings, values, models, labels)}
  end
end

function views.correlation(settings, values)
  local data = values[settings.estimation]
  if not is_data(data) then return end
  local models, labels = labeled(settings, values, is_linear)
  local figures, titles, told = {}, {}, {}
  local channels, _, inputs = all_channels(settings, values, models)
  for _, one in ipairs(channels) do
    local some, names = {}, {}
    for k, model in ipairs(models) do
      local part = channel(settings, labels[k], model, one)
      if part then some[#some + 1], names[#names + 1] = part, labels[k] end
    end
    local fig, seen = with_models(impulseest, {data.ny*data.nu > 1 and data:select(one.output, one.input) or data}, some, names)
    figures[#figures + 1], titles[#titles + 1] = fig, one.title
    told[#told + 1] = (one.title and one.title .. colon() or "") .. seen.message
  end
  return {figure = small_multiples(figures, titles, inputs), words = table.concat(told, "\n")}
end

--- The i-th of a list that may be shorter, or not there.
local function entry(list, i)
  if list and i <= #list then return list[i] end
end

--- Estimates with their intervals, as rows: a picture of numbers of several sizes says little.
function views.parameters(settings, values)
  local models, labels = labeled(settings, values, is_model)
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
  local models, labels = labeled(settings, values, is_linear)
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
  local fig = plot(t, data.y, figure_label("measured"), t, y, figure_label("by_hand"), {style = {"points", "line"}, marker = 0, color = {8, 0}, xlabel = figure_label("time")})
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
  return {figure = fig, kind = r.kind, numbers = numbers, fit = 100*(1 - std(data.y - y)/std(data.y))}
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

local function units_of(data, key)
  local units = field(data, key)
  return type(units) == "string" and {units} or units
end

--- Of which kind each variable is, and what controls ask about it.
local function describe(values)
  local seen = {}
  for name, value in pairs(values) do
    if is_data(value) then
      local t = value.t
      seen[name] = {kind = "data", N = value.N, Ts = value.Ts, start = t[1], last = t[value.N], inputs = value.nu,
                    outputs = value.ny, experiments = value.experiments, hold = value.InterSample,
                    input_names = names_of(value, "InputName", value.nu, "u"), output_names = names_of(value, "OutputName", value.ny, "y"),
                    input_units = units_of(value, "InputUnit"), output_units = units_of(value, "OutputUnit")}
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

--- The lines of the table of models for one model: one for each output that it has of the data.
local function measured(name, model, settings, values, rows)
  local report = field(model, "report")
  local function of(key) return report and field(report, key) end
  local list = channels_of(model)
  local data = values[settings.estimation]
  local own = settings.channel_of and settings.channel_of[name] or {}
  local outputs = is_data(data) and data.ny or #list
  local titles = own_part(settings, name, model, data) and outputs > 1 and names_of(data, "OutputName", outputs, "y") or {}
  local names, errors = field(model, "names"), field(model, "std")
  local function part_of(part) return own_part(settings, name, model, values[part]) end
  local judged = part_of(settings.validation) or part_of(settings.estimation)
  local done, _, tests = pcall(resid, judged, model, {quiet = true})
  for i = 1, #list do
    local row = {name = name, text = tostring(model), message = of("message"), condition = of("condition_number"), outputs = #list, inputs = #list[1],
                 output = own.output or i, output_name = titles[own.output or i]}
    local one = #list*#list[1] == 1 and model or #list[1] == 1 and list[i][1] or nil
    local seen = one or list[i][1]
    local poles, zeros = field(seen, "den"), field(seen, "num")
    row.delay = field(seen, "IODelay")
    if type(poles) == "userdata" and type(zeros) == "userdata" then row.poles, row.zeros = #poles - 1, #zeros - 1 end
    if names and errors and #errors == #names then
      row.parameters = #names
      for k, parameter in ipairs(names) do
        local kind, output = parameter:match("^([%a]+)_?y?(%d*)$")
        local delay = kind == "IODelay" or kind == "Td" or kind == "delay"
        if delay and (output == "" and k == #names or tonumber(output) == i) then row.delay_std = errors[k] end
      end
    end
    local function measure(part, key)
      local whole = part_of(part)
      if not whole then return end
      local measured, seen = pcall(fit_measures, whole.ny > 1 and whole:select(i) or whole, one)
      if one and measured then
        row[key] = {fit = seen.fit_percent, r_squared = seen.r_squared_simulation, yic = seen.yic}
        return
      end
      local fits = {pcall(fit, whole, model)}
      if fits[1] then row[key] = {fit = fits[1 + i]} end
    end
    measure(settings.estimation, "estimation")
    if settings.validation ~= settings.estimation then measure(settings.validation, "validation") end
    if done then
      local about = tests.outputs and tests.outputs[i] or {white = tests.white}  -- none of a model that reproduces the data
      row.is_white, row.independent = about.white, about.inputs ~= nil or tests.independent
      for _, input in ipairs(about.inputs or {}) do row.independent = row.independent and input.independent end
    end
    rows[#rows + 1] = row
  end
end

--- How many poles and zeros a first model has: two and none with a delay, unless a lag explains the response as well, which
--- a zero of the right half plane that imitates the delay does not.
local function first_orders(data)
  local delayed = tfsrivc(data, 2, 0)
  local late, best, least = {}, nil, nil
  for i, row in ipairs(channels_of(delayed)) do
    for j, part in ipairs(row) do
      if part.IODelay > 0.1*data.Ts then late[#late + 1] = {i, j, part.IODelay} end
    end
  end
  if #late == 0 then return end
  local before = {fit(data, delayed)}
  for _, orders in ipairs{{2, 1}, {3, 1}} do
    local done, model = pcall(tfsrivc, data, orders[1], orders[2], {TdMax = 0})
    if done then
      local now, lowest, worse = {fit(data, model)}, math.huge, false
      for i = 1, #now do lowest, worse = math.min(lowest, now[i]), worse or now[i] < before[i] end
      for _, place in ipairs(late) do
        local roots = zero(channels_of(model)[place[1]][place[2]]).re
        for k = 1, #roots do worse = worse or roots[k] > 0 and math.abs(math.log(2/roots[k]/place[3])) < math.log(4) end
      end
      if not worse and (least == nil or lowest > least + 0.5) then best, least = orders, lowest end
    end
  end
  return best
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

--- The orders that New model proposes; `settings.first` is the number of the question.
function views.first(settings, values)
  local known, orders = pcall(first_orders, values[settings.estimation])
  return {number = settings.first, orders = known and orders or {}}
end

function views.variables(settings, values) return describe(values) end

function views.models(settings, values)
  local rows = {}
  for _, name in ipairs(settings.all_models or {}) do
    if is_model(values[name]) then measured(name, values[name], settings, values, rows) end
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
