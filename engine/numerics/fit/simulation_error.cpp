#include "numerics/fit/simulation_error.h"

#include <cmath>

#include "numerics/criteria/denominator_group.h"

namespace dynlab::inline numerics {

double simulation_loss(const IdData& data, const TransferStructure& structure, const VectorView& theta) {
    if (!theta.allFinite()) return kInfinity;
    double squares = 0;
    for (Index output = 0; output < structure.outputs; ++output)
        squares += simulation_squares(data, structure, theta, output);
    const double loss = squares / static_cast<double>(data.sample_count() * structure.outputs);
    return std::isfinite(loss) ? loss : kInfinity;
}

void measure_simulation(Fit& fit, const IdData& data) {
    const TransferStructure& structure = fit.structure;
    const double N = static_cast<double>(data.sample_count()), outputs = static_cast<double>(structure.outputs);
    fit.offsets = Matrix::Zero(static_cast<Index>(data.experiments.size()), structure.outputs);
    fit.fit_percent.resize(structure.outputs);
    fit.noise_variance.resize(structure.outputs);
    fit.loss = 0;
    // Parameters of a common denominator are shared out evenly among the outputs they bear on.
    const double d = static_cast<double>(structure.parameter_count()) / outputs;
    const Vector variations = output_variations(data);
    for (Index output = 0; output < structure.outputs; ++output) {
        const double sum = simulation_squares(data, structure, fit.theta, output);
        const double squares = std::isfinite(sum) ? sum : kInfinity;
        fit.fit_percent[output] = fit_percent_of_sums(squares, variations[output]);
        fit.noise_variance[output] = squares / (N - d);
        fit.loss += squares / N / outputs;
    }
    if (std::isfinite(fit.loss)) return;
    fit.warnings.push_back("The simulation of the model grows beyond all bounds over the record: it has no fit.");
    fit.message += " " + fit.warnings.back();
}

}  // namespace dynlab::inline numerics
