#include <iostream>

#include "app/office/office_page.h"
#include "cli/course/course_commands.h"
#include "cli/pages/browser.h"
#include "platform/interrupt.h"

namespace dynlab::inline cli {
namespace {

struct CoursePageArgs {
    OfficeOptions options;
    bool no_browser = false;
};

int show_office(CoursePageArgs args) {
    DesktopBrowser browser;
    args.options.opened = [&](const std::string& address, Visit visit) {
        std::cout << address << "\n(Ctrl-C to stop)" << std::endl;
        if (visit != Visit::kLate && !args.no_browser) browser.open(address);
    };
    try {
        const SlowEnding commands_are_finished;
        serve_office(args.options);
    } catch (const Interrupted&) {
        std::cout << std::endl;
    }
    return kDone;
}

}  // namespace

void add_course_page(CLI::App& course, CourseArguments& where, Action& action) {
    auto args = std::make_shared<CoursePageArgs>();
    CLI::App* command = course.add_subcommand("page", "Mark answers and manage the course in the browser");
    command->add_option("--port", args->options.port, "Port of the page. Default: a free port.")
        ->check(CLI::Range(1, 65535));
    command->add_flag("--no-browser", args->no_browser, "Print the address without opening the browser");
    command->footer(
        "Five views: Marking (all answers to one question, without names, by keyboard), Today (what is missing, late,\n"
        "unreadable or blocked), Student, Reviews, Marks. Each action is a dynlab course command: the page shows it "
        "and\n"
        "it is in the history. You can use commands in a terminal and several windows at the same time.\n"
        "The page writes files for Moodle and Canvas into exports in the course's folder.\n"
        "Example:  dynlab course page");
    command->callback([&where, args, &action] {
        action = [&where, args] {
            args->options.course = where.folder;
            return show_office(*args);
        };
    });
}

}  // namespace dynlab::inline cli
