#include <array>

#include "scripting/bind/bindings.h"
#include "scripting/objects/figure_object.h"
#include "scripting/objects/text_form.h"
#include "scripting/runtime/help.h"

namespace dynlab::inline scripting {
namespace {

/// help(lsim) is understood like help("lsim").
std::string name_of_function(Call& call) {
    for (const FunctionEntry* entry : call.context().functions)
        if (lua_tocfunction(call.state(), 1) == entry->function) return entry->name;
    throw InvalidArgument("this function has no help; help() lists those that have");
}

int help(Call& call) {
    call.at_most(1);
    const auto& functions = call.context().functions;
    std::string text = help_overview(functions);
    if (call.given(1))
        text = help_text(call.type(1) == LUA_TFUNCTION ? name_of_function(call) : call.text(1, "name"), functions);
    call.print(text);
    return 0;
}

int show(Call& call) {
    lua_State* L = call.state();
    std::string line;
    for (int i = 1; i <= call.count(); ++i) {
        if (const FigurePointer* figure = to_object<FigurePointer>(L, i))
            call.context().recorder.show_figure(*figure);
        else
            line += (line.empty() ? "" : "\t") + text_for_reading(L, i);
    }
    if (!line.empty()) call.print_lines(line + '\n');
    return 0;
}

constexpr std::array kHelpFunctions = {
    FunctionEntry{"help", "help", "help(name)", "explains a function; without a name, lists everything by area",
                  guarded<help>},
    FunctionEntry{"show", "help", "show(x, ...)", "prints values as the prompt does, figures as figures",
                  guarded<show>},
};

}  // namespace

FunctionEntries help_functions() {
    return kHelpFunctions;
}

}  // namespace dynlab::inline scripting
