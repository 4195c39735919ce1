#include "course/byte_text.h"

#include <archive.h>
#include <archive_entry.h>

#include <algorithm>
#include <memory>

#include "course/letters.h"
#include "documents/inflate.h"

namespace dynlab {
namespace {

constexpr std::size_t kShortestRun = 4;
constexpr std::size_t kMostOfArchive = 50u << 20, kMostInside = 4u << 20;
constexpr int kMostEntries = 2000, kMostPieces = 300;

unsigned char byte_at(std::string_view bytes, std::size_t i) {
    return static_cast<unsigned char>(bytes[i]);
}

void append_utf8(std::string& text, char32_t c) {
    if (c < 0x80) {
        text += static_cast<char>(c);
    } else if (c < 0x800) {
        text += static_cast<char>(0xC0 | c >> 6);
        text += static_cast<char>(0x80 | (c & 0x3F));
    } else if (c < 0x10000) {
        text += static_cast<char>(0xE0 | c >> 12);
        text += static_cast<char>(0x80 | (c >> 6 & 0x3F));
        text += static_cast<char>(0x80 | (c & 0x3F));
    }
}

char32_t unit_at(std::string_view bytes, std::size_t i, bool big_endian) {
    const char32_t first = byte_at(bytes, i), second = byte_at(bytes, i + 1);
    return big_endian ? first << 8 | second : second << 8 | first;
}

std::string from_utf16(std::string_view bytes, bool big_endian) {
    std::string text;
    for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) append_utf8(text, unit_at(bytes, i, big_endian));
    return text;
}

bool has_utf16_mark(std::string_view bytes) {
    return bytes.starts_with("\xFE\xFF") || bytes.starts_with("\xFF\xFE");
}

bool is_printable(char32_t c) {
    return c == '\t' || (c >= 0x20 && c != 0x7F && !(c >= 0x80 && c < 0xA0) && c != 0xFFFD);
}

/// Collects runs of printable characters.
class Runs {
  public:
    void add(char32_t c, std::string_view utf8) {
        if (!is_printable(c)) return close();
        run_ += utf8;
        ++count_;
    }
    void close() {
        if (count_ >= kShortestRun) text_ += run_ + '\n';
        run_.clear();
        count_ = 0;
    }
    std::string text() {
        close();
        return std::move(text_);
    }

  private:
    std::string text_, run_;
    std::size_t count_ = 0;
};

std::string runs_of_utf8(std::string_view bytes) {
    Runs runs;
    while (!bytes.empty()) {
        const std::string_view before = bytes;
        const char32_t c = next_character(bytes);
        runs.add(c, before.substr(0, before.size() - bytes.size()));
    }
    return runs.text();
}

/// Latin letters only: any two bytes are some character.
std::string runs_of_utf16(std::string_view bytes, std::size_t from, bool big_endian) {
    Runs runs;
    for (std::size_t i = from; i + 1 < bytes.size(); i += 2) {
        const char32_t c = unit_at(bytes, i, big_endian);
        std::string utf8;
        append_utf8(utf8, c);
        runs.add(c < 0x250 ? c : 0xFFFD, utf8);
    }
    return runs.text();
}

}  // namespace

bool is_text(std::string_view bytes) {
    if (has_utf16_mark(bytes)) return true;
    std::size_t strange = 0, all = 0;
    for (std::string_view rest = bytes.substr(0, 4096); !rest.empty(); ++all) {
        const char32_t c = next_character(rest);
        strange += !is_printable(c) && c != '\n' && c != '\r' && c != '\f';
    }
    return 50 * strange <= all;
}

std::string text_in(std::string_view bytes) {
    if (has_utf16_mark(bytes)) return from_utf16(bytes.substr(2), bytes.starts_with("\xFE\xFF"));
    if (is_text(bytes)) return std::string(bytes);
    std::string text = runs_of_utf8(bytes);
    if (bytes.find('\0') == std::string_view::npos) return text;
    for (const std::size_t from : {0, 1})
        for (const bool big_endian : {false, true}) text += runs_of_utf16(bytes, from, big_endian);
    return text;
}

std::string without_references(const std::string& xml) {
    std::string text;
    for (std::size_t i = 0; i < xml.size(); ++i) {
        const std::size_t end = xml[i] == '&' ? xml.find(';', i) : std::string::npos;
        if (end == std::string::npos || end - i > 10 || xml[i + 1] != '#') {
            text += xml[i];
            continue;
        }
        const bool hexadecimal = xml[i + 2] == 'x' || xml[i + 2] == 'X';
        const std::string number = xml.substr(i + (hexadecimal ? 3 : 2), end - i - (hexadecimal ? 3 : 2));
        append_utf8(text, static_cast<char32_t>(std::strtoul(number.c_str(), nullptr, hexadecimal ? 16 : 10)));
        i = end;
    }
    return text;
}

std::string metadata_of_jpeg(std::string_view bytes) {
    std::string metadata;
    std::size_t at = 2;
    while (at + 4 <= bytes.size() && byte_at(bytes, at) == 0xFF) {
        const unsigned char marker = byte_at(bytes, at + 1);
        if (marker == 0xDA || marker == 0xD9) break;
        const std::size_t length = static_cast<std::size_t>(byte_at(bytes, at + 2)) << 8 | byte_at(bytes, at + 3);
        const bool speaks = marker == 0xFE || (marker >= 0xE0 && marker <= 0xEF);
        if (speaks && length > 2) metadata += text_in(bytes.substr(at + 4, length - 2)) + '\n';
        at += 2 + std::max<std::size_t>(length, 2);
    }
    const std::size_t end = bytes.rfind("\xFF\xD9");
    if (end != std::string_view::npos) metadata += text_in(bytes.substr(end + 2));
    return metadata;
}

std::vector<std::string> texts_of_archive(const std::string& bytes) {
    std::vector<std::string> texts;
    const std::unique_ptr<archive, int (*)(archive*)> in(archive_read_new(), archive_read_free);
    archive_read_support_filter_gzip(in.get());
    archive_read_support_format_zip(in.get());
    archive_read_support_format_tar(in.get());
    if (archive_read_open_memory(in.get(), bytes.data(), bytes.size()) != ARCHIVE_OK) return texts;
    std::size_t total = 0;
    archive_entry* entry = nullptr;
    for (int i = 0; i < kMostEntries && archive_read_next_header(in.get(), &entry) == ARCHIVE_OK; ++i) {
        if (const char* name = archive_entry_pathname(entry)) texts.emplace_back(name);
        std::string content;
        char block[1 << 15];
        for (la_ssize_t got = 1; got > 0 && total < kMostOfArchive;) {
            got = archive_read_data(in.get(), block, sizeof block);
            if (got > 0) content.append(block, static_cast<std::size_t>(got));
            total += got > 0 ? static_cast<std::size_t>(got) : 0;
        }
        texts.push_back(std::move(content));
    }
    return texts;
}

std::vector<std::string> compressed_inside(std::string_view bytes) {
    std::vector<std::string> pieces;
    for (std::size_t i = 0; i + 2 < bytes.size() && pieces.size() < kMostPieces; ++i) {
        if (bytes[i] != 'x' || (byte_at(bytes, i) * 256u + byte_at(bytes, i + 1)) % 31 != 0) continue;
        std::string piece = inflate(bytes.substr(i), kMostInside).bytes;
        if (piece.size() >= kShortestRun) pieces.push_back(std::move(piece));
    }
    return pieces;
}

}  // namespace dynlab
