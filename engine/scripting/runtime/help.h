#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scripting/runtime/function_entry.h"

namespace dynlab::inline scripting {

/// A page of reference/, compiled into the program.
struct HelpPage {
    std::string_view name;  ///< of the function, or of a subject such as "matlab"
    std::string_view text;  ///< Markdown
};

/// All pages, sorted by name (from reference/*.md, made at build time).
std::span<const HelpPage> help_pages();
std::optional<HelpPage> find_help_page(std::string_view name);

/// The functions by area with signature and summary, then how to get on.
std::string help_overview(const std::vector<const FunctionEntry*>& functions);
/// The page of a function or subject; without a page the catalogue's line. Throws InvalidArgument with the nearest
/// name.
std::string help_text(const std::string& name, const std::vector<const FunctionEntry*>& functions);

}  // namespace dynlab::inline scripting
