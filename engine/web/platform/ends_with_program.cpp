#include "platform/files/ends_with_program.h"

// The files of a worker are in its memory and go with it.
namespace dynlab::inline platform {

EndsWithProgram::EndsWithProgram(const std::filesystem::path&) {}
EndsWithProgram EndsWithProgram::of_group(pid_t) {
    return {};
}
EndsWithProgram::~EndsWithProgram() = default;
EndsWithProgram::EndsWithProgram(EndsWithProgram&&) noexcept = default;
EndsWithProgram& EndsWithProgram::operator=(EndsWithProgram&&) noexcept = default;
void end_what_ends_with_program() {}

}  // namespace dynlab::inline platform
