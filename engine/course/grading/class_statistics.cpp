#include "course/grading/class_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <variant>

#include "base/reader.h"
#include "numerics/linalg/types.h"
#include "numerics/signals/robust_statistics.h"

namespace dynlab::inline course {
namespace {

using nlohmann::json;

constexpr std::size_t kMinSubmissionsForCorrelation = 5;
constexpr std::size_t kMaxMistakes = 5;

/// What two messages have in common that differ in their numbers only.
Message without_numbers(const Message& message) {
    std::vector<MessageArgument> arguments = message.arguments();
    for (MessageArgument& argument : arguments) {
        if (auto* const list = std::get_if<MessageList>(&argument))
            for (Message& item : list->items) item = without_numbers(item);
        else if (std::holds_alternative<Number>(argument) || std::holds_alternative<std::int64_t>(argument))
            argument = std::string("...");
    }
    return Message::stored(message.many().empty() ? message.id() : message.many(), "", std::move(arguments));
}

double correlation(const std::vector<double>& x, const std::vector<double>& y) {
    const auto centered = [](const std::vector<double>& values) {
        const Eigen::Map<const Vector> all(values.data(), static_cast<Index>(values.size()));
        return Vector(all.array() - all.mean());
    };
    const Vector a = centered(x), b = centered(y);
    const double size = a.norm() * b.norm();
    // Rounding apart, one of them is constant.
    constexpr double kNothing = 1e-9;
    return size > kNothing ? a.dot(b) / size : std::numeric_limits<double>::quiet_NaN();
}

double discrimination(const std::vector<Grade>& grades, const std::string& id) {
    std::vector<double> own, others;
    for (const Grade& grade : grades) {
        if (!grade.whole() || grade.silent) continue;
        double mine = 0, rest = 0;
        for (const CheckGrade& check : grade.checks) (check.id == id ? mine : rest) += check.earned;
        own.push_back(mine);
        others.push_back(rest);
    }
    return own.size() < kMinSubmissionsForCorrelation ? std::numeric_limits<double>::quiet_NaN()
                                                      : correlation(own, others);
}

std::vector<std::pair<std::string, int>> most_frequent(const std::map<std::string, int>& counts) {
    std::vector<std::pair<std::string, int>> sorted(counts.begin(), counts.end());
    std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
    if (sorted.size() > kMaxMistakes) sorted.resize(kMaxMistakes);
    return sorted;
}

json number_or_null(double value) {
    return std::isfinite(value) ? json(std::round(1e4 * value) / 1e4) : json();
}

json json_of_check(const CheckStatistics& check) {
    json mistakes = json::array();
    for (const auto& [said, count] : check.mistakes) mistakes.push_back({{"said", said}, {"count", count}});
    return {{"id", check.id},
            {"about", check.about},
            {"points", check.points},
            {"graded", check.graded},
            {"passed", check.passed},
            {"mean_share", check.graded > 0 ? number_or_null(check.mean_share) : json()},
            {"discrimination", number_or_null(check.discrimination)},
            {"mistakes", std::move(mistakes)}};
}

json json_of_work(const Grade& grade) {
    json checks = json::object();
    for (const CheckGrade& check : grade.checks) checks[check.id] = check.graded ? json(check.earned) : json();
    return {{"submission", grade.submission}, {"points", grade.whole() ? json(grade.earned()) : json()},
            {"possible", grade.possible()},   {"penalty", grade.penalty},
            {"whole", grade.whole()},         {"trouble", message_text(grade.error_reason)},
            {"checks", std::move(checks)}};
}

}  // namespace

std::vector<CheckStatistics> statistics_of_checks(const std::vector<Grade>& grades) {
    std::vector<CheckStatistics> all;
    const auto first = std::find_if(grades.begin(), grades.end(), [](const Grade& g) { return !g.checks.empty(); });
    if (first == grades.end()) return all;
    for (const CheckGrade& declared : first->checks) {
        CheckStatistics one;
        one.id = declared.id, one.about = message_text(declared.about), one.points = declared.points;
        std::map<std::string, int> said;
        for (const Grade& grade : grades)
            for (const CheckGrade& check : grade.checks) {
                if (check.id != one.id || !check.graded) continue;
                ++one.graded;
                one.passed += check.earned >= check.points;
                one.mean_share += check.earned / check.points;
                if (check.earned < check.points && !check.message.empty())
                    ++said[message_text(without_numbers(check.message))];
            }
        if (one.graded > 0) one.mean_share /= one.graded;
        one.discrimination = discrimination(grades, one.id);
        one.mistakes = most_frequent(said);
        all.push_back(std::move(one));
    }
    return all;
}

std::string class_statistics_json(const std::string& lesson, const std::vector<Grade>& grades) {
    std::vector<double> points;
    json checks = json::array(), works = json::array();
    for (const Grade& grade : grades) {
        if (grade.whole()) points.push_back(grade.earned());
        works.push_back(json_of_work(grade));
    }
    for (const CheckStatistics& check : statistics_of_checks(grades)) checks.push_back(json_of_check(check));
    const Eigen::Map<const Vector> all(points.data(), static_cast<Index>(points.size()));
    const json summary = {{"format", 1},
                          {"lesson", lesson},
                          {"works", grades.size()},
                          {"graded", points.size()},
                          {"mean", points.empty() ? json() : number_or_null(all.mean())},
                          {"median", points.empty() ? json() : number_or_null(median(points))},
                          {"checks", std::move(checks)},
                          {"results", std::move(works)}};
    return summary.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace dynlab::inline course
