#pragma once
#include <string>
#include <vector>

#include "workflow/site/site_page.h"

namespace dynlab::inline workflow {

/// The words of a text: letters (those of ASCII small) and digits, each once, sorted. Punctuation and spaces of Unicode
/// (U+2000 to U+206F, U+00A0) part words as those of ASCII do.
std::vector<std::string> words_in_text(const std::string& text);

/// The data that site.js searches: a script that gives `dynlabPages` a list with file, title, kind, language, whether
/// the page has a translation, about, headings (text and id) and words of each page.
std::string search_index(const std::vector<SitePage>& pages);

}  // namespace dynlab::inline workflow
