#pragma once
#include <sys/types.h>

#include <filesystem>

namespace dynlab::inline platform {

/// What must not outlive this process where it is ended in the middle of something, without the destructors of its
/// objects: a file, a folder with all that is in it, or a group of processes. While one of these lives, its name is
/// known to end_what_ends_with_program(). Copies of the process (fork) do not count as it. Of more than 128 at once,
/// and of paths that are too long, the rest is not known: it is left behind, as it is by kill -9.
class EndsWithProgram {
  public:
    EndsWithProgram() = default;  ///< of nothing
    explicit EndsWithProgram(const std::filesystem::path& file_or_folder);
    static EndsWithProgram of_group(pid_t group);
    ~EndsWithProgram();
    EndsWithProgram(EndsWithProgram&& other) noexcept;
    EndsWithProgram& operator=(EndsWithProgram&& other) noexcept;

  private:
    int slot_ = -1;
};

/// Kills these groups and removes these files and folders. Async-signal-safe.
void end_what_ends_with_program();

}  // namespace dynlab::inline platform
