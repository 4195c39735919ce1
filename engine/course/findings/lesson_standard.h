#pragma once
#include <string>

#include "course/findings/document_findings.h"
#include "workflow/lesson_catalogue.h"

namespace dynlab::inline course {

/// What a lesson asks of reports: its template where that demands something, else its own report in this language, else
/// the template, which then leaves the form free. Throws EnvironmentError or DocumentError where one of them cannot
/// be read.
DocumentStandard standard_of_lesson(const Lesson& lesson, const std::string& language = "en");

}  // namespace dynlab::inline course
