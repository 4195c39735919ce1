#include "platform/error.h"

namespace dynlab::inline platform {

MissingProgram::MissingProgram(const std::string& program, const std::string& package)
    : std::runtime_error(program + " is not installed: sudo apt install " + package) {}

}  // namespace dynlab::inline platform
