#pragma once
#include <filesystem>
#include <string>

#include "course/grading/grade.h"
#include "course/sandbox_jobs/sandboxed_document.h"

namespace dynlab::inline course {

Number points_number(double points);                ///< with at most two digits behind the decimal sign: 3, 2.5, 0.33
std::string points_text(double points);             ///< in English
Message points_of(double earned, double possible);  ///< "2.5 of 3"

/// Untrusted text as Markdown without special meaning.
std::string escaped_markdown(const std::string& text);
/// The same for readers of the Markdown itself: only what would change its meaning is escaped.
std::string readable_markdown(const std::string& text);

/// The student's feedback, as Markdown. Its title names the owner, and its language is that of the submission. Messages
/// of checks are as their author wrote them, or as the lesson's checks.LANGUAGE.po translates them. For hidden checks
/// the feedback contains only points and hint.
std::string feedback_markdown(const Grade& grade);

/// The same as `pdf`, set from report_templates/feedback.md. The file `made` remembers from what text and to which
/// bytes it was set: where both are the same it is not set again. Without `documents` a PDF of another text goes.
void set_feedback(const Grade& grade, const std::filesystem::path& pdf, const std::filesystem::path& made,
                  const SandboxedDocuments* documents);

}  // namespace dynlab::inline course
