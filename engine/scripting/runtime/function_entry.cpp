#include "scripting/runtime/function_entry.h"

namespace dynlab::inline scripting {

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

}  // namespace dynlab::inline scripting
