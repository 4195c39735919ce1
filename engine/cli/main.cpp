#include <unistd.h>

#include <cstdio>
#include <exception>
#include <iostream>

#include "cli/commands.h"
#include "cli/usage_error.h"
#include "platform/error.h"
#include "platform/interrupt.h"
#include "platform/memory.h"
#include "platform/terminal/terminal_text.h"

namespace {

using namespace dynlab;

constexpr const char* kAbout = "dynlab runs a laboratory course on data-driven learning of dynamical systems.";
constexpr const char* kFooter =
    "First steps:\n"
    "  dynlab                         the prompt: type Lua, see the result (or: dynlab < statements.lua)\n"
    "  dynlab demo                    guided demonstrations\n"
    "  dynlab lessons                 what there is to learn\n"
    "  dynlab report 02               a lesson with its worked solution, as a PDF\n"
    "  dynlab new 02 my-work          your own copy, to be worked on\n"
    "  dynlab preview my-work         a page that follows what you write\n"
    "  dynlab hint my-work 4          help with question 4, a little at a time\n"
    "  dynlab report my-work          your report, as a PDF\n"
    "  dynlab check my-work           what an instructor would ask you to mend\n"
    "  dynlab grade handed-in --lesson 04 --out marks          the marks of a class\n"
    "  dynlab course init signals-2026                         hand-ins, peer review and marks of a course\n"
    "  dynlab identify d.csv --input u --output y --poles 2    a model and a report from a file\n"
    "  dynlab run -e 'print(1 + 1)'   a line of Lua\n"
    "  dynlab help tf                 what a function does, with an example; dynlab help lua: Lua in ten minutes\n"
    "\n"
    "Exit codes: 0 done, 1 the script or document failed, 2 wrong usage, 3 a needed program is missing,\n"
    "130 interrupted.";

/// Runs the chosen command and turns what it throws into one line on standard error and an exit code.
int run_action(const Action& action) {
    const InterruptScope interrupts;
    const auto complain = [](const std::exception& error, int code) {
        std::fflush(stdout);
        std::cerr << "dynlab: " << terminal_text(error.what()) << std::endl;
        return code;
    };
    try {
        return action();
    } catch (const Interrupted& error) {
        const int code = complain(error, kInterrupted);
        pass_on_termination();
        return code;
    } catch (const MissingProgram& error) {
        return complain(error, kMissingProgram);
    } catch (const std::exception& error) {
        return complain(error, kFailed);
    }
}

}  // namespace

int main(int argc, char** argv) {
    keep_freed_memory();
    CLI::App app{kAbout, "dynlab"};
    app.set_version_flag("--version", "dynlab " DYNLAB_VERSION);
    app.set_help_flag("-h,--help", "Show this text");
    app.require_subcommand(0, 1);
    bool view = false;
    app.add_flag("--view", view, "Show the prompt's figures in the browser as they are made");
    app.add_option_function<std::string>(
           "--course",
           [](const std::string& folder) { ::setenv("DYNLAB_COURSE", std::filesystem::absolute(folder).c_str(), 1); },
           "A folder with lessons, data and templates of your own (before the command; or DYNLAB_COURSE)")
        ->type_name("DIR");
    app.failure_message(usage_message);

    Action action;
    for (const auto add :
         {add_run,        add_look,      add_identify,    add_report,   add_sheet,     add_hint,     add_weave,
          add_preview,    add_app,       add_new,         add_check,    add_lessons,   add_demo,     add_help,
          add_manual,     add_doctor,    add_pack,        add_verify,   add_bundle,    add_checks,   add_grade,
          add_gradescope, add_hand_back, add_similar,     add_course,   add_boxed,     add_notebook, add_kernel,
          add_lint,       add_lsp,       add_test_lesson, add_complete, add_man_pages, add_work,     add_study})
        add(app, action);
    app.footer(kFooter);  // commands made before have no part in it, nor in the next
    app.set_help_flag("-h,--help", "Show this text, or a command's: dynlab run --help");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const bool asked_for_text = error.get_exit_code() == 0;
        app.exit(error);
        return asked_for_text ? kDone : kUsage;
    }
    return run_action(action ? action : [view] { return open_prompt("", view); });
}
