#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include "course/grading/grading_rules.h"

namespace dynlab::inline cli {

/// --secret and --timeout (s of processor time) of commands that run a lesson's checks.
CLI::Option* add_secret_option(CLI::App& command, std::string& secret);
CLI::Option* add_timeout_option(CLI::App& command, int& seconds);

/// The setup for testing a lesson's checks on the course's own files: one sandbox per core in parallel, with cached
/// results of long calls. `secret` names the file, empty if none was given. Throws EnvironmentError if it cannot be
/// read.
GradingSetup trial_setup(const Lesson& lesson, const std::string& secret, int timeout_seconds);

}  // namespace dynlab::inline cli
