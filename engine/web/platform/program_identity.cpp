#include "platform/program_identity.h"

namespace dynlab::inline platform {

std::string file_stamp(const std::filesystem::path& file) {
    std::error_code failure;
    const auto size = std::filesystem::file_size(file, failure);
    return failure ? "" : file.string() + " " + std::to_string(static_cast<unsigned long>(size));
}

/// What a worker keeps goes with it, so that all of it is of one program.
const std::string& program_identity() {
    static const std::string name = "dynlab in a page";
    return name;
}

}  // namespace dynlab::inline platform
