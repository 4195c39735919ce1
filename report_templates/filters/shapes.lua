-- The shapes of drawings (drawing.lua tells them) as lines and areas on a `paper` with paper:stroke(points, width) and
-- paper:fill(points, shade), lengths in cm, points {x, y}, widths in TeX points. Nothing here needs Pandoc: the program
-- reads it too, for rigs that move.
local thin, thick = 0.5, 1.1  -- TeX points

local function points_of(numbers, from)
  local points = {}
  for i = from or 2, #numbers, 2 do points[#points + 1] = { numbers[i], numbers[i + 1] } end
  return points
end

local function distance(a, b) return math.sqrt((b[1] - a[1]) ^ 2 + (b[2] - a[2]) ^ 2) end

local function between(a, b, part) return { a[1] + part * (b[1] - a[1]), a[2] + part * (b[2] - a[2]) } end

-- A place along the line from a to b, and beside it, to the left.
local function beside(a, b, along, aside)
  local length = distance(a, b)
  local dx, dy = (b[1] - a[1]) / length, (b[2] - a[2]) / length
  return { a[1] + along * dx - aside * dy, a[2] + along * dy + aside * dx }
end

local function dashes(paper, points, width)
  local dash, gap = 0.12, 0.09
  for i = 2, #points do
    local a, b = points[i - 1], points[i]
    local length = distance(a, b)
    for at = 0, length, dash + gap do
      paper:stroke({ between(a, b, at / length), between(a, b, math.min(1, (at + dash) / length)) }, width)
    end
  end
end

local function head(paper, a, b)
  local length = distance(a, b)
  paper:fill({ b, beside(a, b, length - 0.2, 0.07), beside(a, b, length - 0.2, -0.07) }, 1)
end

local function line(paper, shape, points)
  local width = shape.thick and thick or thin
  if shape.arrow then
    head(paper, points[#points - 1], points[#points])
    local a, b = points[#points - 1], points[#points]
    points[#points] = beside(a, b, distance(a, b) - 0.15, 0)
  end
  if shape.dashed then dashes(paper, points, width) else paper:stroke(points, width) end
end

local function area(paper, shape, points)
  if shape.shade then paper:fill(points, shape.shade) end
  if shape.bare then return end
  points[#points + 1] = points[1]
  paper:stroke(points, shape.thick and thick or thin)
end

local function round(x, y, radius, from, to)
  local points, steps = {}, math.max(6, math.ceil(math.abs(to - from) / 8))
  for i = 0, steps do
    local angle = math.rad(from + (to - from) * i / steps)
    points[#points + 1] = { x + radius * math.cos(angle), y + radius * math.sin(angle) }
  end
  return points
end

local shapes = {}  -- by the name of the shape: what it puts on paper

function shapes.line(paper, shape) line(paper, shape, points_of(shape)) end
function shapes.area(paper, shape) area(paper, shape, points_of(shape)) end

function shapes.box(paper, shape)
  local x0, y0, x1, y1 = table.unpack(shape, 2)
  area(paper, shape, { { x0, y0 }, { x1, y0 }, { x1, y1 }, { x0, y1 } })
end

function shapes.circle(paper, shape)
  local points = round(shape[2], shape[3], shape[4], 0, 360)
  points[#points] = nil
  area(paper, shape, points)
end

function shapes.arc(paper, shape) line(paper, shape, round(table.unpack(shape, 2))) end

function shapes.spring(paper, shape)
  local a, b = table.unpack(points_of(shape))
  local length, turns, size = distance(a, b), 6, 0.16
  local lead = 0.15 * length
  local points = { a, beside(a, b, lead, 0) }
  for i = 1, 2 * turns do
    points[#points + 1] = beside(a, b, lead + (i - 0.5) * (length - 2 * lead) / (2 * turns), i % 2 == 0 and -size or size)
  end
  points[#points + 1] = beside(a, b, length - lead, 0)
  points[#points + 1] = b
  paper:stroke(points, thin)
end

function shapes.damper(paper, shape)
  local a, b = table.unpack(points_of(shape))
  local length, size = distance(a, b), 0.17
  local from, to, piston = 0.35 * length, 0.65 * length, 0.52 * length
  paper:stroke({ a, beside(a, b, from, 0) }, thin)
  paper:stroke({ beside(a, b, to, size), beside(a, b, from, size), beside(a, b, from, -size), beside(a, b, to, -size) }, thin)
  paper:stroke({ beside(a, b, piston, 0.8 * size), beside(a, b, piston, -0.8 * size) }, thick)
  paper:stroke({ beside(a, b, piston, 0), b }, thin)
end

function shapes.ground(paper, shape)
  local a, b = table.unpack(points_of(shape))
  paper:stroke({ a, b }, thick)
  for at = 0.15, distance(a, b), 0.15 do
    paper:stroke({ beside(a, b, at, 0), beside(a, b, at - 0.12, -0.14) }, thin)
  end
end

local drawn = {}

-- Puts a shape on paper.
function drawn.add(paper, shape) shapes[shape[1]](paper, shape) end

-- What a drawing shows of the rig itself, in order: { points =, width = or shade =, part = }, without texts and without
-- shapes that only explain (note). `part` is the shape's: the part that its points move with, or a list with one for
-- each point.
function drawn.pieces(result)
  local pieces = {}
  local function keep(points, piece)
    piece.points = table.move(points, 1, #points, 1, {})
    pieces[#pieces + 1] = piece
  end
  for _, shape in ipairs(result) do
    local paper = {
      stroke = function(_, points, width) keep(points, { width = width, part = shape.part }) end,
      fill = function(_, points, shade) keep(points, { shade = shade, part = shape.part }) end,
    }
    if shape[1] ~= "text" and not shape.note then drawn.add(paper, shape) end
  end
  return pieces
end

return drawn
