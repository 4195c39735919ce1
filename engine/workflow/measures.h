#pragma once
#include <map>
#include <string>

namespace dynlab::inline workflow {

/// The measures of `dynlab help measures`, one source for help and documents, or in French those of
/// report_templates/measures.fr.md: the Markdown of each under the word before the colon of its heading, in small
/// letters; the heading's rest is its title, a heading of the third level.
std::map<std::string, std::string> measures_for_documents(const std::string& language);

}  // namespace dynlab::inline workflow
