#include "numerics/models/free_run.h"

#include "numerics/error.h"

namespace dynlab::inline numerics {

void check_channels(const std::string& model, const FreeRunModel& requested, const IdData& data) {
    const bool outputs_fit = data.output_count() == 0 || data.output_count() == requested.output_count();
    if (data.input_count() == requested.input_count() && outputs_fit) return;
    throw InvalidArgument("{}: the model has {} and {}, but the data have {} and {}: select the channels of the model",
                          model, plural(requested.input_count(), "{} input", "{} inputs"),
                          plural(requested.output_count(), "{} output", "{} outputs"), data.input_count(),
                          data.output_count());
}

Message divergence_text(const IdData& data, std::size_t experiment, Index sample) {
    return Message("The simulation diverges at t = {} {}.", data.time(experiment)[sample], data.time_unit);
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
