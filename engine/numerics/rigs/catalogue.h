#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "numerics/models/transfer_function.h"

namespace dynlab::inline numerics {

/// What an experiment leaves, or what theory says of it: values by name, in the order in which they are told. Parts
/// such as one experiment of several are values of their own.
struct RigValue;
using RigValues = std::vector<RigValue>;
struct RigValue {
    std::string name;
    std::variant<double, Vector, TransferFunction, RigValues> value;
};

struct RigSignal {
    std::string name;
    std::string unit;  ///< empty for numbers without one
};

/// Which record is wanted; the default is the stored one.
struct RigChoice {
    std::uint32_t specimen = 0;  ///< of the apparatus (specimen.h); 0 is the one that the rig's header describes
    std::uint32_t seed = 1;      ///< of noise and of random inputs
};

/// One of the course's simulated experiments, whose stored record is the data set of the same name.
struct Rig {
    std::string name;                      ///< of the data set
    std::string title;                     ///< of the records, a few words
    std::vector<RigSignal> signals;        ///< of the record, or of each of its experiments; instants come first
    std::vector<std::string> experiments;  ///< their names; empty where the signals are the record itself
    double Ts = 0;                         ///< of its records, s

    /// The record, N values for each signal: equal choices give equal records on every machine.
    RigValues (*record)(const RigChoice& choice) = nullptr;
    /// What theory says of the specimen, without noise.
    RigValues (*truth)(std::uint32_t specimen) = nullptr;
};

/// The table of rigs, sorted by name.
std::span<const Rig> rig_catalogue();

/// The rig of that name; nothing where there is none.
const Rig* find_rig(std::string_view name);

}  // namespace dynlab::inline numerics
