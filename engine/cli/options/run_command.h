#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/options/script_options.h"
#include "scripting/runtime/services.h"

namespace dynlab::inline cli {

/// What the commands run and study are given.
struct RunArguments {
    std::string file, code, out;
    bool interactive = false, view = false, force = false, gnuplot = false;
    SeedOption seed;
    SliderOption sliders;
};

/// Where a script's files and figures go when no folder is named: NAME_out beside it.
std::filesystem::path figures_folder(const std::filesystem::path& script);

/// Runs a script, draws its figures and prints what it reports. Returns the exit code; throws what run_script throws.
int run_and_show(const RunArguments& args, CallsInParts* parts = nullptr);

}  // namespace dynlab::inline cli
