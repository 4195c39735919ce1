-- Turns a dynlab document into what Pandoc writes: fills the slots from slots.lua (written by the engine into the
-- working folder), numbers figures, tables, equations and sections, resolves cross references, and refuses what a
-- document may not contain. Everything found is told to the engine on standard error, one line each:
--   dynlab:use <TAB> number <TAB> figure|image <TAB> name        a picture to be placed under that number
--   dynlab:error <TAB> code <TAB> text to look for <TAB> details...
--   dynlab:gap <TAB> the same                                    what a draft shows as ??
local folder = PANDOC_SCRIPT_FILE:match("^(.*)/") or "."
local safety = dofile(folder .. "/safety.lua")
local mathematics = dofile(folder .. "/mathematics.lua")
local slots = dofile("slots.lua")
local layout = dofile(folder .. "/layout.lua").new(slots.format, slots.language, slots.slides, mathematics)
local tables = dofile(folder .. "/tables.lua").new(layout)
local diagram = dofile(folder .. "/diagram.lua")
local drawing = dofile(folder .. "/drawing.lua")
local choice = dofile(folder .. "/choice.lua")
local lists = dofile(folder .. "/lists.lua")
local citations = dofile(folder .. "/citations.lua")
local values = dofile(folder .. "/values.lua")

local failed = false
local function clean(text) return (tostring(text):gsub("[%c]", " ")) end

