#include "workflow/lesson_catalog.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "platform/error.h"
#include "platform/files/course_home.h"
#include "platform/program_lookup.h"
#include "platform/spelling.h"
#include "platform/text/small_letters.h"
#include "workflow/given_script.h"

namespace dynlab::inline workflow {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> slugs_of(const std::vector<Lesson>& found) {
    std::vector<std::string> slugs;
    for (const Lesson& lesson : found) slugs.push_back(lesson.slug);
    return slugs;
}

/// `name` is no lesson: what it is instead, or what was meant.
Message no_lesson(const std::string& name, const std::vector<Lesson>& all) {
    const MessageList slugs = listed(slugs_of(all));
    std::error_code none;
    if (!name.empty() && fs::is_directory(name, none)) {
        if (fs::is_regular_file(fs::path(name) / "analysis.lua", none))
            return Message("the folder '{}' contains no lesson.lua; the lessons are {}", name, slugs);
        const Message near = nearly_called(name, "analysis.lua");
        return near.empty()
                   ? Message("the folder '{}' contains neither lesson.lua nor analysis.lua; the lessons are {}", name,
                             slugs)
                   : Message("the folder '{}' contains neither lesson.lua nor analysis.lua, {}; the lessons are {}",
                             name, near, slugs);
    }
    if (fs::is_regular_file(name, none))
        return Message("'{}' is a file; give the number, the name or the folder of a lesson. The lessons are {}", name,
                       slugs);
    const std::string ending = ending_of(name);
    if (ending == ".lua" || ending == ".ipynb") return no_such_work(name);
    if (const auto work = nearest_work(name))
        return Message("unknown lesson or folder '{}'; did you mean '{}'?", name, work->string());
    std::vector<std::string> names;
    for (const Lesson& lesson : all) {
        names.push_back(lesson.slug);
        const std::size_t number_end = lesson.slug.find('_');
        if (number_end != std::string::npos) names.push_back(lesson.slug.substr(number_end + 1));
    }
    const auto near = nearest_word(name, names);
    return near ? Message("unknown lesson or folder '{}'; did you mean '{}'?", name, *near)
                : Message("unknown lesson or folder '{}'; the lessons are {}", name, slugs);
}

/// What the header says below the title, or nothing: "Lesson 3.2 - ...".
std::string subtitle_of(const Lesson& lesson) {
    const std::string key = "-- subtitle: ";
    std::ifstream script(lesson.script());
    int marks = 0;
    for (std::string line; marks < 2 && std::getline(script, line); marks += line == "-- ---")
        if (line.starts_with(key)) return line.substr(key.size());
    return "";
}

/// Sorts lessons of one number by their subtitles; other lessons keep their order.
void put_in_order(std::vector<Lesson>& lessons) {
    const auto number = [](const Lesson& lesson) { return lesson.slug.substr(0, lesson.slug.find('_')); };
    for (auto first = lessons.begin(); first != lessons.end();) {
        const auto end =
            std::find_if(first, lessons.end(), [&](const Lesson& one) { return number(one) != number(*first); });
        if (end - first > 1)
            std::stable_sort(first, end,
                             [](const Lesson& a, const Lesson& b) { return subtitle_of(a) < subtitle_of(b); });
        first = end;
    }
}

}  // namespace

std::optional<Lesson> lesson_in(const fs::path& folder) {
    const fs::path whole = fs::absolute(folder).lexically_normal();
    Lesson lesson{(whole.has_filename() ? whole : whole.parent_path()).filename().string(), whole};
    return fs::is_regular_file(lesson.script()) ? std::optional(lesson) : std::nullopt;
}

std::vector<Lesson> lessons() {
    std::vector<fs::path> folders;
    const char* own = std::getenv("DYNLAB_LESSONS");
    std::istringstream list(own ? own : "");
    for (std::string folder; std::getline(list, folder, ':');) {
        if (folder.empty()) continue;
        if (!fs::is_directory(folder)) throw EnvironmentError("DYNLAB_LESSONS: folder not found: '{}'", folder);
        folders.emplace_back(folder);
    }
    if (const auto course = own_course(); course && fs::is_directory(*course / "lessons"))
        folders.push_back(*course / "lessons");
    folders.push_back(shared_folder() / "lessons");
    std::map<std::string, Lesson> found;
    for (const fs::path& folder : folders)
        for (const auto& entry : fs::directory_iterator(folder))
            if (auto lesson = lesson_in(entry.path())) found.try_emplace(lesson->slug, *std::move(lesson));
    std::vector<Lesson> all;
    for (auto& [slug, lesson] : found) all.push_back(std::move(lesson));
    put_in_order(all);
    return all;
}

Lesson find_lesson(const std::string& name) {
    const std::vector<Lesson> all = lessons();
    const bool digit = name.size() == 1 && name[0] >= '0' && name[0] <= '9';
    const std::string beginning = (digit ? "0" : "") + name;
    std::vector<Lesson> fitting, holding;
    for (const Lesson& lesson : all) {
        if (lesson.slug == beginning) return lesson;
        if (!beginning.empty() && lesson.slug.starts_with(beginning)) fitting.push_back(lesson);
        // Whole words only: of a mistyped folder "work", lesson 3 must not become the report.
        if (!name.empty() && (lesson.slug + "_").find("_" + name + "_") != std::string::npos) holding.push_back(lesson);
    }
    if (fitting.empty()) fitting = holding;
    if (fitting.size() == 1) return fitting.front();
    if (const auto own = name.empty() ? std::nullopt : lesson_in(name)) return *own;
    if (fitting.empty()) throw EnvironmentError(no_lesson(name, all));
    throw EnvironmentError("'{}' matches several lessons ({}); specify more of the name", name,
                           listed(slugs_of(fitting)));
}

std::string lasting_name(const Lesson& lesson) {
    const std::vector<Lesson> listed = lessons();
    const bool known = std::ranges::any_of(listed, [&](const Lesson& one) { return one.folder == lesson.folder; });
    return known ? lesson.slug : lesson.folder.string();
}

}  // namespace dynlab::inline workflow
