#pragma once
#include <filesystem>
#include <string>

#include "course/grading_rules.h"

namespace dynlab {

std::string points_text(double points);  ///< "3", "2.5", "0.33"

/// Text of anybody's as Markdown that means nothing but itself.
std::string escaped_markdown(const std::string& text);

/// Writes what the student gets into `folder`: feedback.md, and when wanted feedback.pdf, set in a box from
/// report_templates/feedback.md. Of hidden checks it has points and hint only.
void write_feedback(const Grade& grade, const std::filesystem::path& folder, bool pdf, const GradingSetup& setup);

/// The part of it inside the box. `job`: {"grade": {...}, "to": place of a folder}. Returns {}.
nlohmann::json make_feedback(const nlohmann::json& job);

}  // namespace dynlab
