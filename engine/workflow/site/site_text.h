#pragma once
#include <string>
#include <vector>

#include "documents/weave.h"
#include "scripting/runtime/help.h"
#include "workflow/site/help_examples.h"

namespace dynlab::inline workflow {

/// A page of Markdown that is set together with others: it begins with a heading of the first level.
struct SiteText {
    std::string name;  ///< "srivc", "guide-first-hour", "methods"
    std::string part;  ///< "Guides", the area of a function; else empty
    MarkdownText markdown;
};

/// The help pages woven with what their examples gave: guides (the first hour first), headed by what they
/// are about, then functions by area.
std::vector<SiteText> help_texts(const HelpExamples& examples);

/// Every method with what it fits, its assumptions and its literature, from the catalog of methods, and with what its
/// help page says of it before the arguments.
SiteText methods_text();

/// What a page that is no function's is about, as a title: "The first hour" for "guide: the first hour"; its name where
/// it says nothing of the kind.
std::string title_of_guide(const HelpPage& page);

/// What begins a help page: the paragraphs between its title and "## Arguments".
std::string beginning_of(std::string_view help_page);

/// All pages as one text, in which every heading has an id that begins with its page's name ("srivc",
/// "srivc-returns").
MarkdownText joined_pages(const std::vector<SiteText>& texts);

}  // namespace dynlab::inline workflow
