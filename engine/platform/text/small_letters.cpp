#include "platform/text/small_letters.h"

namespace dynlab::inline platform {

std::string in_small_letters(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

std::string ending_of(const std::filesystem::path& file) {
    return in_small_letters(file.extension().string());
}

}  // namespace dynlab::inline platform
