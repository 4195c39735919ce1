#include "course/names/letters.h"

#include <array>

namespace dynlab::inline course {
namespace {

/// Letters without accents; '.' where there is none or more than one.
constexpr std::string_view kFromC0 =
    "aaaaaa.ceeeeiiiidnooooo.ouuuuy..aaaaaa.ceeeeiiiidnooooo.ouuuuy.y"
    "aaaaaaccccccccddddeeeeeeeeeegggggggghhhhiiiiiiiiii..jjkkkllllll."
    ".llnnnnnn.nnoooooo..rrrrrrssssssssttttttuuuuuuuuuuuuwwyyyzzzzzzs"
    "bb.......d.....e..f....i.......ooo.............uu....zz........."
    ".............aaiioouuuuuuuuuu.aaaa....ggkkoooo..j...gg..nnaa..oo"
    "aaaaeeeeiiiioooorrrruuuusstt..hh......aaeeooooooooyy............"
    "....u.ee........";
constexpr std::string_view kFrom1E00 =
    "aabbbbbbccddddddddddeeeeeeeeeeffgghhhhhhhhhhiiiikkkkkkllllllllmm"
    "mmmmnnnnnnnnoooooooopppprrrrrrrrssssssssssttttttttuuuuuuuuuuvvvv"
    "wwwwwwwwwwxxxxyyzzzzzzhtwy.s..s.aaaaaaaaaaaaaaaaaaaaaaaaeeeeeeee"
    "eeeeeeeeiiiioooooooooooooooooooooooouuuuuuuuuuuuuuyyyyyyyy......";
static_assert(kFromC0.size() == 0x250 - 0xC0 && kFrom1E00.size() == 0x100);

struct Several {
    char32_t character;
    const char* letters;
};
constexpr Several kSeveral[] = {{0xC6, "ae"},   {0xE6, "ae"},   {0xDF, "ss"},   {0xDE, "th"},    {0xFE, "th"},
                                {0x132, "ij"},  {0x133, "ij"},  {0x152, "oe"},  {0x153, "oe"},   {0x1E9E, "ss"},
                                {0xFB00, "ff"}, {0xFB01, "fi"}, {0xFB02, "fl"}, {0xFB03, "ffi"}, {0xFB04, "ffl"},
                                {0xFB05, "st"}, {0xFB06, "st"}};

constexpr std::u32string_view kGreekAccented = U"ΆΈΉΊΌΎΏάέήίόύώςϊϋ", kGreekPlain = U"αεηιουωαεηιουωσιυ";
static_assert(kGreekAccented.size() == kGreekPlain.size());

/// Greek and Cyrillic in small letters; other scripts as they are.
char32_t small_letter(char32_t c) {
    const auto accented = kGreekAccented.find(c);
    if (accented != std::u32string_view::npos) return kGreekPlain[accented];
    if ((c >= 0x391 && c <= 0x3A9) || (c >= 0x410 && c <= 0x42F)) return c + 0x20;
    if (c >= 0x400 && c <= 0x40F) return c + 0x50;
    return c;
}

/// Full-width and mathematical letters as the plain ones they show.
char32_t plain_form(char32_t c) {
    if (c >= 0xFF01 && c <= 0xFF5E) return c - 0xFEE0;
    if (c >= 0x1D400 && c < 0x1D400 + 13 * 52) {
        const char32_t place = (c - 0x1D400) % 52;
        return place < 26 ? U'A' + place : U'a' + place - 26;
    }
    if (c >= 0x1D7CE && c <= 0x1D7FF) return U'0' + (c - 0x1D7CE) % 10;
    return c;
}

/// Punctuation, symbols and what is no character at all.
bool is_sign(char32_t c) {
    return c < 0xC0 || c == 0xD7 || c == 0xF7 || (c >= 0x2B0 && c < 0x370) || (c >= 0x2000 && c < 0x2C00) ||
           (c >= 0x3000 && c < 0x3040) || (c >= 0xD800 && c < 0xF900) || (c >= 0xFE00 && c < 0xFE70) || c >= 0xFFE0;
}

}  // namespace

std::string utf8_of(char32_t c) {
    const auto tail = [c](int shift) { return static_cast<char>(0x80 | ((c >> shift) & 0x3F)); };
    if (c < 0x80) return {static_cast<char>(c)};
    if (c < 0x800) return {static_cast<char>(0xC0 | (c >> 6)), tail(0)};
    if (c < 0x10000) return {static_cast<char>(0xE0 | (c >> 12)), tail(6), tail(0)};
    return {static_cast<char>(0xF0 | (c >> 18)), tail(12), tail(6), tail(0)};
}

std::string folded_letter(char32_t given) {
    const char32_t c = plain_form(given);
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) return {static_cast<char>(c)};
    if (c >= 'A' && c <= 'Z') return {static_cast<char>(c - 'A' + 'a')};
    if (c < 0x80) return "";
    for (const Several& several : kSeveral)
        if (several.character == c) return several.letters;
    const char base = c >= 0xC0 && c < 0x250      ? kFromC0[c - 0xC0]
                      : c >= 0x1E00 && c < 0x1F00 ? kFrom1E00[c - 0x1E00]
                                                  : '.';
    if (base != '.') return {base};
    return is_sign(c) ? "" : utf8_of(small_letter(c));
}

bool is_silent(char32_t c) {
    return c == 0xAD || c == 0xA8 || c == 0xB4 || c == 0xB8 || (c >= 0x2C6 && c < 0x2E0) || (c >= 0x300 && c < 0x370) ||
           (c >= 0x200B && c <= 0x200F) || c == 0x2060 || c == 0xFEFF;
}

bool is_capital(char32_t given) {
    const char32_t c = plain_form(given);
    if (c < 0x80) return c >= 'A' && c <= 'Z';
    if ((c >= 0xC0 && c <= 0xDE) || (c >= 0x391 && c <= 0x3A9) || (c >= 0x400 && c <= 0x42F)) return true;
    if (c >= 0x139 && c <= 0x148) return c % 2 == 1;
    if (c >= 0x179 && c <= 0x17E) return c % 2 == 1;
    return ((c >= 0x100 && c < 0x178) || (c >= 0x1E00 && c < 0x1F00)) && c % 2 == 0;
}

bool is_ideograph(char32_t c) {
    return (c >= 0x3040 && c < 0xA000) || (c >= 0xAC00 && c < 0xD7B0) || (c >= 0x20000 && c < 0x32000);
}

}  // namespace dynlab::inline course
