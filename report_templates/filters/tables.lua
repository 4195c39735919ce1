-- Tables: their cells, how wide their columns are, and how they stand on pages, on slides and in HTML. One that fits a
-- page is never broken: with a number it floats as figures do, without one it stays where it is written.
local tables = {}

-- layout: of layout.lua, which knows format and language
function tables.new(layout) return setmetatable({ layout = layout }, { __index = tables }) end

local function raw(format, text) return pandoc.RawInline(format, text) end

-- A script may write a minus as it is printed.
local function with_typed_sign(cell) return (cell:gsub("^\u{2212}", "-")) end

-- The parts of a cell that is a number: sign and digits before the point, point and digits after it, then the same of
-- an error behind ±, then a percent sign. Nothing for other texts.
local function number_parts(cell)
  local value, percent = with_typed_sign(cell):match("^(.-)(%s*%%?)$")
  local main, gap, err = value:match("^(.-)(%s*±%s*)(.*)$")
  main, gap, err = main or value, gap or "", err or ""
  local whole, fraction = main:match("^([+-]?%d+)(%.?%d*)$")
  local error_whole, error_fraction = err:match("^(%d+)(%.?%d*)$")
  if not whole or err ~= "" and not error_whole then return nil end
  return { whole, fraction, gap, error_whole or "", error_fraction or "", percent }
end

local function is_number(cell)
  cell = with_typed_sign(cell)
  return cell == "" or cell == "-" or number_parts(cell) ~= nil or tonumber((cell:gsub("%s*%%$", ""))) ~= nil or
    cell:match("^[+-]?[%d.]+e?[+-]?%d*%s*±%s*[%d.]+e?[+-]?%d*$") ~= nil
end

