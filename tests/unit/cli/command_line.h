#pragma once
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cli/program.h"

namespace dynlab::test {

struct CommandResult {
    int exit_code = 0;
    std::string output, error_output;
};

/// Runs `dynlab WORDS...` in this process, with the commands that need no further library.
inline CommandResult command_line(std::vector<std::string> words) {
    words.insert(words.begin(), "dynlab");
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const auto no_view = []() -> FigureListener { return nullptr; };
    const auto no_checks = [] { return std::vector<std::string>(); };
    CommandResult result;
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    result.exit_code =
        Program(everyday_commands(no_view, no_checks), no_view).run(static_cast<int>(words.size()), arguments.data());
    result.output = testing::internal::GetCapturedStdout();
    result.error_output = testing::internal::GetCapturedStderr();
    return result;
}

}  // namespace dynlab::test
