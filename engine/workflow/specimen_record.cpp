#include "workflow/specimen_record.h"

#include <fmt/format.h>

#include <algorithm>

#include "figures/gnuplot_renderer.h"
#include "platform/error.h"
#include "platform/program_lookup.h"
#include "scripting/runtime.h"

namespace dynlab {

namespace fs = std::filesystem;

const std::vector<std::string>& simulated_data_sets() {
    static const std::vector<std::string> names = {"crane",         "heat_exchanger", "heat_transfer", "linear_system",
                                                   "step_response", "suspension",     "thruster"};
    return names;
}

bool is_simulated(const std::string& data_set) {
    const auto& names = simulated_data_sets();
    return std::find(names.begin(), names.end(), data_set) != names.end();
}

std::vector<std::string> simulated_data_of(const std::string& source) {
    std::vector<std::string> found;
    for (const std::string& name : simulated_data_sets())
        if (source.find("load(\"" + name + "\")") != std::string::npos) found.push_back(name);
    return found;
}

void write_specimen_record(const std::string& data_set, std::uint32_t specimen, std::uint32_t seed,
                           const fs::path& folder) {
    GnuplotRenderer renderer;
    RunOptions options;
    options.out_folder = folder;
    Runtime runtime(options, renderer);
    const RunRecord record = runtime.run_code(
        fmt::format("save_mat(\"{0}.mat\", rig(\"{0}\", {{seed = {1}, specimen = {2}}}), {{digits = 7}})", data_set,
                    seed, specimen),
        "record of " + data_set);
    if (record.error) throw EnvironmentError("a record cannot be made: " + record.error->message);
}

void write_group_data(const std::vector<std::string>& data_sets, std::uint32_t group_seed, const fs::path& folder) {
    for (const std::string& name : data_sets) {
        fs::create_directories(folder / name);
        fs::copy_file(shared_folder() / "data" / name / "SOURCE.md", folder / name / "SOURCE.md",
                      fs::copy_options::overwrite_existing);
        write_specimen_record(name, group_seed, group_seed, folder / name);
    }
}

}  // namespace dynlab
