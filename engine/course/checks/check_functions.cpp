#include "course/checks/check_functions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <variant>

#include "base/reader.h"
#include "course/checks/check_data.h"
#include "course/checks/check_session.h"
#include "data_io/values/json_values.h"
#include "platform/spelling.h"
#include "scripting/answers/answer_value.h"
#include "scripting/conversions/arguments.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/runtime/context.h"
#include "scripting/runtime/errors.h"

namespace dynlab::inline course {
namespace {

CheckSession& session_of(const Call& call) {
    return call.owner<CheckSession>();
}

/// A judgement: {share =, message =}.
int give_result(const Call& call, double share, const Message& message) {
    const std::string text = message_text(message);
    session_of(call).said[text] = message;
    return give_table(call, "share", share, "message", text);
}

/// What a judgement of this text says; verbatim where the author of the checks wrote it.
Message message_said(const Call& call, const std::string& text) {
    const auto& said = session_of(call).said;
    const auto known = said.find(text);
    if (known != said.end()) return known->second;
    return text.empty() ? Message() : Message::verbatim(text);
}

/// The sentences of a message that lists several, or the message itself.
std::vector<Message> sentences_of(const Message& message) {
    if (message.id() == "{}")
        if (const auto* const list = std::get_if<MessageList>(&message.arguments().front());
            list != nullptr && list->join == Join::kSentences)
            return list->items;
    return {message};
}

// ---------------------------------------------------------------------------------------------------------------------
// Helpers that explain themselves

/// The numbers or vectors that are compared; arguments 1 and 2.
struct Compared {
    explicit Compared(const Call& call) {
        if (call.type(1) == LUA_TNUMBER && call.type(2) == LUA_TNUMBER) {
            given = Vector::Constant(1, lua_tonumber(call.state(), 1));
            expected = Vector::Constant(1, lua_tonumber(call.state(), 2));
        } else {
            given = call.vector(1, "x");
            expected = call.vector(2, "wanted");
        }
    }

    bool comparable() const { return given.size() == expected.size() && given.allFinite(); }

    /// The largest, relative to the largest wanted value unless `absolute`; infinite where there is none.
    double distance(bool absolute) const {
        if (!comparable()) return std::numeric_limits<double>::infinity();
        if (expected.size() == 0) return 0;
        const double apart = (given - expected).cwiseAbs().maxCoeff(), size = expected.cwiseAbs().maxCoeff();
        return absolute || apart == 0 ? apart : apart / size;
    }

