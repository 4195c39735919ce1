#include "platform/utf8.h"

#include <unicode/uchar.h>
#include <unicode/udata.h>
#include <unicode/unorm2.h>
#include <unicode/uscript.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "platform/error.h"

namespace dynlab::inline platform {
namespace {

/// Latin letters that Unicode does not take apart, and what names with them are compared as.
constexpr std::u32string_view kWholeLetters = U"đħıĸłŋøŧðəƀɓɖƒɨɵƶǥʉɇ", kPlainLetters = U"dhiklnotdebbdfiozgue";
static_assert(kWholeLetters.size() == kPlainLetters.size());

bool is_of(char32_t c, std::uint32_t categories) {
    return (U_GET_GC_MASK(static_cast<UChar32>(c)) & categories) != 0;
}

int property(char32_t c, UProperty which) {
    return u_getIntPropertyValue(static_cast<UChar32>(c), which);
}

const UNormalizer2* compatibility_forms() {
    static const UNormalizer2* const forms = [] {
        UErrorCode status = U_ZERO_ERROR;
        udata_setFileAccess(UDATA_NO_FILES, &status);  // ICU's own data, none that lie in the working folder
        const UNormalizer2* const nfkd = unorm2_getNFKDInstance(&status);
        if (U_FAILURE(status))
            throw EnvironmentError("ICU, the Unicode library, cannot be used: {}", u_errorName(status));
        return nfkd;
    }();
    return forms;
}

/// The letter in its parts: accents, letters of a ligature, the plain form.
std::u16string taken_apart(char32_t c) {
    std::array<UChar, 32> units;  // 18 for the longest
    UErrorCode status = U_ZERO_ERROR;
    const std::int32_t count = unorm2_getDecomposition(compatibility_forms(), static_cast<UChar32>(c), units.data(),
                                                       static_cast<std::int32_t>(units.size()), &status);
    if (count < 0 || U_FAILURE(status)) return utf16_of(utf8_of(c));
    return {units.data(), static_cast<std::size_t>(count)};
}

/// Accents over, under and through letters; vowel signs of other scripts are letters here.
bool is_accent(char32_t c) {
    constexpr int kOverlay = 1, kFirstPlacedAround = 200;  // canonical combining classes, UAX #44
    const int combining_class = property(c, UCHAR_CANONICAL_COMBINING_CLASS);
    return combining_class == kOverlay || combining_class >= kFirstPlacedAround;
}

bool is_sign(char32_t c) {
    constexpr std::uint32_t kLetters = U_GC_L_MASK | U_GC_M_MASK | U_GC_ND_MASK | U_GC_NL_MASK;
    const int form = property(c, UCHAR_DECOMPOSITION_TYPE);
    const bool modifier = c >= 0x2B0 && c < 0x370;  // letters and accents on their own
    return modifier || form == U_DT_SUPER || form == U_DT_SUB || !is_of(c, kLetters) || is_accent(c);
}

bool has_script(char32_t c, std::initializer_list<UScriptCode> scripts) {
    return std::any_of(scripts.begin(), scripts.end(),
                       [c](UScriptCode script) { return uscript_hasScript(static_cast<UChar32>(c), script); });
}

std::string plain_letter(char32_t c) {
    const auto small = static_cast<char32_t>(u_foldCase(static_cast<UChar32>(c), U_FOLD_CASE_DEFAULT));
    if (small == U'æ') return "ae";
    if (small == U'œ') return "oe";
    if (small == U'ß') return "ss";
    if (small == U'þ') return "th";
    const auto index = kWholeLetters.find(small);
    return utf8_of(index == std::u32string_view::npos ? small : kPlainLetters[index]);
}

}  // namespace

std::size_t columns_of(char32_t c) {
    constexpr char32_t kSoftHyphen = 0xAD;  // terminals show it
    if (c < 0x80 || c == kSoftHyphen) return 1;
    const bool no_width = is_of(c, U_GC_MN_MASK | U_GC_ME_MASK) ||
                          u_hasBinaryProperty(static_cast<UChar32>(c), UCHAR_DEFAULT_IGNORABLE_CODE_POINT);
    if (no_width) return 0;
    const int width = property(c, UCHAR_EAST_ASIAN_WIDTH);
    return width == U_EA_WIDE || width == U_EA_FULLWIDTH ? 2 : 1;
}

std::size_t columns_of(std::string_view utf8) {
    std::size_t columns = 0;
    while (!utf8.empty()) columns += columns_of(next_character(utf8));
    return columns;
}

std::string folded_letter(char32_t given) {
    if ((given >= 'a' && given <= 'z') || (given >= '0' && given <= '9')) return {static_cast<char>(given)};
    if (given >= 'A' && given <= 'Z') return {static_cast<char>(given - 'A' + 'a')};
    if (given < 0x80 || is_sign(given)) return "";
    if (is_of(given, U_GC_ND_MASK)) return {static_cast<char>('0' + u_charDigitValue(static_cast<UChar32>(given)))};
    if (has_script(given, {USCRIPT_HANGUL, USCRIPT_HIRAGANA, USCRIPT_KATAKANA})) return utf8_of(given);
    const std::u16string parts = taken_apart(given);
    std::string letters;
    for (std::u16string_view rest = parts; !rest.empty();) {
        const char32_t c = next_character(rest);
        if (!is_sign(c)) letters += plain_letter(c);
    }
    return letters;
}

bool is_ignorable(char32_t c) {
    if (c < 0x80) return false;
    const bool on_its_own = c == 0xA8 || c == 0xB4 || c == 0xB8 || (c >= 0x2C6 && c < 0x2E0);
    return on_its_own || is_accent(c) ||
           u_hasBinaryProperty(static_cast<UChar32>(c), UCHAR_DEFAULT_IGNORABLE_CODE_POINT);
}

Script script_of(char32_t character) {
    UErrorCode error = U_ZERO_ERROR;
    const UScriptCode code = uscript_getScript(static_cast<UChar32>(character), &error);
    if (U_FAILURE(error) || code == USCRIPT_COMMON || code == USCRIPT_INHERITED || code == USCRIPT_UNKNOWN) return {};
    std::string name = uscript_getName(code);
    std::erase(name, '_');
    return {name, uscript_getShortName(code)};
}

bool is_right_to_left(char32_t character) {
    const UCharDirection direction = u_charDirection(static_cast<UChar32>(character));
    return direction == U_RIGHT_TO_LEFT || direction == U_RIGHT_TO_LEFT_ARABIC;
}

bool is_mark(char32_t character) {
    return is_of(character, U_GC_M_MASK);
}

bool is_capital(char32_t c) {
    if (c < 0x80) return c >= 'A' && c <= 'Z';
    return u_hasBinaryProperty(static_cast<UChar32>(c), UCHAR_UPPERCASE) || u_istitle(static_cast<UChar32>(c));
}

bool is_ideograph(char32_t c) {
    return c >= 0x80 && has_script(c, {USCRIPT_HAN, USCRIPT_HIRAGANA, USCRIPT_KATAKANA, USCRIPT_HANGUL,
                                       USCRIPT_BOPOMOFO, USCRIPT_YI});
}

}  // namespace dynlab::inline platform
