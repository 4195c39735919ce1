#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include "course/grading/grading_rules.h"

namespace dynlab::inline cli {

/// --secret and --timeout (s of processor time) of commands that run a lesson's checks.
CLI::Option* add_secret_option(CLI::App& command, std::string& secret);
CLI::Option* add_timeout_option(CLI::App& command, int& seconds);

/// How a lesson's checks are tried on what belongs to the course: as many boxes at once as there are cores, long calls
/// recalled. `secret` names the file, empty where none was given. Throws EnvironmentError where it cannot be read.
GradingSetup trial_setup(const Lesson& lesson, const std::string& secret, int timeout_seconds);

}  // namespace dynlab::inline cli
