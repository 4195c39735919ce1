#include <algorithm>
#include <nlohmann/json.hpp>

#include "scripting/answers/answer_value.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/arguments.h"
#include "scripting/runtime/context.h"

namespace dynlab::inline scripting {
namespace {

/// Throws where the script's header declares answers, but none of this name, or of another kind.
void check_declared(const std::vector<ExpectedAnswer>& expected, const std::string& name, const std::string& kind) {
    if (expected.empty()) return;
    std::vector<std::string> names;
    for (const ExpectedAnswer& answer : expected) {
        names.push_back(answer.name);
        if (answer.name == name && answer.kind != kind)
            throw InvalidArgument("the answer \"{}\" must be of the kind {}, but a value of the kind {} was given",
                                  name, answer.kind, kind);
    }
    if (std::ranges::find(names, name) == names.end()) throw InvalidArgument(undeclared_answer(name, names));
}

/// The kind that the script's header declares for an answer; empty where it declares none of this name.
std::string kind_of(const std::vector<ExpectedAnswer>& expected, const std::string& name) {
    const auto found = std::ranges::find(expected, name, &ExpectedAnswer::name);
    return found == expected.end() ? std::string() : found->kind;
}

AnswerValue checked_answer(const Call& call, const std::string& name) {
    if (!call.given(2))
        wrong_argument(call.state(), 2, "value", Message("the value of the answer, such as 2.5 or {1, 2}"));
    const Recorder& recorder = call.context().recorder;
    if (call.type(2) == LUA_TTABLE && kind_of(recorder.expected_answers(), name) == "vector") call.vector(2, "value");
    AnswerValue value = answer_value(call.state(), 2);
    check_declared(recorder.expected_answers(), name, value.kind);
    return value;
}

AnswerValue refused_answer(const std::string& why) {
    using nlohmann::json;
    const json refused = {{"kind", kRefusedAnswer}, {"why", why}};
    return {kRefusedAnswer, refused.dump(-1, ' ', false, json::error_handler_t::replace)};
}

/// Where the script is graded, an answer that cannot be taken costs that answer and not those behind it.
int answer(Call& call) {
    call.at_most(2);
    const std::string name = call.text(1, "name");
    std::map<std::string, RecordedAnswer>& answers = call.context().recorder.record().answers;
    AnswerValue value;
    try {
        value = checked_answer(call, name);
        const auto before = answers.find(name);  // the same value again is one answer
        if (before != answers.end() && before->second.json != value.json)
            throw InvalidArgument("the answer \"{}\" already has another value; specify each answer only once", name);
    } catch (const InvalidArgument& error) {
        if (!call.context().options.graded) throw;
        value = refused_answer(error.what());
    }
    answers[name] = {std::move(value.kind), std::move(value.json)};
    return 0;
}

constexpr FunctionEntry kAnswersFunctions[] = {
    {"answer", "report", "answer(name, value)", "Submit a result for the checks", guarded<answer>},
};

}  // namespace

FunctionEntries answer_functions() {
    return kAnswersFunctions;
}

}  // namespace dynlab::inline scripting
