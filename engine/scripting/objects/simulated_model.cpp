#include "scripting/objects/simulated_model.h"

#include <algorithm>

#include "scripting/conversions/localized.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/objects/fit_model.h"
#include "scripting/objects/grey_object.h"

namespace dynlab::inline scripting {
namespace {

const SimulatedModel& simulated_self(Call& call) {
    return object_argument<SimulatedModel>(call, 1, "G");
}

int report_of_simulated(Call& call) {
    push_report(call, *simulated_self(call).estimate);
    return 1;
}

std::string equations_text(const SimulatedModel& model) {
    return fmt::format("{}", fmt::join(model.equations, "\n"));
}

/// With what speaks against them: equations look like a law.
int text_of_simulated(Call& call) {
    const SimulatedModel& model = simulated_self(call);
    std::string text = equations_text(model);
    for (const Message& warning : model.estimate->all_warnings()) text += "\n" + localized(call, warning);
    lua_pushlstring(call.state(), text.data(), text.size());
    return 1;
}

constexpr std::array kSimulatedFields = {
    Member{"param", field<SimulatedModel, [](const SimulatedModel& model) { return model.estimate->theta; }>},
    Member{"std", field<SimulatedModel, [](const SimulatedModel& model) { return model.estimate->std(); }>},
    Member{"covariance",
           field<SimulatedModel, [](const SimulatedModel& model) { return model.estimate->covariance(); }>},
    Member{"names", field<SimulatedModel, [](const SimulatedModel& model) { return model.estimate->names; }>},
    Member{"equations", field<SimulatedModel, &SimulatedModel::equations>},
    Member{"report", guarded<report_of_simulated>},
};
constexpr std::array kSimulatedOperators = {Member{"__tostring", guarded<text_of_simulated>}};

constexpr std::array kSimulatedTypes = {
    TypeEntry{&Userdata<SimulatedModel>::type, kSimulatedFields, {}, kSimulatedOperators}};

}  // namespace

TypeEntries simulated_types() {
    return kSimulatedTypes;
}

std::size_t Userdata<SimulatedModel>::outside_bytes(const SimulatedModel& model) {
    const Estimate& estimate = *model.estimate;
    const auto numbers = static_cast<std::size_t>(estimate.theta.size() + estimate.covariance().size());
    return (numbers + estimate.report().values()) * sizeof(double);
}

const SimulatedModel* simulated_model(const Call& call, int index) {
    return index <= call.count() ? to_object<SimulatedModel>(call.state(), index) : nullptr;
}

bool runs_freely(const Call& call, int index) {
    return simulated_model(call, index) != nullptr || to_grey_box(call, index) != nullptr;
}

std::string method_of_model(const Call& call, int index) {
    if (const SimulatedModel* model = simulated_model(call, index)) return model->estimate->method;
    if (to_grey_box(call, index) != nullptr) return "greyest";
    const Model* model = to_object<Model>(call.state(), index);
    return model != nullptr && model->estimate ? model->estimate->method : "";
}

std::string presentation(const SimulatedModel& model, const Reader& reader) {
    const Estimate& estimate = *model.estimate;
    std::string text = equations_text(model) + "\n";
    std::size_t widest = 5;
    for (const std::string& name : estimate.names) widest = std::max(widest, name.size());
    if (!estimate.names.empty()) text += message_text(Message("Parameters:"), reader) + "\n";
    for (std::size_t i = 0; i < estimate.names.size(); ++i) {
        const auto index = static_cast<Index>(i);
        text += fmt::format("  {:<{}} {:>12}", estimate.names[i], widest,
                            number_text(significant(estimate.theta[index], 6), reader));
        if (estimate.std().size() > index) text += "  ± " + number_text(significant(estimate.std()[index], 3), reader);
        text += '\n';
    }
    return text + message_text(Message("Estimated by {}.", estimate.method), reader) + "\n" +
           message_text(estimate.message, reader) + "\n";
}

}  // namespace dynlab::inline scripting
