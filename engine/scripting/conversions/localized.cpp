#include "scripting/conversions/localized.h"

#include "base/languages.h"

namespace dynlab::inline scripting {

Reader reader_of(const Call& call) {
    return {catalog_of(call.context().services.language_code()), call.context().option_name};
}

std::string localized(const Call& call, const Message& message) {
    return message_text(message, reader_of(call));
}

std::vector<std::string> localized(const Call& call, const std::vector<Message>& messages) {
    std::vector<std::string> texts;
    for (const Message& message : messages) texts.push_back(localized(call, message));
    return texts;
}

}  // namespace dynlab::inline scripting
