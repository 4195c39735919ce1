#include "platform/text/foreign_text.h"

#include <unicode/ucnv.h>
#include <unicode/udata.h>
#include <unicode/unorm2.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>

#include "platform/error.h"
#include "platform/utf8.h"

namespace dynlab::inline platform {
namespace {

/// ICU's own data, none that lie in the working folder.
void use_own_data() {
    static const bool once = [] {
        UErrorCode status = U_ZERO_ERROR;
        udata_setFileAccess(UDATA_NO_FILES, &status);
        return U_SUCCESS(status);
    }();
    static_cast<void>(once);
}

std::u16string utf16_of_bytes(std::string_view bytes, const char* charset) {
    use_own_data();
    UErrorCode status = U_ZERO_ERROR;
    const std::unique_ptr<UConverter, void (*)(UConverter*)> converter(ucnv_open(charset, &status), ucnv_close);
    std::u16string units(2 * bytes.size() + 1, u'\0');
    const std::int32_t count = ucnv_toUChars(converter.get(), units.data(), static_cast<std::int32_t>(units.size()),
                                             bytes.data(), static_cast<std::int32_t>(bytes.size()), &status);
    if (U_FAILURE(status))
        throw EnvironmentError("ICU, the Unicode library, cannot read {}: {}", charset, u_errorName(status));
    units.resize(static_cast<std::size_t>(count));
    return units;
}

using Converter = std::unique_ptr<UConverter, void (*)(UConverter*)>;

/// One that stops at what it cannot convert.
Converter strict_converter(const char* charset) {
    use_own_data();
    UErrorCode status = U_ZERO_ERROR;
    Converter converter(ucnv_open(charset, &status), ucnv_close);
    ucnv_setToUCallBack(converter.get(), UCNV_TO_U_CALLBACK_STOP, nullptr, nullptr, nullptr, &status);
    ucnv_setFromUCallBack(converter.get(), UCNV_FROM_U_CALLBACK_STOP, nullptr, nullptr, nullptr, &status);
    if (U_FAILURE(status))
        throw EnvironmentError("ICU, the Unicode library, cannot convert {}: {}", charset, u_errorName(status));
    return converter;
}

std::optional<std::string> bytes_in(const char* charset, const std::u16string& units) {
    const Converter converter = strict_converter(charset);
    UErrorCode status = U_ZERO_ERROR;
    std::string bytes(4 * units.size() + 4, '\0');
    const std::int32_t count = ucnv_fromUChars(converter.get(), bytes.data(), static_cast<std::int32_t>(bytes.size()),
                                               units.data(), static_cast<std::int32_t>(units.size()), &status);
    if (U_FAILURE(status)) return {};
    bytes.resize(static_cast<std::size_t>(count));
    return bytes;
}

std::optional<std::string> text_in(const char* charset, const std::string& bytes) {
    const Converter converter = strict_converter(charset);
    UErrorCode status = U_ZERO_ERROR;
    std::u16string units(2 * bytes.size() + 1, u'\0');
    const std::int32_t count = ucnv_toUChars(converter.get(), units.data(), static_cast<std::int32_t>(units.size()),
                                             bytes.data(), static_cast<std::int32_t>(bytes.size()), &status);
    if (U_FAILURE(status)) return {};
    units.resize(static_cast<std::size_t>(count));
    return utf8_of(std::u16string_view(units));
}

/// How little a text looks like a name.
int strangeness_of(std::u16string_view units) {
    constexpr std::u32string_view kRare = U"þÞðÐƒ";
    int strangeness = 0;
    bool after_small = false;
    while (!units.empty()) {
        const char32_t c = next_character(units);
        const bool letter = !folded_letter(c).empty();
        if (c >= 0x80 && !letter) strangeness += 3;
        if (c >= 0x80 && is_capital(c) && after_small) strangeness += 2;
        if (kRare.find(c) != std::u32string_view::npos) strangeness += 1;
        after_small = letter && !is_capital(c);
    }
    return strangeness;
}

}  // namespace

std::string utf8_of_windows_1252(std::string_view bytes) {
    return utf8_of(std::u16string_view(utf16_of_bytes(bytes, "windows-1252")));
}

std::string utf8_of_name(std::string_view bytes) {
    if (is_utf8(bytes)) return std::string(bytes);
    std::u16string best;
    int least = std::numeric_limits<int>::max();
    for (const char* charset : {"ibm-850", "windows-1252"}) {
        const std::u16string text = utf16_of_bytes(bytes, charset);
        const int strangeness = strangeness_of(text);
        if (strangeness >= least) continue;
        least = strangeness;
        best = text;
    }
    return utf8_of(std::u16string_view(best));
}

std::vector<std::string> other_readings_of_name(std::string_view utf8) {
    std::vector<std::string> readings;
    if (std::none_of(utf8.begin(), utf8.end(), [](unsigned char c) { return c >= 0x80; })) return readings;
    const std::u16string units = utf16_of(utf8);
    for (const char* western : {"ibm-850", "windows-1252"}) {
        const std::optional<std::string> bytes = bytes_in(western, units);
        if (!bytes) continue;
        for (const char* charset : {"ibm-866", "windows-1251", "gbk", "big5", "ibm-943", "ibm-949"})
            if (const auto text = text_in(charset, *bytes);
                text && std::find(readings.begin(), readings.end(), *text) == readings.end())
                readings.push_back(*text);
    }
    return readings;
}

std::string composed(std::string_view utf8) {
    use_own_data();
    const std::u16string units = utf16_of(utf8);
    UErrorCode status = U_ZERO_ERROR;
    const UNormalizer2* const forms = unorm2_getNFCInstance(&status);
    std::u16string result(3 * units.size() + 1, u'\0');  // UAX #15: at most three times as long
    const std::int32_t count = unorm2_normalize(forms, units.data(), static_cast<std::int32_t>(units.size()),
                                                result.data(), static_cast<std::int32_t>(result.size()), &status);
    if (U_FAILURE(status))
        throw EnvironmentError("ICU, the Unicode library, cannot compose letters: {}", u_errorName(status));
    result.resize(static_cast<std::size_t>(count));
    return utf8_of(std::u16string_view(result));
}

}  // namespace dynlab::inline platform
