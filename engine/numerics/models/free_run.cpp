#include "numerics/models/free_run.h"

#include "base/number_text.h"
#include "numerics/error.h"

namespace dynlab::inline numerics {

void check_channels(const std::string& model, const FreeRunModel& wanted, const IdData& data) {
    const bool outputs_fit = data.output_count() == 0 || data.output_count() == wanted.output_count();
    if (data.input_count() == wanted.input_count() && outputs_fit) return;
    throw InvalidArgument(model + ": the model has " + counted(wanted.input_count(), "input") + " and " +
                          counted(wanted.output_count(), "output") + ", and the data hold " +
                          std::to_string(data.input_count()) + " and " + std::to_string(data.output_count()) +
                          ": select the channels it describes");
}

std::string divergence_text(const IdData& data, std::size_t experiment, Index sample) {
    return "The free run leaves all bounds at t = " + number_text(data.time(experiment)[sample], 5) + " " +
           data.time_unit + ".";
}

IdData inputs_alone(const MatrixView& u, double Ts, Hold hold) {
    IdData data;
    data.Ts = Ts;
    data.hold = hold;
    Experiment& experiment = data.experiments.emplace_back();
    experiment.u = u;
    experiment.y = Matrix(u.rows(), 0);
    return data;
}

}  // namespace dynlab::inline numerics
