#include "workflow/error_text.h"

#include <fmt/format.h>

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
    if (fs::path(file).extension() != ".lua" || !fs::is_regular_file(path, none) || !lies_below(path, folder) ||
        fs::file_size(path, none) > kLargestSource)
        return {};
    return read_text(path);
}

std::string place_text(const std::string& file, int line, const PercentScript& script) {
    return fmt::format("{}:{}: ", (script.file.parent_path() / file).string(), line);
}

std::string source_line(const std::string& file, int line, const PercentScript& script) {
    const std::string text = trimmed(line_of(source_of(file, script), line));
    return text.empty() ? "" : fmt::format("\n    {}", text);
}

}  // namespace

std::string error_text(const RecordedError& error, const PercentScript& script) {
    if (error.line == 0) return error.text();
    std::string text = place_text(error.file, error.line, script) + message_text(error.message);
    text += source_line(error.file, error.line, script);
    for (const RecordedCall& call : error.calls)
        text += "\n  " + place_text(call.file, call.line, script) + message_text(call.what) +
                source_line(call.file, call.line, script);
    return text;
}

}  // namespace dynlab::inline workflow
