#include "numerics/fit/simulation_error.h"

#include "numerics/filters/normal_equations.h"

namespace dynlab::inline numerics {

double simulation_squares(const IdData& data, const TransferStructure& structure, const VectorView& theta,
                          Index output) {
    const auto view = [](const auto& column) { return SampleView(column.data(), column.size()); };
    double squares = 0;
    for (const Experiment& experiment : data.experiments) {
        RegressionRecord record{view(experiment.y.col(output)), {},        {},        {},
                                {data.Ts, view(experiment.t)},  data.hold, Hold::kFoh};
        std::vector<Vector> A, B;
        for (Index input = 0; input < structure.inputs; ++input) {
            record.u.push_back(view(experiment.u.col(input)));
            record.delays.push_back(structure.delay(theta, output, input));
            A.push_back(structure.denominator(theta, output, input));
            B.push_back(structure.numerator(theta, output, input));
        }
        squares += output_error_squares(record, A, B);
    }
    return squares;
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
        const double squares = simulation_squares(data, structure, fit.theta, output);
        fit.fit_percent[output] = fit_percent_of_sums(squares, variations[output]);
        fit.noise_variance[output] = squares / (N - d);
        fit.loss += squares / N / outputs;
    }
}

}  // namespace dynlab::inline numerics
