// dynlab-pages: all that dynlab can do, and what shows pages in the browser, for dynlab to go on as.
#include <iterator>

#include "cli/pages/figure_view.h"
#include "cli/program.h"

int main(int count, char** words) {
    using namespace dynlab;
    Commands commands = everyday_commands(view_in_browser);
    for (Commands more : {course_commands(), page_commands()})
        commands.insert(commands.end(), std::move_iterator(more.begin()), std::move_iterator(more.end()));
    return Program(commands, view_in_browser).run(count, words);
}
