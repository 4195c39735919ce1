-- Values of a run as a document prints them, in sentences and in formulas: numbers with a true minus sign, powers of ten
-- and the decimal sign of the language; texts as they are.
local values = {}

-- "−2.5e-03" at the beginning of `text`: its mathematics and the text behind it; nothing where no number begins there.
local function take_number(text, layout)
  local sign, rest = text:match("^([+-]?)(.*)$")
  local special = rest:match("^[Nn]a[Nn]%f[%W]") or rest:match("^[Ii]nf%f[%W]")
  if special then
    local infinite = special:lower() == "inf"
    return infinite and sign .. "\\infty" or "\\mathrm{NaN}", rest:sub(#special + 1)
  end
  local mantissa = rest:match("^%d+%.?%d*") or rest:match("^%.%d+")
  if not mantissa then return nil end
  rest = rest:sub(#mantissa + 1)
  local written = sign .. layout:mathematical_number(mantissa)
  local exponent, behind = rest:match("^[eE]([+-]?%d+)(.*)$")
  if not exponent then return written, rest end
  return ("%s \\cdot 10^{%d}"):format(written, math.tointeger(tonumber(exponent)) or 0), behind
end

-- A real or complex number, or one with its error: its mathematics, what stands behind it, and whether it is a sum.
-- Nothing for other texts.
local function take_value(text, layout)
  local written, rest = take_number(text, layout)
  if not written then return nil end
  if rest:find("^[ij]%f[%W]") then return written .. "\\,\\mathrm{i}", rest:sub(2), false end
  local operator, second = rest:match("^%s*([+-])%s*(.*)$")
  if not operator then
    second = rest:match("^%s*±%s*(.*)$")
    operator = second and "\\pm"
  end
  if not operator then return written, rest, false end
  local other, behind = take_number(second, layout)
  if not other then return written, rest, false end
  local is_imaginary = behind:find("^[ij]%f[%W]") ~= nil
  if operator ~= "\\pm" and not is_imaginary then return nil end
  if is_imaginary then other, behind = other .. "\\,\\mathrm{i}", behind:sub(2) end
  return ("%s %s %s"):format(written, operator, other), behind, true
end

local function with_typed_signs(text) return (text:gsub("\u{2212}", "-"):match("^%s*(.-)%s*$")) end

local text_escapes = {
  ["\\"] = "\\textbackslash ", ["{"] = "\\{", ["}"] = "\\}", ["$"] = "\\$", ["%"] = "\\%", ["#"] = "\\#", ["&"] = "\\&",
  ["_"] = "\\_", ["^"] = "\\textasciicircum ", ["~"] = "\\textasciitilde ",
}

local function as_text(text) return text == "" and "" or "\\text{" .. text:gsub("[\\{}$%%#&_^~]", text_escapes) .. "}" end

-- The value as mathematics, and whether signs stand in it: "negative", "sum" or nothing.
local function mathematics(text, layout)
  local typed = with_typed_signs(text)
  local written, rest, is_sum = take_value(typed, layout)
  local unit = written and (rest:match("^%s+(%S.*)$") or rest:match("^%%$"))
  if not written or rest ~= "" and not unit then return as_text(layout:number(text)) end
  if unit then written = written .. "\\," .. as_text(unit) end
  return written, is_sum and "sum" or typed:find("^[+-]") and "negative" or typed:find("%d[eE]") and "power" or nil
end

--- A value in a sentence.
function values.printed(text, layout)
  local typed = with_typed_signs(text)
  local written, rest = take_value(typed, layout)
  local is_special = written and (written:find("NaN") or written:find("infty"))
  if written and rest == "" and not is_special and typed:find("[-eEij]") then return pandoc.Math("InlineMath", written) end
  return pandoc.Str((layout:number(text):gsub("^%-(%d)", "\u{2212}%1")))
end

-- What a value needs around it so that the formula means what its author meant: (-2)^2, x - (-2), x^{-2}.
local function fitted(written, signs, before, after)
  local follows_sign = before:find("[+*/-]%s*$") or before:find("\\cdot%s*$") or before:find("\\times%s*$") or
    before:find("\\pm%s*$")
  local is_factor = signs == "sum" and (after:find("^%s*[%a(]") or after:find("^%s*\\cdot") or after:find("^%s*\\times"))
  if signs and after:find("^%s*%^") or follows_sign and signs and signs ~= "power" or is_factor then return "(" .. written .. ")" end
  local is_argument = before:find("[%^_]%s*$") or before:find("\\%a+%s*$") and not follows_sign
  return is_argument and "{" .. written .. "}" or written
end

local text_commands = {}
for word in ("text textrm textbf textit textsf texttt textup textnormal mbox hbox fbox emph intertext"):gmatch("%S+") do
  text_commands[word] = true
end

--- The formula with its slots `name`{.value} filled. `text_of(name)` gives the text of a value, or nothing and what
--- stands in its place; `refuse(code, name, ...)` is called for what is no slot.
function values.in_formula(formula, layout, text_of, refuse)
  if not formula:find("`", 1, true) then return formula end
  local function filled(part, in_text)
    local result, from = "", 1
    for first, name, behind in part:gmatch("()`([^`'\n]+)`()") do
      local class, after = part:match("^{([^{}]*)}()", behind)
      local before = part:sub(from, first - 1)
      if class == ".value" then
        local text, instead = text_of(name)
        local written, signs
        if text then written, signs = mathematics(text, layout) else written = instead end
        if in_text then
          written = "$" .. written .. "$"
        else
          written = fitted(written, signs, result .. before, part:sub(after))
        end
        -- A letter behind it must not become part of a command at its end.
        if written:find("\\%a+$") and part:find("^%a", after) then written = written .. " " end
        result, from = result .. before .. written, after
      else
        refuse(class and class:find("^%.") and "code-class" or "slot-in-formula", name, class)
      end
    end
    return result .. part:sub(from)
  end
  local with_texts = formula:gsub("\\(%a+)(%b{})", function(command, group)
    if text_commands[command] then return "\\" .. command .. filled(group, true) end
  end)
  return filled(with_texts, false)
end

-- Stands for a dollar sign of a value in a cell, which begins no formula.
values.dollar = "\u{E024}"

--- A cell of a script's table with its slots filled, plainly; `gap` stands in the place of what is not there.
function values.in_cell(text, layout, text_of, gap)
  local alone = text:match("^`([^`\n]+)`{%.value}$")
  if alone then return text_of(alone) or gap end
  return (text:gsub("`([^`\n]+)`{%.value}", function(name)
    local value = text_of(name)
    return value and layout:number(value):gsub("%$", values.dollar) or gap
  end))
end

local plain_words = {
  { "\\,\\mathrm{i}", "i" }, { "\\,", "\u{202F}" }, { " \\cdot ", " · " }, { "\\pm", "±" }, { "\\infty", "∞" },
  { "{,}", "," }, { "\\%a+{([^{}]*)}", "%1" }, { "%^{([^{}]*)}", "^%1" }, { "-", "\u{2212}" },
}

--- Inlines as plain text, with their values and simple formulas as they are read.
function values.plain_text(inlines)
  local plain = pandoc.Span(inlines):walk {
    Math = function(formula)
      local text = formula.text
      for _, pair in ipairs(plain_words) do text = text:gsub(pair[1], pair[2]) end
      return pandoc.Str(text)
    end,
  }
  return pandoc.utils.stringify(plain)
end

return values
