-- How figures, tables, equations, code and boxes look in LaTeX (pages or slides), HTML and Markdown.
local layout = {}

local words = {
  en = { fig = "Figure", tbl = "Table", eq = "Equation", sec = "Section", note = "Note", warning = "Take care",
         exercise = "Exercise", missing = "is not there: the script stopped before" },
  fr = { fig = "Figure", tbl = "Tableau", eq = "Équation", sec = "Section", note = "Remarque", warning = "Attention",
         exercise = "Exercice", missing = "manque : le programme s’est arrêté avant" },
}

local latex_escapes = { ["\\"] = "\\textbackslash{}", ["{"] = "\\{", ["}"] = "\\}" }
local html_escapes = { ["&"] = "&amp;", ["<"] = "&lt;", [">"] = "&gt;", ['"'] = "&quot;" }
local zero_width_space = "\u{200B}"
local no_break_space = "\u{A0}"

-- slides: whether LaTeX sets the document as slides; mathematics: what formulas may hold
function layout.new(format, language, slides, mathematics)
  return setmetatable({ format = format, words = words[language], slides = slides, mathematics = mathematics },
    { __index = layout })
end

local function html(text) return (text:gsub('[&<>"]', html_escapes)) end

local function raw(format, text) return pandoc.RawInline(format, text) end

function layout:name_with_number(kind, number)
  return self.words[kind] .. no_break_space .. number
end

-- As a reference shows it. French writes it small, for an article stands before it: "de l'équation 1", "la figure 2".
local french_references = { fig = "figure", tbl = "tableau", eq = "équation", sec = "section" }
function layout:reference(kind, number)
  if self.words ~= words.fr then return self:name_with_number(kind, number) end
  return french_references[kind] .. no_break_space .. number
end

-- French writes decimals behind a comma: in texts that are numbers, with or without an error, a unit or a percent sign.
function layout:number(text)
  if self.words ~= words.fr or not text:find("^[%s±−+%-(]*%d[%d.eE+%-±−%s%%()]*%a*/?%a*$") then return text end
  return (text:gsub("(%d)%.(%d)", "%1,%2"))
end

-- In a formula a comma between braces is no punctuation.
function layout:mathematical_number(text)
  return self.words == words.fr and text:gsub("%.", "{,}") or text
end

