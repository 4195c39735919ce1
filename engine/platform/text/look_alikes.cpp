#include "platform/text/look_alikes.h"

#include <unicode/uchar.h>
#include <unicode/uscript.h>
#include <unicode/uspoof.h>

#include <array>
#include <cctype>
#include <memory>
#include <string_view>

#include "platform/utf8.h"

namespace dynlab::inline platform {
namespace {

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
