#include "platform/utf8_locale.h"

#include <cerrno>

#include "platform/error.h"
#include "platform/system_call.h"

namespace dynlab::inline platform {
namespace {

/// Read once from the files of the C library.
locale_t locale_of_utf8() {
    static const locale_t read = [] {
        const locale_t locale = ::newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr);
        if (locale == nullptr)
            throw EnvironmentError(
                "the locale C.UTF-8 is not available: {}. Install this locale (Debian: package libc-bin)",
                system_reason(errno));
        return locale;
    }();
    return read;
}

}  // namespace

Utf8Locale::Utf8Locale() : before_(::uselocale(locale_of_utf8())) {}

Utf8Locale::~Utf8Locale() {
    ::uselocale(before_);
}

}  // namespace dynlab::inline platform
