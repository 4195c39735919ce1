#pragma once
#include <optional>
#include <string>

#include "course/findings/document_text.h"
#include "course/intake/finding.h"

namespace dynlab::inline course {

struct LanguageFindings {
    std::string language;  ///< "en" or "fr": that of most function words; empty when there are too few to tell
    Findings findings;
};

/// English and French told apart by their function words ("the", "which"; "les", "dans"). language-mixed (hint): a
/// passage in the other language. language-differs (hint): the document's language is not the `declared` one.
LanguageFindings language_findings(const DocumentText& text, const std::optional<std::string>& declared);

}  // namespace dynlab::inline course
