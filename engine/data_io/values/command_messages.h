#pragma once
#include <filesystem>
#include <vector>

#include "data_io/values/message_values.h"

namespace dynlab::inline data_io {

/// The messages of a dynlab command to its user. A program that runs a command for a separate reader names a file in
/// the command's environment. It finds the messages in that file, and makes their text itself.
struct CommandMessages {
    std::vector<Message> results;            ///< on standard output
    std::vector<Message> complaints, notes;  ///< on standard error

    bool empty() const { return results.empty() && complaints.empty() && notes.empty(); }
    Message all() const;  ///< a line each
};
DYNLAB_DESCRIBE(CommandMessages, results, complaints, notes)

/// The variable of the environment that names the file.
inline constexpr char kFileOfCommandMessages[] = "DYNLAB_MESSAGES";

void write_command_messages(const std::filesystem::path& file, const CommandMessages& said);
/// Nothing where there is no such file, or one that write_command_messages did not write.
CommandMessages read_command_messages(const std::filesystem::path& file);

}  // namespace dynlab::inline data_io
