#include "scripting/runtime/help.h"

#include <fmt/format.h>

#include <algorithm>

#include "numerics/error.h"
#include "platform/spelling.h"

namespace dynlab::inline scripting {
namespace {

std::vector<std::string> help_names(const std::vector<const FunctionEntry*>& functions) {
    std::vector<std::string> names;
    for (const FunctionEntry* entry : functions) names.emplace_back(entry->name);
    for (const HelpPage& page : help_pages()) names.emplace_back(page.name);
    return names;
}

}  // namespace

std::optional<HelpPage> find_help_page(std::string_view name) {
    for (const HelpPage& page : help_pages())
        if (page.name == name) return page;
    return std::nullopt;
}

std::string help_overview(const std::vector<const FunctionEntry*>& functions) {
    std::vector<std::string_view> areas;
    for (const FunctionEntry* entry : functions)
        if (std::find(areas.begin(), areas.end(), entry->area) == areas.end()) areas.emplace_back(entry->area);
    std::string text;
    for (std::string_view area : areas) {
        text += fmt::format("{}\n", area);
        for (const FunctionEntry* entry : functions)
            if (entry->area == area) text += fmt::format("  {:<18} {}\n", entry->name, entry->summary);
        text += '\n';
    }
    return text +
           "help(\"lsim\") explains a function, help(\"matlab\") is a phrase book for those who come from MATLAB\n";
}

std::string help_text(const std::string& name, const std::vector<const FunctionEntry*>& functions) {
    if (const auto page = find_help_page(name)) return std::string(page->text);
    const auto entry =
        std::find_if(functions.begin(), functions.end(), [&](const FunctionEntry* e) { return e->name == name; });
    if (entry != functions.end()) return fmt::format("{}\n  {}\n", (*entry)->signature, (*entry)->summary);
    const auto near = nearest_word(name, help_names(functions));
    throw InvalidArgument(fmt::format("there is no help about '{}'{}", name,
                                      near ? fmt::format("; did you mean '{}'?", *near) : "; help() lists everything"));
}

}  // namespace dynlab::inline scripting
