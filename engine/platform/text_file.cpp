#include "platform/text_file.h"

#include "platform/atomic_file.h"

namespace dynlab::inline platform {

std::string read_text(const std::filesystem::path& file) {
    std::string text = read_file(file);
    text.erase(0, text.size() - without_byte_order_mark(text).size());
    return text;
}

std::string_view without_byte_order_mark(std::string_view text) {
    constexpr std::string_view kMark = "\xEF\xBB\xBF";
    return text.starts_with(kMark) ? text.substr(kMark.size()) : text;
}

}  // namespace dynlab::inline platform