-- What must stand unseen within the numbers of a right-aligned column so that their points stand below each other, a
-- table for each row; nothing where powers of ten occur.
local function paddings(rows, column)
  local parts, longest = {}, { "", "", "", "", "", "" }
  for r, row in ipairs(rows) do
    local cell = row[column]
    if cell ~= "" and cell ~= "-" then
      parts[r] = number_parts(cell)
      if not parts[r] then return {} end
      for i, part in ipairs(parts[r]) do
        if #part > #longest[i] then longest[i] = part end
      end
    end
  end
  local function rest(part, i) return longest[i]:sub(#part + 1) end
  local result = {}
  for r, part in pairs(parts) do
    local has_error = part[4] ~= ""
    result[r] = {
      parts = part,
      after_fraction = rest(part[2], 2),
      before_error = has_error and string.rep("0", #rest(part[4], 4)) or "",
      after_error = has_error and rest(part[5], 5) or longest[3] .. longest[4] .. longest[5],
      at_end = rest(part[6], 6),
    }
  end
  return result
end

-- Takes room and prints nothing.
function tables:unseen(text)
  if text == "" then return pandoc.List {} end
  if self.layout.format == "latex" then return pandoc.List { raw("latex", "\\hphantom{" .. text:gsub("%%", "\\%%") .. "}") } end
  return pandoc.List { pandoc.Span({ pandoc.Str(text) }, { class = "unseen" }) }
end

-- A number with what it needs to stand at the point of its column.
function tables:aligned_number(padding)
  local part = padding.parts
  local function shown(text) return pandoc.Str(self.layout:number((text:gsub("^%-(%d)", "\u{2212}%1")))) end
  local inlines = pandoc.List { shown(part[1] .. part[2]) } .. self:unseen(padding.after_fraction)
  if part[4] ~= "" then
    inlines:insert(pandoc.Str(part[3]))
    inlines = inlines .. self:unseen(padding.before_error)
    inlines:insert(shown(part[4] .. part[5]))
  end
  inlines = inlines .. self:unseen(padding.after_error)
  if part[6] ~= "" then inlines:insert(pandoc.Str(part[6])) end
  return inlines .. self:unseen(padding.at_end)
end

-- A cell's text, with formulas between dollar signs as Pandoc's Markdown knows them. A formula that the document's own
-- text might not hold stays text.
function tables:cell_inlines(text)
  local function allowed(formula)
    return ("{" .. formula .. "}"):find("^%b{}$") and #self.layout.mathematics.refused_in(formula) == 0
  end
  local inlines, from = pandoc.List {}, 1
  for before, formula, after in text:gmatch("()%$([^%s$][^$]*)%$()") do
    if before >= from and not formula:find("%s$") and not text:find("^%d", after) and
      allowed(formula) then
      if before > from then inlines:insert(pandoc.Str(text:sub(from, before - 1))) end
      inlines:insert(pandoc.Math("InlineMath", formula))
      from = after
    end
  end
  if from <= #text then inlines:insert(pandoc.Str(text:sub(from))) end
  return inlines
end

-- The text as it is seen, for measuring: a symbol for each command, no signs of mathematics.
local function seen(text)
  return (text:gsub("%$([^%s$][^$]*)%$", function(formula)
    return (formula:gsub("\\hat%s*", ""):gsub("\\%a+%s*", "x"):gsub("\\.", ""):gsub("[_^{}]", ""))
  end))
end

-- Lines that a table takes whose columns have these relative widths (0: as wide as their text).
local function table_lines(rows, widths, characters)
  local total = 1
  for _, row in ipairs(rows) do
    local lines = 1
    for c, text in ipairs(row) do
      if widths[c] > 0 then lines = math.max(lines, math.ceil((utf8.len(text) or #text) / (widths[c] * characters))) end
    end
    total = total + lines
  end
  return total
end

-- A number with what may stand around it: signs, an error, brackets, a percent sign.
local function is_number_like(cell)
  local plain = cell:gsub("±", ""):gsub("×", ""):gsub("−", "")
  return plain:find("%d") ~= nil and plain:find("^[%d%s.,eE+%-()%%]+$") ~= nil
end

local function longest_word(text)
  local longest = 0
  for word in text:gmatch("%S+") do longest = math.max(longest, utf8.len(word) or #word) end
  return longest
end

-- Tables of so many lines are kept on one page.
local most_table_lines = 36

-- Type sizes with the width of a character in points; the text is 455 points wide, columns stand 12 points apart.
local sizes = { { "\\normalsize", 5.5 }, { "\\small", 5.0 }, { "\\footnotesize", 4.6 }, { "\\scriptsize", 4.25 } }
local text_width, column_gap = 455, 12

-- least, natural: characters each column needs at least and would like. Returns relative widths (0: natural), the
-- type size with which the table stays inside the text, and the characters of a line; nothing when it cannot.
local function fit_columns(least, natural)
  local room = text_width - column_gap * (#least - 1)
  local least_sum, natural_sum, widths = 0, 0, {}
  for c = 1, #least do
    least_sum, natural_sum, widths[c] = least_sum + least[c], natural_sum + natural[c], 0
  end
  for _, size in ipairs(sizes) do
    local name, character = size[1], size[2]
    if natural_sum * character <= room then return widths, name, room / character end
    if least_sum < natural_sum and (least_sum + 8) * character <= room then
      -- What the longest words leave of the line goes to the columns that have more text.
      local left = room / character - least_sum
      for c = 1, #least do
        local more = left * (natural[c] - least[c]) / (natural_sum - least_sum)
        widths[c] = (least[c] + more) * character / room
      end
      return widths, name, room / character
    end
  end
end

-- Relative widths, type size and lines of a table of these texts; the columns with numbers are not wrapped.
local function measured(data, numeric)
  local natural, least = {}, {}
  for c, title in ipairs(data.header) do
    title = seen(title)
    natural[c], least[c] = utf8.len(title) or #title, longest_word(title)
    for _, row in ipairs(data.rows) do
      local text = seen(row[c])
      natural[c] = math.max(natural[c], utf8.len(text) or #text)
      least[c] = math.max(least[c], longest_word(text))
    end
    if numeric[c] then least[c] = natural[c] end
  end
  local widths, size, characters = fit_columns(least, natural)
  return widths, size, widths and table_lines(data.rows, widths, characters)
end

function tables:cell(text)
  if text == "" then return {} end
  local shown = self.layout:number(text)
  if self.layout.format == "html" and is_number_like(shown) then
    return { pandoc.Plain { pandoc.Span({ pandoc.Str(shown) }, { class = "number" }) } }
  end
  return { pandoc.Plain(self:cell_inlines(shown)) }
end

-- A cell of a column of numbers.
function tables:number_cell(text, padding)
  if text == "" then return {} end
  if self.layout.format == "markdown" then return { pandoc.Plain { pandoc.Str(self.layout:number(text)) } } end
  if padding then return { pandoc.Plain(self:aligned_number(padding)) } end
  return { pandoc.Plain { pandoc.Str(self.layout:number((text:gsub("^%-(%d)", "\u{2212}%1")))) } }
end

-- data: {header = {...}, rows = {{...}, ...}} of plain text; returns Pandoc's table, its type size and its
-- lines, nil when it is too wide for the page
function tables:recorded(data, caption)
  local numeric, alignments, padding = {}, {}, {}
  for c = 1, #data.header do
    numeric[c] = #data.rows > 0
    for _, row in ipairs(data.rows) do numeric[c] = numeric[c] and is_number(row[c]) end
    alignments[c] = numeric[c] and pandoc.AlignRight or pandoc.AlignLeft
    padding[c] = numeric[c] and paddings(data.rows, c) or {}
  end
  local widths, size, lines = measured(data, numeric)
  if self.layout.format ~= "latex" or self.layout.slides then
    widths = {}
    for c = 1, #data.header do widths[c] = 0 end
  elseif not widths then
    return nil
  end
  local header, rows = {}, {}
  for c, title in ipairs(data.header) do header[c] = self:cell(title) end
  for r, row in ipairs(data.rows) do
    rows[r] = {}
    for c, text in ipairs(row) do
      rows[r][c] = numeric[c] and self:number_cell(text, padding[c][r]) or self:cell(text)
    end
  end
  local simple = pandoc.SimpleTable(caption, alignments, widths, header, rows)
  return pandoc.utils.from_simple_table(simple), size, lines
end

local letters = { AlignRight = "r", AlignCenter = "c" }
local starts = { AlignRight = "\\raggedleft", AlignCenter = "\\centering" }

local function column_letter(alignment, width, columns)
  if width == 0 then return letters[alignment] or "l" end
  return string.format(">{%s\\arraybackslash}p{(\\linewidth - %d\\tabcolsep) * \\real{%.4f}}",
    starts[alignment] or "\\raggedright", 2 * columns - 2, width)
end

-- The rows of a table between rules, as inlines for LaTeX.
local function tabular(simple)
  local columns = ""
  for c, alignment in ipairs(simple.aligns) do
    columns = columns .. column_letter(tostring(alignment), simple.widths[c], #simple.aligns)
  end
  local content = pandoc.List { raw("latex", "\\begin{tabular}{@{}" .. columns .. "@{}}\\toprule ") }
  local function add(row)
    for c, cell in ipairs(row) do
      if c > 1 then content:insert(raw("latex", " & ")) end
      content:extend(pandoc.utils.blocks_to_inlines(cell))
    end
    content:insert(raw("latex", " \\\\ "))
  end
  if #simple.header > 0 then
    add(simple.header)
    content:insert(raw("latex", "\\midrule "))
  end
  for _, row in ipairs(simple.rows) do add(row) end
  content:insert(raw("latex", "\\bottomrule\\end{tabular}"))
  return content
end

local function target(id) return id and "\\hypertarget{" .. id .. "}{}" or "" end

function tables:on_slide(element, id)
  local simple = pandoc.utils.to_simple_table(element)
  local content = pandoc.List { raw("latex", target(id) .. "\\begin{dynlabtable}") }
  content:extend(tabular(simple))
  content:insert(raw("latex", "\\end{dynlabtable}"))
  content:extend(self.layout:slide_caption(simple.caption))
  return { pandoc.Plain(content) }
end

local function on_page(element, id, size)
  local simple = pandoc.utils.to_simple_table(element)
  local floats = #simple.caption > 0
  local content = pandoc.List { raw("latex", "\\begin{table}[" .. (floats and "!htp" or "H") .. "]\\centering" .. target(id)) }
  if floats then
    content:insert(raw("latex", "\\caption{"))
    content:extend(simple.caption)
    content:insert(raw("latex", "}"))
  end
  content:insert(raw("latex", size .. " "))
  content:extend(tabular(simple))
  content:insert(raw("latex", "\\end{table}"))
  return { pandoc.Plain(content) }
end

-- The lines of a table that an author wrote; nothing when a cell holds more than a line of text, or spans others.
local function written_lines(element)
  local simple = pandoc.utils.to_simple_table(element)
  local rows, widths = {}, {}
  for c, width in ipairs(simple.widths) do widths[c] = width end
  for r, row in ipairs(simple.rows) do
    rows[r] = {}
    for c, cell in ipairs(row) do
      if #cell > 1 or cell[1] and cell[1].t ~= "Plain" and cell[1].t ~= "Para" then return nil end
      rows[r][c] = pandoc.utils.stringify(cell)
    end
  end
  return table_lines(rows, widths, text_width / sizes[1][2])
end

-- size, lines: of a table that a script reported; one that an author wrote is measured here.
function tables:place(element, id, size, lines)
  if self.layout.slides then return self:on_slide(element, id) end
  if self.layout.format == "latex" then
    lines = lines or written_lines(element)
    size = size or "\\normalsize"
    if lines and lines <= most_table_lines then return on_page(element, id, size) end
    return { pandoc.RawBlock("latex", "{" .. size .. target(id)), element, pandoc.RawBlock("latex", "}") }
  elseif self.layout.format == "html" then
    return { pandoc.Div({ element }, { id = id or "", class = "table" }) }
  end
  return { element }
end

return tables