    Vector given, expected;
};

/// Whether this check uses data sets that students must learn nothing about: the distance of an answer from the true
/// value would reveal that value to a student who submits twice.
bool uses_hidden_data(const Call& call) {
    const CheckSession& session = session_of(call);
    if (!session.current) return false;
    const std::string& rerun = session.current->rerun;
    return session.took_hidden || (!rerun.empty() && rerun != kOtherSeedRun);
}

constexpr std::array kNearOptions = {
    OptionEntry{"rel", ValueKind::kNumber, about("largest relative error of a correct answer"), {.initial = "0.05"}},
    OptionEntry{"abs", ValueKind::kNumber, about("largest absolute error of a correct answer, instead of 'rel'")},
    OptionEntry{"half", ValueKind::kNumber,
                about("largest error that earns half the points, relative or absolute as the tolerance. Default: the "
                      "tolerance")}};
constexpr OptionTable kNear[] = {kNearOptions};

int near(Call& call) {
    call.at_most(3);
    const Options options(call, 3, kNear);
    const bool absolute = options.has("abs");
    if (absolute && options.has("rel")) throw InvalidArgument("specify either 'rel' or 'abs', not both");
    const double max_error = absolute ? options.number("abs", 0) : options.number("rel", 0.05);
    const double half = options.number("half", max_error);  // this far away earns half the points
    if (!(max_error >= 0) || !(half >= max_error))
        throw InvalidArgument(
            "the tolerance must be nonnegative and at most 'half', but the tolerance is {} and 'half' is {}", max_error,
            half);
    const Compared compared(call);
    const double apart = compared.distance(absolute);
    const auto measured = [&](double x) {
        return absolute ? Message("{}", significant(x, 3)) : Message("{} %", significant(100 * x, 3));
    };
    if (apart <= max_error) return give_result(call, 1, {});
    if (!absolute && compared.comparable() && compared.expected.isZero(0))
        throw InvalidArgument(
            "the expected value is 0, so a relative tolerance allows no error: give an absolute tolerance, {abs = "
            "...}");
    if (!std::isfinite(apart))
        return give_result(call, 0, Message("The answer is not a finite number, or has the wrong size."));
    if (uses_hidden_data(call))
        return give_result(call, apart <= half ? 0.5 : 0,
                           Message("On a data set that you have not seen, the error is too large."));
    return give_result(
        call, apart <= half ? 0.5 : 0,
        Message("The error is {}; the largest allowed error is {}.", measured(apart), measured(max_error)));
}

int points_between(Call& call) {
    call.at_most(3);
    const double x = call.number(1, "x"), low = call.number(2, "low"), high = call.number(3, "high");
    if (!(low != high)) throw InvalidArgument("'low' and 'high' must differ, but both are {}", low);
    const double share = std::isfinite(x) ? std::clamp((x - low) / (high - low), 0.0, 1.0) : 0;
    if (share == 1) return give_result(call, 1, {});
    if (uses_hidden_data(call))
        return give_result(call, share,
                           Message("On a data set that you have not seen, the answer does not earn full points."));
    return give_result(call, share,
                       Message("The score is {}. A score of {} earns full points, and a score of {} earns no points.",
                               significant(x, 3), significant(high, 3), significant(low, 3)));
}

/// What a test may return at a stack index: true or false, a share, a judgement.
CheckOutcome check_outcome_at(const Call& call, int index) {
    lua_State* L = call.state();
    CheckOutcome outcome;
    switch (lua_type(L, index)) {
        case LUA_TNIL:
        case LUA_TNONE:
            break;
        case LUA_TBOOLEAN:
            outcome.share = lua_toboolean(L, index) ? 1 : 0;
            break;
        case LUA_TNUMBER: {
            const double share = lua_tonumber(L, index);
            if (share < 0 || share > 1)
                throw InvalidArgument("a test returned {}; expected a number from 0 to 1", significant(share, 4));
            outcome.share = std::isfinite(share) ? share : 0;
            break;
        }
        case LUA_TTABLE:
            lua_getfield(L, index, "share");
            outcome = check_outcome_at(call, lua_gettop(L));
            lua_getfield(L, index, "message");
            if (lua_type(L, -1) == LUA_TSTRING) outcome.message = message_said(call, lua_tostring(L, -1));
            lua_pop(L, 2);
            break;
        default:
            throw InvalidArgument(
                "a test must return true, false, a number from 0 to 1, or the result of near(...) or a similar "
                "function");
    }
    return outcome;
}

/// The least share, with the messages of what falls short.
int all_of(Call& call) {
    double least = 1;
    std::vector<Message> said;
    for (int i = 1; i <= call.count(); ++i) {
        const CheckOutcome one = check_outcome_at(call, i);
        least = std::min(least, one.share);
        if (!(one.share < 1) || one.message.empty()) continue;
        for (Message& sentence : sentences_of(one.message))
            if (std::ranges::find(said, sentence) == said.end()) said.push_back(std::move(sentence));
    }
    return give_result(call, least, sentences(std::move(said)));
}

int any_of(Call& call) {
    CheckOutcome best;
    for (int i = 1; i <= call.count(); ++i) {
        const CheckOutcome one = check_outcome_at(call, i);
        if (i == 1 || one.share > best.share) best = one;
    }
    return give_result(call, best.share, best.message);
}

/// Whether two answers differ by more than rounding, as answers computed from different data sets do.
int differs(Call& call) {
    call.at_most(2);
    constexpr double kEqualityTolerance = 1e-9;
    if (Compared(call).distance(false) > kEqualityTolerance) return give_result(call, 1, {});
    return give_result(call, 0, Message("The answer is the same for another data set: compute it from the data."));
}

// ---------------------------------------------------------------------------------------------------------------------
// Facts

int has(Call& call, const std::vector<std::string>& names, const Message& otherwise) {
    const bool there = std::ranges::find(names, call.text(1, "name")) != names.end();
    return there ? give_result(call, 1, {}) : give_result(call, 0, otherwise);
}

int has_figure(Call& call) {
    call.at_most(1);
    return has(call, session_of(call).runs.at(kMainRun).figures,
               Message("The report has no figure \"{}\".", call.text(1, "name")));
}

int has_value(Call& call) {
    call.at_most(1);
    return has(call, session_of(call).runs.at(kMainRun).values,
               Message("The report has no value \"{}\".", call.text(1, "name")));
}

/// no_finding(id, ...): none of these findings of the document, or none at all that breaks a rule.
int no_finding(Call& call) {
    std::vector<std::string> ids;
    for (int i = 1; i <= call.count(); ++i) ids.push_back(call.text(i, "id"));
    static const std::set<std::string> no_document = {"document-fails", "analysis-fails", "analysis-missing",
                                                      "folder-too-large"};
    for (const Issue& issue : session_of(call).findings) {
        const bool concerned = no_document.contains(issue.id) || ids.empty()
                                   ? issue.severity == Severity::kRule
                                   : std::find(ids.begin(), ids.end(), issue.id) != ids.end();
        if (concerned) return give_result(call, 0, issue.what);
    }
    return give_result(call, 1, {});
}

constexpr const char* kArea = "checks";
constexpr std::array kFunctions = {
    FunctionEntry{"near", kArea, "near(x, wanted, {rel = | abs =, half =})", "compares a number or vector",
                  guarded<near>, kNear},
    FunctionEntry{"points_between", kArea, "points_between(x, low, high)", "a share that grows from low to high",
                  guarded<points_between>},
    FunctionEntry{"all_of", kArea, "all_of(judgement, ...)", "the smallest of several shares", guarded<all_of>},
    FunctionEntry{"any_of", kArea, "any_of(judgement, ...)", "the largest of several shares", guarded<any_of>},
    FunctionEntry{"differs", kArea, "differs(x, y)", "whether an answer was computed from the data", guarded<differs>},
    FunctionEntry{"has_figure", kArea, "has_figure(name)", "whether the report has this figure", guarded<has_figure>},
    FunctionEntry{"has_value", kArea, "has_value(name)", "whether the report has this value", guarded<has_value>},
    FunctionEntry{"no_finding", kArea, "no_finding(id, ...)", "whether the document has no findings",
                  guarded<no_finding>},
};

// ---------------------------------------------------------------------------------------------------------------------
// Trying a check

/// Whether an answer contains NaN or an infinite number (see data_io/values/json_values.h).
bool holds_no_numbers(const nlohmann::json& answer) {
    if (answer.is_string()) return answer == "NaN" || answer == "Infinity" || answer == "-Infinity";
    return answer.is_structured() && std::any_of(answer.begin(), answer.end(), holds_no_numbers);
}

/// Multiplies the number, vector, matrix or model on top, or those in the table there; true becomes false.
void multiply_on_top(lua_State* L, double factor) {
    const int top = lua_gettop(L);
    switch (lua_type(L, top)) {
        case LUA_TBOOLEAN:
            lua_pushboolean(L, !lua_toboolean(L, top));
            return lua_replace(L, top);
        case LUA_TTABLE:
            for (lua_pushnil(L); lua_next(L, top) != 0; lua_settop(L, top + 1)) {
                multiply_on_top(L, factor);
                lua_pushvalue(L, top + 1);
                lua_insert(L, -2);
                lua_rawset(L, top);
            }
            return;
        case LUA_TNUMBER:
        case LUA_TUSERDATA:
            lua_pushnumber(L, factor);
            return lua_arith(L, LUA_OPMUL);
        default:
            return;
    }
}

/// Why an answer is not available, in words for the student. For runs other than the run on the student's own data
/// sets, the message contains nothing that the script chose itself.
Message answer_error(const std::string& name, const std::string& run,
                     const std::map<std::string, RecordedAnswer>& answers) {
    const auto given = answers.find(name);
    if (run != kMainRun && given != answers.end())
        return Message("The answer \"{}\" was not submitted in the requested form.", name);
    if (given != answers.end()) {
        std::string why = parsed_json(given->second.json).value("why", "");
        if (!why.empty()) why.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(why.front())));
        return Message::verbatim(why + ".");
    }
    std::vector<std::string> unknown;
    for (const auto& [other, answer] : answers)
        if (run == kMainRun && answer.kind == kRefusedAnswer) unknown.push_back(other);
    const auto near = nearest_word(name, unknown);
    if (!near) return Message("The answer \"{}\" was not submitted.", name);
    return Message("The answer \"{}\" was not submitted; \"{}\" was submitted, which the lesson does not ask for.",
                   name, *near);
}

