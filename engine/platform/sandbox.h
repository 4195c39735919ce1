#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/message.h"
#include "platform/child_process.h"
#include "platform/time_limits.h"

namespace dynlab::inline platform {

/// Level of isolation of untrusted work.
/// * kFull: bubblewrap provides a separate file system (only /usr, the added files and an empty scratch folder),
///   separate process numbers, and no network.
/// * kProcess: a separate process with time limits, an almost empty environment and a temporary working folder.
/// At both levels the program inside must confine itself (confine_process) before it reads untrusted input.
enum class Isolation { kFull, kProcess };

std::string isolation_name(Isolation level);  ///< "full", "process"

/// Why this machine cannot have the level, and what to do about it, in one line; nothing where it can.
std::optional<Message> obstacle_to(Isolation level);
/// The strongest level that this machine can have; found out once.
Isolation strongest_isolation();

/// A process in a sandbox.
class Sandbox {
  public:
    explicit Sandbox(Isolation level) : level_(level) {}

    /// Adds a file or folder to the sandbox. Returns its path there: `inside` at level kFull, otherwise `outside`.
    std::filesystem::path add(const std::filesystem::path& outside, const std::string& inside);
    /// The same for a folder that the work may write into.
    std::filesystem::path add_writable(const std::filesystem::path& outside, const std::string& inside);
    void set_environment(const std::string& name, const std::string& value) { environment_.emplace_back(name, value); }
    /// Adds a dynlab program with its libraries, and dynlab-course if the program is `dynlab`, which runs its commands.
    /// Returns the path of the program in the sandbox.
    std::filesystem::path add_program(const std::filesystem::path& program);
    /// The TeX, font and alternatives settings of this machine, for pandoc, LaTeX and gnuplot.
    void add_document_programs();
    /// The same, with a home of dynlab that has these data and our templates of reports.
    void add_document_home(const std::filesystem::path& data);

    struct Limits {
        TimeLimits time;                             ///< of all processes in it; then they are killed
        std::uint64_t output_bytes = 32ull << 20;    ///< of standard output and error
        std::uint64_t scratch_bytes = 128ull << 20;  ///< of /tmp at level kFull
        std::optional<std::uint64_t> file_bytes;     ///< of the largest file written; SIGXFSZ ends who writes more
        std::optional<std::uint64_t> memory_bytes;   ///< address space of each process
    };
    /// `command` names this program (its place comes from add_program) or one in /usr/bin. `folder` is a place in the
    /// sandbox.
    ChildResult run(const std::vector<std::string>& command, const std::filesystem::path& folder,
                    const std::string& input, const Limits& limits) const;

  private:
    struct Mount {
        std::filesystem::path outside;
        std::string inside;
        bool writable;
    };
    std::filesystem::path mount(const std::filesystem::path& outside, const std::string& inside, bool writable);

    Isolation level_;
    std::vector<Mount> mounts_;
    std::vector<std::pair<std::string, std::string>> environment_;
};

}  // namespace dynlab::inline platform
