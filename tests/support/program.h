#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "platform/child_process.h"
#include "platform/temporary_folder.h"

namespace dynlab::test {

/// The formats of LaTeX that tests of this build have made, as links in a cache that is empty.
void lend_formats(const std::filesystem::path& cache);
/// Those that were made in such a cache, for later tests; the first of two wins.
void keep_formats(const std::filesystem::path& cache);

/// An empty folder in which the built program runs as for a user, with a separate cache.
class Workbench {
  public:
    /// kShared: other tests of this build use the cached results of lessons, as a user's second run does.
    /// kOwn: only the formats of LaTeX are shared. They take a second to make, and their names contain all that makes
    /// them.
    enum class Memory { kOwn, kShared };

    std::filesystem::path path(const std::string& name = "") const { return folder_.path() / "work" / name; }
    /// XDG_CACHE_HOME of what is run.
    const std::filesystem::path& cache() const { return cache_; }
    void write(const std::string& name, const std::string& text) const;
    std::string read(const std::string& name) const;
    std::vector<std::string> files() const;  ///< names in the folder, hidden ones too, sorted

    ChildResult dynlab(std::vector<std::string> arguments) const;
    ChildResult shell(const std::string& command) const;  ///< bash; $DYNLAB is the program
    void hide_program(const std::string& name);           ///< from now on PATH has every usual program except this one

    /// The folder with lessons, data and templates from now on, instead of the source tree.
    void set_home(const std::filesystem::path& home) { home_ = home.string(); }

    explicit Workbench(Memory memory = Memory::kOwn);
    ~Workbench();

  private:
    ChildResult run(std::vector<std::string> command) const;

    TemporaryFolder folder_;
    std::string path_variable_, home_;
    std::filesystem::path cache_;
};

/// The file that `dynlab COMMAND -o name` makes: once for all tests of this build, as long as nothing changes.
/// Throws EnvironmentError with the program's message when it fails.
std::filesystem::path shared_document(const std::vector<std::string>& command, const std::string& name);
/// The page that `dynlab report` makes of a lesson.
std::filesystem::path page_of_lesson(const std::string& lesson);

}  // namespace dynlab::test
