#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace dynlab::inline platform {

/// UTF-8 of a text in Windows-1252, what Latin-1 is called when it holds quotation marks and dashes.
std::string utf8_of_windows_1252(std::string_view bytes);

/// A file's name from an archive or a disk that does not state its character set: unchanged if it is UTF-8, else
/// decoded from code page 850 (used by zip before Unicode; its letters include those of 437) or from Windows-1252,
/// whichever gives letters without capitals in the middle of words.
std::string utf8_of_name(std::string_view bytes);

/// Other possible readings of a name that utf8_of_name decoded: the same bytes in code pages of other scripts (866 and
/// 1251, GBK, Big5, Shift-JIS, Windows' Korean), if they are text there. None for a name in ASCII. The caller, who
/// knows the names, must choose the right one.
std::vector<std::string> other_readings_of_name(std::string_view utf8);

/// With letters and their accents as one character each where Unicode has it (NFC, UAX #15); macOS takes the names of
/// files apart. What is not UTF-8 becomes U+FFFD.
std::string composed(std::string_view utf8);

}  // namespace dynlab::inline platform
