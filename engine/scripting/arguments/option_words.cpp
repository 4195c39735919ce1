#include "scripting/arguments/option_words.h"

#include <algorithm>
#include <array>
#include <utility>

namespace dynlab::inline scripting {
namespace {

using OptionWord = std::pair<std::string_view, std::string_view>;
constexpr std::array kOptionWords = {
    OptionWord{"initial_state", "InitialState"},
    OptionWord{"offset", "Offset"},
    OptionWord{"least_delay", "TdMin"},
    OptionWord{"largest_delay", "TdMax"},
    OptionWord{"delay_count", "NumTd"},
    OptionWord{"delay", "IODelay"},
    OptionWord{"max_iterations", "MaxIter"},
    OptionWord{"tolerance", "Tol"},
    OptionWord{"stable", "Stable"},
    OptionWord{"fixed", "Fixed"},
    OptionWord{"output_weights", "OutputWeights"},
    OptionWord{"integration", "Integration"},
    OptionWord{"bins", "Bins"},
    OptionWord{"breakpoints", "Breakpoints"},
    OptionWord{"block_rows", "BlockRows"},
    OptionWord{"weighting", "Weighting"},
};

}  // namespace

std::string in_lua_words(std::string_view message) {
    std::string text;
    while (!message.empty()) {
        const std::size_t begin = message.find('`'), end = message.find('`', begin + 1);
        if (begin == std::string_view::npos || end == std::string_view::npos) break;
        const std::string_view name = message.substr(begin + 1, end - begin - 1);
        const auto word = std::find_if(kOptionWords.begin(), kOptionWords.end(),
                                       [&](const OptionWord& option) { return option.first == name; });
        const bool known = word != kOptionWords.end();
        text += message.substr(0, known ? begin : end);  // a closing backtick may open the next name
        if (known) text += word->second;
        message.remove_prefix(known ? end + 1 : end);
    }
    return text += message;
}

std::vector<std::string> translated_options() {
    std::vector<std::string> names;
    for (const OptionWord& word : kOptionWords) names.emplace_back(word.first);
    return names;
}

}  // namespace dynlab::inline scripting
