#pragma once
#include <filesystem>
#include <string>

#include "course/boxes/boxed_document.h"
#include "course/grading/grade.h"

namespace dynlab::inline course {

std::string points_text(double points);  ///< "3", "2.5", "0.33"

/// Text of anybody's as Markdown that means nothing but itself.
std::string escaped_markdown(const std::string& text);
/// The same for readers of the Markdown itself: only what would change its meaning is escaped.
std::string readable_markdown(const std::string& text);

/// What the student gets, as Markdown. It is titled after whom it is for and in the language of what was handed in;
/// what checks say is as their author wrote it. Of hidden checks it has points and hint only.
std::string feedback_markdown(const Grade& grade);

/// The same as `pdf`, set from report_templates/feedback.md. The file `made` remembers from what text and to which
/// bytes it was set: where both are the same it is not set again. Without `documents` a PDF of another text goes.
void set_feedback(const Grade& grade, const std::filesystem::path& pdf, const std::filesystem::path& made,
                  const BoxedDocuments* documents);

/// What feedback says around the words of the checks, which are their author's; {} stands for what is filled in.
struct FeedbackWords {
    const char *title, *result, *points, *colon, *of, *not_graded, *checks;
    const char *ran, *silent, *unreadable, *not_begun, *not_ended;
    const char *late, *better_counts, *newest_counts, *closing;
};

/// Of "fr"; English for all else.
const FeedbackWords& feedback_words(const std::string& language);

}  // namespace dynlab::inline course
