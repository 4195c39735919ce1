#pragma once
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "numerics/fit/fit.h"
#include "scripting/conversions/arguments.h"

namespace dynlab::inline scripting {

/// An estimation as a script asked for it, its arguments checked: ready for any data, in any thread.
using Estimation = std::function<Fit(const IdData&)>;

/// Reads the arguments of one method from the second on; the first, where the data stand, is not looked at.
using EstimationReader = Estimation (*)(const Call& call);

/// The readers of a file of bindings, by the methods' Lua names.
using NamedReader = std::pair<const char*, EstimationReader>;
using EstimationReaders = std::span<const NamedReader>;

}  // namespace dynlab::inline scripting
