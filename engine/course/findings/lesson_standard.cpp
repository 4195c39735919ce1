#include "course/findings/lesson_standard.h"

#include "documents/percent_script.h"

namespace dynlab::inline course {

DocumentStandard standard_of_lesson(const Lesson& lesson, const std::string& language) {
    DocumentStandard named = standard_of(read_percent_script(lesson.script()).header.template_name);
    const std::filesystem::path report = lesson.report(language);
    const bool demands = named.rules.pages || !named.rules.sections.empty();
    return demands || !std::filesystem::exists(report) ? named : standard_of(report.string());
}

}  // namespace dynlab::inline course
