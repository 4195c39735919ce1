#pragma once
#include <string>

#include "base/message.h"

namespace dynlab::inline scripting {

/// A message and the line of a script that it is about; an empty file and line 0 where that is not known.
struct PlacedMessage {
    Message message;
    std::string file = {};
    int line = 0;

    /// In English: "lesson.lua:3: there is no function or variable 'y'".
    std::string text() const;
    /// Place and message as one message, for another one that quotes it.
    Message with_place() const;
};

}  // namespace dynlab::inline scripting
