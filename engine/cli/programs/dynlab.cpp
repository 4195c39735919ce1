// dynlab: what people start. What it has not is left to programs beside it, so that a script, a report and the prompt
// begin without the libraries of PDF files, of the course's database and of pages.
#include <algorithm>
#include <string>
#include <string_view>

#include "cli/program.h"
#include "platform/program_lookup.h"

namespace {

using namespace dynlab;

constexpr std::string_view kCourseCommands[] = {"check",      "pack",      "bundle",  "verify", "checks",      "grade",
                                                "gradescope", "hand-back", "similar", "course", "test-lesson", "work"};

/// The command, or what stands in its place; the option --course DIR may stand before it.
std::string_view first_word(int count, char** words) {
    int i = 1;
    while (i < count && std::string_view(words[i]).starts_with("--course"))
        i += std::string_view(words[i]) == "--course" ? 2 : 1;
    return i < count ? words[i] : "";
}

}  // namespace

int main(int count, char** words) {
    const auto figures = [words]() -> FigureListener { go_on_as(kPagesProgram, words); };
    Program program(everyday_commands(figures), figures);
    const std::string_view first = first_word(count, words);
    const bool is_here =
        first.empty() || first == "--view" || first == "--version" || program.has_command(std::string(first));
    if (is_here) return program.run(count, words);
    go_on_as(std::ranges::count(kCourseCommands, first) > 0 ? kCourseProgram : kPagesProgram, words);
}
