#include "scripting/runtime/placed_message.h"

#include "base/reader.h"

namespace dynlab::inline scripting {

std::string PlacedMessage::text() const {
    return message_text(with_place());
}

Message PlacedMessage::with_place() const {
    return line > 0 ? Message("{}:{}: {}", file, line, message) : message;
}

}  // namespace dynlab::inline scripting
