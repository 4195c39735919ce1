#include "course/grading/grade.h"

#include <algorithm>
#include <cmath>

#include "platform/error.h"

namespace dynlab::inline course {
namespace {

using nlohmann::json;

double rounded(double points) {
    return std::round(100 * points) / 100;
}

json test_of(const CheckGrade& check, std::size_t number) {
    const std::string state = !check.graded ? "ungraded" : check.earned >= check.points ? "passed" : "failed";
    json test = {{"number", std::to_string(number)},
                 {"name", check.about},
                 {"max_score", check.points},
                 {"output", check.visible ? check.message : check.hint},
                 {"visibility", "visible"}};
    if (check.graded) {
        test["score"] = rounded(check.earned);
        test["status"] = state;
    }
    return test;
}

json json_of(const CheckGrade& check) {
    return {{"id", check.id},         {"about", check.about},     {"hint", check.hint},     {"points", check.points},
            {"earned", check.earned}, {"visible", check.visible}, {"graded", check.graded}, {"message", check.message}};
}

CheckGrade check_of(const json& j) {
    return {j.at("id"),     j.at("about"),  j.at("hint"),    j.at("message"),
            j.at("points"), j.at("earned"), j.at("visible"), j.at("graded")};
}

}  // namespace

double Grade::earned() const {
    double sum = -penalty;
    for (const CheckGrade& check : checks) sum += check.graded ? check.earned : 0;
    return rounded(std::max(0.0, sum));
}

double Grade::possible() const {
    double sum = 0;
    for (const CheckGrade& check : checks) sum += check.graded ? check.points : 0;
    return sum;
}

bool Grade::whole() const {
    return !checks.empty() && std::all_of(checks.begin(), checks.end(), [](const CheckGrade& c) { return c.graded; });
}

std::string to_results_json(const Grade& grade, const Grade& marked) {
    json tests = json::array(), checks = json::array();
    for (const CheckGrade& check : marked.checks) tests.push_back(test_of(check, tests.size() + 1));
    for (const CheckGrade& check : grade.checks) checks.push_back(json_of(check));
    json j = {{"output", grade.trouble},
              {"stdout_visibility", "hidden"},
              {"tests", std::move(tests)},
              {"extra_data",
               {{"dynlab",
                 {{"format", 1},
                  {"submission", grade.submission},
                  {"lesson", grade.lesson},
                  {"isolation", grade.isolation},
                  {"fingerprint", grade.fingerprint},
                  {"trouble", grade.trouble},
                  {"printed", grade.printed},
                  {"late_hours", grade.late_hours},
                  {"penalty", grade.penalty},
                  {"whole", marked.whole()},
                  {"checks", std::move(checks)}}}}}};
    if (marked.whole()) j["score"] = marked.earned();
    return j.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

Grade from_results_json(const std::string& text) {
    try {
        const json j = json::parse(text).at("extra_data").at("dynlab");
        Grade grade;
        grade.submission = j.at("submission");
        grade.lesson = j.at("lesson");
        grade.isolation = j.at("isolation");
        grade.fingerprint = j.at("fingerprint");
        grade.trouble = j.at("trouble");
        grade.printed = j.at("printed");
        grade.late_hours = j.at("late_hours");
        grade.penalty = j.at("penalty");
        for (const json& check : j.at("checks")) grade.checks.push_back(check_of(check));
        return grade;
    } catch (const json::exception&) {
        throw EnvironmentError("this is not a result that dynlab grade wrote");
    }
}

}  // namespace dynlab::inline course
