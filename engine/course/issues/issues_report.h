#pragma once
#include <string>

#include "base/reader.h"
#include "course/issues/document_issues.h"

namespace dynlab::inline course {

/// The outcome for a reader: broken rules, then hints, each with its place and remedy; one line if there is nothing to
/// fix. Text from the document is shown without control characters.
std::string issues_as_text(const CheckResult& result, bool in_color, const Reader& reader = {});

/// The outcome for a program, as JSON in UTF-8:
///
///     {"subject": "report.pdf", "template": "lab_report", "language": "en", "pages": 7, "passed": false,
///      "checked": ["7 pages of at most 6 + 1 of appendix", ...],
///      "findings": [{"id": "pages", "severity": "rule", "page": 7, "place": null, "what": "...", "remedy": "..."}]}
///
/// severity is "rule" or "hint"; template, language, pages, page and place are null if unknown. The fields
/// what_message, remedy_message and checked_messages contain the messages from which the texts were made
/// (data_io/values/message_values.h).
std::string issues_as_json(const CheckResult& result);

/// The outcome that issues_as_json wrote. Throws EnvironmentError for any other text.
CheckResult issues_from_json(const std::string& json);

}  // namespace dynlab::inline course
