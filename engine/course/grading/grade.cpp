#include "course/grading/grade.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/reader.h"
#include "course/grading/grade_description.h"
#include "data_io/values/json_values.h"
#include "data_io/values/message_values.h"
#include "platform/error.h"

namespace dynlab::inline course {

namespace {

using nlohmann::json;

double rounded(double points) {
    return std::round(100 * points) / 100;
}

json test_of(const CheckGrade& check, std::size_t number) {
    const std::string state = !check.graded ? "ungraded" : check.earned >= check.points ? "passed" : "failed";
    MessageList shown{{}, Join::kLines};
    if (check.visible && !check.message.empty()) shown.items.push_back(check.message);
    if (state == "failed" && !check.hint.empty()) shown.items.push_back(check.hint);
    const Message output = Message("{}", shown);
    JsonWriter stored;
    write_value(stored, output);
    json test = {{"number", std::to_string(number)}, {"name", message_text(check.about)},
                 {"max_score", check.points},        {"output", message_text(output)},
                 {"visibility", "visible"},          {"extra_data", {{"dynlab", {{"output", stored.value()}}}}}};
    if (check.graded) {
        test["score"] = rounded(check.earned);
        test["status"] = state;
    }
    return test;
}

/// What `read` makes of the text of a file of results.
template <class Read>
auto read_results(const std::string& text, const Read& read) {
    try {
        return read(parsed_json(text));
    } catch (const json::exception&) {
    } catch (const ValueError&) {
    }
    throw EnvironmentError("this result was not written by dynlab grade");
}

}  // namespace

double Grade::earned() const {
    if (whole_mark) return rounded(*whole_mark);
    double sum = -penalty;
    for (const CheckGrade& check : checks) sum += check.graded ? check.earned : 0;
    return rounded(std::max(0.0, sum));
}

double Grade::possible() const {
    double sum = 0;
    for (const CheckGrade& check : checks) sum += check.graded || whole_mark ? check.points : 0;
    return sum;
}

bool Grade::whole() const {
    if (whole_mark) return true;
    return !checks.empty() && std::all_of(checks.begin(), checks.end(), [](const CheckGrade& c) { return c.graded; });
}

std::string to_results_json(const Grade& grade, const Grade& marked) {
    json tests = json::array();
    for (const CheckGrade& check : marked.checks) tests.push_back(test_of(check, tests.size() + 1));
    Grade kept = grade;  // the file may be passed on to students
    for (CheckGrade& check : kept.checks)
        if (!check.visible) check.message = Message();
    JsonWriter writer;
    write_value(writer, kept);
    json own = writer.value();
    own["format"] = 1;
    own["whole"] = marked.whole();
    const bool costs = marked.penalty > 0;
    MessageList output{{}, Join::kLines};
    if (!grade.error_reason.empty()) output.items.push_back(grade.error_reason);
    if (costs)
        output.items.push_back(
            Message("The submission was late. Points deducted: {} ({}).", decimals(marked.penalty, 2), grade.lateness));
    if (marked.whole_mark) output.items.push_back(Message("Marked as a whole: {}", marked.whole_reason));
    json j = {{"output", message_text(Message("{}", output))},
              {"stdout_visibility", "hidden"},
              {"tests", std::move(tests)},
              {"extra_data", {{"dynlab", std::move(own)}}}};
    if (marked.whole()) j["score"] = marked.earned();
    return j.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

Grade from_results_json(const std::string& text) {
    return read_results(
        text, [](const json& results) { return value_of_json<Grade>(results.at("extra_data").at("dynlab")); });
}

std::vector<ShownResult> shown_results(const std::string& text) {
    return read_results(text, [](const json& results) {
        std::vector<ShownResult> shown;
        for (const json& test : results.at("tests")) {
            const double points = test.at("max_score");
            shown.push_back({Message::verbatim(test.at("name")),
                             value_of_json<Message>(test.at("extra_data").at("dynlab").at("output")), points,
                             test.value("score", points)});
        }
        return shown;
    });
}

}  // namespace dynlab::inline course
