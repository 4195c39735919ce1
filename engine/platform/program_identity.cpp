#include "platform/program_identity.h"

#include <link.h>

#include <string_view>

#include "platform/program_lookup.h"

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

namespace {

/// Adds the stamp of a loaded library, where it is the program's own: one for each level of processors.
int add_library(dl_phdr_info* library, std::size_t, void* stamps) {
    const std::string_view path = library->dlpi_name;
    if (path.substr(path.rfind('/') + 1) == "libdynlab_numerics.so")
        *static_cast<std::string*>(stamps) += file_stamp(path);
    return 0;
}

}  // namespace

const std::string& program_identity() {
    static const std::string stamps = [] {
        std::string programs;
        for (const fs::path& program : programs_next_to(running_program())) programs += file_stamp(program) + "\n";
        ::dl_iterate_phdr(add_library, &programs);
        return programs;
    }();
    return stamps;
}

}  // namespace dynlab::inline platform
