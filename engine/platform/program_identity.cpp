#include "platform/program_identity.h"

namespace dynlab::inline platform {

namespace fs = std::filesystem;

std::string file_stamp(const fs::path& file) {
    std::error_code missing;
    const fs::path real = fs::canonical(file, missing);
    if (missing) return {};
    const auto size = fs::file_size(real, missing);
    const auto date = fs::last_write_time(real, missing).time_since_epoch().count();
    return missing ? std::string() : real.string() + " " + std::to_string(size) + " " + std::to_string(date);
}

const std::string& program_identity() {
    static const std::string stamp = file_stamp("/proc/self/exe");
    return stamp;
}

}  // namespace dynlab::inline platform
