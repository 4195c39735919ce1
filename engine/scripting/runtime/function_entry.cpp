#include "scripting/runtime/function_entry.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace dynlab::inline scripting {
namespace {

struct RenamedFunction {
    std::string_view earlier, present;
};
constexpr std::array kRenamedFunctions = {
    RenamedFunction{"guess", "predict_first"}, RenamedFunction{"outcome", "reveal"}, RenamedFunction{"rig", "plant"},
    RenamedFunction{"rig_truth", "true_model"}, RenamedFunction{"declare_rig", "declare_plant"}};

}  // namespace

std::string signature_text(const FunctionEntry& function) {
    constexpr std::string_view kPlace = "{options}";
    constexpr std::size_t kShown = 4;
    std::string text = function.signature;
    const std::vector<std::string> names = option_names(function.options);
    const bool all = names.size() <= kShown;
    std::string list;
    for (std::size_t i = 0; i < (all ? names.size() : kShown - 1); ++i) list += (i > 0 ? ", " : "") + names[i] + " =";
    if (!all) list += ", ...";
    for (std::size_t at = text.find(kPlace); at != text.npos; at = text.find(kPlace))
        text.replace(at, kPlace.size(), "{" + list + "}");
    return text;
}

std::string_view present_name(std::string_view earlier) {
    const auto found = std::ranges::find(kRenamedFunctions, earlier, &RenamedFunction::earlier);
    return found == kRenamedFunctions.end() ? std::string_view() : found->present;
}

Message renamed(std::string_view earlier) {
    return Message("{} is now called {}; the earlier name works until the end of 2027", std::string(earlier),
                   std::string(present_name(earlier)));
}

std::string other_spelling(std::string name) {
    static constexpr std::array kSpellings = {std::pair("color", "colour"), std::pair("centered", "centred"),
                                              std::pair("realizations", "realisations"),
                                              std::pair("variant", "specimen"), std::pair("plant", "rig")};
    for (const auto& [present, earlier] : kSpellings)
        if (name == present || name == earlier) return name == present ? earlier : present;
    if (name.empty()) return name;
    const auto first = static_cast<unsigned char>(name[0]);
    name[0] = static_cast<char>(std::isupper(first) ? std::tolower(first) : std::toupper(first));
    return name;
}

std::string initial_text(const OptionEntry& option) {
    if (*option.facts.initial != '\0') return option.facts.initial;
    return option.initial == nullptr ? std::string() : option.initial();
}

const OptionEntry* find_option(OptionTables tables, const std::string& name) {
    const std::string other = other_spelling(name);
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
