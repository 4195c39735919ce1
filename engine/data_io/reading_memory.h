#pragma once
#include <cstddef>
#include <filesystem>

#include "base/message.h"

namespace dynlab::inline data_io {

/// The bytes of memory that reading a file of so many may take: 512 MB, or eight times as much as a larger file. What
/// asks for more is refused, before it is taken where its size is known.
constexpr std::size_t memory_for_reading(std::size_t file_bytes) {
    constexpr std::size_t kMinValue = std::size_t{512} << 20, kTimes = 8;
    return file_bytes > kMinValue / kTimes ? kTimes * file_bytes : kMinValue;
}

/// For messages about it.
struct ReadingMegabytes {
    std::size_t limit, of_file;
};
constexpr ReadingMegabytes megabytes_for_reading(std::size_t file_bytes) {
    constexpr std::size_t kMegabyte = std::size_t{1} << 20;
    return {memory_for_reading(file_bytes) / kMegabyte, (file_bytes + kMegabyte - 1) / kMegabyte};
}

/// "data.mat: reading it takes more than 512 MB of memory, too much for a file of 2 MB"
Message refusal_for_memory(const std::filesystem::path& file, std::size_t file_bytes);

/// 0 for one that is not there; who reads it says so.
std::size_t bytes_of_file(const std::filesystem::path& file);

}  // namespace dynlab::inline data_io
