-- What documents may not contain: whoever writes a template or a report must not reach files, macros or scripts
-- of the machine that renders it. Every function returns what is wrong, or nil.
local safety = {}

local function set(words)
  local found = {}
  for word in words:gmatch("%S+") do found[word] = true end
  return found
end

function safety.is_comment(html)
  return html:match("^%s*<!%-%-.*%-%->%s*$") ~= nil
end

function safety.link_allowed(target)
  return target:find("^https?://") or target:find("^mailto:") or target:find("^#[%w:_.-]+$")
end

local languages = set [[lua matlab octave bash sh json c cpp python toml text]]
local block_classes = set [[lua cell output error]]
local division_classes =
  set [[table text note warning exercise pagebreak columns column references measures block-diagram drawing choice unanswered question answer kept screen]]

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