-- "Figure 1." before the caption, the same in every format: LaTeX's own counters are not used.
function layout:numbered_caption(kind, number, caption)
  local start = { pandoc.Strong { pandoc.Str(self:name_with_number(kind, number) .. (#caption > 0 and "." or "")) } }
  if #caption > 0 then start[#start + 1] = pandoc.Space() end
  return pandoc.List(start) .. caption
end

local function latex_size(width)
  if not width then return "" end
  local percent = width:match("^(%d+%.?%d*)%%$")
  if percent then return string.format("[width=%.4f\\linewidth]", tonumber(percent) / 100) end
  return "[width=" .. width .. "]"
end

-- file: what the engine put the picture under; caption: inlines, number included, or empty
function layout:figure(file, id, caption, alternative, width)
  if self.slides then
    local content = pandoc.List { raw("latex", "\\begin{dynlabpicture}" .. (id and "\\hypertarget{" .. id .. "}{}" or "") ..
      "\\includegraphics" .. latex_size(width) .. "{" .. file .. "}") }
    content:extend(self:slide_caption(caption))
    content:insert(raw("latex", "\\end{dynlabpicture}"))
    return { pandoc.Plain(content) }
  elseif self.format == "latex" then
    local content = pandoc.List { raw("latex", "\\begin{figure}[H]\\centering" ..
      (id and "\\hypertarget{" .. id .. "}{}" or "") .. "\\includegraphics" .. latex_size(width) .. "{" .. file .. "}") }
    if #caption > 0 then
      content:insert(raw("latex", "\\caption{"))
      content:extend(caption)
      content:insert(raw("latex", "}"))
    end
    content:insert(raw("latex", "\\end{figure}"))
    return { pandoc.Plain(content) }
  elseif self.format == "html" then
    local content = pandoc.List { raw("html", "<figure" .. (id and ' id="' .. id .. '"' or "") .. ">" ..
      self:html_image(file, alternative, width)) }
    if #caption > 0 then
      content:insert(raw("html", "<figcaption>"))
      content:extend(caption)
      content:insert(raw("html", "</figcaption>"))
    end
    content:insert(raw("html", "</figure>"))
    return { pandoc.Plain(content) }
  end
  local blocks = { pandoc.Para { pandoc.Image({ pandoc.Str(alternative) }, file) } }
  if #caption > 0 then blocks[2] = pandoc.Para(caption) end
  return blocks
end

function layout:slide_caption(caption)
  if #caption == 0 then return {} end
  return pandoc.List { raw("latex", "\\dynlabcaption{") } .. caption .. { raw("latex", "}") }
end

function layout:html_image(file, alternative, width)
  return '<img src="' .. file .. '" alt="' .. html(alternative) .. '"' ..
    (width and ' style="width:' .. width .. '"' or "") .. " />"
end

function layout:inline_image(file, alternative, width)
  if self.format == "latex" then return raw("latex", "\\includegraphics" .. latex_size(width) .. "{" .. file .. "}") end
  if self.format == "html" then return raw("html", self:html_image(file, alternative, width)) end
  return pandoc.Image({ pandoc.Str(alternative) }, file)
end

function layout:equation(mathematics, id, number)
  if self.format == "latex" then
    return { pandoc.Math("DisplayMath", mathematics.text .. "\\tag{" .. number .. "}\\hypertarget{" .. id .. "}{}") }
  elseif self.format == "html" then
    return { pandoc.Span({ mathematics, pandoc.Span({ pandoc.Str("(" .. number .. ")") }, { class = "number" }) },
                         { id = id, class = "equation" }) }
  end
  return { mathematics, pandoc.Space(), pandoc.Str("(" .. number .. ")") }
end

-- Long words get places where a line may break; LaTeX needs them in code, HTML scrolls.
local function breakable(text, longest)
  return (text:gsub("%S+", function(word)
    if utf8.len(word) and utf8.len(word) > longest then
      return (word:gsub(utf8.charpattern, "%0" .. zero_width_space))
    end
  end))
end

function layout:inline_code(code)
  if self.format ~= "latex" then return nil end
  code.text = breakable(code.text, 24)
  return code
end

-- Printed blocks of so many lines, a presented model among them, stay on one page.
local most_kept_together = 20

-- Code of so many lines stays on one page; of longer code so many lines at least stand below the text above it.
local short_code, least_code = 10, 6

local function line_count(text) return select(2, text:gsub("\n", "\n")) + 1 end

local verbatim_environments = { output = "dynlaboutput", error = "dynlaberror" }

-- Begins a new page unless so many lines fit on this one.
function layout:need(lines)
  if self.slides then return pandoc.Null() end
  return pandoc.RawBlock("latex", string.format("\\dynlabneed{%d\\baselineskip}", lines))
end

function layout:code_block(block)
  if self.format == "latex" then
    block.text = breakable(block.text, 60)
    local class = block.classes[1]
    if class and not verbatim_environments[class] and class ~= "text" then
      local lines = line_count(block.text)
      return { self:need(lines <= short_code and lines or least_code), block }
    end
    local environment = verbatim_environments[class] or "Highlighting"
    local options = line_count(block.text) <= most_kept_together and "[samepage=true]" or ""
    return pandoc.RawBlock("latex", "\\begin{Shaded}\n\\begin{" .. environment .. "}" .. options .. "\n" ..
      block.text:gsub("[\\{}]", latex_escapes) .. "\n\\end{" .. environment .. "}\n\\end{Shaded}")
  elseif self.format == "html" then
    -- Pandoc would look for a language "output" in all its syntax definitions, which takes 0.3 s.
    local class = block.classes[1]
    if class and not verbatim_environments[class] and class ~= "text" then return block end
    return pandoc.RawBlock("html", "<pre" .. (class and ' class="' .. class .. '"' or "") .. "><code>" ..
      html(block.text) .. "</code></pre>")
  elseif self.format == "markdown" then
    block.classes = block.classes:filter(function(class) return class ~= "cell" end)
    return block
  end
end

-- In the place of what a script that stopped has not reported, within a line or alone.
function layout:missing_word(name) return pandoc.Strong { pandoc.Str("[" .. name .. "]") } end

function layout:missing_block(name)
  return pandoc.Para { pandoc.Strong { pandoc.Str("[" .. name .. " " .. self.words.missing .. "]") } }
end

-- What a filter returns in a list is not filtered again, but what stands in it is: hence the division around the blocks.
local function within(format, begin, blocks, finish)
  return pandoc.List { pandoc.RawBlock(format, begin), pandoc.Div(blocks), pandoc.RawBlock(format, finish) }
end

function layout:box(division, kind)
  local title = self.words[kind]
  if self.format == "latex" then
    local colour = kind == "warning" and "dlerror" or "dlnote"
    return within("latex", "\\begin{dynlabbox}{" .. colour .. "}{" .. title .. "}", division.content, "\\end{dynlabbox}")
  elseif self.format == "html" then
    division.content:insert(1, pandoc.Para { pandoc.Strong { pandoc.Str(title) } })
    return pandoc.Div(division.content, { class = "box " .. kind })
  end
  division.content:insert(1, pandoc.Para { pandoc.Strong { pandoc.Str(title) } })
  return pandoc.BlockQuote(division.content)
end

-- Below the title, HTML and Markdown sections start at the second level.
function layout:heading_level(level, has_title)
  return (has_title and self.format ~= "latex") and math.min(level + 1, 6) or level
end

function layout:page_break()
  if self.slides then return {} end
  if self.format == "latex" then return pandoc.RawBlock("latex", "\\clearpage") end
  if self.format == "html" then return pandoc.RawBlock("html", '<div class="pagebreak"></div>') end
  return {}
end

-- Columns, a list of {blocks, percent}, stand side by side on slides and in HTML, one after the other elsewhere.
function layout:columns(list)
  local blocks = pandoc.List {}
  local function around(format, begin, finish)
    blocks:insert(1, pandoc.RawBlock(format, begin))
    blocks:insert(pandoc.RawBlock(format, finish))
  end
  for _, column in ipairs(list) do
    local content, percent = column[1], column[2]
    if self.slides then
      local begin = string.format("\\begin{column}{%.4f\\textwidth}", percent / 100)
      blocks:extend(within("latex", begin, content, "\\end{column}"))
    elseif self.format == "html" then
      blocks:extend(within("html", string.format('<div class="column" style="width:%g%%">', percent), content, "</div>"))
    else
      blocks:insert(pandoc.Div(content))
    end
  end
  if self.slides then
    around("latex", "\\begin{columns}[T,onlytextwidth]", "\\end{columns}")
  elseif self.format == "html" then
    around("html", '<div class="columns">', "</div>")
  end
  return blocks
end

-- Beamer must know of the slides on which code stands; Pandoc sees only code it writes itself.
function layout:mark_slides_with_code(blocks)
  if not self.slides then return blocks end
  local title
  for i, block in ipairs(blocks) do
    if block.t == "Header" and block.level == 1 then title = block end
    if block.t == "RawBlock" and block.text:find("\\begin{Shaded}", 1, true) then
      if not title then
        title = pandoc.Header(1, {}, { class = "fragile" })
        blocks:insert(1, title)
        return self:mark_slides_with_code(blocks)
      end
      title.classes = { "fragile" }
    end
  end
  return blocks
end

-- Tables ---------------------------------------------------------------------------------------------------------

local function is_number(cell)
  return cell == "" or cell == "-" or tonumber((cell:gsub("%s*%%$", ""))) ~= nil or
    cell:match("^[+-]?[%d.]+e?[+-]?%d*%s*±%s*[%d.]+e?[+-]?%d*$") ~= nil
end

-- A cell's text, with formulas between dollar signs as Pandoc's Markdown knows them. A formula that the document's own
-- text might not hold stays text.
function layout:cell_inlines(text)
  local function allowed(formula)
    return ("{" .. formula .. "}"):find("^%b{}$") and #self.mathematics.refused_in(formula) == 0
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
local most_table_lines = 24

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

-- data: {header = {...}, rows = {{...}, ...}} of plain text; returns Pandoc's table, its type size and its
-- lines, nil when it is too wide for the page
function layout:table(data, caption)
  local columns = #data.header
  local numeric, natural, least, alignments = {}, {}, {}, {}
  for c = 1, columns do
    local title = seen(data.header[c])
    numeric[c], natural[c] = #data.rows > 0, utf8.len(title) or #title
    least[c] = longest_word(title)
    for _, row in ipairs(data.rows) do
      local text = seen(row[c])
      numeric[c] = numeric[c] and is_number(row[c])
      natural[c] = math.max(natural[c], utf8.len(text) or #text)
      least[c] = math.max(least[c], longest_word(text))
    end
    if numeric[c] then least[c] = natural[c] end
    alignments[c] = numeric[c] and pandoc.AlignRight or pandoc.AlignLeft
  end
  local widths, size, characters = fit_columns(least, natural)
  local lines = widths and table_lines(data.rows, widths, characters)
  if self.format ~= "latex" or self.slides then
    widths = {}
    for c = 1, columns do widths[c] = 0 end
  elseif not widths then
    return nil
  end
  local function cell(text, is_numeric)
    if text == "" then return {} end
    if is_numeric and self.format ~= "markdown" then text = text:gsub("^%-(%d)", "\u{2212}%1") end
    text = self:number(text)
    if self.format == "html" and not is_numeric and is_number_like(text) then
      return { pandoc.Plain { pandoc.Span({ pandoc.Str(text) }, { class = "number" }) } }
    end
    return { pandoc.Plain(self:cell_inlines(text)) }
  end
  local header, rows = {}, {}
  for c = 1, columns do header[c] = cell(data.header[c]) end
  for r, row in ipairs(data.rows) do
    rows[r] = {}
    for c = 1, columns do rows[r][c] = cell(row[c], numeric[c]) end
  end
  local simple = pandoc.SimpleTable(caption, alignments, widths, header, rows)
  return pandoc.utils.from_simple_table(simple), size, lines
end

local column_letters = { AlignRight = "r", AlignCenter = "c" }

-- Slides have no pages to break, and columns that longtable cannot stand in.
function layout:slide_table(element, id)
  local simple = pandoc.utils.to_simple_table(element)
  local letters = ""
  for _, alignment in ipairs(simple.aligns) do letters = letters .. (column_letters[tostring(alignment)] or "l") end
  local content = pandoc.List { raw("latex", (id and "\\hypertarget{" .. id .. "}{}" or "") ..
    "\\begin{dynlabtable}\\begin{tabular}{@{}" .. letters .. "@{}}\\toprule ") }
  local function add(row)
    for c, cell in ipairs(row) do
      if c > 1 then content:insert(raw("latex", " & ")) end
      content:extend(pandoc.utils.blocks_to_inlines(cell))
    end
    content:insert(raw("latex", " \\\\ "))
  end
  add(simple.header)
  content:insert(raw("latex", "\\midrule "))
  for _, row in ipairs(simple.rows) do add(row) end
  content:insert(raw("latex", "\\bottomrule\\end{tabular}\\end{dynlabtable}"))
  content:extend(self:slide_caption(simple.caption))
  return { pandoc.Plain(content) }
end

-- A short table does not begin where it would be broken; four lines are for caption and rules.
function layout:place_table(element, id, size, lines)
  if self.slides then return self:slide_table(element, id) end
  if self.format == "latex" then
    local start = "{" .. (size or "\\normalsize") .. (id and "\\hypertarget{" .. id .. "}{}" or "")
    local blocks = pandoc.List { pandoc.RawBlock("latex", start), element, pandoc.RawBlock("latex", "}") }
    if lines and lines <= most_table_lines then blocks:insert(1, self:need(lines + 4)) end
    return blocks
  elseif self.format == "html" then
    return { pandoc.Div({ element }, { id = id or "", class = "table" }) }
  end
  return { element }
end

return layout
