#pragma once
#include <string>
#include <vector>

#include "base/reader.h"

namespace dynlab::test {

/// In English.
inline std::vector<std::string> texts_of(const std::vector<Message>& messages) {
    std::vector<std::string> texts;
    for (const Message& message : messages) texts.push_back(message_text(message));
    return texts;
}

}  // namespace dynlab::test
