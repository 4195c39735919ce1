#include "scripting/conversions/option_words.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <utility>
#include <variant>

#include "base/reader.h"
#include "platform/spelling.h"

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
    OptionWord{"transient", "transient"},
    OptionWord{"noise_variance", "NoiseVariance"},
    OptionWord{"history_points", "HistoryPoints"},
    OptionWord{"degree", "degree"},
    OptionWord{"terms", "terms"},
    OptionWord{"threshold", "threshold"},
    OptionWord{"weak", "weak"},
    OptionWord{"window", "window"},
    OptionWord{"width", "width"},
    OptionWord{"rank", "rank"},
    OptionWord{"delays", "delays"},
    OptionWord{"runs", "runs"},
    OptionWord{"confidence", "confidence"},
    OptionWord{"points", "points"},
    OptionWord{"range", "range"},
    OptionWord{"relative_tolerance", "RelTol"},
    OptionWord{"starts", "starts"},
    OptionWord{"outputs", "outputs"},
};

std::optional<std::string> word_of(std::string_view name) {
    const auto found = std::ranges::find(kOptionWords, name, &OptionWord::first);
    return found == kOptionWords.end() ? std::nullopt : std::optional<std::string>(found->second);
}

}  // namespace

std::string option_name(std::string_view member) {
    return word_of(member).value_or("`" + std::string(member) + "`");
}

Message with_script_options(const Message& message) {
    std::vector<MessageArgument> arguments = message.arguments();
    for (MessageArgument& argument : arguments) {
        if (const auto* const option = std::get_if<OptionName>(&argument)) {
            argument = option_name(option->member);
        } else if (auto* const list = std::get_if<MessageList>(&argument)) {
            for (Message& item : list->items) item = with_script_options(item);
        }
    }
    return Message::stored(message.id(), message.many(), std::move(arguments));
}

Message unknown_option(const std::string& name, const std::vector<std::string>& known) {
    const auto near = nearest_word(name, known);
    return near ? Message("option '{}' is unknown; did you mean '{}'?", name, *near)
                : Message("option '{}' is unknown; the options are {}", name, listed(known));
}

MessageList listed_in_quotes(const std::vector<std::string>& texts) {
    MessageList list;
    for (const std::string& text : texts) list.items.push_back(Message::verbatim('"' + text + '"'));
    return list;
}

std::vector<std::string> translated_options() {
    std::vector<std::string> names;
    for (const OptionWord& word : kOptionWords) names.emplace_back(word.first);
    return names;
}

}  // namespace dynlab::inline scripting
