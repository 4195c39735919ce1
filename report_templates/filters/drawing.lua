-- Drawings of the course's processes: `::: {.drawing name=crane}`, with a line for the caption. Each is a list of shapes in
-- report_templates/drawings/NAME.lua, lengths in cm from the lower left corner:
--
--   { width = 8, height = 4,
--     { "line", 0, 1, 2, 1, 2, 3, dashed = true, thick = true, arrow = true },   through points
--     { "area", 0, 0, 2, 0, 2, 1, shade = 0.15, bare = true },                   a closed line, filled; bare: without a rim
--     { "box", 0, 0, 2, 1, shade = 0.15 },                                       from corner to corner
--     { "circle", 1, 1, 0.3, shade = 1 }, { "arc", 1, 1, 0.3, -90, -60 },        center, radius; from and to an angle, degrees
--     { "spring", 0, 1, 2, 1 }, { "damper", 0, 1, 2, 1 }, { "ground", 0, 0, 2, 0 },   hatched to the right of its direction
--     { "text", 1, 2, "$u$", width = 2, align = "left" } }                       or { en = "water", fr = "eau" }
--
-- A shape with `note = true` explains only. Rigs whose records can be played (motion() in scripts) say besides which of
-- their parts moves with which signal:
--
--     motion = { { part = "trolley", signal = "position", unit = "m", at = 0.1, slide = { 6.1, 0 } },       cm per unit
--                { part = "load", on = "trolley", signal = "angle", unit = "rad", at = 0.5, turn = { 5.5, 2.8 }, by = 1 } }
--
-- `at` is the value at which it is drawn, `turn` the point about which it turns, by so many radians per unit, to the left;
-- `on` the part that carries it, named before. A shape belongs to a part by part = "trolley", or point by point: part =
-- { false, "trolley" }.
--
-- Everything becomes lines and areas (shapes.lua), so that paper, page and motion show the same.
local drawing = {}
local folder = PANDOC_SCRIPT_FILE:match("^(.*)/") or "."
local canvas = dofile(folder .. "/canvas.lua")
local shapes = dofile(folder .. "/shapes.lua")

local names = { "crane", "drifting_process", "drive", "heat_exchanger", "heat_rig", "suspension", "thruster", "two_tanks" }

-- The drawing of that name for `language`; nothing, and all names, where there is none. inlines_of(Markdown) sets what is
-- written in it.
function drawing.read(name, language, inlines_of)
  local known = false
  for _, one in ipairs(names) do known = known or one == name end
  if not known then return nil, table.concat(names, " ") end
  local result = dofile(folder .. "/../drawings/" .. name .. ".lua")
  for _, shape in ipairs(result) do
    if shape[1] == "text" then
      local text = shape[4]
      shape.inlines = inlines_of(type(text) == "table" and text[language] or text)
    end
  end
  return result
end

-- As inlines for "latex" or "html".
function drawing.draw(result, format)
  local paper = canvas.new(format, result.width, result.height)
  for _, shape in ipairs(result) do
    if shape[1] == "text" then
      paper:label(shape.inlines, shape[2], shape[3], shape.width or 2.4, shape.align)
    else
      shapes.add(paper, shape)
    end
  end
  return paper:finish()
end

return drawing
