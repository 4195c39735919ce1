#include "data_io/reading_memory.h"

namespace dynlab::inline data_io {

Message refusal_for_memory(const std::filesystem::path& file, std::size_t file_bytes) {
    const ReadingMegabytes megabytes = megabytes_for_reading(file_bytes);
    return Message(
        "{}: reading it requires more than {} MB of memory, the limit for a file of {} MB; save only the variables "
        "that you need",
        file.string(), megabytes.limit, megabytes.of_file);
}

std::size_t bytes_of_file(const std::filesystem::path& file) {
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(file, error);
    return error ? 0 : static_cast<std::size_t>(bytes);
}

}  // namespace dynlab::inline data_io
