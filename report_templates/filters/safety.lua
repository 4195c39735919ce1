-- What documents may not contain: whoever writes a template or a report must not reach files, macros or scripts
-- of the machine that renders it. Every function returns what is wrong, or nil.
local safety = {}

local function set(words)
  local found = {}
  for word in words:gmatch("%S+") do found[word] = true end
  return found
end

-- TeX commands that read or write files, define macros, change the meaning of characters, leave the formula or
-- run for ever. \label, \ref and \tag belong to the cross references, which the filter numbers itself.
local forbidden_commands = set [[
  input include includeonly InputIfFileExists IfFileExists openin openout closein closeout read readline write
  newread newwrite immediate special shipout output dump endinput end-document bye stop batchmode scrollmode errorstopmode
  nonstopmode interactionmode message errmessage show showthe showbox showlists tracingall includegraphics
  verbatiminput lstinputlisting VerbatimInput CatchFileDef filecontents bibliography addbibresource usepackage
  RequirePackage documentclass LoadClass PassOptionsToPackage makeatletter makeatother ExplSyntaxOn
  def edef gdef xdef let futurelet newcommand renewcommand providecommand DeclareRobustCommand DeclareMathOperator
  newenvironment renewenvironment newtheorem newcounter newif newtoks newbox newlength newsavebox
  NewDocumentCommand RenewDocumentCommand ProvideDocumentCommand DeclareDocumentCommand
  catcode lccode uccode sfcode mathcode delcode mathchardef chardef char countdef dimendef skipdef toksdef
  csname endcsname expandafter noexpand scantokens string meaning detokenize unexpanded uppercase lowercase
  loop repeat iterate aftergroup afterassignment global outer long protected everymath everydisplay everypar everyjob
  everycr everyhbox everyvbox hypertarget hyperlink href url hypersetup AtBeginDocument AtEndDocument AddToHook
  the number romannumeral advance multiply divide count dimen skip toks setbox box copy unhbox unvbox vsplit
  loggingall font fontdimen jobname directlua luaexec label ref pageref eqref tag notag nonumber
  DeclareUnicodeCharacter setlength addtolength setcounter addtocounter stepcounter
]]
local forbidden_environments = set [[document filecontents verbatim Verbatim lrbox figure table minipage longtable]]

function safety.forbidden_in_mathematics(text)
  if text:find("^^", 1, true) then return "^^" end
  for name in text:gmatch("\\([%a@]+)") do
    if forbidden_commands[name] or name:find("^pdf") or name:find("@", 1, true) then return "\\" .. name end
  end
  for name in text:gmatch("\\begin%s*{%s*([^}]*)") do
    if forbidden_environments[name:gsub("[%s*]", "")] then return "\\begin{" .. name .. "}" end
  end
  for name in text:gmatch("\\end%s*{%s*([^}]*)") do
    if forbidden_environments[name:gsub("[%s*]", "")] then return "\\end{" .. name .. "}" end
  end
  return text:match("\\[%]%[%(%)]")
end

function safety.is_comment(html)
  return html:match("^%s*<!%-%-.*%-%->%s*$") ~= nil
end

function safety.link_allowed(target)
  return target:find("^https?://") or target:find("^mailto:") or target:find("^#[%w:_.-]+$")
end

local languages = set [[lua matlab octave bash sh json c cpp python toml text]]
local block_classes = set [[lua cell output error]]
local division_classes = set [[table text note warning exercise pagebreak columns column]]

function safety.unknown_code_class(classes, is_block)
  for _, class in ipairs(classes) do
    if not languages[class] and not (is_block and block_classes[class]) then return class end
  end
end

function safety.unknown_division_class(classes)
  for _, class in ipairs(classes) do
    if not division_classes[class] then return class end
  end
end

-- Attributes an element may carry; others could hold scripts or styles.
function safety.unknown_attribute(attributes, allowed)
  for key in pairs(attributes) do
    if not allowed[key] then return key end
  end
end

return safety
