#pragma once
#include <string>
#include <type_traits>
#include <utility>

#include "base/message.h"
#include "base/reader.h"
#include "data_io/values/message_values.h"

namespace dynlab::inline course {

/// A message as files for other programs store it: its English text as `name`, and where there is one the message
/// itself as `message_name`. What earlier versions stored is text alone, which is read as verbatim.
template <class V, class M>
void store_text_with_message(V& member, const char* name, const char* message_name, M& message) {
    if constexpr (std::is_const_v<M>) {
        const std::string text = message_text(message);
        member(name, text), member.unless_empty(message_name, message);
    } else {
        std::string text;
        Message stored;
        member(name, text), member.unless_empty(message_name, stored);
        if (!stored.empty() && message_text(stored) == text)
            message = std::move(stored);
        else
            message = text.empty() ? Message() : Message::verbatim(std::move(text));
    }
}

/// What an author wrote, which is its text and nothing else.
template <class V, class M>
void store_text_of_author(V& member, const char* name, M& message) {
    std::string text;
    if constexpr (std::is_const_v<M>) text = message_text(message);
    member(name, text);
    if constexpr (!std::is_const_v<M>) message = Message::verbatim(std::move(text));
}

}  // namespace dynlab::inline course
