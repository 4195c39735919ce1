#include "cli/options/script_argument.h"

#include <CLI/CLI.hpp>

#include "workflow/given_script.h"

namespace dynlab::inline cli {

void refuse_other_files(const std::string& given, const std::string& command) {
    if (const std::string why = why_no_script(given, command); !why.empty()) throw CLI::ValidationError(why);
}

}  // namespace dynlab::inline cli
