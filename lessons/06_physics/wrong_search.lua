-- expects: tanks: was not submitted
-- expects: free_run: was not submitted
-- expects: simulated: was not submitted
-- expects: figures: The report has no figure
-- expects: crane_follows: For the other crane, the search failed
-- expects: tanks_follow: was not submitted
-- Only the crane, with a search without bounds that converges for the official data, but not for other cranes.
local tried, now = plant("crane").estimation, load("crane").estimation
local astray = norm(now.theta - tried.theta)
answer("crane", vector{0.3724 - 1e6*astray, 0.24 + astray})
answer("crane_fit", 98.1)
