#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace dynlab::inline workflow {

/// A page of the site before it is framed: the content between the site's bar and the scripts.
struct SitePage {
    std::string file;             ///< from the top of the site: "functions/srivc.html"
    std::string title;            ///< plain text
    std::string kind;             ///< "lesson", "demonstration", "guide", "function", "overview"
    std::string about;            ///< a line for lists and results of the search, plain text
    std::string area;             ///< of a function, else empty
    std::string script;           ///< file with the Lua script that the page shows, offered beside it; else empty
    std::string body;             ///< HTML: <header> if any, and <main>
    std::string language = "en";  ///< of the page
    std::string translation;      ///< file of the same page in the other language; else empty
    /// Further style sheets and JavaScript modules, from the top of the site; the first modules run while the page is
    /// still read.
    std::vector<std::string> styles, modules, first_modules;

    /// The way from the page to the top of the site: "", "../", "../../".
    std::string root() const;
};

/// What all pages of a site share.
struct SiteFrame {
    std::string style;  ///< CSS
    bool runs = false;  ///< the site has the engine: cells run, there is a workbench, and pages open offline
};

/// The files of a folder, by name.
using SiteFiles = std::map<std::string, std::string>;

std::string html_text(std::string_view text);  ///< with & < > " as entities

/// The text of HTML, without elements, formulas' annotations and what scripts hold; white space as it comes.
std::string text_in_html(const std::string& html);

/// The headings h1 to h3 that have an id: id and text.
std::vector<std::pair<std::string, std::string>> headings_in(const std::string& html);

/// Moves pictures that are in the page as data into separate files, named after their content; `root` is the path to
/// the top of the site. They are loaded when they come into view.
std::string with_pictures_apart(const std::string& html, const std::string& root, SiteFiles& files);

/// Code that is the name or the call of a function of `pages` (name to file), or asks for its help, leads to that page;
/// not in links, blocks of code and choices, and not on the page itself.
std::string with_links_to_pages(const SitePage& page, const std::map<std::string, std::string>& pages);

/// The content security policy of all pages of a site, as a meta element: pages load files of the site only, from a
/// server or from a folder.
extern const char* const kSitePolicy;
/// The whole page with the site's bar, policy, style and scripts.
std::string framed_page(const SitePage& page, const SiteFrame& frame);

}  // namespace dynlab::inline workflow
