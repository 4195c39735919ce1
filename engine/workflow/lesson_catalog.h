#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "documents/percent_script.h"

namespace dynlab::inline workflow {

/// A lesson of the course: the folder lessons/NN_slug with its master script.
struct Lesson {
    std::string slug;  ///< "02_least_squares"
    std::filesystem::path folder;
    std::filesystem::path script() const { return folder / "lesson.lua"; }
    /// What helps with its questions, in a language; of lessons in English alone there is no other file.
    std::filesystem::path hints(const std::string& language) const {
        return folder / (language == "en" ? "hints.md" : "hints." + language + ".md");
    }
    /// Questions to check oneself by, with answers: the last section of the sheet and of the woven lesson; may be
    /// absent.
    std::filesystem::path self_check(const std::string& language = "en") const {
        return folder / (language == "en" ? "self_check.md" : "self_check." + language + ".md");
    }
    /// What the authors of checks.lua wrote, in another language: a catalog (base/catalog.h); may be absent.
    std::filesystem::path checks_in(const std::string& language) const {
        return folder / ("checks." + language + ".po");
    }
    /// Title and text cells in another language; no such file for lessons in English alone.
    std::filesystem::path tasks(const std::string& language) const { return folder / ("tasks." + language + ".lua"); }
    /// Questions that a talk on the lesson may meet, with model answers: for instructors only; may be absent.
    std::filesystem::path talk_questions() const { return folder / "talk.md"; }
    /// The reference solution's report, for lessons with a specific report form; the file does not exist for other
    /// lessons.
    std::filesystem::path report(const std::string& language) const { return folder / ("report." + language + ".md"); }
};

/// The lesson in any folder, with the folder's name; nothing if there is no lesson.lua.
std::optional<Lesson> lesson_in(const std::filesystem::path& folder);

/// All lessons, sorted by number and, for equal numbers, by subtitle (3.1, 3.2): those in the folders that
/// DYNLAB_LESSONS lists (separated by colons), those of the user's course (DYNLAB_COURSE), and the installed ones; of
/// two lessons with one name the first counts.
std::vector<Lesson> lessons();

/// The lesson whose slug starts with `name` ("02", "2", "02_least") or holds it as a whole word ("crane"), or that in a
/// folder of that path. Throws EnvironmentError that lists the lessons when none or several fit.
Lesson find_lesson(const std::string& name);

/// What find_lesson finds the lesson by from every folder: its slug if it is listed, otherwise its path.
std::string lasting_name(const Lesson& lesson);

}  // namespace dynlab::inline workflow
