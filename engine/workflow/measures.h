#pragma once
#include <map>
#include <string>

namespace dynlab::inline workflow {

/// The measures of `dynlab help measures`, one source for help and documents: the Markdown of each under the word
/// before the colon of its heading, in small letters; the heading's rest is its title, a heading of the third level.
std::map<std::string, std::string> measures_for_documents();

}  // namespace dynlab::inline workflow