/// Reads an answer when it is first asked for; upvalue 3 is the name of the run. One that is not there fails the check,
/// in words for the student.
int answer_of(Call& call) {
    lua_State* L = call.state();
    const std::string name = call.text(2, "name"), run = lua_tostring(L, lua_upvalueindex(3));
    CheckSession& session = session_of(call);
    const auto refuse = [&session](const Message& why) { throw InvalidArgument(session.answer_error = why); };
    const auto& answers = session.runs[run].answers;
    const auto answer = answers.find(name);
    if (answer == answers.end() || answer->second.kind == kRefusedAnswer) refuse(answer_error(name, run, answers));
    const auto& [kind, text] = answer->second;
    if (kind != "data" && kind != "text" && holds_no_numbers(parsed_json(text)))
        refuse(Message("The answer \"{}\" contains NaN or infinite numbers.", name));
    push_answer_value(L, text);
    if (session.change && session.change->first == name) multiply_on_top(L, session.change->second);
    lua_pushvalue(L, 2);
    lua_pushvalue(L, -2);
    lua_rawset(L, 1);
    return 1;
}

/// The answers of a run as a table, which knows the run.
void push_answers(const Call& call, const std::string& run) {
    lua_State* L = call.state();
    lua_newtable(L);
    give_table(call, kRunOfAnswers, run);
    lua_pushlightuserdata(L, const_cast<char*>("_"));
    lua_pushlightuserdata(L, &session_of(call));  // where Call::owner reads it
    call.give(run);
    lua_pushcclosure(L, guarded<answer_of>, 3);
    lua_setfield(L, -2, "__index");
    lua_setmetatable(L, -2);
}

