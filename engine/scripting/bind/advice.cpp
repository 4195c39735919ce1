#include <algorithm>
#include <array>

#include "numerics/validation/advice.h"
#include "scripting/arguments/option_words.h"
#include "scripting/arguments/table_fields.h"
#include "scripting/bind/bindings.h"
#include "scripting/objects/data_object.h"

namespace dynlab::inline scripting {
namespace {

/// {{first, last}, ...} as data:discard takes it.
void push_segments(lua_State* L, const std::vector<Segment>& segments) {
    lua_createtable(L, static_cast<int>(segments.size()), 0);
    for (std::size_t i = 0; i < segments.size(); ++i) {
        lua_createtable(L, 2, 0);
        lua_pushinteger(L, segments[i].first);
        lua_rawseti(L, -2, 1);
        lua_pushinteger(L, segments[i].last);
        lua_rawseti(L, -2, 2);
        lua_rawseti(L, -2, static_cast<lua_Integer>(i + 1));
    }
}

void push_finding(const Call& call, const RecordFinding& finding) {
    lua_State* L = call.state();
    lua_createtable(L, 0, 7);
    set_text(call, "code", finding.code);
    set_flag(L, "warning", finding.weight == Weight::kWarning);
    set_text(call, "channel", finding.channel);
    set_text(call, "message", in_lua_words(finding.message));
    set_number(L, "value", finding.value);
    set_integer(L, "experiment", static_cast<Index>(finding.experiment + 1));
    push_segments(L, finding.sections);
    lua_setfield(L, -2, "sections");
}

std::string text_of(const Advice& advice, std::size_t experiments) {
    std::string text;
    for (const RecordFinding& finding : advice.findings)
        text += fmt::format("{} {}{}\n", finding.weight == Weight::kWarning ? "!" : "-",
                            experiments > 1 ? fmt::format("Experiment {}: ", finding.experiment + 1) : "",
                            in_lua_words(finding.message));
    if (advice.clean()) text += "There is no objection to fitting a model to this record.\n";
    return text;
}

int give_advice(Call& call) {
    call.at_most(1);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const Advice advice = advise(data, call.cancel());
    call.print(text_of(advice, data.experiments.size()));
    lua_State* L = call.state();
    lua_createtable(L, static_cast<int>(advice.findings.size()), 2);
    for (std::size_t i = 0; i < advice.findings.size(); ++i) {
        push_finding(call, advice.findings[i]);
        lua_rawseti(L, -2, static_cast<lua_Integer>(i + 1));
    }
    set_flag(L, "clean", advice.clean());
    push_segments(L, advice.discard);
    lua_setfield(L, -2, "discard");
    return 1;
}

constexpr std::array kAdviceFunctions = {
    FunctionEntry{"advice", "data", "advice(data) -> table",
                  "what a teacher would say of a record before a model is fitted to it", guarded<give_advice>},
};

}  // namespace

FunctionEntries advice_functions() {
    return kAdviceFunctions;
}

}  // namespace dynlab::inline scripting
