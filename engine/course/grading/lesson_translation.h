#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "workflow/lesson_catalog.h"

namespace dynlab::inline course {

/// The sentences that the author of a checks.lua writes for students, each once: the texts of say, hint, about, message
/// and `judge`.
std::vector<std::string> sentences_of_checks(const std::string& source);

/// Writes the texts to translate, in English, into the lesson's folder: tasks.LANGUAGE.lua with the text cells, where
/// there is none, and the sentences that checks.LANGUAGE.po lacks. Returns the files that it wrote.
std::vector<std::filesystem::path> write_translation_skeleton(const Lesson& lesson, const std::string& language);

}  // namespace dynlab::inline course
