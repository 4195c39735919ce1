-- Citations and cross references in what Pandoc has read as text: @key, [see @key, p. 3; -@other] and @key [p. 3].
-- Pandoc has an extension for them, but reads each "[" of a paragraph in two ways with it. Its time doubles
-- with each "[" that is not closed, as in the interval [0, 1[, so that twelve intervals take a minute.
local citations = {}

local letters = "[\xC3-\xE1\xE3-\xF4][\x80-\xBF]+"  -- not ASCII; those that begin with C2 and E2 are signs and spaces
local between = "^[:.#$%%&%-+?<>~/][%w_\xC3-\xE1\xE3-\xF4]"  -- a sign within a key

-- Behind the key that begins at `at`.
local function end_of_key(text, at)
  local here = at
  while true do
    local _, last = text:find("^[%w_]+", here)
    if not last then _, last = text:find("^" .. letters, here) end
    if not last and here > at and text:find(between, here) then last = here end
    if not last then return here end
    here = last + 1
  end
end

local function ends_in_letter(text) return text:find("%w$") ~= nil or text:find(letters .. "$") ~= nil end

-- The inlines, with brackets, semicolons and keys by themselves. A bracket that is closed knows where.
local function pieces_of(inlines, escaped)
  local pieces, open, any = {}, {}, false
  local function put(piece)
    pieces[#pieces + 1] = piece
    if piece.sign == "[" then
      open[#open + 1] = piece
    elseif piece.sign == "]" and #open > 0 then
      table.remove(open).close = #pieces
    end
  end
  local function split(text)
    local from, at = 1, 1
    local function put_text(last)
      if last >= from then put { inline = pandoc.Str(text:sub(from, last)), joined = from > 1 } end
    end
    while true do
      at = text:find("[%[%];@]", at)
      if not at then break end
      local sign, before = text:sub(at, at), text:sub(math.max(from, at - 5), at - 1)
      local behind = sign == "@" and end_of_key(text, at + 1) or at + 1
      if sign ~= "@" then
        put_text(at - 1)
        put { inline = pandoc.Str(sign), sign = sign, joined = at > 1 }
        from = behind
      elseif behind > at + 1 and not ends_in_letter(before) and not escaped[text:sub(at, behind - 1)] then
        local suppressed = before:sub(-1) == "-" and not ends_in_letter(before:sub(1, -2))
        local begin = suppressed and at - 1 or at
        put_text(begin - 1)
        put { inline = pandoc.Str(text:sub(begin, behind - 1)), id = text:sub(at + 1, behind - 1),
              suppressed = suppressed, joined = begin > 1 }
        from, any = behind, true
      end
      at = behind
    end
    put_text(#text)
  end
  for _, inline in ipairs(inlines) do
    if inline.t == "Str" and inline.text:find("[%[%];@]") then split(inline.text) else put { inline = inline } end
  end
  return any and pieces or nil
end

local function is_space(piece) return piece ~= nil and (piece.inline.t == "Space" or piece.inline.t == "SoftBreak") end

local built  -- pieces to inlines, defined below

local function written(pieces, first, last)
  local inlines = pandoc.List {}
  for i = first, last do inlines:insert(pieces[i].inline) end
  return inlines
end

local function trimmed(pieces, first, last, keeps_first)
  while first <= last and not keeps_first and is_space(pieces[first]) do first = first + 1 end
  while first <= last and is_space(pieces[last]) do last = last - 1 end
  return built(pieces, first, last)
end

-- What lies between brackets as citations; nothing where a part of it has no key.
local function group(pieces, first, last)
  local parts, part = {}, { first = first }
  local i = first
  while i <= last do
    local piece = pieces[i]
    if piece.sign == ";" then
      part.last = i - 1
      parts[#parts + 1], part = part, { first = i + 1 }
    elseif piece.id and not part.key then
      part.key = i
    end
    i = piece.close and piece.close + 1 or i + 1
  end
  part.last = last
  parts[#parts + 1] = part
  for _, each in ipairs(parts) do
    if not each.key then return nil end
  end
  local list = pandoc.List {}
  for _, each in ipairs(parts) do
    local key = pieces[each.key]
    list:insert(pandoc.Citation(key.id, key.suppressed and "SuppressAuthor" or "NormalCitation",
                                trimmed(pieces, each.first, each.key - 1), trimmed(pieces, each.key + 1, each.last, true)))
  end
  return list
end

-- @key, with the place in brackets behind it where it is of literature, and the last piece that belongs to it.
local function named(pieces, at)
  local key, last, suffix = pieces[at], at, pandoc.List {}
  local open = pieces[at + 2]
  if not key.id:find(":", 1, true) and is_space(pieces[at + 1]) and open and open.close and
    not group(pieces, at + 3, open.close - 1) then
    last, suffix = open.close, trimmed(pieces, at + 3, open.close - 1)
  end
  local shown = pandoc.List { pandoc.Str("@" .. key.id) }
  shown:extend(written(pieces, at + 1, last))
  return pandoc.Cite(shown, { pandoc.Citation(key.id, "AuthorInText", {}, suffix) }), last
end

function built(pieces, first, last)
  local inlines = pandoc.List {}
  local function add_text(text, joined)
    local before = inlines[#inlines]
    if joined and before and before.t == "Str" then
      inlines[#inlines] = pandoc.Str(before.text .. text)
    else
      inlines:insert(pandoc.Str(text))
    end
  end
  local i = first
  while i <= last do
    local piece = pieces[i]
    local cited = piece.close and piece.close <= last and group(pieces, i + 1, piece.close - 1)
    if cited then
      inlines:insert(pandoc.Cite(written(pieces, i, piece.close), cited))
      i = piece.close
    elseif piece.id then
      if piece.suppressed then add_text("-", piece.joined) end  -- only brackets suppress an author
      local cite
      cite, i = named(pieces, i)
      inlines:insert(cite)
    elseif piece.joined then
      add_text(piece.inline.text, true)
    else
      inlines:insert(piece.inline)
    end
    i = i + 1
  end
  return inlines
end

-- The blocks with their citations. `escaped` has the keys that stand for themselves, "@key".
function citations.read(blocks, escaped)
  return pandoc.Pandoc(blocks):walk {
    Inlines = function(inlines)
      local pieces = pieces_of(inlines, escaped)
      return pieces and built(pieces, 1, #pieces)
    end,
  }.blocks
end

return citations
