// dynlab-course: all commands, for dynlab to go on as.
#include <iterator>

#include "cli/pages/figure_view.h"
#include "cli/program.h"
#include "course/checks/check_functions.h"

int main(int count, char** args) {
    using namespace dynlab;
    Commands commands = everyday_commands(view_in_browser, names_of_check_functions);
    for (Commands more : {course_commands(), page_commands()})
        commands.insert(commands.end(), std::move_iterator(more.begin()), std::move_iterator(more.end()));
    return Program(commands, view_in_browser).run(count, args);
}
