// dynlab: what people start. It has the commands of a lesson and the prompt, so that these begin without the libraries
// of PDF files, of the course's database and of pages, and are built before all else; any other command it leaves to
// dynlab-course.
#include <string>
#include <string_view>
#include <vector>

#include "cli/program.h"
#include "platform/program_lookup.h"
#include "scripting/runtime/help.h"

namespace {

using namespace dynlab;

/// The command, or the first argument where there is none; the option --course DIR may precede it.
std::string_view first_argument(int count, char** args) {
    int i = 1;
    while (i < count && std::string_view(args[i]).starts_with("--course"))
        i += std::string_view(args[i]) == "--course" ? 2 : 1;
    return i < count ? args[i] : "";
}

/// `help` of a command that the other program has, "help course page": no page is called so.
bool asks_for_other_command(int count, char** args, const Program& program) {
    if (first_argument(count, args) != "help") return false;
    std::string name;
    for (int i = 1; i < count; ++i)
        if (const std::string_view word = args[i]; word != "help" || !name.empty())
            name += (name.empty() ? "" : " ") + std::string(word);
    const std::string first = name.substr(0, name.find(' '));
    return !name.empty() && name.find_first_of("-.") == name.npos && !find_help_page(name) &&
           !program.has_command(first);
}

}  // namespace

int main(int count, char** args) {
    const FigureView view = [args]() -> FigureListener { go_on_as(kCourseProgram, args); };
    const CheckNames check_names = [args]() -> std::vector<std::string> { go_on_as(kCourseProgram, args); };
    Program program(everyday_commands(view, check_names), view);
    const std::string_view first = first_argument(count, args);
    const bool is_here =
        first.empty() || first == "--view" || first == "--version" || program.has_command(std::string(first));
    if (is_here && !asks_for_other_command(count, args, program)) return program.run(count, args);
    go_on_as(kCourseProgram, args);
}
