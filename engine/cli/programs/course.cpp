// dynlab-course: the commands for checking, grading and running a course, for dynlab to go on as.
#include "cli/program.h"
#include "platform/program_lookup.h"

int main(int count, char** words) {
    using namespace dynlab;
    Commands commands = course_commands();
    commands.emplace_back(add_boxed_version);
    return Program(commands, [words]() -> FigureListener { go_on_as(kPagesProgram, words); }).run(count, words);
}
