#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "scripting/prompt/prompt_session.h"

namespace dynlab::inline cli {

/// Exit codes of every command.
enum ExitCode { kDone = 0, kFailed = 1, kUsage = 2, kMissingProgram = 3, kInterrupted = 130 };

/// Runs a command after its arguments are parsed. Returns the exit code.
using Action = std::function<int()>;

/// Opens a page in the browser for figures and gives what shows them there. Programs without pages never return from
/// it: they hand over to the one that has them.
using FigureView = std::function<FigureListener()>;

/// What a program can do, in the order of its help: each adds its command with options and help text to the first and
/// sets the second when it is the one called.
using Commands = std::vector<std::function<void(CLI::App&, Action&)>>;

/// Names that check files may use in addition to those of lessons, for lint. Only the program with all commands knows
/// these names; the other program starts that program.
using CheckNames = std::function<std::vector<std::string>()>;

/// The commands of a folder beside this file, whose libraries all programs with them load as they start.
Commands everyday_commands(const FigureView& view, const CheckNames& check_names);
Commands course_commands();
Commands page_commands();

// everyday/
void add_run(CLI::App& app, Action& action, const FigureView& view);
void add_inspect(CLI::App& app, Action& action);
void add_identify(CLI::App& app, Action& action);
void add_report(CLI::App& app, Action& action);
void add_sheet(CLI::App& app, Action& action);
void add_hint(CLI::App& app, Action& action);
void add_weave(CLI::App& app, Action& action);
void add_new(CLI::App& app, Action& action);
void add_lessons(CLI::App& app, Action& action);
void add_demo(CLI::App& app, Action& action);
void add_help(CLI::App& app, Action& action);
void add_notebook(CLI::App& app, Action& action);
void add_lint(CLI::App& app, Action& action, const CheckNames& check_names);
void add_lsp(CLI::App& app, Action& action);

// course/
void add_check(CLI::App& app, Action& action);
void add_pack(CLI::App& app, Action& action);
void add_bundle(CLI::App& app, Action& action);
void add_verify(CLI::App& app, Action& action);
void add_checks(CLI::App& app, Action& action);
void add_grade(CLI::App& app, Action& action);
void add_gradescope(CLI::App& app, Action& action);
void add_export_grades(CLI::App& app, Action& action);
void add_similar(CLI::App& app, Action& action);
void add_answers(CLI::App& app, Action& action);
void add_course(CLI::App& app, Action& action);
void add_test_lesson(CLI::App& app, Action& action);
void add_study(CLI::App& app, Action& action);
void add_sandboxed_version(CLI::App& app, Action& action);

// pages/
void add_site(CLI::App& app, Action& action);
void add_preview(CLI::App& app, Action& action);
void add_app(CLI::App& app, Action& action);
void add_kernel(CLI::App& app, Action& action);
void add_doctor(CLI::App& app, Action& action);
void add_complete(CLI::App& app, Action& action);
void add_man_pages(CLI::App& app, Action& action);

/// What `dynlab` without a command does: the prompt on a terminal, statements from a pipe or file otherwise.
/// After running a script, unless `script` is empty, whose variables stay.
int open_prompt(const std::string& script, const FigureListener& see);

}  // namespace dynlab::inline cli
