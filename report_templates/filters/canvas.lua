-- What drawings are made on: inlines of LaTeX (pict2e) or of HTML (SVG), lengths in cm from the lower left corner.
local canvas = {}
canvas.__index = canvas

canvas.pixels = 96 / 2.54  -- of HTML, in a cm

local function raw(format, text) return pandoc.RawInline(format, text) end

-- format: "latex" or "html"
function canvas.new(format, width, height)
  local self = setmetatable({ format = format, height = height, content = pandoc.List {} }, canvas)
  if format == "latex" then
    self:add(string.format("\\setlength{\\unitlength}{1cm}\\linethickness{.5pt}\\begin{picture}(%.3f,%.3f)", width, height))
  else
    local w, h = width * canvas.pixels, height * canvas.pixels
    self:add(string.format('<svg class="diagram" xmlns="http://www.w3.org/2000/svg" viewBox="0 0 %.1f %.1f" ' ..
      'width="%.0f" height="%.0f">', w, h, w, h))
  end
  return self
end

function canvas:add(text) self.content:insert(raw(self.format, text)) end

-- HTML counts from above.
function canvas:down(y) return (self.height - y) * canvas.pixels end

local function listed(points, each)
  local result = {}
  for i, point in ipairs(points) do result[i] = each(point[1], point[2]) end
  return table.concat(result, " ")
end

function canvas:points(points)
  if self.format == "latex" then
    return listed(points, function(x, y) return string.format("(%.3f,%.3f)", x, y) end):gsub(" ", "")
  end
  return listed(points, function(x, y) return string.format("%.1f,%.1f", x * canvas.pixels, self:down(y)) end)
end

-- A line through points, so many TeX points wide.
function canvas:stroke(points, width)
  if self.format == "latex" then
    self:add(string.format("{\\linethickness{%.2fpt}\\roundcap\\roundjoin\\polyline%s}", width, self:points(points)))
  else
    self:add(string.format('<polyline points="%s" fill="none" stroke="currentColor" stroke-width="%.2f" ' ..
      'stroke-linejoin="round" stroke-linecap="round"/>', self:points(points), width * 96 / 72.27))
  end
end

-- A surface between points, without a rim: 0 is white, 1 black.
function canvas:fill(points, shade)
  if self.format == "latex" then
    self:add(string.format("{\\color[gray]{%.2f}\\polygon*%s}", 1 - shade, self:points(points)))
  else
    self:add(string.format('<polygon points="%s" fill="currentColor" fill-opacity="%.2f"/>', self:points(points), shade))
  end
end

local raggedness = { center = "\\centering", left = "\\raggedright", right = "\\raggedleft" }

-- Inlines about (x, y), "left" or "right" of which they begin or end; at most so wide.
function canvas:label(inlines, x, y, width, align)
  align = align or "center"
  if align == "left" then x = x + width / 2 elseif align == "right" then x = x - width / 2 end
  if self.format == "latex" then
    self:add(string.format("\\put(%.3f,%.3f){\\makebox(0,0){\\parbox{%.3fcm}{%s\\small ", x, y, width, raggedness[align]))
    self.content:extend(inlines)
    return self:add("}}}")
  end
  local height = 0.9
  self:add(string.format('<foreignObject x="%.1f" y="%.1f" width="%.1f" height="%.1f"><div class="diagram-label%s"><span>',
    (x - 0.5 * width) * canvas.pixels, self:down(y) - 0.5 * height * canvas.pixels, width * canvas.pixels,
    height * canvas.pixels, align == "center" and "" or " " .. align))
  self.content:extend(inlines)
  self:add("</span></div></foreignObject>")
end

-- All of it as inlines; nothing can be added any more.
function canvas:finish()
  self:add(self.format == "latex" and "\\end{picture}" or "</svg>")
  return self.content
end

return canvas
