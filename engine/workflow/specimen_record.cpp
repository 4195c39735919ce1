#include "workflow/specimen_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "documents/text_lines.h"
#include "figures/gnuplot_renderer.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/program_lookup.h"
#include "platform/text_file.h"
#include "scripting/runtime/runtime.h"

namespace dynlab::inline workflow {

namespace fs = std::filesystem;

namespace {

constexpr char kSourceFile[] = "SOURCE.md";
constexpr std::string_view kSpecimenKey = "Specimen:";
constexpr char kOwnRecord[] = R"(
**Your group's own record.** It was made as is said above, but on another specimen of the apparatus, whose parameters
are others, and with other noise: `rig("{name}", {{specimen = {seed}, seed = {seed}}})` makes it again, and
`rig_truth("{name}", {{specimen = {seed}}})` tells what theory says of it.

{key} {seed}
)";

}  // namespace

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
        const std::string source = read_text(shared_folder() / "data" / name / kSourceFile);
        const std::string own = fmt::format(kOwnRecord, fmt::arg("name", name), fmt::arg("seed", group_seed),
                                            fmt::arg("key", kSpecimenKey));
        write_file_atomically(folder / name / kSourceFile, source + own);
        write_specimen_record(name, group_seed, group_seed, folder / name);
    }
}

std::optional<std::uint32_t> group_seed_of(const fs::path& data_folder) {
    for (const std::string& name : simulated_data_sets()) {
        const fs::path source = data_folder / name / kSourceFile;
        if (!fs::is_regular_file(source)) continue;
        for (const std::string& line : lines_of(read_text(source))) {
            if (!line.starts_with(kSpecimenKey)) continue;
            const std::string number = trimmed(std::string_view(line).substr(kSpecimenKey.size()));
            std::uint32_t seed = 0;
            const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), seed);
            if (error == std::errc() && end == number.data() + number.size()) return seed;
        }
    }
    return {};
}

}  // namespace dynlab::inline workflow
