#include "data_io/reading_memory.h"

#include <fmt/format.h>

namespace dynlab::inline data_io {

std::string memory_refusal(std::size_t file_bytes) {
    constexpr std::size_t kMegabyte = std::size_t{1} << 20;
    return fmt::format("reading it takes more than {} MB of memory, too much for a file of {} MB",
                       memory_for_reading(file_bytes) / kMegabyte, (file_bytes + kMegabyte - 1) / kMegabyte);
}

std::size_t bytes_of_file(const std::filesystem::path& file) {
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(file, error);
    return error ? 0 : static_cast<std::size_t>(bytes);
}

}  // namespace dynlab::inline data_io
