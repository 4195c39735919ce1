#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "platform/atomic_file.h"

namespace dynlab::test {

/// Folders of lessons, sorted; demos/ holds the guided demonstrations.
inline std::vector<std::string> lesson_slugs() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(DYNLAB_SOURCE_DIR "/lessons"))
        if (entry.path().filename() != "demos") names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
}

/// The lessons that end with a special report, or the others, by the header's `template`.
inline std::vector<std::string> lesson_slugs(bool with_report) {
    std::vector<std::string> names;
    for (const std::string& name : lesson_slugs()) {
        std::ifstream file(DYNLAB_SOURCE_DIR "/lessons/" + name + "/lesson.lua");
        bool report = false;
        for (std::string line; std::getline(file, line) && !line.starts_with("-- %%");)
            report = report || (line.starts_with("-- template: ") && line != "-- template: lesson");
        if (report == with_report) names.push_back(name);
    }
    return names;
}

inline std::filesystem::path lesson_folder(const std::string& lesson) {
    return std::filesystem::path(DYNLAB_SOURCE_DIR) / "lessons" / lesson;
}

/// A lesson's reference solution with only two repeated experiments. These take most of its time and lead to no answer
/// (tests/course/test_lesson_checks.cpp).
inline std::string quick_solution_of(const std::string& lesson) {
    static const std::regex repetitions("\nlocal repetitions = \\d+\n");
    const std::string script = read_file(lesson_folder(lesson) / "lesson.lua");
    EXPECT_EQ(std::regex_search(script, repetitions), script.find("repetitions = ") != std::string::npos);
    return std::regex_replace(script, repetitions, "\nlocal repetitions = 2\n");
}

}  // namespace dynlab::test
