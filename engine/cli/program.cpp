#include "cli/program.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>

#include "base/error.h"
#include "cli/say.h"
#include "cli/usage_error.h"
#include "platform/error.h"
#include "platform/files/file_error.h"
#include "platform/interrupt.h"
#include "platform/memory.h"
#include "platform/program_lookup.h"
#include "platform/system_call.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline cli {
namespace {

constexpr const char* kFooter =
    "First steps:\n"
    "  dynlab                         the prompt: type Lua, see the result (or: dynlab < statements.lua)\n"
    "  dynlab demo                    guided demonstrations\n"
    "  dynlab lessons                 list of lessons\n"
    "  dynlab report 02               a lesson with its reference solution, as a PDF\n"
    "  dynlab new 02 my-work          your own copy to work on\n"
    "  dynlab preview my-work         a page that follows your changes\n"
    "  dynlab hint my-work 4          hints for question 4, one at a time\n"
    "  dynlab report my-work          your report, as a PDF\n"
    "  dynlab check my-work           problems to fix before submission\n"
    "  dynlab grade submissions --lesson 04 --out marks        the marks of a class\n"
    "  dynlab course init signals-2026                         submissions, peer review and marks of a course\n"
    "  dynlab identify d.csv --input u --output y --poles 2    a model and a report from a file\n"
    "  dynlab run -e 'print(1 + 1)'   a line of Lua\n"
    "  dynlab help tf                 help for a function, with an example; dynlab help lua: Lua in ten minutes\n"
    "\n"
    "Exit codes: 0 done, 1 the script or document failed, 2 wrong usage, 3 a required program is missing,\n"
    "130 interrupted.";

/// Where what was printed has not been taken by whatever standard output is.
std::optional<Message> complaint_about_output() {
    std::cout.flush();
    if (std::fflush(stdout) == 0 && std::cout && std::ferror(stdout) == 0) return {};
    // The write that failed may lie far back, and its reason is lost: another one fails for the same.
    const bool taken = retry_interrupted([] { return ::write(STDOUT_FILENO, "\n", 1); }) == 1;
    return taken ? Message("cannot write the output") : Message("cannot write the output: {}", system_reason(errno));
}

/// Runs the chosen command and turns what it throws into one line on standard error and an exit code.
int run_action(const Action& action) {
    const InterruptScope interrupts(InterruptScope::Unhandled::kEnds);
    try {
        const int code = action();
        const std::optional<Message> complaint = complaint_about_output();
        if (!complaint) return code;
        complain(*complaint);
    } catch (const Interrupted& error) {
        complain(message_of(error));
        pass_on_termination();
        return kInterrupted;
    } catch (const MissingProgram& error) {
        complain(message_of(error));
        return kMissingProgram;
    } catch (const std::filesystem::filesystem_error& error) {
        complain(file_error_sentence(error));
    } catch (const std::exception& error) {
        complain(message_of(error));
    }
    return kFailed;
}

}  // namespace

Program::Program(const Commands& commands, FigureView view) : view_(std::move(view)) {
    app_.set_version_flag("--version", "dynlab " DYNLAB_VERSION);
    app_.set_help_flag("-h,--help", "Show this text");
    app_.require_subcommand(0, 1);
    app_.add_flag("--view", shows_figures_, "Show the prompt's figures in the browser as they are drawn");
    app_.add_option_function<std::string>(
            "--course",
            [](const std::string& folder) { ::setenv("DYNLAB_COURSE", std::filesystem::absolute(folder).c_str(), 1); },
            "Folder with your own lessons, data and templates (before the command; or DYNLAB_COURSE)")
        ->type_name("DIR");
    app_.failure_message(usage_message);
    for (const auto& add : commands) add(app_, action_);
    app_.footer(kFooter);  // commands made before have no part in it, nor in the next
    app_.set_help_flag("-h,--help", "Show this text, or the help of a command: dynlab run --help");
}

bool Program::has_command(const std::string& name) const {
    return !app_.get_subcommands([&](const CLI::App* command) { return command->get_name() == name; }).empty();
}

int Program::run(int count, char** args) {
    keep_freed_memory();
    speak_as_environment();
    try {
        app_.parse(count, args);
    } catch (const CLI::ParseError& error) {
        const bool asked_for_text = error.get_exit_code() == 0;
        app_.exit(error);
        return asked_for_text ? run_action([] { return kDone; }) : kUsage;
    }
    if (!action_) action_ = [this] { return open_prompt("", shows_figures_ ? view_() : nullptr); };
    return run_action(action_);
}

namespace {

/// scripts/start of the source tree that `dynlab` was built from, where that is known and still there.
std::optional<std::filesystem::path> build_script(const std::filesystem::path& dynlab) {
    std::filesystem::path source;
    if (std::ifstream location(source_location_file(dynlab)); location) {
        std::string line;
        std::getline(location, line);
        source = line;
    } else {
        for (source = dynlab.parent_path(); source.has_relative_path(); source = source.parent_path())
            if (std::filesystem::exists(source / "scripts/start")) break;
    }
    std::error_code error;
    const std::filesystem::path script = source / "scripts/start";
    return std::filesystem::is_regular_file(script, error) ? std::optional(script) : std::nullopt;
}

}  // namespace

void go_on_as(const std::string& program, char** args) {
    const std::filesystem::path dynlab = running_program(), file = dynlab.parent_path() / program;
    ::execv(file.c_str(), args);
    const int error = errno;
    const auto script = build_script(dynlab);
    if (error == ENOENT && script)
        std::cerr << fmt::format("dynlab: this command is not built yet ({} is missing). Build it with:\n  {}\n",
                                 program, terminal_text(script->string()));
    else
        std::cerr << fmt::format("dynlab: cannot start {} ({}), the program of this command. Reinstall dynlab.\n",
                                 terminal_text(file.string()), std::strerror(error));
    std::exit(kMissingProgram);
}

}  // namespace dynlab::inline cli