local function tell(sign, code, needle, ...)
  local fields = { sign, code, clean(needle) }
  for _, field in ipairs { ... } do fields[#fields + 1] = clean(field) end
  io.stderr:write(table.concat(fields, "\t"), "\n")
end

local function report(...)
  failed = true
  tell("dynlab:error", ...)
end

-- What points to nothing. A draft is made all the same.
local function report_gap(...)
  if slots.draft then tell("dynlab:gap", ...) else report(...) end
end

local shows_gaps = slots.draft and not slots.stopped

-- Slots ----------------------------------------------------------------------------------------------------------

local kinds = { "value", "table", "figure", "text" }

local function entry(kind, name, needle)
  local found = slots[kind][name]
  if found or slots.stopped then return found end  -- what is not there may come
  for _, other in ipairs(kinds) do
    if slots[other][name] then
      report_gap("wrong-kind", needle, kind, name, other)
      return nil
    end
  end
  report_gap("no-entry", needle, kind, name)
end

-- The text of a value; for a missing value nothing, and the sign that a formula shows for it.
local function value_text(name)
  local found = entry("value", name, "`" .. name .. "`")
  if found then return found end
  return nil, slots.stopped and "\\text{[" .. name .. "]}" or shows_gaps and "\\mathbf{??}" or ""
end

-- What stands in the place of an entry that is not there, once that was told or the script stopped before it.
local function missing_block(name)
  return slots.stopped and layout:missing_block(name) or shows_gaps and layout:gap_block(name) or {}
end

local pictures = {}
local picture_count = 0

-- The name under which the engine puts a picture for the writer.
local function picture_file(kind, name)
  local key = kind .. ":" .. name
  if not pictures[key] then
    picture_count = picture_count + 1
    local extension = kind == "figure" and slots.figure_extension or (name:match("%.(%w+)$") or ""):lower()
    pictures[key] = slots.picture_prefix .. picture_count .. "." .. extension
    io.stderr:write(table.concat({ "dynlab:use", tostring(picture_count), kind, clean(name) }, "\t"), "\n")
  end
  return pictures[key]
end

local function read_blocks(markdown) return citations.read(pandoc.read(markdown, slots.reader).blocks, slots.escaped) end

local checked_inlines  -- Markdown to inlines, safely; defined below, with the checks

-- Numbers and labels ---------------------------------------------------------------------------------------------

-- Equations of a lesson's solution, {#eq:solution-name}, are counted by themselves as S1, S2, ..., so that those of its
-- text have the same numbers with and without it.
local counters = { fig = 0, tbl = 0, eq = 0, ["eq:solution"] = 0 }
local section_numbers = { 0, 0, 0, 0, 0, 0 }
local labels = {}  -- label -> what a reference to it shows
local chunk        -- the number of the chunk that is being set, of a document that is set in chunks
if slots.chunks then
  for label, shown in pairs(slots.chunks.labels) do labels[label] = shown end
end

local function define(label, shown)
  if labels[label] then
    report("duplicate-label", "#" .. label, label)
  else
    labels[label] = shown
    if chunk then io.stderr:write(table.concat({ "dynlab:label", chunk, label, clean(shown) }, "\t"), "\n") end
  end
end

local function number(kind, label)
  local of_solution = (label or ""):find("^eq:solution%-") ~= nil
  local counter = of_solution and "eq:solution" or kind
  counters[counter] = counters[counter] + 1
  local shown = (of_solution and "S" or "") .. counters[counter]
  if label then define(label, layout:reference(kind, shown)) end
  return shown
end

local function label_of(identifier, kind)
  if identifier == "" then return nil end
  if identifier:match("^" .. kind .. ":[%w_.:-]+$") then return identifier end
  report("label-kind", "#" .. identifier, identifier, kind)
end

-- Takes a trailing "{#kind:name}" off a list of inlines.
local function take_label(inlines, kind)
  local last = inlines[#inlines]
  local label = last and last.t == "Str" and last.text:match("^{#(.-)}$")
  if not label then return nil end
  inlines:remove()
  while #inlines > 0 and (inlines[#inlines].t == "Space" or inlines[#inlines].t == "SoftBreak") do inlines:remove() end
  return label_of(label, kind)
end

-- Elements -------------------------------------------------------------------------------------------------------

local picture_attributes = { width = true }

local function checked_width(image)
  local bad = safety.unknown_attribute(image.attributes, picture_attributes)
  if bad then report("attribute", bad, bad, "picture") end
  local width = image.attributes.width
  if width and not width:match("^%d+%.?%d*%%$") and not width:match("^%d+%.?%d*[cm]m$") then
    report("width", width, width)
    return nil
  end
  return width
end

local function picture(image)
  local name, pasted = image.src:match("^figure:(.+)$"), image.src:match("^attachment:(.+)$")
  if pasted then
    report_gap("pasted-picture", image.src, pasted)
    return nil, nil, pasted
  end
  if not name then return picture_file("image", image.src), image.caption end
  local found = entry("figure", name, image.src)
  if not found then return nil, nil, name end
  local caption = image.caption
  if #caption == 0 and not slots.slides then caption = checked_inlines(found.caption) end
  return picture_file("figure", name), caption, name
end

-- On slides only what has a label of its own; what stands beside a picture there needs no number to find it.
local function is_numbered(caption, label) return label or #caption > 0 and not slots.slides end

local function figure(image)
  local file, caption, name = picture(image)
  local label = label_of(image.identifier, "fig")
  if not file then return missing_block(name) end
  local alternative = values.plain_text(caption)
  if alternative == "" then alternative = name or image.src end
  if is_numbered(caption, label) and not image.classes:includes("unnumbered") then
    local shown = number("fig", label)
    caption = layout:numbered_caption("fig", shown, caption)
  end
  return layout:figure(file, label, caption, alternative, checked_width(image))
end

local function inline_image(image)
  if image.src:find("^figure:") or image.identifier ~= "" then
    report("figure-not-alone", image.src, image.src)
    return {}
  end
  if image.src:find("^attachment:") then
    report_gap("pasted-picture", image.src, image.src:match(":(.*)$"))
    return shows_gaps and layout:gap() or {}
  end
  local alternative = values.plain_text(image.caption)
  return layout:inline_image(picture_file("image", image.src), alternative, checked_width(image))
end

-- On pages whose script can run again: which value or table this is, so that the page can renew it.
local function named_value(name, printed)
  return slots.names_values and pandoc.Span({ printed }, { class = "value", ["data-name"] = name }) or printed
end

local function named_table(name, blocks)
  if not slots.names_values then return blocks end
  if #blocks == 1 and blocks[1].t == "Div" then
    blocks[1].attributes["data-table"] = name
    return blocks
  end
  return { pandoc.Div(blocks, { class = "table", ["data-table"] = name }) }
end

local function table_slot(division)
  local name = division.attributes.name or ""
  local label = label_of(division.identifier, "tbl")
  local caption = pandoc.List {}
  if #division.content > 1 or (division.content[1] and not division.content[1].content) then
    report("table-content", "name=" .. name, name)
  elseif division.content[1] then
    caption = division.content[1].content
    label = take_label(caption, "tbl") or label
  end
  local found = entry("table", name, "name=" .. name)
  if not found then
    local missing = missing_block(name)
    return missing.t and named_table(name, { missing }) or missing, false
  end
  if is_numbered(caption, label) then caption = layout:numbered_caption("tbl", number("tbl", label), caption) end
  local function filled(row)
    for c, cell in ipairs(row) do row[c] = values.in_cell(cell, layout, value_text, "??") end
  end
  filled(found.header)
  for _, row in ipairs(found.rows) do filled(row) end
  local element, size, lines = tables:recorded(found, caption)
  if not element then
    report("table-width", "name=" .. name, name, #found.header)
    return {}
  end
  element = element:walk { Str = function(text) return pandoc.Str((text.text:gsub(values.dollar, "$"))) end }
  return named_table(name, tables:place(element, label, size, lines)), false
end

local function written_table(element)
  local blocks = element.caption.long
  local label
  if blocks[1] then
    local caption = blocks[1].content
    label = take_label(caption, "tbl")
    if is_numbered(caption, label) then
      blocks[1].content = layout:numbered_caption("tbl", number("tbl", label), caption)
    end
    element.caption.long = blocks
  end
  return tables:place(element, label), false
end

-- The content was written by a script; no text slots inside it, or two texts could name each other for ever.
local function text_slot(division)
  local name = division.attributes.name or ""
  local found = entry("text", name, "name=" .. name)
  if not found then return missing_block(name) end
  return pandoc.Div(read_blocks(found)):walk {
    Div = function(inner)
      if inner.classes[1] == "text" then
        report("nested-text", "name=" .. name, name)
        return {}
      end
    end,
  }.content
end

local function equations(inlines)
  local changed = pandoc.List {}
  local i = 1
  while i <= #inlines do
    local element = inlines[i]
    local display = element.t == "Math" and element.mathtype == "DisplayMath"
    local after = i + 1
    if display and inlines[after] and (inlines[after].t == "Space" or inlines[after].t == "SoftBreak") then
      after = after + 1
    end
    local label, rest
    if display and inlines[after] and inlines[after].t == "Str" then
      label, rest = inlines[after].text:match("^{#(.-)}(.*)$")
    end
    if label then
      label = label_of(label, "eq")
      if label then changed:extend(layout:equation(element, label, number("eq", label))) end
      if rest ~= "" then changed:insert(pandoc.Str(rest)) end
      i = after
    else
      changed:insert(element)
    end
    i = i + 1
  end
  return changed
end

local function header(element)
  local bad = safety.unknown_attribute(element.attributes, {})
  if bad then report("attribute", bad, bad, "heading") end
  local title = slots.section_titles[pandoc.utils.stringify(element.content)]
  if title then element.content = pandoc.List { pandoc.Str(title) } end
  local shown = "“" .. values.plain_text(element.content) .. "”"
  if slots.numbersections and not element.classes:includes("unnumbered") then
    section_numbers[element.level] = section_numbers[element.level] + 1
    for level = element.level + 1, 6 do section_numbers[level] = 0 end
    local section = table.concat(section_numbers, ".", 1, element.level)
    element.content:insert(1, pandoc.Str(section .. "\u{2002}"))
    shown = layout:reference("sec", section)
  end
  if element.identifier:find("^sec:") then
    define(element.identifier, shown)
  elseif element.identifier:find("^%a+:") then
    label_of(element.identifier, "sec")
  end
  element.classes = {}
  element.level = layout:heading_level(element.level, slots.metadata.title)
  return element
end

local function check_mathematics(element)
  element.text = values.in_formula(element.text, layout, value_text, function(code, name, class)
    report(code, "`" .. name .. "`", code == "code-class" and class:sub(2) or name, name)
  end)
  for _, refused in ipairs(mathematics.refused_in(element.text)) do
    local kind, written, needle = table.unpack(refused)
    report("mathematics", needle, kind, written, kind == "command" and mathematics.known() or "")
  end
  return element
end

local division_attributes =
  { table = { name = true }, text = { name = true }, drawing = { name = true }, column = { width = true },
    question = { right = true } }

local function columns(element)
  local list = {}
  for _, inner in ipairs(element.content) do
    local is_column = inner.t == "Div" and inner.classes[1] == "column"
    local width = is_column and inner.attributes.width or ""
    local percent = tonumber(width:match("^(%d+%.?%d*)%%$"))
    if not is_column then
      report("not-a-column", "columns")
    elseif not percent or percent <= 0 or percent > 100 then
      report("column-width", width == "" and "column" or width, width)
    else
      list[#list + 1] = { inner.content, percent }
    end
  end
  return layout:columns(list)
end

-- Chunks: pieces of a document that a page replaces one by one. What is counted when one begins is told, so that it can
-- be set alone another time with the same numbers.
local function tell_count(what, number)
  local fields = { "dynlab:" .. what, number, counters.fig, counters.tbl, counters.eq,
    counters["eq:solution"] }
  for _, section in ipairs(section_numbers) do fields[#fields + 1] = section end
  io.stderr:write(table.concat(fields, "\t"), "\n")
end

local function begin_chunk(element)
  if chunk then tell_count("chunk-end", chunk) end
  chunk = element.attributes.number
  local count = slots.chunks.counts[chunk]
  if count then
    counters.fig, counters.tbl, counters.eq, counters["eq:solution"] = count[1], count[2], count[3], count[4]
    section_numbers = { table.unpack(count, 5) }
  end
  tell_count("chunk", chunk)
  return pandoc.Div(element.content, pandoc.Attr("chunk-" .. chunk))
end

-- A list of nodes and arrows, then at most a line with the caption.
local function block_diagram(division)
  local list, last = division.content[1], division.content[2]
  local label = label_of(division.identifier, "fig")
  local caption = last and last.content or pandoc.List {}
  if not list or list.t ~= "BulletList" or #division.content > 2 or last and last.t ~= "Para" and last.t ~= "Plain" then
    report("diagram", "block-diagram", "list")
    return {}
  end
  label = take_label(caption, "fig") or label
  local items = pandoc.List {}
  for _, blocks in ipairs(list.content) do items:insert(pandoc.utils.blocks_to_inlines(blocks)) end
  local drawing = diagram.read(items, function(needle, ...) report("diagram", needle, ...) end)
  if not drawing then return {} end
  if is_numbered(caption, label) then caption = layout:numbered_caption("fig", number("fig", label), caption) end
  return layout:diagram(drawing, diagram, label, caption), false
end

-- A drawing by its name, and at most a line with the caption.
local function named_drawing(division)
  local name, line = division.attributes.name or "", division.content[1]
  local label = label_of(division.identifier, "fig")
  local caption = line and line.content or pandoc.List {}
  if #division.content > 1 or line and line.t ~= "Para" and line.t ~= "Plain" then
    report("drawing-content", "name=" .. name, name)
    return {}
  end
  label = take_label(caption, "fig") or label
  local drawn, names = drawing.read(name, slots.language, checked_inlines)
  if not drawn then
    report("unknown-drawing", name == "" and "drawing" or "name=" .. name, name, names)
    return {}
  end
  if is_numbered(caption, label) then caption = layout:numbered_caption("fig", number("fig", label), caption) end
  return layout:diagram(drawn, drawing, label, caption), false
end

local function division(element)
  local class = element.classes[1]
  if slots.chunks and class == "chunk" then return begin_chunk(element) end
  local bad = safety.unknown_division_class(element.classes)
  if bad or not class then
    report("division-class", bad or element.identifier, bad or "")
    return {}, false
  end
  local allowed = division_attributes[class] or {}
  local attribute = safety.unknown_attribute(element.attributes, allowed)
  if attribute then report("attribute", attribute, attribute, "block", class) end
  if class == "table" then return table_slot(element) end
  if class == "references" then return pandoc.Div({}, { id = "refs" }), false end
  if class == "pagebreak" then return layout:page_break() end
  if class == "columns" then return columns(element) end
  if class == "block-diagram" then return block_diagram(element) end
  if class == "drawing" then return named_drawing(element) end
  if class == "kept" then return layout:kept(element.content) end
  if class == "question" then return layout:question(element.content, element.attributes.right or "") end
  if class == "answer" then return layout:folded(element.content, layout.words.answer) end
  if class == "column" then
    report("not-a-column", "column")
    return {}
  end
  return layout:box(element, class)
end

-- Code in a line, and values: filled where they are checked, so that captions, headings and cells of tables have them.
local function code(element)
  local attribute = safety.unknown_attribute(element.attributes, {})
  if attribute then report("attribute", attribute, attribute, "code") end
  if element.classes:includes("value") then
    local found = entry("value", element.text, "`" .. element.text .. "`")
    local shown = found and values.printed(found, layout) or slots.stopped and layout:missing_word(element.text) or
      shows_gaps and layout:gap()
    return shown and named_value(element.text, shown) or {}
  end
  local bad = safety.unknown_code_class(element.classes, false)
  if bad then report("code-class", "." .. bad, bad, element.text) end
  return layout:inline_code(element)
end

local function check_code_block(element)
  local bad = safety.unknown_code_class(element.classes, true)
  if bad then report("block-class", bad, bad) end
  local attribute = safety.unknown_attribute(element.attributes, {})
  if attribute then report("attribute", attribute, attribute, "code-block") end
end

local function code_block(element) return layout:code_block(element) end

-- A slot in the path of a picture or in the address of a link.
local function check_address(target)
  local written = target:gsub("%%(%x%x)", function(code) return string.char(tonumber(code, 16)) end)
  local holds_slot = written:find("{.value", 1, true) ~= nil
  if holds_slot then report("slot-in-address", written, written) end
  return holds_slot
end

local function raw(element)
  if element.format ~= "html" or not safety.is_comment(element.text) then
    report("raw", element.text:match("^[^\n]*"), element.text:match("^[^\n]*"))
  end
  return {}
end

local function span(element)
  local bad = safety.unknown_attribute(element.attributes, {})
  if bad then report("attribute", bad, bad, "span") end
  if #element.classes > 0 then report("span-class", "." .. element.classes[1], element.classes[1]) end
  return element.content
end

local function link(element)
  check_address(element.target)
  if not safety.link_allowed(element.target) then report("link", element.target, element.target) end
  local bad = safety.unknown_attribute(element.attributes, {})
  if bad then report("attribute", bad, bad, "link") end
  element.classes = {}
  return element
end

local function plain_image(blocks_content)
  local image = blocks_content[1]
  return #blocks_content == 1 and image.t == "Image" and image or nil
end

local function paragraph(element)
  local image = plain_image(element.content)
  if image then return figure(image), false end
  return layout:heading_line(element)
end

-- Raw output and attributes of spans, which the reader takes for text.
local function string(element)
  local class, attribute = element.text:match("%]{%.([%w_-]+)"), element.text:match("%]{(%a[%w_-]*)=")
  if class then report("span-class", "." .. class, class) end
  if attribute then report("attribute", attribute, attribute, "span") end
  if element.text:match("^{=%w+}") then report("raw-attribute", element.text, element.text) end
end

-- What was meant as a slot: without backticks, or with a space before its class.
local function slots_of_other_forms(inlines)
  for i, element in ipairs(inlines) do
    if element.t == "Str" and element.text:find("{.value}", 1, true) then
      local before, space = inlines[i - 1], ""
      if before and before.t == "Space" then before, space = inlines[i - 2], " " end
      local written = element.text
      if before and before.t == "Code" then written = "`" .. before.text .. "`" .. space .. written end
      if before and before.t == "Quoted" then written = (before.quotetype == "SingleQuote" and "'" or '"') .. written end
      report("slot-form", written, written)
    end
  end
end

-- First what the author wrote is checked, then slots are filled in document order, so that numbers are given as the
-- elements come and nothing the filter itself writes is checked again.
local check = {
  RawBlock = raw, RawInline = raw, Span = span, Link = link, Str = string, Math = check_mathematics,
  Code = code, CodeBlock = check_code_block, Image = function(image) if check_address(image.src) then return {} end end,
  Inlines = slots_of_other_forms,
}
local fill = {
  traverse = "topdown",
  Para = paragraph, Table = written_table, Div = division, Header = header, CodeBlock = code_block,
  Inlines = equations, Image = inline_image,
}

local function checked(markdown) return pandoc.Pandoc(read_blocks(markdown)):walk(check) end

function checked_inlines(markdown) return pandoc.utils.blocks_to_inlines(checked(markdown).blocks) end

-- References -----------------------------------------------------------------------------------------------------

local known_keys = {}  -- of the bibliography; they may hold a colon, as labels do

local function is_literature(id) return known_keys[id] or not id:find(":", 1, true) end

local function reference(citation)
  local id = citation.id
  local kind = id:match("^(%a+):")
  if kind ~= "sec" and not counters[kind] then
    report_gap("reference-kind", "@" .. id, id)
  elseif not labels[id] then
    if not slots.stopped then report_gap("dangling", "@" .. id, id) end
  else
    local shown = labels[id]
    if citation.mode == "SuppressAuthor" then shown = shown:match("\u{A0}(.*)$") or shown end
    if slots.format == "markdown" then return pandoc.Str(shown) end
    return pandoc.Link({ pandoc.Str(shown) }, "#" .. id)
  end
end

local unknown_citations = {}

-- Literature is left to Pandoc's citeproc, which runs next.
local function references(cite)
  if is_literature(cite.citations[1].id) then
    for _, citation in ipairs(cite.citations) do
      if shows_gaps and unknown_citations[citation.id] then return layout:gap() end
    end
    return slots.bibliography == "" and cite.content or nil
  end
  local shown = pandoc.List {}
  for i, citation in ipairs(cite.citations) do
    if i > 1 then shown:extend { pandoc.Str(","), pandoc.Space() } end
    if #citation.prefix > 0 then
      shown:extend(citation.prefix)
      shown:insert(pandoc.Space())
    end
    shown:insert(reference(citation) or shows_gaps and layout:gap() or pandoc.Str(citation.id))
    shown:extend(citation.suffix)
  end
  return shown
end

-- Literature -----------------------------------------------------------------------------------------------------

local cites_literature = false

local function keys_of_bibliography()
  local keys = {}
  if slots.bibliography == "" then return keys end
  local everything = pandoc.Cite({ pandoc.Str("@*") }, { pandoc.Citation("*", pandoc.NormalCitation) })
  local whole = pandoc.Pandoc({}, pandoc.Meta { bibliography = pandoc.MetaString(slots.bibliography),
                                                nocite = pandoc.MetaInlines { everything } })
  local read, entries = pcall(pandoc.utils.references, whole)
  if not read then
    report("bibliography", "bibliography:", (tostring(entries):match("%(line %d+, column %d+%).*") or tostring(entries)):gsub('\\n', ", "):gsub('"', ""))
    return nil
  end
  for _, entry in ipairs(entries) do keys[entry.id] = true end
  return keys
end

local function check_citations(document)
  local keys = keys_of_bibliography()
  if not keys then return end
  known_keys = keys
  local names = {}
  for key in pairs(keys) do names[#names + 1] = key end
  document:walk {
    Cite = function(cite)
      if not is_literature(cite.citations[1].id) then return end
      for _, citation in ipairs(cite.citations) do
        local id = citation.id
        unknown_citations[id] = not keys[id]
        if slots.bibliography == "" then
          report_gap("no-bibliography", "@" .. id, id)
        elseif not keys[id] then
          report_gap("unknown-citation", "@" .. id, id, table.concat(names, " "))
        else
          cites_literature = true
        end
      end
    end,
  }
end

-- A control word of LaTeX in prose; not what stands in a path such as C:\temp or \server\share.
local function latex_word(text)
  local before, word, after = text:match("^([^\\]*)(\\%a+)(.*)$")
  if word and not before:find("[%w:.]$") and not after:find("^\\") then return word end
end

local function check_no_latex(document)
  document:walk {
    Str = function(element)
      local word = latex_word(element.text)
      if word and not slots.escaped[word:sub(2)] then report("latex", word, word) end
    end,
  }
end

-- What citeproc reads: the file, and the heading of the list unless the author gives the list its place.
local function set_literature(document)
  if slots.bibliography == "" or not cites_literature then return end
  local placed = false
  document:walk { Div = function(element) placed = placed or element.identifier == "refs" end }
  document.meta.bibliography = pandoc.MetaString(slots.bibliography)
  document.meta["link-citations"] = true
  if not placed then document.meta["reference-section-title"] = pandoc.MetaString(layout.words.references) end
end

-- The measures that a block names, each with its title, formula and meaning.
local function measures(division)
  local blocks = pandoc.List {}
  for name in pandoc.utils.stringify(pandoc.Span(pandoc.utils.blocks_to_inlines(division.content))):gmatch("[^,%s]+") do
    local markdown = slots.measures[name:lower()]
    if markdown then
      blocks:extend(read_blocks(markdown))
    else
      local names = {}
      for known in pairs(slots.measures) do names[#names + 1] = known end
      report("unknown-measure", name, name, table.concat(names, " "))
    end
  end
  return blocks
end

-- Questions to check oneself by, numbered through the document, and the answers for its end. A division of the classes
-- choice and unanswered, as on task sheets, is printed without its answer.
local choices, answers = 0, pandoc.List {}
local function asked_choice(division)
  local read, complaint = choice.read(division)
  if not read then
    report("choice", division.content[1] and pandoc.utils.stringify(division.content[1]):match("^%S+") or "choice", complaint)
    return {}
  end
  choices = choices + 1
  local shown = not slots.chunks and choices or nil
  local blocks = pandoc.List { pandoc.Div(choice.asked(read, shown), { class = "kept" }) }
  if division.classes[2] == "unanswered" then return blocks end
  local answer = choice.answered(read, shown, layout.words)
  if slots.format == "html" then
    blocks:insert(pandoc.Div(answer, { class = "answer" }))
    return pandoc.Div(blocks, { class = "question", right = choice.right_places(read) })
  else
    answers:insert(pandoc.Div(answer, { class = "kept" }))
  end
  return blocks
end

-- What pages show and paper does not: figures that move or are to be played with. They have no numbers, so that page and
-- paper count alike.
local function on_screens(division)
  if slots.format ~= "html" then return {} end
  return division:walk { Image = function(image) image.classes:insert("unnumbered"); return image end }.content
end

local function expand(element)
  if element.classes[1] == "screen" and #element.classes == 1 then return on_screens(element) end
  if element.classes[1] == "choice" and (#element.classes == 1 or element.classes[2] == "unanswered") then
    return asked_choice(element)
  end
  if element.classes[1] == "measures" and #element.classes == 1 then return measures(element) end
  if element.classes[1] == "text" and #element.classes == 1 then return text_slot(element) end
end

local units = {}
for unit in ("m cm mm µm km s ms µs min h Hz kHz V mV A mA N mN kN kg g rad mrad ° °C K W J Ω dB % " ..
             "1/s bar Pa kPa"):gmatch("%S+") do units[unit] = true end

-- A unit, or a product or quotient of units: °C/V, N·m, m/s².
local function is_unit(word)
  if units[word] then return true end
  local parts = 0
  for part in word:gsub("·", "/"):gsub("²", ""):gmatch("[^/]+") do
    if not units[part] then return false end
    parts = parts + 1
  end
  return parts > 1
end

local function ends_in_number(element)
  if element.t == "Span" and element.classes:includes("value") then element = element.content[1] end
  return (element.t == "Str" or element.t == "Math" and element.mathtype == "InlineMath") and element.text:match("%d$") ~= nil
end

local function begins_with_unit(element)
  return element.t == "Str" and is_unit((element.text:gsub("[.,;:!?)]+$", "")))
end

local function is_text(element, text) return element.t == "Str" and element.text == text end

-- "p = 0.63" where a formula holds the first part, and "92 ± 3".
local function belong_together(before, after)
  return is_text(before, "±") or is_text(after, "±") or
    before.t == "Math" and before.mathtype == "InlineMath" and before.text:match("[=<>]%s*$") ~= nil
end

-- No line ends between a number and its unit, where the space is thin, nor before a number and its error.
local function keep_units(inlines)
  for i = 2, #inlines - 1 do
    local between = inlines[i].t
    if between == "Space" or between == "SoftBreak" then
      if ends_in_number(inlines[i - 1]) and begins_with_unit(inlines[i + 1]) then
        inlines[i] = pandoc.Str("\u{202F}")
      elseif belong_together(inlines[i - 1], inlines[i + 1]) then
        inlines[i] = pandoc.Str("\u{A0}")
      end
    end
  end
  return inlines
end

local function finished(document)
  local filled = document:walk { Para = lists.after_text }:walk(check):walk(fill)
  if slots.format ~= "markdown" then filled = filled:walk { Inlines = keep_units } end
  return filled:walk { Cite = references }
end

function Pandoc(document)
  document.blocks = citations.read(document.blocks, slots.escaped)
  check_citations(document)
  check_no_latex(document)
  local metadata = {}
  for key, markdown in pairs(slots.metadata) do metadata[key] = finished(pandoc.Pandoc(read_blocks(markdown))).blocks end
  document = document:walk { Div = expand }
  if #answers > 0 then
    document.blocks:insert(pandoc.Header(1, { pandoc.Str(layout.words.answers) }, { class = "unnumbered" }))
    document.blocks:extend(answers)
  end
  document = finished(document)
  for key, blocks in pairs(metadata) do document.meta[key] = pandoc.MetaBlocks(blocks) end
  for _, key in ipairs { "title", "subtitle", "date", "header" } do
    local value = document.meta[key]
    if value then document.meta[key] = pandoc.MetaInlines(pandoc.utils.blocks_to_inlines(value)) end
  end
  for key, text in pairs(slots.variables) do document.meta[key] = text end
  if document.meta.title then document.meta.pagetitle = values.plain_text(document.meta.title) end
  if chunk then tell_count("chunk-end", chunk) end
  if failed and not slots.chunks then os.exit(64) end
  set_literature(document)
  document.blocks = layout:keep_formulas_with_their_text(document.blocks)
  document.blocks = layout:mark_slides_with_code(document.blocks)
  return document
end
