#include "data_io/reading_memory.h"

namespace dynlab::inline data_io {

std::size_t bytes_of_file(const std::filesystem::path& file) {
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(file, error);
    return error ? 0 : static_cast<std::size_t>(bytes);
}

}  // namespace dynlab::inline data_io
