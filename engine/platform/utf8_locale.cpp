#include "platform/utf8_locale.h"

#include <cerrno>

#include "platform/error.h"
#include "platform/system_call.h"

namespace dynlab::inline platform {

Utf8Locale::Utf8Locale() : own_(::newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr)), before_(nullptr) {
    if (own_ == nullptr) throw EnvironmentError("the C library has no locale C.UTF-8: " + system_reason(errno));
    before_ = ::uselocale(own_);
}

Utf8Locale::~Utf8Locale() {
    ::uselocale(before_);
    ::freelocale(own_);
}

}  // namespace dynlab::inline platform
