#pragma once
#include <nlohmann/json.hpp>

#include "numerics/signals/iddata.h"
#include "scripting/objects/model.h"

namespace dynlab::inline scripting {

/// JSON of what answers are made of, and back. Reading throws InvalidArgument for anything that does not fit together,
/// as its text may come from anybody.
nlohmann::json json_of_number(double value);
double number_of_json(const nlohmann::json& j);
nlohmann::json json_of_matrix(const MatrixView& m);
Matrix matrix_of_json(const nlohmann::json& j);
nlohmann::json json_of_data(const IdData& data);
IdData data_of_json(const nlohmann::json& j);
nlohmann::json json_of_system(const StateSpace& system);
StateSpace system_of_json(const nlohmann::json& j);
nlohmann::json json_of_model(const Model& model);
Model model_of_json(const nlohmann::json& j);

}  // namespace dynlab::inline scripting
