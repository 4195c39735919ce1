#include "scripting/runtime/option_entry.h"

#include "scripting/conversions/option_words.h"

namespace dynlab::inline scripting {

std::string initial_text(const OptionEntry& option) {
    if (*option.facts.initial != '\0') return option.facts.initial;
    return option.initial == nullptr ? std::string() : option.initial();
}

const OptionEntry* find_option(OptionTables tables, const std::string& name) {
    const std::string other = with_other_case(name);
    for (const OptionTable& table : tables)
        for (const OptionEntry& option : table)
            if (name == option.name || other == option.name) return &option;
    return nullptr;
}

std::vector<std::string> option_names(OptionTables tables) {
    std::vector<std::string> names;
    for (const OptionTable& table : tables)
        for (const OptionEntry& option : table) names.emplace_back(option.name);
    return names;
}

}  // namespace dynlab::inline scripting
