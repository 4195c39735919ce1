-- How figures, tables, equations, code and boxes look in LaTeX (pages or slides), HTML and Markdown.
local layout = {}

local words = {
  en = { fig = "Figure", tbl = "Table", eq = "Equation", sec = "Section", note = "Note", warning = "Take care",
         exercise = "Exercise", references = "References", missing = "is not there yet",
         answer = "Answer", answers = "Answers to the questions", right = "Right.", wrong = "Wrong." },
  fr = { fig = "Figure", tbl = "Tableau", eq = "Équation", sec = "Section", note = "Remarque", warning = "Attention",
         exercise = "Exercice", references = "Références", missing = "n’est pas encore là",
         answer = "Réponse", answers = "Réponses aux questions", right = "Juste.", wrong = "Faux." },
}

-- in code; a plain backtick would be copied as a quotation mark
local latex_escapes = { ["\\"] = "\\textbackslash{}", ["{"] = "\\{", ["}"] = "\\}", ["`"] = "\\textasciigrave{}" }
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
  if text:find("%d%.%d+%.%d") then return text end  -- a version or a date
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

-- drawn: inlines; caption: inlines, number included, or empty
function layout:drawn_figure(drawn, id, caption)
  local target = id and "\\hypertarget{" .. id .. "}{}" or ""
  local content = pandoc.List {}
  if self.slides then
    content:insert(raw("latex", "\\begin{dynlabpicture}" .. target))
    content:extend(drawn)
    content:extend(self:slide_caption(caption))
    content:insert(raw("latex", "\\end{dynlabpicture}"))
  elseif self.format == "latex" then
    -- What has a number may stand where the page has room; what has none is spoken of where it stands.
    content:insert(raw("latex", "\\begin{figure}[" .. (#caption > 0 and "!htp" or "H") .. "]\\centering" .. target))
    content:extend(drawn)
    if #caption > 0 then
      content:insert(raw("latex", "\\caption{"))
      content:extend(caption)
      content:insert(raw("latex", "}"))
    end
    content:insert(raw("latex", "\\end{figure}"))
  else
    content:insert(raw("html", "<figure" .. (id and ' id="' .. id .. '"' or "") .. ">"))
    content:extend(drawn)
    if #caption > 0 then
      content:insert(raw("html", "<figcaption>"))
      content:extend(caption)
      content:insert(raw("html", "</figcaption>"))
    end
    content:insert(raw("html", "</figure>"))
  end
  return { pandoc.Plain(content) }
end

-- file: what the engine put the picture under
function layout:figure(file, id, caption, alternative, width)
  if self.format == "latex" then
    return self:drawn_figure({ raw("latex", "\\includegraphics" .. latex_size(width) .. "{" .. file .. "}") }, id, caption)
  elseif self.format == "html" then
    return self:drawn_figure({ raw("html", self:html_image(file, alternative, width)) }, id, caption)
  end
  local blocks = { pandoc.Para { pandoc.Image({ pandoc.Str(alternative) }, file) } }
  if #caption > 0 then blocks[2] = pandoc.Para(caption) end
  return blocks
end

-- drawing: of the module diagram (diagram.lua or drawing.lua). Markdown has none: the caption stands alone.
function layout:diagram(drawing, diagram, id, caption)
  if self.format == "markdown" then return #caption > 0 and { pandoc.Para(caption) } or {} end
  return self:drawn_figure(diagram.draw(drawing, self.format), id, caption)
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

-- Code and printed blocks of so many lines stay on one page; of longer ones so many lines at least stand below the text
-- above them: more would leave white at the ends of pages.
local least_lines = 6

local function line_count(text) return select(2, text:gsub("\n", "\n")) + 1 end

local verbatim_environments = { output = "dynlaboutput", error = "dynlaberror" }

-- Begins a new page unless so many lines fit on this one.
function layout:need(lines)
  if self.slides then return pandoc.Null() end
  return pandoc.RawBlock("latex", string.format("\\dynlabneed{%d\\baselineskip}", lines))
end

-- A paragraph that is one bold line heads what follows: better no page ends behind it, also where a list follows, before
-- which LaTeX likes to end pages unless it stands behind a heading.
function layout:heading_line(paragraph)
  local inlines = paragraph.content
  if self.format ~= "latex" or self.slides or #inlines ~= 1 or inlines[1].t ~= "Strong" then return nil end
  return pandoc.Blocks { pandoc.Para { inlines[1], raw("latex", "\\nopagebreak[3]") },
    pandoc.RawBlock("latex", "\\csname @afterheading\\endcsname") }
end

-- A formula in a paragraph of its own goes on with the sentence before it: no page ends between them.
function layout:keep_formulas_with_their_text(blocks)
  if self.format ~= "latex" or self.slides then return blocks end
  for i = 2, #blocks do
    local first = blocks[i].t == "Para" and blocks[i].content[1]
    if first and first.t == "Math" and first.mathtype == "DisplayMath" and blocks[i - 1].t == "Para" then
      blocks[i - 1].content:insert(raw("latex", "\\nopagebreak"))
    end
  end
  return blocks
end

function layout:need_for_lines(text) return self:need(math.min(line_count(text), least_lines)) end

function layout:code_block(block)
  if self.format == "latex" then
    block.text = breakable(block.text, 60)
    local class = block.classes[1]
    if class and not verbatim_environments[class] and class ~= "text" then
      return { self:need_for_lines(block.text), block }
    end
    local environment = verbatim_environments[class] or "Highlighting"
    -- Long lines of printed text are broken, but never between a number and its percent sign. Code is not changed: readers copy it.
    local text = environment == "Highlighting" and block.text or block.text:gsub("(%d) %%", "%1\u{a0}%%")
    return { self:need_for_lines(block.text), pandoc.RawBlock("latex", "\\begin{Shaded}\n\\begin{" .. environment ..
      "}\n" .. text:gsub("[\\{}`]", latex_escapes) .. "\n\\end{" .. environment .. "}\n\\end{Shaded}") }
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

-- In the place of what points to nothing, within a line or alone. LaTeX's French would put a space between the marks.
function layout:gap_mark() return self.format == "latex" and raw("latex", "\\string?\\string?") or pandoc.Str("??") end

function layout:gap() return pandoc.Strong { self:gap_mark() } end

function layout:gap_block(name)
  return pandoc.Para { pandoc.Strong { self:gap_mark(), pandoc.Str(" [" .. name .. "]") } }
end

-- What a filter returns in a list is not filtered again, but what stands in it is: hence the division around the blocks.
local function within(format, begin, blocks, finish)
  return pandoc.List { pandoc.RawBlock(format, begin), pandoc.Div(blocks), pandoc.RawBlock(format, finish) }
end

function layout:box(division, kind)
  local title = self.words[kind]
  if self.format == "latex" then
    local color = kind == "warning" and "dlerror" or "dlnote"
    return within("latex", "\\begin{dynlabbox}{" .. color .. "}{" .. title .. "}", division.content, "\\end{dynlabbox}")
  elseif self.format == "html" then
    division.content:insert(1, pandoc.Para { pandoc.Strong { pandoc.Str(title) } })
    return pandoc.Div(division.content, { class = "box " .. kind })
  end
  division.content:insert(1, pandoc.Para { pandoc.Strong { pandoc.Str(title) } })
  return pandoc.BlockQuote(division.content)
end

-- A paragraph and its list, of which so many lines at least stand together.
function layout:kept(blocks)
  if self.format ~= "latex" then return pandoc.Div(blocks) end
  return { self:need(least_lines), pandoc.Div(blocks) }
end

-- What the reader unfolds; on paper it stands open.
function layout:folded(blocks, title)
  if self.format ~= "html" then return pandoc.Div(blocks) end
  return within("html", '<details class="answer"><summary>' .. html(title) .. "</summary>", blocks, "</details>")
end

-- A question with its answer; `right`: the places of the options that are, "1 3".
function layout:question(blocks, right)
  if self.format ~= "html" then return pandoc.Div(blocks) end
  return within("html", '<div class="choice" data-right="' .. right:gsub("[^%d ]", "") .. '">', blocks, "</div>")
end

-- A list of literature, as Pandoc's citeproc leaves it: entries with hanging first lines.
function layout:literature(list)
  if self.format ~= "latex" then return list end
  local blocks = pandoc.List { pandoc.RawBlock("latex", "\\begin{dynlabliterature}") }
  for _, entry in ipairs(list.content) do
    local inlines = pandoc.utils.blocks_to_inlines(entry.content)
    inlines:insert(1, raw("latex", "\\item\\hypertarget{" .. entry.identifier .. "}{}"))
    blocks:insert(pandoc.Plain(inlines))
  end
  blocks:insert(pandoc.RawBlock("latex", "\\end{dynlabliterature}"))
  return pandoc.Div(blocks)
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

return layout
