#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "numerics/plants/plant_catalog.h"

namespace dynlab::inline workflow {

/// Writes NAME.mat into `folder`: the record of the data set's rig, rounded to seven significant digits as the stored
/// ones are. Throws InvalidArgument for a data set that no rig makes, EnvironmentError where the file cannot be
/// written.
void write_variant_data(const std::string& data_set, const PlantChoice& choice, const std::filesystem::path& folder);

/// Makes `folder`/NAME with SOURCE.md and such a record for each of the data sets, as a group finds its own data:
/// specimen and noise are the group's seed's, which SOURCE.md tells.
void write_group_data(const std::vector<std::string>& data_sets, std::uint32_t group_seed,
                      const std::filesystem::path& folder);

/// The seed of the group whose records write_group_data made in this folder; nothing where there are none.
std::optional<std::uint32_t> group_seed_of(const std::filesystem::path& data_folder);

}  // namespace dynlab::inline workflow
