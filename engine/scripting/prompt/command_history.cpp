#include "scripting/prompt/command_history.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/system_call.h"

namespace dynlab::inline scripting {
namespace {

namespace fs = std::filesystem;

/// Bytes of the UTF-8 character at the start of `text`; 0 when it is none (RFC 3629).
std::size_t character_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = byte(0);
    if (lead < 0x80) return 1;
    const std::size_t length = lead >= 0xC2 && lead <= 0xDF   ? 2
                               : lead >= 0xE0 && lead <= 0xEF ? 3
                               : lead >= 0xF0 && lead <= 0xF4 ? 4
                                                              : 0;
    if (length == 0 || length > text.size()) return 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xC0) != 0x80) return 0;
    const bool overlong = (lead == 0xE0 && byte(1) < 0xA0) || (lead == 0xF0 && byte(1) < 0x90);
    const bool no_character = (lead == 0xED && byte(1) > 0x9F) || (lead == 0xF4 && byte(1) > 0x8F);
    return overlong || no_character ? 0 : length;
}

/// The end of the file; empty when it is not there or no ordinary file.
std::string end_of_file(const fs::path& file) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return {};
    std::ifstream stream(file, std::ios::binary);
    const auto size = fs::file_size(file, error);
    if (!error && size > CommandHistory::kLargestFile)
        stream.seekg(-static_cast<std::streamoff>(CommandHistory::kLargestFile), std::ios::end);
    std::ostringstream text;
    text << stream.rdbuf();
    return std::move(text).str();
}

bool is_control(std::string_view character) {
    const auto first = static_cast<unsigned char>(character[0]);
    const bool second_block = character.size() == 2 && first == 0xC2 && static_cast<unsigned char>(character[1]) < 0xA0;
    return first < 0x20 || first == 0x7F || second_block;
}

}  // namespace

CommandHistory::CommandHistory(fs::path file) : file_(std::move(file)) {
    if (file_.empty()) return;
    const std::string text = end_of_file(file_);
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (line = clean_line(line); !line.empty() && line.size() <= kLongestLine) lines_.push_back(std::move(line));
    const bool too_long = lines_.size() > kMostLines || text.size() >= kLargestFile;
    if (lines_.size() > kMostLines) lines_.erase(lines_.begin(), lines_.end() - kMostLines);
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
    if (line.find_first_not_of(' ') == std::string::npos || line.size() > kLongestLine) return false;
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
    const auto folder = [](const char* variable) -> fs::path {
        const char* value = std::getenv(variable);
        return value != nullptr && *value == '/' ? fs::path(value) : fs::path();
    };
    if (const fs::path state = folder("XDG_STATE_HOME"); !state.empty()) return state / "dynlab/history";
    if (const fs::path home = folder("HOME"); !home.empty()) return home / ".local/state/dynlab/history";
    return {};
}

std::string clean_line(std::string_view text) {
    std::string line;
    while (!text.empty()) {
        const std::size_t length = character_length(text);
        const std::string_view character = text.substr(0, std::max<std::size_t>(length, 1));
        if (character == "\t")
            line += ' ';
        else if (length > 0 && !is_control(character))
            line += character;
        text.remove_prefix(character.size());
    }
    return line;
}

}  // namespace dynlab::inline scripting
