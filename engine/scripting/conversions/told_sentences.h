#pragma once
#include <functional>
#include <string>
#include <vector>

#include "base/message.h"
#include "scripting/conversions/boxed.h"

namespace dynlab::inline scripting {

/// What numerics says, in the names that scripts use (option_words.h) and in the language of the document that is made
/// (ReportLanguage), line by line. What report_templates/engine_sentences.fr.txt does not know stays as it is.
std::string told(const Call& call, const std::string& text);
std::vector<std::string> told(const Call& call, const std::vector<std::string>& sentences);
/// By the message's English text.
std::string told(const Call& call, const Message& message);
std::vector<std::string> told(const Call& call, const std::vector<Message>& messages);

template <class T, auto kGet>
int give_told_field(Call& call) {
    return call.give(told(call, std::invoke(kGet, object_itself<T>(call))));
}
/// As `field`, of a text that numerics says.
template <class T, auto kGet>
constexpr lua_CFunction told_field = guarded<give_told_field<T, kGet>>;

}  // namespace dynlab::inline scripting
