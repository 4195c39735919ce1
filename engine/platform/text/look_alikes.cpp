#include "platform/text/look_alikes.h"

#include <unicode/uchar.h>
#include <unicode/unorm2.h>
#include <unicode/uscript.h>
#include <unicode/uspoof.h>

#include <array>
#include <cctype>
#include <cmath>
#include <memory>
#include <string_view>

#include "platform/utf8.h"

namespace dynlab::inline platform {
namespace {

/// By radical from U+2E80 to U+2EF3: the ideograph (Unicode's property Equivalent_Unified_Ideograph). Tables of fonts
/// give radicals for ideographs.
// It splits literals of wide letters differently each time.
// clang-format off
constexpr std::u32string_view kIdeographsOfRadicals =
    U"⺀厂乛乚乙亻冂𠘨刀刂卜㔾小尐兀尣尢𡯂巳幺彑彐忄心扌攵⺚旡日月歺母民氵氺灬爫爬丬"
    U"牛"
    U"犭王𤴔目示礻𥫗糹纟罓罒㓁冗𦉫羊𦍌𦍋耂肀聿肉𦥑艹艺艻虎衤覀西见角𧢲讠贝𧾷车辶辷辸邑"
    U"钅長镸长门𨸏阝雨青韦页风飞食𩙿飠饣𩠐马骨鬼鱼鸟卤麦黄黾斉齐歯齿竜龙龜亀龟";
// clang-format on

bool is_latin_letter(char32_t c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool is_enclosed(char32_t c) {
    return (c >= 0x2460 && c < 0x2500) || (c >= 0x1F100 && c < 0x1F200);
}

/// "LATIN LETTER SMALL CAPITAL A", "MODIFIER LETTER SMALL A", "CIRCLED LATIN SMALL LETTER A": the letter at the end of
/// the name.
char32_t letter_of_name(char32_t c) {
    std::array<char, 100> name{};
    UErrorCode status = U_ZERO_ERROR;
    u_charName(static_cast<UChar32>(c), U_UNICODE_CHAR_NAME, name.data(), static_cast<int>(name.size()), &status);
    if (U_FAILURE(status)) return c;
    if (const std::string_view whole(name.data()); is_enclosed(c)) {
        const bool letter = whole.size() > 8 && whole.substr(0, whole.size() - 1).ends_with(" LETTER ");
        return letter ? static_cast<char32_t>(std::tolower(static_cast<unsigned char>(whole.back()))) : c;
    }
    for (const std::string_view kind :
         {"LATIN LETTER SMALL CAPITAL ", "MODIFIER LETTER SMALL ", "MODIFIER LETTER CAPITAL ",
          "LATIN SUBSCRIPT SMALL LETTER ", "SUPERSCRIPT LATIN SMALL LETTER "}) {
        const std::string_view whole(name.data());
        if (whole.starts_with(kind) && whole.size() == kind.size() + 1)
            return static_cast<char32_t>(std::tolower(static_cast<unsigned char>(whole.back())));
    }
    return c;
}

bool is_radical(char32_t c) {
    return c >= 0x2E80 && c <= 0x2FD5;
}

char32_t ideograph_of(char32_t radical) {
    if (const std::size_t index = radical - 0x2E80; index < kIdeographsOfRadicals.size())
        return kIdeographsOfRadicals[index];
    UErrorCode status = U_ZERO_ERROR;
    std::array<UChar, 4> decomposed{};
    const int length = unorm2_getRawDecomposition(unorm2_getNFKCInstance(&status), static_cast<UChar32>(radical),
                                                  decomposed.data(), static_cast<int>(decomposed.size()), &status);
    return U_SUCCESS(status) && length == 1 ? decomposed.front() : radical;
}

const USpoofChecker* confusables() {
    static const std::unique_ptr<USpoofChecker, void (*)(USpoofChecker*)> checker = [] {
        UErrorCode status = U_ZERO_ERROR;
        return std::unique_ptr<USpoofChecker, void (*)(USpoofChecker*)>(uspoof_open(&status), uspoof_close);
    }();
    return checker.get();
}

}  // namespace

char32_t look_alike(char32_t c) {
    if (c < 0x80) return c;
    if (is_radical(c)) return ideograph_of(c);
    const double number = u_getNumericValue(static_cast<UChar32>(c));
    if (u_charType(static_cast<UChar32>(c)) == U_OTHER_NUMBER && number >= 0 && number <= 9 &&
        number == std::floor(number))
        return U'0' + static_cast<char32_t>(number);
    if (is_enclosed(c)) return letter_of_name(c);
    if (!u_isalpha(static_cast<UChar32>(c))) return c;
    UErrorCode status = U_ZERO_ERROR;
    const UScriptCode script = uscript_getScript(static_cast<UChar32>(c), &status);
    const bool other = script == USCRIPT_CYRILLIC || script == USCRIPT_GREEK || script == USCRIPT_ARMENIAN ||
                       script == USCRIPT_CHEROKEE || script == USCRIPT_COPTIC || script == USCRIPT_LISU;
    if (!other) return folded_letter(c).size() == 1 ? c : letter_of_name(c);
    const std::u16string text = utf16_of(utf8_of(c));
    std::array<UChar, 16> skeleton{};
    const int length = uspoof_getSkeleton(confusables(), 0, text.data(), static_cast<int>(text.size()), skeleton.data(),
                                          static_cast<int>(skeleton.size()), &status);
    if (U_FAILURE(status) || length < 1) return c;
    const std::u16string_view shape(skeleton.data(), static_cast<std::size_t>(length));
    if (shape == u"rn") return 'm';  // as the table writes that letter
    return length == 1 && is_latin_letter(shape.front()) ? shape.front() : c;
}

}  // namespace dynlab::inline platform
