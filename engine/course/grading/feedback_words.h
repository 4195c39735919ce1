#pragma once
#include <string>

namespace dynlab::inline course {

/// What feedback says around the words of the checks, which are their author's; {} stands for what is filled in.
struct FeedbackWords {
    const char *title, *result, *points, *colon, *of, *not_graded, *checks;
    const char *ran, *silent, *unreadable, *not_begun, *not_ended;
    const char *late, *better_counts, *newest_counts, *closing;
};

/// Of "fr"; English for all else.
const FeedbackWords& feedback_words(const std::string& language);

}  // namespace dynlab::inline course
