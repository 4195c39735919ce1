#include "platform/text/word_set.h"

#include <algorithm>

namespace dynlab::inline platform {

std::unordered_set<std::string_view> word_set(std::string_view list) {
    std::unordered_set<std::string_view> words;
    for (std::size_t begin = 0; begin < list.size();) {
        const std::size_t end = std::min(list.find(' ', begin), list.size());
        words.insert(list.substr(begin, end - begin));
        begin = end + 1;
    }
    return words;
}

}  // namespace dynlab::inline platform
