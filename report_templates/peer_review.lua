-- ---
-- title: Review of a report
-- template: peer_review
-- language: en
-- ---

-- %% [markdown]
-- Your review stands in `report.md`. This script is only for scores, where your course asks for them: whole numbers from 1
-- (much is missing) to 5 (nothing to add), one for each of the five questions. What is left `nil` is not given.

-- %%
local scores = {data = nil, steps = nil, conclusions = nil, strength = nil, suggestions = nil}

-- %% [markdown]
-- Nothing is to be changed below.

-- %%
local french = report.language() == "fr"
local questions = {
  {"data", "Data and experiments", "Données et expériences"},
  {"steps", "Steps of the identification", "Étapes de l'identification"},
  {"conclusions", "Conclusions", "Conclusions"},
  {"strength", "Greatest strength", "Principale qualité"},
  {"suggestions", "Suggestions", "Suggestions"},
}
local rows = {french and {"Question", "Note"} or {"Question", "Score"}}
for _, question in ipairs(questions) do
  local name, title = question[1], french and question[3] or question[2]
  local score = scores[name]
  scores[name] = nil
  if score then
    if math.type(score) ~= "integer" or score < 1 or score > 5 then
      error("the score " .. name .. " is a whole number from 1 to 5, not " .. tostring(score))
    end
    answer(name, score)
  end
  rows[#rows + 1] = {title, score and tostring(score) or "–"}
end
local unknown = next(scores)
if unknown then error("there is no question " .. unknown) end
report.table("scores", rows)
