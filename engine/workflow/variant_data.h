#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "numerics/plants/plant_catalog.h"

namespace dynlab::inline workflow {

/// Writes NAME.mat into `folder`: the data of the data set's simulated plant, rounded to seven significant digits like
/// the stored data. Throws InvalidArgument for a data set that no simulated plant creates, EnvironmentError if the file
/// cannot be written.
void write_variant_data(const std::string& data_set, const PlantChoice& choice, const std::filesystem::path& folder);

/// Creates `folder`/NAME with SOURCE.md and the data for each of the data sets, as a group finds its own data: plant
/// variant and noise follow from the group's seed, which SOURCE.md states.
void write_group_data(const std::vector<std::string>& data_sets, std::uint32_t group_seed,
                      const std::filesystem::path& folder);

/// The seed of the group whose data write_group_data created in this folder; nothing if there are none.
std::optional<std::uint32_t> group_seed_of(const std::filesystem::path& data_folder);

}  // namespace dynlab::inline workflow
