#include "cli/terminal_colour.h"

#include <unistd.h>

#include <cstdlib>

namespace dynlab::inline cli {

bool in_colour() {
    const char* no_colour = std::getenv("NO_COLOR");
    return ::isatty(STDOUT_FILENO) != 0 && (no_colour == nullptr || *no_colour == '\0');
}

}  // namespace dynlab::inline cli
