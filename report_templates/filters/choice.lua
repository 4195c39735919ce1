-- Questions to check oneself by:
--   ::: choice
--   What does a fit of 0 % mean?
--
--   - [ ] Nothing was simulated.
--
--     A model whose output is zero may have any fit.
--   - [x] The model does no better than a constant.
--
--     The fit compares with the mean of the measured output.
--   :::
-- The question, then a list: each item an option, marked right or wrong, and a paragraph that says why. In HTML the
-- options answer when they are chosen (html/choices.js), and without scripts the answers stand folded below their
-- question; elsewhere they stand at the end of the document.
local choice = {}

local signs = { ["☐"] = "wrong", ["☒"] = "right" }

-- The option of an item without its mark, the mark, and the reason; nothing where the item is of another form.
local function option_of(item)
  local first = item[1]
  if #item < 2 or (first.t ~= "Para" and first.t ~= "Plain") or not first.content[1] then return nil end
  local mark = first.content[1].t == "Str" and signs[first.content[1].text]
  if not mark then return nil end
  local words = pandoc.List { table.unpack(first.content, 3) }
  return words, mark, pandoc.List { table.unpack(item, 2) }
end

-- The parts of a question, or a code that says what is wrong with it; filter_messages.cpp has the sentences.
function choice.read(division)
  local blocks = division.content
  local list = blocks[#blocks]
  if #blocks < 2 or list.t ~= "BulletList" then
    return nil, "list"
  end
  local read = { question = pandoc.List { table.unpack(blocks, 1, #blocks - 1) }, options = {} }
  local right = 0
  for _, item in ipairs(list.content) do
    local words, mark, reason = option_of(item)
    if not words then
      return nil, "option"
    end
    right = right + (mark == "right" and 1 or 0)
    table.insert(read.options, { words = words, right = mark == "right", reason = reason })
  end
  if right == 0 or #read.options < 2 then return nil, "none-right" end
  return read
end

local function letter(place) return string.char(96 + place) end

-- Chunks of a page are set by themselves and have no numbers.
local function with_number(number, blocks)
  local first = blocks[1]
  if number and first and (first.t == "Para" or first.t == "Plain") then
    first.content:insert(1, pandoc.Space())
    first.content:insert(1, pandoc.Strong { pandoc.Str(number .. ".") })
  end
  return blocks
end

-- The question and its options under letters.
function choice.asked(read, number)
  local items = pandoc.List {}
  for _, option in ipairs(read.options) do items:insert { pandoc.Plain(option.words) } end
  local blocks = with_number(number, read.question:clone())
  blocks:insert(pandoc.OrderedList(items, { 1, "LowerAlpha", "OneParen" }))
  return blocks
end

-- The places of the right options, "1 3".
function choice.right_places(read)
  local places = {}
  for place, option in ipairs(read.options) do
    if option.right then table.insert(places, tostring(place)) end
  end
  return table.concat(places, " ")
end

-- Which options are right, and why each is or is not.
function choice.answered(read, number, words)
  local items = pandoc.List {}
  for _, option in ipairs(read.options) do
    local reason = option.reason:clone()
    local first = reason[1]
    local verdict = pandoc.Strong { pandoc.Str(option.right and words.right or words.wrong) }
    local inlines = pandoc.List { verdict, pandoc.Space() }
    inlines:extend(first.content)
    reason[1] = pandoc.Plain(inlines)
    items:insert(reason)
  end
  local right = {}
  for place, option in ipairs(read.options) do
    if option.right then table.insert(right, letter(place) .. ")") end
  end
  local head = pandoc.Para { pandoc.Str(table.concat(right, ", ")) }
  return with_number(number, pandoc.List { head }) .. pandoc.List { pandoc.OrderedList(items, { 1, "LowerAlpha", "OneParen" }) }
end

return choice
