#include "scripting/conversions/told_sentences.h"

#include <algorithm>

#include "documents/words/sentence_catalogue.h"
#include "scripting/conversions/option_words.h"

namespace dynlab::inline scripting {
namespace {

/// With the indentation that the line has.
std::string told_line(const std::string& line) {
    const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
    return line.substr(0, begin) + french_engine_sentences().translated(line.substr(begin));
}

}  // namespace

std::string told(const Call& call, const std::string& text) {
    const std::string english = in_lua_words(text);
    if (call.context().services.language_code() != "fr") return english;
    std::string french;
    for (std::size_t begin = 0; begin < english.size();) {
        const std::size_t end = std::min(english.find('\n', begin), english.size());
        french += told_line(english.substr(begin, end - begin));
        if (end < english.size()) french += '\n';
        begin = end + 1;
    }
    return french;
}

std::vector<std::string> told(const Call& call, const std::vector<std::string>& sentences) {
    std::vector<std::string> result;
    for (const std::string& sentence : sentences) result.push_back(told(call, sentence));
    return result;
}

std::string told(const Call& call, const Message& message) {
    return told(call, in_lua_words(message));
}

std::vector<std::string> told(const Call& call, const std::vector<Message>& messages) {
    std::vector<std::string> result;
    for (const Message& message : messages) result.push_back(told(call, message));
    return result;
}

}  // namespace dynlab::inline scripting
