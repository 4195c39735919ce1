-- Block diagrams: a list of blocks on a grid and of arrows between them, drawn with lines of LaTeX's own or as SVG.
--
--   ::: block-diagram
--   - u = signal 1 1: $u$
--   - G = block 2 1: $G(s)$
--   - y = signal 3 1: $y$
--   - u -> G -> y
--
--   What it shows {#fig:loop}
--   :::
--
-- Numbers are column and row, from the upper left corner; kinds are block, sum, signal (text without a frame) and branch
-- (a dot). An arrow -> is straight, -| goes along first and then up or down, |- the other way round; what stands behind a
-- colon is written beside the last arrow. Nothing of the list but labels, which are checked as all text is, and numbers
-- reaches LaTeX or HTML.
local diagram = {}
local canvas = dofile((PANDOC_SCRIPT_FILE:match("^(.*)/") or ".") .. "/canvas.lua")

local kinds = { block = true, sum = true, signal = true, branch = true }
local arrows = { ["->"] = true, ["-|"] = true, ["|-"] = true }
local most_nodes, most_columns, most_rows = 60, 12, 12

-- cm
local text_width, widest_column, row_height = 15.8, 3.0, 1.5
local widest_block, shortest_arrow, block_height, sum_radius = 2.05, 0.6, 0.9, 0.25

local function words_and_label(inlines)
  local words = {}
  for i, element in ipairs(inlines) do
    if element.t == "Str" then
      local word, colon = element.text:match("^(.-)(:?)$")
      if word ~= "" then words[#words + 1] = word end
      if colon == ":" then
        local label = pandoc.List {}
        for k = i + 1, #inlines do
          if k > i + 1 or inlines[k].t ~= "Space" then label:insert(inlines[k]) end
        end
        return words, label
      end
    elseif element.t ~= "Space" and element.t ~= "SoftBreak" then
      return words, nil, pandoc.utils.stringify(element)
    end
  end
  return words, pandoc.List {}
end

-- items: lists of inlines. Returns {nodes =, arrows =, columns =, rows =}; nothing after a complaint, which is reported
-- by complain(text to look for, code, ...); filter_messages.cpp has the sentences.
function diagram.read(items, complain)
  local result = { nodes = {}, order = {}, arrows = {}, columns = 1, rows = 1 }
  local failed = false
  local function wrong(words, ...)
    failed = true
    complain(table.concat(words, " "), ...)
  end
  local function read_node(words, label)
    local name, kind, column, row = words[1], words[3], math.tointeger(tonumber(words[4])), math.tointeger(tonumber(words[5]))
    if #words ~= 5 or not name:find("^%a[%w_]*$") then
      return wrong(words, "node")
    elseif not kinds[kind] then
      return wrong(words, "kind", kind)
    elseif not column or not row or column < 1 or row < 1 or column > most_columns or row > most_rows then
      return wrong(words, "place", most_columns)
    elseif result.nodes[name] then
      return wrong(words, "node-twice", name)
    elseif #result.order == most_nodes then
      return wrong(words, "most-nodes", most_nodes)
    end
    result.nodes[name] = { kind = kind, column = column, row = row, label = label }
    result.order[#result.order + 1] = name
    result.columns, result.rows = math.max(result.columns, column), math.max(result.rows, row)
  end
  local function read_arrows(words, label)
    for i = 2, #words - 1, 2 do
      if not arrows[words[i]] then return wrong(words, "sign", words[i]) end
    end
    for i = 1, #words, 2 do
      if not result.nodes[words[i]] then return wrong(words, "no-node", words[i]) end
    end
    if #words < 3 or #words % 2 == 0 then return wrong(words, "arrow") end
    for i = 1, #words - 2, 2 do
      local from, to = result.nodes[words[i]], result.nodes[words[i + 2]]
      if words[i + 1] == "->" and (from.row == to.row) == (from.column == to.column) then
        return wrong(words, "not-straight", words[i], words[i + 2])
      end
      result.arrows[#result.arrows + 1] =
        { from = from, to = to, way = words[i + 1], label = i + 2 == #words and label or pandoc.List {} }
    end
  end
  for _, inlines in ipairs(items) do
    local words, label, other = words_and_label(inlines)
    if other then
      wrong({ other }, "label-first")
    elseif words[2] == "=" then
      read_node(words, label)
    else
      read_arrows(words, label)
    end
  end
  return not failed and result or nil
end

-- Drawing --------------------------------------------------------------------------------------------------------

local function center(drawing, node)
  return (node.column - 0.5) * drawing.step, (drawing.rows - node.row + 0.5) * row_height
end

local function block_width(drawing) return math.min(widest_block, drawing.step - shortest_arrow) end

-- Half the width and height that arrows stop at.
local function reach(drawing, node)
  if node.kind == "block" then return 0.5 * block_width(drawing), 0.5 * block_height end
  if node.kind == "sum" then return sum_radius, sum_radius end
  if node.kind == "branch" then return 0, 0 end
  return 0.3, 0.3
end

local function sign(x) return x > 0 and 1 or x < 0 and -1 or 0 end

-- The corners of an arrow, from the rim of one node to that of the other.
local function path(drawing, arrow)
  local x0, y0 = center(drawing, arrow.from)
  local x1, y1 = center(drawing, arrow.to)
  local rx0, ry0 = reach(drawing, arrow.from)
  local rx1, ry1 = reach(drawing, arrow.to)
  local dx, dy = sign(x1 - x0), sign(y1 - y0)
  if dx == 0 then return { { x0, y0 + dy * ry0 }, { x1, y1 - dy * ry1 } } end
  if dy == 0 then return { { x0 + dx * rx0, y0 }, { x1 - dx * rx1, y1 } } end
  if arrow.way == "-|" then return { { x0 + dx * rx0, y0 }, { x1, y0 }, { x1, y1 - dy * ry1 } } end
  return { { x0, y0 + dy * ry0 }, { x0, y1 }, { x1 - dx * rx1, y1 } }
end

-- Beside the middle of the last piece; returns the width that a label may take, too.
local function label_place(corners)
  local a, b = corners[#corners - 1], corners[#corners]
  if a[2] == b[2] then return 0.5 * (a[1] + b[1]), a[2] + 0.26, math.max(1, math.abs(b[1] - a[1])) end
  return a[1] + 0.3, 0.5 * (a[2] + b[2]), 1
end

local latex = {}

function latex.segment(_, a, b, with_head)
  local command = with_head and "vector" or "line"
  local length = math.abs(b[1] - a[1]) + math.abs(b[2] - a[2])
  return string.format("\\put(%.3f,%.3f){\\%s(%d,%d){%.3f}}", a[1], a[2], command, sign(b[1] - a[1]), sign(b[2] - a[2]), length)
end

function latex.frame(drawing, node, x, y)
  if node.kind == "block" then
    local width = block_width(drawing)
    return string.format("\\put(%.3f,%.3f){\\framebox(%.3f,%.3f){}}", x - 0.5 * width, y - 0.5 * block_height, width, block_height)
  elseif node.kind == "sum" then
    return string.format("\\put(%.3f,%.3f){\\circle{%.3f}}", x, y, 2 * sum_radius)
  elseif node.kind == "branch" then
    return string.format("\\put(%.3f,%.3f){\\circle*{.12}}", x, y)
  end
  return ""
end

local svg = {}
local pixels = canvas.pixels

local function svg_y(drawing, y) return (drawing.rows * row_height - y) * pixels end

-- The heads of SVG's arrows
svg.begin = '<defs><marker id="dynlab-head" viewBox="0 0 10 10" refX="10" refY="5" markerWidth="8" markerHeight="8" ' ..
  'orient="auto"><path d="M0 1 L10 5 L0 9 z" fill="currentColor"/></marker></defs>'

function svg.segment(drawing, a, b, with_head)
  return string.format('<line x1="%.1f" y1="%.1f" x2="%.1f" y2="%.1f" stroke="currentColor"%s/>', a[1] * pixels,
    svg_y(drawing, a[2]), b[1] * pixels, svg_y(drawing, b[2]), with_head and ' marker-end="url(#dynlab-head)"' or "")
end

function svg.frame(drawing, node, x, y)
  local cx, cy = x * pixels, svg_y(drawing, y)
  if node.kind == "block" then
    local width, height = block_width(drawing) * pixels, block_height * pixels
    return string.format('<rect x="%.1f" y="%.1f" width="%.1f" height="%.1f" fill="none" stroke="currentColor"/>',
      cx - 0.5 * width, cy - 0.5 * height, width, height)
  elseif node.kind == "sum" then
    return string.format('<circle cx="%.1f" cy="%.1f" r="%.1f" fill="none" stroke="currentColor"/>', cx, cy, sum_radius * pixels)
  elseif node.kind == "branch" then
    return string.format('<circle cx="%.1f" cy="%.1f" r="2.5" fill="currentColor"/>', cx, cy)
  end
  return ""
end

-- The drawing as inlines for "latex" or "html".
function diagram.draw(drawing, format)
  local pen = format == "latex" and latex or svg
  drawing.step = math.min(widest_column, text_width / drawing.columns)
  local paper = canvas.new(format, drawing.columns * drawing.step, drawing.rows * row_height)
  if pen.begin then paper:add(pen.begin) end
  local function label(inlines, x, y, width)
    if #inlines > 0 then paper:label(inlines, x, y, width) end
  end
  for _, arrow in ipairs(drawing.arrows) do
    local corners = path(drawing, arrow)
    for i = 2, #corners do
      paper:add(pen.segment(drawing, corners[i - 1], corners[i], i == #corners and arrow.to.kind ~= "branch"))
    end
    label(arrow.label, label_place(corners))
  end
  for _, name in ipairs(drawing.order) do
    local node = drawing.nodes[name]
    local x, y = center(drawing, node)
    paper:add(pen.frame(drawing, node, x, y))
    label(node.label, x, y, node.kind == "block" and (block_width(drawing) - 0.06) or drawing.step)
  end
  return paper:finish()
end

return diagram
