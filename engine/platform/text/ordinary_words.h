#pragma once
#include <string>

namespace dynlab::inline platform {

/// Whether a name, folded as by folded_letter, has another meaning in documents: an ordinary word in English or French,
/// a name of the field or of a program.
bool is_ordinary_word(const std::string& folded);

}  // namespace dynlab::inline platform
