#include "platform/text/shown_order.h"

#include <unicode/ubidi.h>

#include <algorithm>
#include <memory>

#include "platform/error.h"
#include "platform/utf8.h"

namespace dynlab::inline platform {
namespace {

bool turns(std::string_view utf8) {
    static constexpr std::string_view kSigns[] = {"\u202A", "\u202B", "\u202C", "\u202D", "\u202E",
                                                  "\u2066", "\u2067", "\u2068", "\u2069"};
    return std::any_of(std::begin(kSigns), std::end(kSigns),
                       [&](std::string_view sign) { return utf8.find(sign) != std::string_view::npos; });
}

}  // namespace

std::string in_shown_order(std::string_view utf8) {
    if (!turns(utf8)) return std::string(utf8);
    const std::u16string units = utf16_of(utf8);
    const std::unique_ptr<UBiDi, void (*)(UBiDi*)> order(ubidi_open(), ubidi_close);
    UErrorCode status = U_ZERO_ERROR;
    ubidi_setPara(order.get(), units.data(), static_cast<std::int32_t>(units.size()), UBIDI_DEFAULT_LTR, nullptr,
                  &status);
    std::u16string shown(units.size(), u'\0');
    const std::int32_t count =
        ubidi_writeReordered(order.get(), shown.data(), static_cast<std::int32_t>(shown.size()),
                             UBIDI_DO_MIRRORING | UBIDI_KEEP_BASE_COMBINING | UBIDI_REMOVE_BIDI_CONTROLS, &status);
    if (U_FAILURE(status))
        throw EnvironmentError("ICU, the Unicode library, cannot order letters: {}", u_errorName(status));
    shown.resize(static_cast<std::size_t>(count));
    return utf8_of(std::u16string_view(shown));
}

}  // namespace dynlab::inline platform
