#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace dynlab::inline platform {

/// UTF-8 of a text in Windows-1252, what Latin-1 is called when it holds quotation marks and dashes.
std::string utf8_of_windows_1252(std::string_view bytes);

/// A file's name from an archive or a disk that does not say its character set: as it is where it is UTF-8, else read
/// in code page 850 (what zip had before Unicode, 437 among it as far as letters go) or in Windows-1252, whichever
/// makes letters of it, without capitals in the middle of words.
std::string utf8_of_name(std::string_view bytes);

/// What the name may be as well that utf8_of_name made of bytes: the same bytes in code pages of other scripts (866 and
/// 1251, GBK, Big5, Shift-JIS, Windows' Korean), where they are text there. Nothing of a name in ASCII. Which one holds
/// is for somebody to say who knows the names.
std::vector<std::string> other_readings_of_name(std::string_view utf8);

/// With letters and their accents as one character each where Unicode has it (NFC, UAX #15); macOS takes the names of
/// files apart. What is not UTF-8 becomes U+FFFD.
std::string composed(std::string_view utf8);

}  // namespace dynlab::inline platform
