-- Lists that begin right below a line of text, without the empty line that Markdown wants: each further line that
-- begins with "- " or "* " is an item, and numbered lines are items where the text before them ends in a colon.
local lists = {}

local function is_break(element) return element and element.t == "SoftBreak" end

local function is_space(element) return element and (element.t == "Space" or element.t == "SoftBreak") end

-- The sign with which an item begins at this place, the first after a line's end.
local function sign_at(inlines, i)
  local sign, after = inlines[i], inlines[i + 1]
  if not is_break(inlines[i - 1]) or not sign or sign.t ~= "Str" or not after or after.t ~= "Space" then return nil end
  if sign.text == "-" or sign.text == "*" then return "-" end
  return sign.text:match("^(%d+)[.)]$")
end

local function ends_in_colon(inlines, last)
  return inlines[last] and inlines[last].t == "Str" and inlines[last].text:find(":$") ~= nil
end

--- A paragraph as text and list, nothing where there is no list in it.
function lists.after_text(paragraph)
  local inlines = paragraph.content
  local first
  for i = 3, #inlines do
    local sign = sign_at(inlines, i)
    if sign == "-" or sign == "1" and ends_in_colon(inlines, i - 2) then
      first = i
      break
    end
  end
  if not first then return nil end
  local bullets = sign_at(inlines, first) == "-"
  local function begins_item(i)
    local sign = sign_at(inlines, i)
    return sign and (sign == "-") == bullets
  end
  local text, items, item = pandoc.List { table.unpack(inlines, 1, first - 2) }, pandoc.List {}, nil
  for i = first, #inlines do
    if begins_item(i) then
      item = pandoc.List {}
      items:insert(item)
    elseif not (begins_item(i + 1) and is_break(inlines[i])) and not (#item == 0 and is_space(inlines[i])) then
      item:insert(inlines[i])
    end
  end
  local blocks = items:map(function(content) return { pandoc.Plain(content) } end)
  return { pandoc.Para(text), bullets and pandoc.BulletList(blocks) or pandoc.OrderedList(blocks) }
end

return lists
