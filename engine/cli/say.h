#pragma once
#include "base/message.h"

namespace dynlab::inline cli {

/// What a command says to its user, each on lines of its own. Where the environment wants them, the messages are in a
/// file, too (data_io/values/said_messages.h).
void say(const Message& result);          ///< on standard output
void complain(const Message& complaint);  ///< on standard error, behind "dynlab: "
void note(const Message& remark);         ///< on standard error, behind "dynlab: note: "

}  // namespace dynlab::inline cli
