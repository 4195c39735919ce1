#pragma once
#include <string>
#include <vector>

#include "numerics/models/transfer_function.h"

namespace dynlab {

/// A model with the name that the legend shows (no entry when empty).
struct NamedModel {
    std::string name;
    TransferFunction G;
};

}  // namespace dynlab
