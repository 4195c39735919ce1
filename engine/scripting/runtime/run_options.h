#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "platform/time_limits.h"

namespace dynlab::inline figures {
class GnuplotRenderer;
}

namespace dynlab::inline scripting {

class CallCache;

struct RunOptions {
    std::uint32_t seed = 1;                              ///< state of the random stream at the start
    std::filesystem::path script_folder = ".";           ///< where load() looks first
    std::filesystem::path out_folder = ".";              ///< what a script writes must lie below this folder
    std::function<void(const std::string&)> print = {};  ///< gets printed text at once, in addition to the run results
    std::function<void(const std::string&)> enter_cell = {};  ///< gets the id of each cell as the script enters it
    CallCache* call_cache = nullptr;  ///< of results of calls that take long; all are computed again without
    std::size_t memory_limit_bytes = std::size_t{2} << 30;
    std::size_t output_limit_bytes = std::size_t{16} << 20;  ///< of printed text
    std::optional<TimeLimits> time = {};
    bool stay_in_folder = false;  ///< load() refuses paths that lead out of the script's folder, as where `graded`
    bool graded = false;  ///< the course's data win over files of the same name, and saved figures are not drawn
};

}  // namespace dynlab::inline scripting
