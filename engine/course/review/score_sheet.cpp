#include "course/review/score_sheet.h"
#include "platform/text/small_letters.h"

#include <algorithm>

#include "numerics/error.h"

namespace dynlab::inline course {
std::optional<double> percent_of(const std::vector<Criterion>& criteria, const CriterionPoints& points) {
    double sum = 0, most = 0;
    for (std::size_t c = 0; c < criteria.size(); ++c)
        if (points[c]) sum += *points[c], most += criteria[c].most;
    if (most == 0) return {};
    return 100 * sum / most;
}

ScoreSheet::ScoreSheet(const Assignment& assignment, const std::filesystem::path& file,
                       const std::vector<std::string>& owners, std::set<std::string> others)
    : assignment_(assignment), file_(file), table_(read_text_table(file)) {
    const auto has = [&](const std::string& name) { return table_.column(name).has_value(); };
    if (std::ranges::none_of(owners, has)) fail(1, Message("the column {} is missing", listed(owners, Join::kOr)));
    others.insert(owners.begin(), owners.end());
    std::vector<std::string> criteria, unknown;
    bool any = false;
    for (const Criterion& c : assignment.criteria) {
        criteria.push_back(c.name);
        any = any || has(in_small_letters(c.name));
        others.insert(in_small_letters(c.name));
    }
    for (const std::string& name : table_.names)
        if (!others.contains(name)) unknown.push_back(name);
    const Message known = Message("the criteria of {} are {}", assignment.name, listed(criteria));
    if (!unknown.empty()) fail(1, Message("unknown columns: {}; {}", listed(unknown), known));
    if (!any) fail(1, Message("there is no column of a criterion; {}", known));
}

std::string ScoreSheet::cell(std::size_t row, const std::string& name) const {
    const auto index = table_.column(name);
    return index ? table_.rows[row][*index] : "";
}

ScoreEntry ScoreSheet::entry(std::size_t row, std::size_t criterion) const {
    const Criterion& c = assignment_.criteria[criterion];
    const std::string text = cell(row, in_small_letters(c.name));
    if (text.empty()) return {};
    if (text == "-") return {true, {}};
    const std::optional<double> value = number_in_cell(text);
    if (!value || !(*value >= 0 && *value <= c.most))
        fail(table_.lines[row],
             Message("{} must be a number from 0 to {}, but \"{}\" was given", c.name, c.most, text));
    return {true, value};
}

bool ScoreSheet::has_points(std::size_t row) const {
    for (std::size_t c = 0; c < assignment_.criteria.size(); ++c)
        if (entry(row, c).points) return true;
    return false;
}

void refuse_dropped_out(const Group& group) {
    if (group.dropped_out) throw InvalidArgument("{} dropped out: it has no scores", group.name);
}

void ScoreSheet::fail(int line, const Message& what) const {
    throw EnvironmentError("{}, line {}: {}", file_.string(), line, what);
}

}  // namespace dynlab::inline course
