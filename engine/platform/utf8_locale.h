#pragma once
#include <locale.h>

namespace dynlab::inline platform {

/// While it lives, the character set of this thread is UTF-8. For libraries that take it from the locale; the C
/// locale, in which a program starts, knows ASCII only. Nothing else of the locale changes, and no other thread's.
/// Throws EnvironmentError where the C library has no C.UTF-8.
class Utf8Locale {
  public:
    Utf8Locale();
    ~Utf8Locale();
    Utf8Locale(const Utf8Locale&) = delete;
    Utf8Locale& operator=(const Utf8Locale&) = delete;

  private:
    locale_t before_;
};

}  // namespace dynlab::inline platform
