#pragma once
#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <string>

namespace dynlab::inline platform {

/// Prevents scripts from overwriting files of other programs and users: a file may be replaced only if a run of dynlab
/// wrote it and it has not changed since. A ledger lists the written files, one line per file: SHA-256 of its path, and
/// SHA-256 of its content; "-" and the SHA-256 of content that is about to be put in place (a killed run then leaves
/// the old or the new content); or "?" if nothing was written after all.
class WrittenFiles {
  public:
    enum class Others { kKept, kReplaced };
    /// An empty `ledger`, or one that cannot be written: nothing is known of earlier runs. With `kReplaced` any file
    /// may be replaced.
    explicit WrittenFiles(std::filesystem::path ledger, Others others = Others::kKept);
    ~WrittenFiles();  ///< settles
    /// Notes the current content of the files, including figures that were drawn after the script: later changes are
    /// those of another user. A prompt calls this function after each statement.
    void settle();
    WrittenFiles(const WrittenFiles&) = delete;
    WrittenFiles& operator=(const WrittenFiles&) = delete;

    /// Asks to write `file`, an absolute path without links. Throws EnvironmentError where another's file is there.
    void take(const std::filesystem::path& file);
    /// `finished` is about to be renamed to `target`: where that was taken, its content is noted.
    void note_replacement(const std::filesystem::path& target, const std::filesystem::path& finished) const;

  private:
    std::set<std::string> known_contents(const std::string& path_hash) const;
    void note(const std::string& lines) const;

    std::filesystem::path ledger_;
    Others others_;
    struct Taken {
        std::string path_hash;
        std::string others_content;  ///< SHA-256 of a foreign file that may be replaced; empty for none
    };
    [[noreturn]] void refuse(const std::filesystem::path& file, bool was_ours) const;
    mutable std::mutex mutex_;
    std::map<std::filesystem::path, Taken> taken_;  ///< guarded by mutex_
};

/// Notifies all WrittenFiles of this process that `finished` is about to be renamed to `target`: for code that puts
/// files in place.
void note_replacement(const std::filesystem::path& target, const std::filesystem::path& finished);

/// A file of this name where programs keep their state: $XDG_STATE_HOME/dynlab, else ~/.local/state/dynlab; empty when
/// neither folder is known.
std::filesystem::path state_file(const char* name);

}  // namespace dynlab::inline platform
