#include "workflow/program_identity.h"

#include <filesystem>

namespace dynlab {

std::string program_identity() {
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
    return std::to_string(std::filesystem::file_size(program)) + "/" +
           std::to_string(std::filesystem::last_write_time(program).time_since_epoch().count());
}

}  // namespace dynlab
