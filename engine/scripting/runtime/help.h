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

/// All pages, sorted by name, as reference/*.md and reference/guides/*.md are.
std::span<const HelpPage> help_pages();
std::optional<HelpPage> find_help_page(std::string_view name);
/// The page of a function with its signature, arguments and options, which its row declares; others as they are
/// (nullptr).
std::string page_text(const HelpPage& page, const FunctionEntry* function);
/// What stands behind "guide: " or "subject: " in the third line of a page that is no function's.
std::string subject_of(const HelpPage& page);

constexpr std::size_t kHelpWidth = 80;  ///< columns, where nobody knows better

/// The functions by area with their summaries, the guides, then how to get on, in lines of at most `width` columns.
std::string help_overview(const std::vector<const FunctionEntry*>& functions, std::size_t width = kHelpWidth);
/// What there is to say about a name, laid out in lines of at most `width` columns: the page of a function or subject;
/// for a function of MATLAB or its toolboxes what is written here; for "iddata.split" or "fig.add" what the page of the
/// object says of the method; for a word of Lua the part of its guide; else the pages that speak of it. Throws
/// InvalidArgument with the nearest name where there is nothing.
std::string help_text(const std::string& name, const std::vector<const FunctionEntry*>& functions,
                      std::size_t width = kHelpWidth);
/// The functions and subjects in whose names, summaries or pages the words stand, those first in whose names it does.
/// Throws InvalidArgument where there are none.
std::string help_search(const std::string& word, const std::vector<const FunctionEntry*>& functions,
                        std::size_t width = kHelpWidth);

}  // namespace dynlab::inline scripting
