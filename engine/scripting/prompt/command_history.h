#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace dynlab::inline scripting {

/// The lines typed at the prompt, kept in a file from one session to the next.
class CommandHistory {
  public:
    static constexpr std::size_t kMaxLineCount = 2000;     ///< of the file; older ones are dropped
    static constexpr std::size_t kMaxLineLength = 4096;    ///< bytes; longer ones are not kept
    static constexpr std::size_t kMaxFileBytes = 8 << 20;  ///< bytes; of a larger one the end is read

    /// Reads what `file` holds, whatever that is, and shortens the file when it has grown too long. Without a file (an
    /// empty path, or one that cannot be read) the history starts empty.
    explicit CommandHistory(std::filesystem::path file);

    const std::vector<std::string>& lines() const { return lines_; }
    /// Appends a line, and writes it to the file at once: several prompts may write to the file at the same time.
    /// Returns whether the line was kept: it is not blank, not too long, and differs from the previous one. The prompt
    /// also works if the file cannot be written.
    bool add(std::string_view line);

  private:
    void shorten_file() const;
    std::filesystem::path file_;
    std::vector<std::string> lines_;
};

/// $XDG_STATE_HOME/dynlab/history, else ~/.local/state/dynlab/history; empty when neither folder is known.
std::filesystem::path history_file();

/// One line of clean UTF-8: tabs become spaces, other control characters and invalid bytes are left out.
std::string clean_line(std::string_view text);

}  // namespace dynlab::inline scripting
