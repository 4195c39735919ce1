#include <emscripten.h>

#include <algorithm>
#include <string>

#include "platform/utf8.h"

// What Unicode says of characters, as the browser knows it: \p{...} of its regular expressions (ECMA-262, 22.2) and
// String.normalize.

EM_JS(int, dynlab_character_is, (int character, const char* pattern), {
    const known = globalThis.dynlabPatterns || (globalThis.dynlabPatterns = new Map());
    const source = UTF8ToString(pattern);
    if (!known.has(source)) known.set(source, new RegExp("^" + source + "$", "u"));
    return known.get(source).test(String.fromCodePoint(character)) ? 1 : 0;
});

EM_JS(void, dynlab_compatible_form, (int character, char* to, int capacity),
      { stringToUTF8(String.fromCodePoint(character).normalize("NFKD").toLowerCase(), to, capacity); });

namespace dynlab::inline platform {
namespace {

bool is(char32_t c, const char* pattern) {
    return dynlab_character_is(static_cast<int>(c), pattern) != 0;
}

}  // namespace

std::size_t columns_of(char32_t c) {
    constexpr char32_t kSoftHyphen = 0xAD;
    if (c < 0x80 || c == kSoftHyphen) return 1;
    if (is(c, "[\\p{Mn}\\p{Me}\\p{Default_Ignorable_Code_Point}]")) return 0;
    return is(c, "[\\p{Script=Hani}\\p{Script=Hira}\\p{Script=Kana}\\p{Script=Hang}\\uFF01-\\uFF60]") ? 2 : 1;
}

std::size_t columns_of(std::string_view utf8) {
    std::size_t columns = 0;
    while (!utf8.empty()) columns += columns_of(next_character(utf8));
    return columns;
}

std::string folded_letter(char32_t c) {
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) return {static_cast<char>(c)};
    if (c >= 'A' && c <= 'Z') return {static_cast<char>(c - 'A' + 'a')};
    if (c < 0x80 || !is(c, "[\\p{L}\\p{Nd}\\p{Nl}]")) return "";
    char parts[128];
    dynlab_compatible_form(static_cast<int>(c), parts, sizeof parts);
    std::string letters;
    for (std::string_view rest = parts; !rest.empty();) {
        const char32_t part = next_character(rest);
        if (part < 0x80 || is(part, "[\\p{L}\\p{Nd}\\p{Nl}]")) letters += utf8_of(part);
    }
    return letters;
}

bool is_ignorable(char32_t c) {
    return c >= 0x80 && is(c, "[\\p{Mn}\\p{Default_Ignorable_Code_Point}\\u00A8\\u00B4\\u00B8\\u02C6-\\u02DF]");
}

Script script_of(char32_t c) {
    static const Script kScripts[] = {
        {"Arabic", "Arab"},   {"Armenian", "Armn"}, {"Bengali", "Beng"}, {"Cyrillic", "Cyrl"},  {"Devanagari", "Deva"},
        {"Ethiopic", "Ethi"}, {"Georgian", "Geor"}, {"Greek", "Grek"},   {"Gujarati", "Gujr"},  {"Gurmukhi", "Guru"},
        {"Hangul", "Hang"},   {"Han", "Hani"},      {"Hebrew", "Hebr"},  {"Hiragana", "Hira"},  {"Katakana", "Kana"},
        {"Khmer", "Khmr"},    {"Lao", "Laoo"},      {"Latin", "Latn"},   {"Malayalam", "Mlym"}, {"Mongolian", "Mong"},
        {"Myanmar", "Mymr"},  {"Sinhala", "Sinh"},  {"Tamil", "Taml"},   {"Telugu", "Telu"},    {"Thai", "Thai"},
        {"Tibetan", "Tibt"}};
    for (const Script& script : kScripts)
        if (is(c, ("\\p{Script=" + script.code + "}").c_str())) return script;
    return {};
}

bool is_right_to_left(char32_t c) {
    return c >= 0x80 && is(c, "[\\p{Script=Hebr}\\p{Script=Arab}\\p{Script=Syrc}\\p{Script=Thaa}\\p{Script=Nkoo}]");
}

bool is_mark(char32_t c) {
    return c >= 0x80 && is(c, "\\p{M}");
}

bool is_capital(char32_t c) {
    return c < 0x80 ? c >= 'A' && c <= 'Z' : is(c, "[\\p{Lu}\\p{Lt}\\p{Uppercase}]");
}

bool is_ideograph(char32_t c) {
    return c >= 0x80 &&
           is(c, "[\\p{Script=Hani}\\p{Script=Hira}\\p{Script=Kana}\\p{Script=Hang}\\p{Script=Bopo}\\p{Script=Yiii}]");
}

}  // namespace dynlab::inline platform
