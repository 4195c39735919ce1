#pragma once
#include <optional>
#include <string>
#include <vector>

#include "documents/template_file.h"

namespace dynlab::inline documents {

/// A section that a template asks for, by its heading in English and French.
struct SectionRule {
    std::string english, french;
    bool optional = false;

    const std::string& title(const std::string& language) const { return language == "fr" ? french : english; }
};

/// The rules of a template for the documents made with it, in its YAML header:
///
///     sections: |
///       Process | Procédé
///       Appendix | Annexe | optional
///     pages: 6
///     appendix_pages: 1
///     least_pages: 1
///     layout: slides
///
/// A heading that is one of these titles, in either language, is set in the document's language. `pages` limits the
/// pages before the first optional section, `appendix_pages` those from it on; 0 means no limit. A document of less
/// than `least_pages` gets a hint. With the layout `slides`, every heading of the first level begins a slide of 160 mm
/// by 90 mm, and `pages` does not apply.
struct DocumentRules {
    std::vector<SectionRule> sections;
    std::optional<int> pages, appendix_pages;
    std::optional<int> least_pages = std::nullopt;
    bool slides = false;
};

bool is_document_rule(const std::string& key);  ///< sections, pages, ..., layout

/// Throws DocumentError at `where` for a line of `sections` without both titles, or a number of pages that is not whole
/// and positive, or another layout.
void read_document_rule(const std::string& key, const std::string& value, const Place& where, DocumentRules& rules);

DocumentRules document_rules(const TemplateFile& source);

}  // namespace dynlab::inline documents
