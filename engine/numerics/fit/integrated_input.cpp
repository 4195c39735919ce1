#include "numerics/fit/integrated_input.h"

#include "numerics/error.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/models/polynomial_model.h"

namespace dynlab::inline numerics {

IdData integrated_inputs(const IdData& data) {
    if (data.hold != Hold::kZoh)
        throw InvalidArgument("{} needs an input with zero-order hold (zoh), because it integrates the input exactly",
                              OptionName{"integration"});
    IdData integrated = data;
    integrated.hold = Hold::kFoh;
    for (std::size_t e = 0; e < data.experiments.size(); ++e) {
        const Matrix& u = data.experiments[e].u;
        const Vector t = data.regular() ? Vector() : data.time(e);
        Matrix& sum = integrated.experiments[e].u;
        sum.setZero();
        for (Index k = 1; k < u.rows(); ++k)
            sum.row(k) = sum.row(k - 1) + (data.regular() ? data.Ts : t[k] - t[k - 1]) * u.row(k - 1);
    }
    return integrated;
}

IdData summed_inputs(const IdData& data) {
    IdData summed = data;
    for (Experiment& experiment : summed.experiments)
        for (Index k = 1; k < experiment.u.rows(); ++k) experiment.u.row(k) += experiment.u.row(k - 1);
    return summed;
}

FitOptions options_with_integrator(FitOptions options) {
    if (options.offset == Offset::kRemove)
        throw InvalidArgument(
            "{} = \"remove\" cannot be combined with {}, because an integrator has no operating point. Use "
            "\"estimate\", which adds a constant to the output",
            OptionName{"offset"}, OptionName{"integration"});
    if (options.initial_state == InitialState::kEstimate) options.offset = Offset::kEstimate;
    if (options.initial_state == InitialState::kAuto && options.offset == Offset::kNone) options.offset = Offset::kAuto;
    return options;
}

void append_integrator(Fit& fit) {
    const TransferFunction integrator(Vector::Ones(1), Vector::Unit(2, 0));
    for (TransferFunction& G : fit.models) G = G * integrator;
    if (!fit.polynomial) return;
    PolynomialModel model = *fit.polynomial;
    for (Vector& F : model.F) F = multiply(F, Eigen::Vector2d(1, -1));
    fit.polynomial = std::make_shared<PolynomialModel>(std::move(model));
}

}  // namespace dynlab::inline numerics
