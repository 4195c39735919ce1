-- Runs after Pandoc's citeproc: what a bibliography holds is held to the rules of the document, and the list of literature
-- gets its looks.
local folder = PANDOC_SCRIPT_FILE:match("^(.*)/") or "."
local safety = dofile(folder .. "/safety.lua")
local mathematics = dofile(folder .. "/mathematics.lua")
local slots = dofile("slots.lua")
local layout = dofile(folder .. "/layout.lua").new(slots.format, slots.language, slots.slides, mathematics)

local function within_rules(element)
  return element:walk {
    RawInline = function() return {} end,
    RawBlock = function() return {} end,
    Image = function(image) return image.caption end,
    Math = function(formula)
      if #mathematics.refused_in(formula.text) > 0 then return pandoc.Str(formula.text) end
    end,
    Link = function(link)
      if not safety.link_allowed(link.target) then return link.content end
    end,
  }
end

function Div(element)
  if element.identifier == "refs" then return layout:literature(within_rules(element)), false end
end

function Header(element)
  if element.identifier ~= "bibliography" then return nil end
  element.level = layout:heading_level(element.level, slots.metadata.title)
  element.classes = {}
  return element
end
