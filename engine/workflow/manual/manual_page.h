#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace dynlab::inline workflow {

/// A page of the manual on its way: what stands between the site's bar and the scripts.
struct ManualPage {
    std::string file;    ///< "help-srivc.html", all in one folder
    std::string title;   ///< plain text
    std::string kind;    ///< "lesson", "demonstration", "guide", "function", "overview"
    std::string about;   ///< a line for lists and results of the search, plain text
    std::string area;    ///< of a function, else empty
    std::string script;  ///< Lua that the page comes from, offered as a file beside it; else empty
    std::string body;    ///< HTML: <header> if any, and <main>
};

/// The files of a folder, by name.
using ManualFiles = std::map<std::string, std::string>;

std::string html_text(std::string_view text);  ///< with & < > " as entities

/// The text of HTML, without elements, formulas' annotations and what scripts hold; white space as it comes.
std::string text_in_html(const std::string& html);

/// The headings h1 to h3 that have an id: id and text.
std::vector<std::pair<std::string, std::string>> headings_in(const std::string& html);

/// Pictures that stand in the page as data go into files of their own, once each, named after what they hold.
std::string with_pictures_apart(const std::string& html, ManualFiles& files);

/// Code that is the name or the call of a function of `pages` (name to file), or asks for its help, leads there; not in
/// links, blocks of code and choices, and not on the page itself (`own`).
std::string with_links_to_pages(const std::string& html, const std::map<std::string, std::string>& pages,
                                const std::string& own);

/// The page whole, in the site's frame.
std::string framed_page(const ManualPage& page, const std::string& style);

}  // namespace dynlab::inline workflow
