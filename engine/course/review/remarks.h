#pragma once
#include <string>
#include <vector>

#include "course/findings/document_text.h"

namespace dynlab::inline course {

/// A paragraph or an item of a list in a review.
struct Remark {
    std::string question;  ///< the heading it stands below; may be empty
    std::string text;
    int page = 1;
    bool wants_answer = true;  ///< false where the review's form asks for the greatest strength
};

/// The remarks of a review in their order; its scores are none. `praise` and `scores` are the headings, in any
/// language, of the form's question for the greatest strength and of its table of scores.
struct ReviewForm {
    std::vector<std::string> praise, scores;
};
std::vector<Remark> remarks_in(const DocumentText& review, const ReviewForm& form);

/// The form that `dynlab new review` gives (report_templates/peer_review.md).
ReviewForm review_form();

}  // namespace dynlab::inline course
