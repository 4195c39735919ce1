#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "numerics/models/transfer_function.h"

namespace dynlab::inline numerics {

/// Results of an experiment, or their theoretical values: values by name, in the order in which they are documented.
/// Parts of a data set, such as one of several experiments, are nested values.
struct PlantValue;
using PlantValues = std::vector<PlantValue>;
struct PlantValue {
    std::string name;
    std::variant<double, Vector, TransferFunction, PlantValues> value;
};

struct PlantSignal {
    std::string name;
    std::string unit;  ///< empty for numbers without one
};

/// Selects a data set. Default: the stored data set.
struct PlantChoice {
    std::uint32_t variant_number =
        0;                   ///< plant variant (plant_variant.h); 0: the parameters in the header of the plant
    std::uint32_t seed = 1;  ///< of noise and of random inputs
};

/// One of the course's simulated plants. Its stored data set has the same name.
struct Plant {
    std::string name;                      ///< of the data set
    std::string title;                     ///< of the data sets, a few words
    std::vector<PlantSignal> signals;      ///< of the data set, or of each of its experiments; instants come first
    std::vector<std::string> experiments;  ///< their names; empty if the data set has no nested experiments
    double Ts = 0;                         ///< of its data sets, s

    /// Returns the data set, N values for each signal. Equal choices give equal data on every machine.
    PlantValues (*simulated_data)(const PlantChoice& choice) = nullptr;
    /// True parameters of the plant variant, without noise.
    PlantValues (*truth)(std::uint32_t variant_number) = nullptr;
};

/// The table of plants, sorted by name.
std::span<const Plant> plant_catalog();

/// The simulated plant with this name; nullptr if there is none.
const Plant* find_plant(std::string_view name);

}  // namespace dynlab::inline numerics
