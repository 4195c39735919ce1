#pragma once
#include <string>

#include "base/message.h"
#include "base/reader.h"

namespace dynlab::inline cli {

/// Prints from now on in that language. Without a catalog of it, and for English, the language stays.
void speak(const std::string& language);
/// Prints from now on in the language that LC_ALL, LC_MESSAGES or LANG names.
void speak_as_environment();
/// Who reads what the program prints.
const Reader& user();

/// Messages of a command to its user, each on separate lines. If the environment requests it, the messages are also
/// written to a file (data_io/values/command_messages.h).
void say(const Message& result);          ///< on standard output
void complain(const Message& complaint);  ///< on standard error, behind "dynlab: "
void note(const Message& remark);         ///< on standard error, behind "dynlab: note: "

}  // namespace dynlab::inline cli
