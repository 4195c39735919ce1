#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "workflow/lesson_catalog.h"

namespace dynlab::inline workflow {

/// Makes a student's folder for a lesson: analysis.lua (the script without its solutions), report.md, group.toml and a
/// link to the data. A folder `data` replaces the link if the lesson contains data sets, or if a group's seed is given.
/// It contains the lesson's data sets and the group's own versions (variant_data.h) of the simulated data sets that the
/// lesson loads (lesson_data.h: the lesson may be run for this). Report and tasks are in `language` ("en", "fr"), the
/// lesson's when empty; tasks only if the lesson has tasks.LANGUAGE.lua. The folder is created completely, with
/// everything that `further` puts into it, or not at all. Throws EnvironmentError if `folder` exists and is not empty,
/// or cannot be made.
void make_student_copy(const Lesson& lesson, const std::filesystem::path& folder,
                       std::optional<std::uint32_t> group_seed = {}, const std::string& language = {},
                       const std::function<void(const std::filesystem::path& growing)>& further = {});

/// The lesson's script with the header's title, subtitle and language and the text cells of tasks.LANGUAGE.lua, where
/// the lesson has it: cell by cell in their order. Throws DocumentError when their numbers differ.
PercentScript lesson_script(const Lesson& lesson, const std::string& language);

/// Makes a folder for the review of a classmate's report: report.md with the five questions, analysis.lua for scores,
/// group.toml. Otherwise as make_student_copy.
void make_review_folder(const std::filesystem::path& folder, const std::string& language = {});

}  // namespace dynlab::inline workflow
