#pragma once
#include <memory>
#include <string>
#include <vector>

#include "numerics/models/free_run.h"
#include "scripting/objects/model.h"

namespace dynlab::inline scripting {

/// A model that is simulated and is no transfer function: narx, sindy, equations of physics.
struct SimulatedModel {
    std::shared_ptr<const FreeRunModel> run;
    std::shared_ptr<const Estimate> estimate;
    std::vector<std::string> equations;  ///< a line each, as print shows them
};

template <>
struct Userdata<SimulatedModel> {
    static constexpr ObjectType type{"simulated model"};
    static std::size_t outside_bytes(const SimulatedModel& model);
};

TypeEntries simulated_types();

/// The object of an argument, nullptr for anything else.
const SimulatedModel* simulated_model(const Call& call, int index);
/// Whether the model's free run is simulated by its own equations, as for a grey-box model.
bool runs_freely(const Call& call, int index);
/// Name of the method that gave the model of an argument; empty for a model that was written down.
std::string method_of_model(const Call& call, int index);

/// What present(G) prints: equations, parameters with their standard errors where they have any, fit and message.
std::string presentation(const SimulatedModel& model, const Reader& reader);

}  // namespace dynlab::inline scripting
