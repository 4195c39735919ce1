#include <array>

#include "base/number_text.h"
#include "numerics/validation/advice.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/localized.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/objects/data_object.h"

namespace dynlab::inline scripting {
namespace {

/// {{first, last}, ...} as data:discard takes it.
void set_segments(const Call& call, const char* name, const std::vector<Segment>& segments) {
    give_list(call, segments, [&](const Segment& segment) {
        give_value(call, std::array{segment.first, segment.last});
    });
    lua_setfield(call.state(), -2, name);
}

void push_finding(const Call& call, const DataIssue& issue) {
    give_table(call, "code", issue.code, "warning", issue.weight == Weight::kWarning, "channel", issue.channel,
               "message", localized(call, issue.message), "value", issue.value, "experiment",
               static_cast<Index>(issue.experiment + 1));
    set_segments(call, "sections", issue.sections);
}

std::string text_of(const Call& call, const Advice& advice, std::size_t experiments) {
    std::string text;
    for (const DataIssue& issue : advice.findings)
        text +=
            fmt::format("{} {}{}\n", issue.weight == Weight::kWarning ? "!" : "-",
                        experiments > 1 ? localized(call, Message("Experiment {}:", issue.experiment + 1)) + " " : "",
                        localized(call, issue.message));
    if (advice.clean())
        text += localized(call, Message("No problems were found. You can fit a model to these data.")) + "\n";
    return text;
}

/// print(advice(data)): the sentences have been printed, so that this only says what the table holds.
int advice_to_text(lua_State* L) {
    const std::string text = localized(
        Call(L),
        plural(static_cast<std::int64_t>(lua_rawlen(L, 1)),
               "({} issue; the result a = advice(data) has the fields a[1].message, ..., a.clean and a.discard)",
               "({} issues; the result a = advice(data) has the fields a[1].message, ..., a.clean and a.discard)"));
    lua_pushlstring(L, text.data(), text.size());
    return 1;
}

int advice_table(Call& call) {
    call.at_most(1);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const Advice advice = advise(data, call.cancel());
    call.print(text_of(call, advice, data.experiments.size()));
    give_list(call, advice.findings, [&](const DataIssue& issue) { push_finding(call, issue); });
    set_field(call, "clean", advice.clean());
    set_segments(call, "discard", advice.discard);
    return 1;
}

/// A result from the cache is a plain table: this function adds its __tostring.
int give_advice(Call& call) {
    run_memoized_call(call, advice_table);
    lua_createtable(call.state(), 0, 1);
    lua_pushcfunction(call.state(), advice_to_text);
    lua_setfield(call.state(), -2, "__tostring");
    lua_setmetatable(call.state(), -2);
    return 1;
}

constexpr FunctionEntry kAdviceFunctions[] = {
    {"advice", "data", "advice(data) -> table", "Check a data set for common problems before estimation",
     guarded<give_advice>},
};

}  // namespace

FunctionEntries advice_functions() {
    return kAdviceFunctions;
}

}  // namespace dynlab::inline scripting
