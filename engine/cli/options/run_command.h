#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/options/script_options.h"
#include "scripting/memoized_calls/shared_pieces.h"

namespace dynlab::inline cli {

/// What the commands run and study are given.
struct RunArguments {
    std::string file, code, out;
    bool interactive = false, view = false, force = false, gnuplot = false;
    SeedOption seed;
    SliderOption sliders;
};

/// Other machines that make parts of a script's long calls.
class RunSharing {
  public:
    virtual ~RunSharing() = default;
    /// Called before the script runs, with the folder of its figures and its seed.
    virtual SharedPieces& begin(const std::filesystem::path& out, std::uint32_t seed) = 0;
    /// Called after it; returns notes for the user.
    virtual std::vector<std::string> end(bool succeeded) = 0;
};

/// Runs a script, draws its figures and prints what it reports. Returns the exit code; throws what run_script throws.
int run_and_show(const RunArguments& args, RunSharing* sharing = nullptr);

}  // namespace dynlab::inline cli
