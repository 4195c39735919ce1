#include "data_io/mat_layout.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <fstream>
#include <optional>

#include "platform/error.h"
#include "platform/file_blocks.h"

namespace dynlab::inline data_io {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::uint64_t kHeader5 = 128;  // text, version, byte order
constexpr std::uint64_t kTag5 = 8;       // type and number of bytes
constexpr std::uint64_t kHeader4 = 20;   // five integers
constexpr std::uint64_t kHdf5Start = 512;
constexpr std::uint32_t kMatrix = 14, kCompressed = 15;

class MatFileSkeleton {
  public:
    explicit MatFileSkeleton(const std::filesystem::path& file) : file_(file) {
        open_to_read(file).close();  // says why when the file is not there
        std::error_code error;
        size_ = std::filesystem::file_size(file, error);
        if (error) fail_to_read(file, error.value());
        stream_.open(file, std::ios::binary);
    }

    MatLayout layout() {
        if (size_ == 0) throw EnvironmentError("{} is empty", file_.string());
        if (const auto swapped = byte_order_5()) return {version_5_or_73(*swapped), variables_};
        if (const auto swapped = byte_order_4()) {
            walk_4(*swapped);
            return {MatVersion::k4, variables_};
        }
        throw EnvironmentError("{} is not a MATLAB file (MAT versions 4, 5, 7 and 7.3 can be read)", file_.string());
    }

  private:
    [[noreturn]] void fail_cut_off(std::uint64_t start) const {
        throw EnvironmentError(
            "{} is truncated: variable number {} starts at byte {} and does not end within the {} bytes of the file",
            file_.string(), variables_ + 1, start, size_);
    }
    [[noreturn]] void fail_without_variable(std::uint64_t at) const {
        throw EnvironmentError("{} is damaged: no variable starts at byte {}", file_.string(), at);
    }

    template <class T>
    T read_at(std::uint64_t position) {
        T value{};
        stream_.clear();
        stream_.seekg(static_cast<std::streamoff>(position));
        stream_.read(reinterpret_cast<char*>(&value), sizeof value);
        return value;
    }
    std::uint32_t word_at(std::uint64_t position, bool swapped) {
        const auto word = read_at<std::uint32_t>(position);
        return swapped ? __builtin_bswap32(word) : word;
    }

    /// Whether bytes are swapped, when the file carries the byte order mark of levels 5 and 7.3.
    std::optional<bool> byte_order_5() {
        const auto mark = read_at<std::array<char, 2>>(126);
        if (size_ < kHeader5) return std::nullopt;
        if (mark == std::array{'I', 'M'}) return false;
        if (mark == std::array{'M', 'I'}) return true;
        return std::nullopt;
    }

    MatVersion version_5_or_73(bool swapped) {
        const auto stored = read_at<std::uint16_t>(124);
        const unsigned version = swapped ? __builtin_bswap16(stored) : stored;
        if (version == 0x0100) {
            walk_5(swapped);
            return MatVersion::k5;
        }
        if (version != 0x0200)
            throw EnvironmentError("{} has the unknown MAT version {}; MAT versions 4, 5, 7 and 7.3 can be read",
                                   file_.string(), fmt::format("{:#06x}", version));
        constexpr std::array<char, 8> kHdf5Signature = {'\x89', 'H', 'D', 'F', '\r', '\n', '\x1a', '\n'};
        if (size_ < kHdf5Start + 8)
            throw EnvironmentError("{} is truncated: it has only {}", file_.string(),
                                   plural(static_cast<std::int64_t>(size_), "{} byte", "{} bytes"));
        if (read_at<std::array<char, 8>>(kHdf5Start) != kHdf5Signature)
            throw EnvironmentError("{} is damaged: its HDF5 part is missing", file_.string());
        return MatVersion::k73;
    }

    void walk_5(bool swapped) {
        for (std::uint64_t at = kHeader5; at < size_; ++variables_) {
            if (size_ - at < kTag5) fail_cut_off(at);
            const std::uint32_t type = word_at(at, swapped), bytes = word_at(at + 4, swapped);
            if (type != kMatrix && type != kCompressed) fail_without_variable(at);
            if (bytes > size_ - at - kTag5) fail_cut_off(at);
            at += kTag5 + bytes;
        }
    }

    struct Header4 {
        std::uint32_t type, rows, columns, imaginary, name_length;
    };
    Header4 header_4(std::uint64_t at, bool swapped) {
        return {word_at(at, swapped), word_at(at + 4, swapped), word_at(at + 8, swapped), word_at(at + 12, swapped),
                word_at(at + 16, swapped)};
    }
    /// The type is decimal MOPT: M byte order (0 or 1 here), O zero, P precision 0-5, T full, text or sparse.
    static bool is_possible_4(const Header4& header) {
        const std::uint32_t M = header.type / 1000, O = header.type / 100 % 10, P = header.type / 10 % 10,
                            T = header.type % 10;
        return M <= 1 && O == 0 && P <= 5 && T <= 2 && header.imaginary <= 1 && header.name_length >= 1;
    }

    std::optional<bool> byte_order_4() {
        if (size_ < kHeader4) return std::nullopt;
        for (const bool swapped : {false, true}) {
            const Header4 header = header_4(0, swapped);
            if (is_possible_4(header) && (header.type / 1000 == 1) == swapped) return swapped;
        }
        return std::nullopt;
    }

    void walk_4(bool swapped) {
        constexpr std::uint64_t kBytes[6] = {8, 4, 4, 2, 2, 1};
        for (std::uint64_t at = 0; at < size_; ++variables_) {
            if (size_ - at < kHeader4) fail_cut_off(at);
            const Header4 header = header_4(at, swapped);
            if (!is_possible_4(header)) fail_without_variable(at);
            std::uint64_t left = size_ - at - kHeader4;
            if (header.name_length > left) fail_cut_off(at);
            left -= header.name_length;
            const std::uint64_t element = kBytes[header.type / 10 % 10] * (1 + header.imaginary);
            // Division, as the product of hostile sizes may not fit any integer.
            if (header.columns > 0 && header.rows > left / element / header.columns) fail_cut_off(at);
            at += kHeader4 + header.name_length + element * header.rows * header.columns;
        }
    }

    const std::filesystem::path& file_;
    std::ifstream stream_;
    std::uint64_t size_ = 0;
    std::size_t variables_ = 0;
};

}  // namespace

MatLayout check_mat_layout(const std::filesystem::path& file) {
    return MatFileSkeleton(file).layout();
}

}  // namespace dynlab::inline data_io
