#pragma once
#include <string>

#include "base/reader.h"
#include "scripting/objects/model.h"

namespace dynlab::inline scripting {

/// What present(G) prints: transfer function, parameters with standard errors, gain, poles with damping and time
/// constant, and for an estimate its fit, noise and message.
std::string presentation(const Model& model, const Reader& reader);

/// The transfer function, or one after the other those from several inputs.
std::string channels_text(const Model& model, const Reader& reader);

}  // namespace dynlab::inline scripting
