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

/// How far untrusted work is kept apart. kFull: bubblewrap gives it its own file system with nothing but /usr, what is
/// put into the box and an empty scratch folder, its own process numbers, no network. kProcess: a process of its own
/// with limits of time, an almost empty environment and a temporary working folder. In both the program inside is
/// expected to confine itself (confine_process) before it touches what is not trusted.
enum class Isolation { kFull, kProcess };

std::string isolation_name(Isolation level);  ///< "full", "process"

/// Why this machine cannot have the level, and what to do about it, in one line; nothing where it can.
std::optional<Message> obstacle_to(Isolation level);
/// The strongest level that this machine can have; found out once.
Isolation strongest_isolation();

/// One process in a box.
class Box {
  public:
    explicit Box(Isolation level) : level_(level) {}

    /// Puts a file or folder into the box and returns its place there: `inside` at level kFull, `outside` otherwise.
    std::filesystem::path add(const std::filesystem::path& outside, const std::string& inside);
    /// The same for a folder that the work may write into.
    std::filesystem::path add_writable(const std::filesystem::path& outside, const std::string& inside);
    void set_environment(const std::string& name, const std::string& value) { environment_.emplace_back(name, value); }
    /// A program of dynlab's with the libraries of its own that it may have, `dynlab` with dynlab-course, too, whose
    /// commands it has there; returns its place.
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
    /// box.
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
