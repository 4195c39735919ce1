#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dynlab::inline workflow {

/// The data sets that a simulator of the project makes.
const std::vector<std::string>& simulated_data_sets();
bool is_simulated(const std::string& data_set);

/// Those of them that a script loads by name.
std::vector<std::string> simulated_data_of(const std::string& source);

/// Writes NAME.mat into `folder`: the data set's experiment on another specimen of the apparatus, with other noise.
/// Throws EnvironmentError.
void write_specimen_record(const std::string& data_set, std::uint32_t specimen, std::uint32_t seed,
                           const std::filesystem::path& folder);

/// Makes `folder`/NAME with SOURCE.md and such a record for each of the data sets, as a group finds its own data:
/// specimen and noise are the group's seed's, which SOURCE.md tells.
void write_group_data(const std::vector<std::string>& data_sets, std::uint32_t group_seed,
                      const std::filesystem::path& folder);

/// The seed of the group whose records write_group_data made in this folder; nothing where there are none.
std::optional<std::uint32_t> group_seed_of(const std::filesystem::path& data_folder);

}  // namespace dynlab::inline workflow
