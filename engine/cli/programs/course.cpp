// dynlab-course: all commands, for dynlab to go on as.
#include <csignal>
#include <iostream>
#include <iterator>

#include "cli/course_aliases.h"
#include "cli/pages/figure_view.h"
#include "cli/program.h"
#include "course/checks/check_functions.h"

int main(int count, char** args) {
    using namespace dynlab;
    std::signal(SIGXFSZ, SIG_IGN);  // then a file at the limit of sizes is an error that names it
    Commands commands = everyday_commands(view_in_browser, names_of_check_functions);
    for (Commands more : {course_commands(), page_commands()})
        commands.insert(commands.end(), std::move_iterator(more.begin()), std::move_iterator(more.end()));
    std::string note;
    std::vector<std::string> words = with_new_names({args + 1, args + count}, note);
    if (!note.empty()) std::cerr << "dynlab: " << note << '\n';
    std::vector<char*> pointers = {args[0]};
    for (std::string& word : words) pointers.push_back(word.data());
    return Program(commands, view_in_browser).run(static_cast<int>(pointers.size()), pointers.data());
}
