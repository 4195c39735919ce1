#include "data_io/mat_compression.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/system_call.h"

namespace dynlab::inline data_io {
namespace {

constexpr std::size_t kFileHeader = 128, kElementTag = 8;
constexpr std::uint32_t kPlainElement = 14, kDeflatedElement = 15;
constexpr std::size_t kLargeElement = std::size_t{1} << 22;  // bytes from which the choice is made
constexpr std::size_t kTrial = std::size_t{1} << 16;         // bytes from the middle that show the compression ratio
constexpr double kLargestCompressedShare = 6.0 / 7;          // of the bytes that may be left

struct ElementTag {
    std::uint32_t type = 0, bytes = 0;
};

ElementTag tag_at(std::string_view content, std::size_t offset) {
    ElementTag tag;
    std::memcpy(&tag, content.data() + offset, sizeof tag);
    return tag;
}

std::string deflated(std::string_view bytes) {
    std::string packed(compressBound(bytes.size()), '\0');
    uLongf size = packed.size();
    const auto* source = reinterpret_cast<const Bytef*>(bytes.data());
    if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, source, bytes.size(), Z_BEST_SPEED) != Z_OK)
        throw EnvironmentError("cannot compress a MATLAB variable: not enough memory");
    packed.resize(size);
    return packed;
}

bool shrinks(std::string_view element) {
    const std::string_view part = element.substr(element.size() / 2, kTrial);
    return static_cast<double>(deflated(part).size()) < kLargestCompressedShare * static_cast<double>(part.size());
}

/// A variable as it goes into the new file: its old bytes, or the deflated stream in their place.
struct Piece {
    std::string_view plain;
    std::string stream;
};

std::vector<Piece> pieces_of(std::string_view content) {
    std::vector<Piece> pieces;
    for (std::size_t at = kFileHeader; at + kElementTag <= content.size();) {
        const ElementTag tag = tag_at(content, at);
        const std::string_view element = content.substr(at, kElementTag + tag.bytes);
        const bool pack = tag.type == kPlainElement && element.size() >= kLargeElement && shrinks(element);
        pieces.push_back({element, pack ? deflated(element) : std::string()});
        at += element.size();
    }
    return pieces;
}

void write_piece(std::ofstream& file, const Piece& piece) {
    if (!piece.stream.empty()) {
        const ElementTag tag{kDeflatedElement, static_cast<std::uint32_t>(piece.stream.size())};
        file.write(reinterpret_cast<const char*>(&tag), sizeof tag);
    }
    const std::string_view bytes = piece.stream.empty() ? piece.plain : std::string_view(piece.stream);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// Whether the elements in a matrix fill it.
bool is_filled(std::string_view matrix) {
    while (!matrix.empty()) {
        if (matrix.size() < kElementTag) return false;
        const ElementTag tag = tag_at(matrix, 0);
        const bool small = tag.type >> 16 != 0;  // the data are within the tag
        const std::size_t padded = small ? 0 : (std::size_t{tag.bytes} + 7) / 8 * 8;
        matrix.remove_prefix(kElementTag);
        if (padded > matrix.size()) return false;
        if (!small && tag.type == kPlainElement && !is_filled(matrix.substr(0, tag.bytes))) return false;
        matrix.remove_prefix(padded);
    }
    return true;
}

bool ends_well(std::string_view stream) {
    z_stream state{};
    if (inflateInit(&state) != Z_OK) return false;
    state.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(stream.data()));
    state.avail_in = static_cast<uInt>(stream.size());
    Bytef block[1 << 16];
    int result = Z_OK;
    while (result == Z_OK) {
        state.next_out = block, state.avail_out = sizeof block;
        result = inflate(&state, Z_NO_FLUSH);
    }
    inflateEnd(&state);
    return result == Z_STREAM_END;
}

}  // namespace

bool is_whole(const std::filesystem::path& file) {
    const std::string content = read_file(file);
    std::size_t at = kFileHeader;
    while (at + kElementTag <= content.size()) {
        const ElementTag tag = tag_at(content, at);
        if (tag.bytes > content.size() - at - kElementTag) return false;
        const std::string_view element = std::string_view(content).substr(at + kElementTag, tag.bytes);
        if (!(tag.type == kDeflatedElement ? ends_well(element) : is_filled(element))) return false;
        at += kElementTag + tag.bytes;
    }
    return at == content.size();
}

std::filesystem::path with_quick_compression(const std::filesystem::path& file) {
    if (std::filesystem::file_size(file) < kLargeElement) return file;
    const std::string content = read_file(file);
    const std::vector<Piece> pieces = pieces_of(content);
    if (std::all_of(pieces.begin(), pieces.end(), [](const Piece& piece) { return piece.stream.empty(); })) return file;
    std::filesystem::path target = file;
    target += ".packed";
    std::ofstream packed(target, std::ios::binary);
    packed.write(content.data(), kFileHeader);
    for (const Piece& piece : pieces) write_piece(packed, piece);
    packed.close();
    if (!packed) throw EnvironmentError("cannot write {}: {}", target.string(), system_reason(errno));
    return target;
}

}  // namespace dynlab::inline data_io
