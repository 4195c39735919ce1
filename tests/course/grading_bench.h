#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "platform/atomic_file.h"
#include "platform/sandbox.h"
#include "support/lesson_list.h"
#include "support/program.h"

namespace dynlab::test {

/// All lessons with a checks.lua, in order.
inline std::vector<std::string> lessons_with_checks() {
    std::vector<std::string> lessons;
    for (const auto& entry : std::filesystem::directory_iterator(lesson_folder("")))
        if (std::filesystem::exists(entry.path() / "checks.lua")) lessons.push_back(entry.path().filename());
    std::sort(lessons.begin(), lessons.end());
    return lessons;
}

/// A course of one small lesson, 99_small, and a folder of submissions, graded by the built program.
class GradingBench {
  public:
    GradingBench(const std::string& answers, const std::string& checks, const std::string& solution) {
        namespace fs = std::filesystem;
        const fs::path source = DYNLAB_SOURCE_DIR, home = bench_.path("home");
        fs::create_directories(home / "lessons" / "99_small");
        fs::create_directories(bench_.path("in"));
        fs::create_directory_symlink(source / "report_templates", home / "report_templates");
        fs::create_directory_symlink(source / "data", home / "data");
        bench_.write("home/lessons/99_small/lesson.lua", header(answers) + solution);
        bench_.write("home/lessons/99_small/checks.lua", checks);
        bench_.set_home(home);
    }
    static std::string header(const std::string& answers) {
        return "-- ---\n-- title: A small lesson\n-- lesson: 99_small\n-- answers:\n" + answers + "-- ---\n";
    }

    Workbench& bench() { return bench_; }
    void submit_file(const std::string& name, const std::string& script) {
        bench_.write("in/" + name + "/analysis.lua", script);
    }
    ChildResult grade(std::vector<std::string> more = {}) {
        std::vector<std::string> words = {"grade", "in",          "--lesson", "99",      "--out",
                                          "out",   "--isolation", level(),    "--no-pdf"};
        words.insert(words.end(), more.begin(), more.end());
        return bench_.dynlab(words);
    }
    /// Full where this machine can have it.
    static std::string level() { return obstacle_to(Isolation::kFull) ? "process" : "full"; }
    nlohmann::json result(const std::string& name) const {
        return nlohmann::json::parse(read_file(bench_.path("out/results/" + name + "/results.json")));
    }
    static double score(const nlohmann::json& result) { return result.value("score", -1.0); }
    static std::string error_reason(const nlohmann::json& result) {
        return result.at("extra_data").at("dynlab").at("trouble").get<std::string>();
    }

  private:
    Workbench bench_;
};

}  // namespace dynlab::test
