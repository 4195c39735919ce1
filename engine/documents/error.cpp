#include "documents/error.h"

#include <algorithm>

namespace dynlab::inline documents {
namespace {

Message without_zero_bytes(const Message& message);

MessageArgument without_zero_bytes(MessageArgument argument) {
    if (auto* text = std::get_if<std::string>(&argument)) std::replace(text->begin(), text->end(), '\0', '?');
    if (auto* list = std::get_if<MessageList>(&argument))
        for (Message& item : list->items) item = without_zero_bytes(item);
    return argument;
}

/// A message may quote a line with a zero byte, at which what() would end.
Message without_zero_bytes(const Message& message) {
    std::vector<MessageArgument> arguments;
    for (const MessageArgument& argument : message.arguments()) arguments.push_back(without_zero_bytes(argument));
    return Message::stored(message.id(), message.many(), std::move(arguments));
}

}  // namespace

Message placed(const Place& place, const Message& sentence) {
    const std::string line = place.line > 0 ? ":" + std::to_string(place.line) : "";
    return Message("{}{}", place.file.string() + line + ": ", sentence);
}

DocumentError::DocumentError(const Message& message) : ErrorOf(without_zero_bytes(message)), sentence_(message) {}

DocumentError::DocumentError(Place place, const Message& sentence)
    : ErrorOf(without_zero_bytes(placed(place, sentence))), place_(std::move(place)), sentence_(sentence) {}

}  // namespace dynlab::inline documents
