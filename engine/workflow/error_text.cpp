#include "workflow/error_text.h"

#include <fmt/format.h>

#include "base/languages.h"
#include "base/reader.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "platform/files/inside_folder.h"
#include "scripting/runtime/errors.h"
#include "scripting/runtime/output_path.h"

namespace dynlab::inline workflow {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestSource = 1u << 20;  // bytes of a file of which a line is shown

/// The source of `file`, which a message names: the script's own or one beside it; empty where it is not there.
std::string source_of(const std::string& file, const PercentScript& script) {
    if (file == script.file.filename()) return script.source;
    const fs::path folder = folder_around(script.file);
    const fs::path path = folder / file;
    std::error_code none;
    if (fs::path(file).extension() != ".lua" || !fs::is_regular_file(path, none) || !is_below_folder(path, folder) ||
        fs::file_size(path, none) > kLargestSource)
        return {};
    return read_text(path);
}

std::string place_text(const std::string& file, int line, const PercentScript& script) {
    return fmt::format("{}:{}: ", (script.file.parent_path() / file).string(), line);
}

void add_source_line(MessageList& lines, const std::string& file, int line, const PercentScript& script) {
    const std::string text = trimmed(line_of(source_of(file, script), line));
    if (!text.empty()) lines.items.push_back(Message::verbatim("    " + text));
}

}  // namespace

Message error_message(const RecordedError& error, const PercentScript& script) {
    if (error.line == 0) return error.message;
    MessageList lines{{Message("{}{}", place_text(error.file, error.line, script), error.message)}, Join::kLines};
    add_source_line(lines, error.file, error.line, script);
    for (const RecordedCall& call : error.calls) {
        lines.items.push_back(Message("{}{}", "  " + place_text(call.file, call.line, script), call.what));
        add_source_line(lines, call.file, call.line, script);
    }
    return Message("{}", lines);
}

std::string error_text(const RecordedError& error, const PercentScript& script) {
    return message_text(error_message(error, script), {catalog_of(script.header.language)});
}

}  // namespace dynlab::inline workflow
