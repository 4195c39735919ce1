
#include "scripting/runtime/help.h"
#include "numerics/models/transfer_function.h"
#include "scripting/bind/bindings.h"
#include "scripting/objects/figure_object.h"
#include "scripting/objects/model.h"
#include "scripting/runtime/text_form.h"

namespace dynlab::inline scripting {
namespace {

/// help(lsim) is understood like help("lsim").
std::string name_of_function(Call& call) {
    for (const FunctionEntry* entry : call.context().functions)
        if (lua_tocfunction(call.state(), 1) == entry->function) return entry->name;
    throw InvalidArgument("this function has no help page; help() lists the functions that have help pages");
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

/// The formula of a model with one channel; empty for other values.
std::string formula_of(lua_State* L, int index) {
    const Model* model = to_object<Model>(L, index);
    return model != nullptr && model->single_channel() ? "$\\displaystyle " + to_latex(model->G) + "$" : "";
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
    if (line.empty()) return 0;
    const ValueListener* const listener = call.context().services.listener;
    if (listener != nullptr && listener->expect) listener->expect(call.count() == 1 ? formula_of(L, 1) : "");
    call.print_lines(line + '\n');
    return 0;
}

constexpr FunctionEntry kHelpFunctions[] = {
    {"help", "help", "help(name)", "Show the help page of a function, or list all functions", guarded<help>},
    {"show", "help", "show(x, ...)", "Print values as the prompt does, and show figures", guarded<show>},
};

}  // namespace

FunctionEntries help_functions() {
    return kHelpFunctions;
}

}  // namespace dynlab::inline scripting
