#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "workflow/lesson_catalog.h"

namespace dynlab::inline course {

struct AutograderRequest {
    Lesson lesson;
    std::optional<std::filesystem::path> more_checks;  ///< the instructor's own
    std::string secret;                                ///< of the course
    int timeout_seconds = 60;                          ///< of processor time, of each run of a script
    std::filesystem::path program;                     ///< dynlab
};

/// Writes an autograder for Gradescope: setup.sh, which installs what the zip brings along (the program, the shared
/// libraries it needs beyond the C library, data, the lesson and the checks) into a container, and run_autograder,
/// which grades /autograder/submission and leaves results.json. It asks for nothing from the net. The container must
/// be x86-64 Linux with a C library as new as this machine's; setup.sh says so where it is not. Returns the bytes of
/// the zip. Throws EnvironmentError.
std::uintmax_t write_autograder(const AutograderRequest& request, const std::filesystem::path& zip);

}  // namespace dynlab::inline course
