#include "workflow/lesson_catalogue.h"

#include <algorithm>

#include "platform/error.h"
#include "platform/program_lookup.h"

namespace dynlab::inline workflow {
namespace {

std::string joined_slugs(const std::vector<Lesson>& found) {
    std::string list;
    for (const Lesson& lesson : found) list += (list.empty() ? "" : ", ") + lesson.slug;
    return list;
}

}  // namespace

std::vector<Lesson> lessons() {
    std::vector<Lesson> found;
    for (const auto& entry : std::filesystem::directory_iterator(shared_folder() / "lessons")) {
        Lesson lesson{entry.path().filename().string(), entry.path()};
        if (std::filesystem::is_regular_file(lesson.script())) found.push_back(std::move(lesson));
    }
    std::sort(found.begin(), found.end(), [](const Lesson& a, const Lesson& b) { return a.slug < b.slug; });
    return found;
}

Lesson find_lesson(const std::string& name) {
    const std::vector<Lesson> all = lessons();
    const bool digit = name.size() == 1 && name[0] >= '0' && name[0] <= '9';
    const std::string beginning = (digit ? "0" : "") + name;
    std::vector<Lesson> fitting, holding;
    for (const Lesson& lesson : all) {
        if (lesson.slug == beginning) return lesson;
        if (!beginning.empty() && lesson.slug.starts_with(beginning)) fitting.push_back(lesson);
        if (!name.empty() && lesson.slug.find("_" + name) != std::string::npos) holding.push_back(lesson);
    }
    if (fitting.empty()) fitting = holding;
    if (fitting.size() == 1) return fitting.front();
    if (fitting.empty()) {
        throw EnvironmentError("there is no lesson or folder '" + beginning + "'; the lessons are " +
                               joined_slugs(all));
    }
    throw EnvironmentError("'" + beginning + "' fits several lessons (" + joined_slugs(fitting) +
                           "); give enough of the name to tell them apart");
}

}  // namespace dynlab::inline workflow
