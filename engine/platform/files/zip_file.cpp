#include "platform/files/zip_file.h"

#include <algorithm>
#include <boost/crc.hpp>
#include <cstdint>

#include "platform/atomic_file.h"
#include "platform/error.h"

namespace dynlab::inline platform {
namespace {

constexpr std::uint64_t kMaxZipBytes = 0xfffffffeu;
constexpr std::size_t kMaxEntries = 0xfffe;
constexpr std::uint16_t kVersion = 10, kMadeOnUnix = 3 << 8 | 20;
constexpr std::uint16_t kTime = 0, kDate = 1 << 5 | 1;  // 1 January 1980, midnight: the first that zip knows
constexpr std::uint32_t kPlainFile = std::uint32_t{0100644} << 16;  // as Unix has it
constexpr std::uint16_t kUtf8Name = 1 << 11;

/// Little endian.
template <class... Numbers>
void put(std::string& bytes, Numbers... numbers) {
    const auto put_one = [&bytes](auto number) {
        for (std::size_t i = 0; i < sizeof number; ++i) bytes += static_cast<char>(number >> 8 * i & 0xff);
    };
    (put_one(numbers), ...);
}

std::uint32_t crc32_of(const std::string& bytes) {
    boost::crc_32_type crc;
    crc.process_bytes(bytes.data(), bytes.size());
    return crc.checksum();
}

/// The common part of the header before the file and of its entry in the list at the end.
std::string common_header(const std::string& name, const std::string& content) {
    const bool ascii = std::all_of(name.begin(), name.end(), [](char c) { return static_cast<signed char>(c) >= 0; });
    const auto size = static_cast<std::uint32_t>(content.size());
    std::string header;
    put(header, kVersion, ascii ? std::uint16_t{0} : kUtf8Name, std::uint16_t{0}, kTime, kDate, crc32_of(content), size,
        size, static_cast<std::uint16_t>(name.size()), std::uint16_t{0});
    return header;
}

[[noreturn]] void refuse_size() {
    throw EnvironmentError("a zip file can contain at most {} files and {} MB; remove files that are not needed",
                           kMaxEntries, kMaxZipBytes >> 20);
}

}  // namespace

std::string zip_of(const std::map<std::string, std::string>& contents) {
    if (contents.size() > kMaxEntries) refuse_size();
    std::string zip, list;
    for (const auto& [name, content] : contents) {
        if (zip.size() + list.size() + content.size() > kMaxZipBytes) refuse_size();
        const std::string header = common_header(name, content);
        put(list, std::uint32_t{0x02014b50}, kMadeOnUnix);
        list += header;
        put(list, std::uint16_t{0}, std::uint16_t{0}, std::uint16_t{0}, kPlainFile,
            static_cast<std::uint32_t>(zip.size()));
        list += name;
        put(zip, std::uint32_t{0x04034b50});
        zip += header + name + content;
    }
    if (zip.size() + list.size() > kMaxZipBytes) refuse_size();
    const auto count = static_cast<std::uint16_t>(contents.size());
    const auto begin = static_cast<std::uint32_t>(zip.size());
    zip += list;
    put(zip, std::uint32_t{0x06054b50}, std::uint16_t{0}, std::uint16_t{0}, count, count,
        static_cast<std::uint32_t>(list.size()), begin, std::uint16_t{0});
    return zip;
}

void write_zip(const std::filesystem::path& file, const std::map<std::string, std::string>& contents) {
    write_file_atomically(file, zip_of(contents));
}

}  // namespace dynlab::inline platform
