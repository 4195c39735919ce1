#pragma once
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include "base/message.h"
#include "base/reader.h"
#include "scripting/conversions/userdata.h"

namespace dynlab::inline scripting {

/// The language of the document that is made (ReportLanguage), and the option names of scripts.
Reader reader_of(const Call& call);

/// The text for that reader.
std::string localized(const Call& call, const Message& message);
std::vector<std::string> localized(const Call& call, const std::vector<Message>& messages);

template <class T, auto kGet>
int give_localized_field(Call& call) {
    const T& object = object_itself<T>(call);
    if constexpr (std::is_invocable_v<decltype(kGet), const T&, const Reader&>)
        return call.give(std::invoke(kGet, object, reader_of(call)));
    else
        return call.give(localized(call, std::invoke(kGet, object)));
}
/// As `field`, of a message, or of a text that kGet(object, reader) makes for the reader.
template <class T, auto kGet>
constexpr lua_CFunction localized_field = guarded<give_localized_field<T, kGet>>;

}  // namespace dynlab::inline scripting
