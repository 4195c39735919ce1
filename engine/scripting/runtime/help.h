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
/// The page of a function with the parts that its row declares (summary, syntax, arguments, options); for a guide or
/// subject (nullptr) the text, with its subject as a sentence.
std::string page_text(const HelpPage& page, const FunctionEntry* function);
/// The text after "guide: " or "subject: " in the third line of a guide or subject.
std::string subject_of(const HelpPage& page);

constexpr std::size_t kHelpWidth = 80;  ///< columns, if the width of the terminal is unknown

/// The functions by area with their summaries, the guides and further commands, in lines of at most `width` columns.
std::string help_overview(const std::vector<const FunctionEntry*>& functions, std::size_t width = kHelpWidth);
/// The answer to a name, laid out in lines of at most `width` columns. In this order:
/// - the page of a function or subject
/// - the method of an object ("iddata.split", "fig.add"), from the page of the object
/// - the equivalent of a function of MATLAB or its toolboxes
/// - the part of the guide to Lua about a word of Lua
/// - the pages that contain the word
///
/// Throws InvalidArgument with the nearest name if there is no answer.
std::string help_text(const std::string& name, const std::vector<const FunctionEntry*>& functions,
                      std::size_t width = kHelpWidth);
/// The functions and subjects whose names, summaries or pages contain the words; hits in names come first.
/// Throws InvalidArgument if there are none.
std::string help_search(const std::string& word, const std::vector<const FunctionEntry*>& functions,
                        std::size_t width = kHelpWidth);

}  // namespace dynlab::inline scripting
