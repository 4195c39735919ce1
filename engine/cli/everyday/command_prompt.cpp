#include <unistd.h>

#include <iostream>
#include <sstream>

#include "cli/commands.h"
#include "scripting/prompt/console.h"

namespace dynlab::inline cli {
namespace {

constexpr const char* kFigureFolder = "dynlab_out";
constexpr const char* kGreeting =
    "dynlab " DYNLAB_VERSION
    ": type a statement, or help for a list of functions, help tf for help on tf.\n"
    "Tab completes, the arrow keys show earlier lines, Ctrl-C stops a statement, Ctrl-D or quit exits.\n";

}  // namespace

int open_prompt(const std::string& script, const FigureListener& see) {
    std::string quoted;
    for (const char c : script) quoted += (c == '"' || c == '\\' ? "\\" : "") + std::string(1, c);
    const std::string first = script.empty() ? "" : "run(\"" + quoted + "\")";
    if (::isatty(STDIN_FILENO) && ::isatty(STDOUT_FILENO)) {
        run_prompt(kFigureFolder, kGreeting, first, see);
        return kDone;
    }
    if (first.empty()) return run_statements_of(std::cin, kFigureFolder, see) ? kDone : kFailed;
    std::stringstream input;
    input << first << '\n' << std::cin.rdbuf();
    return run_statements_of(input, kFigureFolder, see) ? kDone : kFailed;
}

}  // namespace dynlab::inline cli
