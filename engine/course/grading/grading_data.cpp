// The data sets of GradingRules: hidden ones, those of reruns, those of groups.
#include <fmt/format.h>

#include "course/checks/read_checks.h"
#include "course/grading/grading_rules.h"
#include "course/sandbox_jobs/sandbox_work.h"
#include "data_io/mat_file.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/hash.h"
#include "platform/program_lookup.h"
#include "workflow/lesson_data.h"
#include "workflow/variant_data.h"

namespace dynlab::inline course {

namespace fs = std::filesystem;

std::uint32_t GradingRules::drawn(const std::string& what) const {
    return drawn_number(setup_.secret, setup_.lesson.slug, what);
}

/// Creates a hidden data set of every simulated plant. Only a running check shows which ones it needs, and all together
/// take a tenth of a second.
void GradingRules::make_data_sets() {
    fs::create_directories(data_sets_.path() / kHiddenDataSets);
    for (const Plant& plant : plant_catalog())
        make_data_set(plant.name, kHiddenDataSets, data_sets_.path() / kHiddenDataSets);
    for (const std::string& rerun : reruns_) {
        if (rerun == kOtherSeedRun) continue;
        const fs::path data = data_sets_.path() / rerun / "data";
        fs::create_directories(data.parent_path());
        fs::copy(official_data(), data, fs::copy_options::recursive);
        fs::create_directories(data / rerun);
        for (const auto& entry : fs::directory_iterator(data / rerun))
            if (entry.path().extension() == ".csv" || entry.path().extension() == ".mat") fs::remove(entry.path());
        if (!fs::exists(data / rerun / "SOURCE.md")) write_file_atomically(data / rerun / "SOURCE.md", "A record.\n");
        if (const auto file = own_data_set("rerun", rerun)) {
            fs::copy_file(*file, data / rerun / file->filename());
            own_data_sets_ += sha256_of_file(*file);
        } else if (find_plant(rerun)) {
            make_data_set(rerun, rerun, data / rerun);
        }
    }
    if (setup_.more_checks && fs::is_directory(*setup_.more_checks / kHiddenDataSets))
        for (const auto& entry : fs::directory_iterator(*setup_.more_checks / kHiddenDataSets)) {
            const std::string name = entry.path().stem().string();
            if (!own_data_set(kHiddenDataSets, name)) continue;
            fs::remove(data_sets_.path() / kHiddenDataSets / (name + ".mat"));
            fs::copy_file(entry.path(), data_sets_.path() / kHiddenDataSets / entry.path().filename());
            variants_[kHiddenDataSets].erase(name);  // the instructor's file replaces the simulated one
            own_data_sets_ += sha256_of_file(entry.path());
        }
    make_data_of_declared_plants();
}

/// A data set from the instructor's folder of checks.
std::optional<fs::path> GradingRules::own_data_set(const std::string& folder, const std::string& data_set) const {
    if (!setup_.more_checks) return {};
    for (const char* ending : {".csv", ".mat"}) {
        const fs::path file = *setup_.more_checks / folder / (data_set + ending);
        if (fs::is_regular_file(file)) return file;
    }
    return {};
}

/// Hidden data sets, and those of reruns, of all simulated plants that the files declare.
void GradingRules::make_data_of_declared_plants() {
    if (declared_plants_.empty()) return;
    std::vector<RequestedDataSet> requested;
    std::vector<fs::path> files;
    for (const std::string& plant : declared_plants_)
        for (const std::string& run : {std::string(kHiddenDataSets), plant}) {
            const bool hidden = run == kHiddenDataSets;
            if (!hidden && !reruns_.contains(plant)) continue;
            const std::uint32_t variant_number = drawn(plant);
            requested.push_back({plant, variant_number, drawn(noise_of(plant, run))});
            files.push_back(
                (hidden ? data_sets_.path() / kHiddenDataSets : data_sets_.path() / plant / "data" / plant) /
                (plant + ".mat"));
            variants_[run][plant] = variant_number;
        }
    const SandboxResult<CheckResults> made = listed(requested);
    if (!made.output)
        throw EnvironmentError("the simulated plants that the checks declare cannot be run: {}", made.reason);
    if (made.output->error) throw EnvironmentError(*made.output->error);
    for (std::size_t k = 0; k < files.size(); ++k) {
        VariableTable variables;
        for (const auto& [name, values] : made.output->data_sets.at(k))
            variables[name] = {Vector(Eigen::Map<const Vector>(values.data(), static_cast<Index>(values.size())))};
        write_mat_file(files[k], variables);
    }
}

void GradingRules::make_data_set(const std::string& data_set, const std::string& run, const fs::path& folder) {
    // The draw of the variant ignores `run`: hidden data sets are further experiments with the plant of the rerun.
    const PlantChoice choice{.variant_number = drawn(data_set), .seed = drawn(noise_of(data_set, run))};
    variants_[run][data_set] = choice.variant_number;
    write_variant_data(data_set, choice, folder);
}

void GradingRules::bring_lesson_data() {
    if (has_own_data(setup_.lesson)) {
        const fs::path data = data_sets_.path() / "official" / "data";
        fs::create_directories(data.parent_path());
        fs::copy(shared_folder() / "data", data, fs::copy_options::recursive);
        copy_own_data(setup_.lesson, data);
    }
    own_data_sets_ += digest_of_folder(official_data()).hex();
}

/// The installed data sets, and those that the lesson brings along.
fs::path GradingRules::official_data() const {
    const fs::path data = data_sets_.path() / "official" / "data";
    return fs::exists(data) ? data : shared_folder() / "data";
}

/// Data sets of the lesson that groups may have for themselves. Needs the lock of `making_`.
std::vector<std::string> GradingRules::simulated() const {
    if (!simulated_) simulated_ = simulated_data_of(setup_.lesson);
    return *simulated_;
}

/// The official data with a group's own data sets, as the group has them.
fs::path GradingRules::data_of(const GroupSeed& group_seed) const {
    if (!group_seed) return official_data();
    const std::lock_guard lock(*making_);
    const fs::path data = data_sets_.path() / fmt::format("group-{}", *group_seed) / "data";
    if (fs::exists(data)) return data;
    const fs::path growing = data.parent_path() / "growing";
    fs::create_directories(growing.parent_path());
    fs::copy(official_data(), growing, fs::copy_options::recursive);
    for (const std::string& name : simulated()) fs::remove_all(growing / name);
    write_group_data(simulated(), *group_seed, growing);
    fs::rename(growing, data);
    return data;
}

std::map<std::string, PlantVariants> GradingRules::variants_of(const GroupSeed& group_seed) const {
    std::map<std::string, PlantVariants> all = variants_;
    if (!group_seed) return all;
    const std::lock_guard lock(*making_);
    for (const std::string& name : simulated())
        for (const char* run : {kMainRun, kOtherSeedRun}) all[run][name] = *group_seed;
    return all;
}

}  // namespace dynlab::inline course
