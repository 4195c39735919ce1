#include "scripting/prompt/command_history.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <fstream>
#include <sstream>

#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/system_call.h"
#include "platform/utf8.h"
#include "platform/written_files.h"

namespace dynlab::inline scripting {
namespace {

namespace fs = std::filesystem;

/// The end of the file; empty when it is not there or not a regular file.
std::string end_of_file(const fs::path& file) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return {};
    std::ifstream stream(file, std::ios::binary);
    const auto size = fs::file_size(file, error);
    if (!error && size > CommandHistory::kMaxFileBytes)
        stream.seekg(-static_cast<std::streamoff>(CommandHistory::kMaxFileBytes), std::ios::end);
    std::ostringstream text;
    text << stream.rdbuf();
    return std::move(text).str();
}

bool is_control(char32_t c) {
    return c < 0x20 || (c >= 0x7F && c < 0xA0);
}

}  // namespace

CommandHistory::CommandHistory(fs::path file) : file_(std::move(file)) {
    if (file_.empty()) return;
    const std::string text = end_of_file(file_);
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (line = clean_line(line); !line.empty() && line.size() <= kMaxLineLength) lines_.push_back(std::move(line));
    const bool too_long = lines_.size() > kMaxLineCount || text.size() >= kMaxFileBytes;
    if (lines_.size() > kMaxLineCount) lines_.erase(lines_.begin(), lines_.end() - kMaxLineCount);
    if (too_long) shorten_file();
}

void CommandHistory::shorten_file() const {
    std::string text;
    for (const std::string& line : lines_) text += line + '\n';
    try {
        write_file_atomically(file_, text);
    } catch (const EnvironmentError&) {  // a folder that became read-only: the next session tries again
    }
}

bool CommandHistory::add(std::string_view text) {
    const std::string line = clean_line(text);
    if (line.find_first_not_of(' ') == std::string::npos || line.size() > kMaxLineLength) return false;
    if (!lines_.empty() && lines_.back() == line) return false;
    lines_.push_back(line);
    if (file_.empty()) return true;
    std::error_code ignored;
    fs::create_directories(file_.parent_path(), ignored);
    const FileDescriptor stream(::open(file_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NONBLOCK, 0600));
    const std::string entry = line + '\n';
    if (stream) write_all(stream.get(), entry.data(), entry.size());
    return true;
}

fs::path history_file() {
    return state_file("history");
}

std::string clean_line(std::string_view text) {
    std::string line;
    while (!text.empty()) {
        const std::string_view before = text;
        const std::optional<char32_t> c = take_character(text);
        if (c == U'\t')
            line += ' ';
        else if (c && !is_control(*c))
            line += before.substr(0, before.size() - text.size());
    }
    return line;
}

}  // namespace dynlab::inline scripting
