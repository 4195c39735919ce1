#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "base/message.h"
#include "documents/run_record.h"

namespace dynlab::inline course {

/// The message with `change` made to its text. It stays translatable where changing its text arguments alone has that
/// effect; else the changed text is verbatim.
Message with_changed_text(const Message& message, const std::function<std::string(const std::string&)>& change);

/// What was said in a box about work that lay in `folder` there, as its author may read it: files by their names in
/// the work ("analysis.lua:98: ..."), without the program's name in front.
std::string told_outside(const std::string& said, const std::filesystem::path& folder);
Message told_outside(const Message& said, const std::filesystem::path& folder);

/// The message of an error with its place: "analysis.lua:98: ...".
Message with_place(const RecordedError& error);

/// What an error says, cut where it is long.
Message shortened_trouble(const Message& trouble);

/// What stands before the full stop of another sentence.
std::string without_full_stop(std::string text);

}  // namespace dynlab::inline course