/// The sentence of the first common mistake that the answers match.
std::optional<Message> mistake_made(const Call& call, const DeclaredCheck& check, int answers) {
    if (check.mistakes == 0) return {};
    lua_State* L = call.state();
    const int top = lua_gettop(L);
    lua_rawgeti(L, LUA_REGISTRYINDEX, check.mistakes);
    std::optional<Message> said;
    for (lua_Integer i = 1; !said && lua_rawgeti(L, top + 1, i) == LUA_TTABLE; ++i, lua_settop(L, top + 1)) {
        lua_getfield(L, -1, "say");
        lua_getfield(L, -2, "when");
        if (lua_type(L, -1) != LUA_TFUNCTION || lua_type(L, -2) != LUA_TSTRING)
            throw InvalidArgument("entry {} of 'mistakes' must be {when = function, say = text}", i);
        lua_pushvalue(L, answers);
        lua_pushvalue(L, answers + 1);
        // A mistake that cannot be looked for was not made.
        const bool made = lua_pcall(L, 2, 1, 0) == LUA_OK && check_outcome_at(call, lua_gettop(L)).share == 1;
        if (made) said = Message::verbatim(lua_tostring(L, -2));
    }
    lua_settop(L, top);
    return said;
}

/// For a data set that students must learn nothing about, an error message or a number in a test's message may quote
/// the data. The message then goes to the instructor only.
void keep_secret(const CheckSession& session, bool ended, CheckOutcome& outcome) {
    const bool has_number = message_text(outcome.message).find_first_of("0123456789") != std::string::npos;
    if (ended ? !has_number : outcome.message == session.answer_error) return;
    if (outcome.for_instructor.empty()) outcome.for_instructor = std::move(outcome.message);
    outcome.message = ended ? Message("On a data set that you have not seen, the answer does not earn full points.")
                            : Message(
                                  "On a data set that you have not seen, the check ended with an error. The answer "
                                  "probably has the wrong type or size.");
}

int store_outcome(Call& call) {
    CheckSession& session = session_of(call);
    lua_State* L = call.state();
    const DeclaredCheck& check = session.checks.at(static_cast<std::size_t>(call.size(1, "number")));
    session.current = &check;
    session.took_hidden = false;
    session.answer_error = Message();
    const int answers = lua_gettop(L) + 1;
    push_answers(call, kMainRun);
    push_answers(call, check.rerun.empty() ? kMainRun : check.rerun);
    lua_rawgeti(L, LUA_REGISTRYINDEX, check.test);
    lua_pushvalue(L, answers);
    lua_pushvalue(L, answers + 1);
    const bool ended = lua_pcall(L, 2, 2, 0) == LUA_OK;
    CheckOutcome found;
    if (ended) {
        found = check_outcome_at(call, answers + 2);
        if (lua_type(L, answers + 3) == LUA_TSTRING && found.share < 1)
            found.message = message_said(call, lua_tostring(L, answers + 3));
    } else {
        pass_stop_on(L);
        const PlacedMessage error =
            lua_type(L, -1) == LUA_TSTRING ? error_at(L, -1) : PlacedMessage{Message("The check failed.")};
        // Where in the checks it happened is nothing to the student.
        found.message = error.message;
        if (message_text(found.message) == message_text(session.answer_error))
            found.message = session.answer_error;
        else
            found.for_instructor = error.with_place();
    }
    if (found.share < 1 && uses_hidden_data(call)) keep_secret(session, ended, found);
    if (found.share < 1)
        if (auto said = mistake_made(call, check, answers)) found.message = *std::move(said);
    session.outcome = std::move(found);
    return 0;
}

constexpr std::array kOutcomeFunction = {
    FunctionEntry{"_verdict", kArea, "", "", guarded<store_outcome>},
};

}  // namespace

FunctionEntries check_functions() {
    return kFunctions;
}

FunctionEntries outcome_function() {
    return kOutcomeFunction;
}

std::vector<std::string> names_of_check_functions() {
    std::vector<std::string> names;
    for (const auto functions : {check_declarations, check_functions, check_source_functions, check_data_functions})
        for (const FunctionEntry& entry : functions()) names.emplace_back(entry.name);
    return names;
}

}  // namespace dynlab::inline course
