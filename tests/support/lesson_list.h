#pragma once
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace dynlab::test {

/// Folders of lessons, sorted; demos/ holds the guided demonstrations.
inline std::vector<std::string> lesson_slugs() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(DYNLAB_SOURCE_DIR "/lessons"))
        if (entry.path().filename() != "demos") names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
}

/// Those that end with a report of a form of its own, or the others, by the header's `template`.
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

}  // namespace dynlab::test
