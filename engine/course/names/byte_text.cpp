#include "course/names/byte_text.h"

#include <archive.h>
#include <archive_entry.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>

#include "documents/pdf/inflate.h"
#include "platform/text/read_number.h"
#include "platform/utf8.h"
#include "platform/utf8_locale.h"

namespace dynlab::inline course {
namespace {

constexpr std::size_t kShortestRun = 4;
constexpr std::size_t kMostOfArchive = 50u << 20, kMostInside = 4u << 20;
constexpr std::size_t kLongestReference = 32;
constexpr int kMostEntries = 2000, kMostPieces = 300;

/// HTML 4.01, 24.2.1: U+00A0 to U+00FF.
constexpr const char* kNamesFromA0[] = {
    "nbsp",   "iexcl",  "cent",   "pound",  "curren", "yen",    "brvbar", "sect",   "uml",    "copy",   "ordf",
    "laquo",  "not",    "shy",    "reg",    "macr",   "deg",    "plusmn", "sup2",   "sup3",   "acute",  "micro",
    "para",   "middot", "cedil",  "sup1",   "ordm",   "raquo",  "frac14", "frac12", "frac34", "iquest", "Agrave",
    "Aacute", "Acirc",  "Atilde", "Auml",   "Aring",  "AElig",  "Ccedil", "Egrave", "Eacute", "Ecirc",  "Euml",
    "Igrave", "Iacute", "Icirc",  "Iuml",   "ETH",    "Ntilde", "Ograve", "Oacute", "Ocirc",  "Otilde", "Ouml",
    "times",  "Oslash", "Ugrave", "Uacute", "Ucirc",  "Uuml",   "Yacute", "THORN",  "szlig",  "agrave", "aacute",
    "acirc",  "atilde", "auml",   "aring",  "aelig",  "ccedil", "egrave", "eacute", "ecirc",  "euml",   "igrave",
    "iacute", "icirc",  "iuml",   "eth",    "ntilde", "ograve", "oacute", "ocirc",  "otilde", "ouml",   "divide",
    "oslash", "ugrave", "uacute", "ucirc",  "uuml",   "yacute", "thorn",  "yuml"};

unsigned char byte_at(std::string_view bytes, std::size_t i) {
    return static_cast<unsigned char>(bytes[i]);
}

std::u16string units_in(std::string_view bytes, bool big_endian) {
    std::u16string units;
    for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
        const unsigned first = byte_at(bytes, i), second = byte_at(bytes, i + 1);
        units += static_cast<char16_t>(big_endian ? first << 8 | second : second << 8 | first);
    }
    return units;
}

bool has_utf16_mark(std::string_view bytes) {
    return bytes.starts_with("\xFE\xFF") || bytes.starts_with("\xFF\xFE");
}

bool is_printable(char32_t c) {
    return c == '\t' || (c >= 0x20 && c != 0x7F && !(c >= 0x80 && c < 0xA0) && c != kNoCharacter);
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

/// Latin letters and pairs of units only: any other two bytes are some character.
std::string runs_of_utf16(std::string_view bytes, bool big_endian) {
    const std::u16string units = units_in(bytes, big_endian);
    Runs runs;
    for (std::u16string_view rest = units; !rest.empty();) {
        const char32_t c = next_character(rest);
        runs.add(c < 0x250 || c >= 0x10000 ? c : kNoCharacter, utf8_of(c));
    }
    return runs.text();
}

/// The names that XML and HTML 4 know for Latin letters, signs and spaces.
const std::map<std::string_view, char32_t>& named_characters() {
    static const std::map<std::string_view, char32_t> names = [] {
        std::map<std::string_view, char32_t> known = {
            {"amp", '&'},     {"lt", '<'},      {"gt", '>'},        {"quot", '"'},     {"apos", '\''},
            {"OElig", 0x152}, {"oelig", 0x153}, {"Scaron", 0x160},  {"scaron", 0x161}, {"Yuml", 0x178},
            {"ensp", 0x2002}, {"emsp", 0x2003}, {"thinsp", 0x2009}, {"zwnj", 0x200C},  {"zwj", 0x200D},
            {"lrm", 0x200E},  {"rlm", 0x200F}};
        char32_t c = 0xA0;
        for (const char* name : kNamesFromA0) known.emplace(name, c++);
        return known;
    }();
    return names;
}

/// The character that "#xE9", "#233" or "eacute" refers to; none for other text.
std::optional<char32_t> referred_to(std::string_view reference) {
    if (!reference.starts_with('#')) {
        const auto found = named_characters().find(reference);
        return found == named_characters().end() ? std::nullopt : std::optional(found->second);
    }
    const bool hexadecimal = reference.starts_with("#x") || reference.starts_with("#X");
    reference.remove_prefix(hexadecimal ? 2 : 1);
    const auto code = read_number<std::uint32_t>(reference, hexadecimal ? 16 : 10);
    if (!code) return std::nullopt;
    const bool is_character = *code > 0 && *code <= 0x10FFFF && (*code < 0xD800 || *code >= 0xE000);
    return is_character ? static_cast<char32_t>(*code) : kNoCharacter;
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
    if (has_utf16_mark(bytes)) return utf8_of(units_in(bytes.substr(2), bytes.starts_with("\xFE\xFF")));
    if (is_text(bytes)) return std::string(bytes);
    std::string text = runs_of_utf8(bytes);
    constexpr std::string_view kSigns("\0\xD8", 2);  // in UTF-16 of Latin letters, of mathematical ones
    if (bytes.find_first_of(kSigns) == std::string_view::npos) return text;
    for (const std::size_t from : {0, 1})
        for (const bool big_endian : {false, true}) text += runs_of_utf16(bytes.substr(from), big_endian);
    return text;
}

std::string without_references(const std::string& xml) {
    std::string text;
    for (std::size_t i = 0; i < xml.size(); ++i) {
        const std::string_view behind = std::string_view(xml).substr(i + 1, kLongestReference);
        const std::size_t end = xml[i] == '&' ? behind.find(';') : std::string_view::npos;
        const auto c = end == std::string_view::npos ? std::nullopt : referred_to(behind.substr(0, end));
        if (!c) {
            text += xml[i];
            continue;
        }
        text += utf8_of(*c);
        i += 1 + end;
    }
    return text;
}

std::vector<std::string> texts_of_archive(const std::string& bytes) {
    std::vector<std::string> texts;
    const Utf8Locale names;  // libarchive gives them in the character set of the locale
    const std::unique_ptr<archive, int (*)(archive*)> in(archive_read_new(), archive_read_free);
    archive_read_support_filter_gzip(in.get());
    archive_read_support_format_zip(in.get());
    archive_read_support_format_tar(in.get());
    if (archive_read_open_memory(in.get(), bytes.data(), bytes.size()) != ARCHIVE_OK) return texts;
    std::size_t total = 0;
    archive_entry* entry = nullptr;
    const auto next = [&] {
        const int status = archive_read_next_header(in.get(), &entry);
        return status == ARCHIVE_OK || status == ARCHIVE_WARN;  // a warning: its name cannot be read, its content can
    };
    for (int i = 0; i < kMostEntries && next(); ++i) {
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

}  // namespace dynlab::inline course
