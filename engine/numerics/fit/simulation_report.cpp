#include "numerics/fit/simulation_report.h"

#include <algorithm>
#include <cmath>

#include "numerics/error.h"
#include "numerics/number_text.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kSamplesPerParameter = 3;
constexpr double kBadCondition = 1e10;
constexpr double kCancellation = 0.02;  // distance of a pole from a zero, relative to the pole

std::string numbered(const char* what, Index place, Index count) {
    return count == 1 ? std::string("the ") + what : std::string(what) + " " + std::to_string(place + 1);
}

bool constant(const Eigen::Ref<const Vector>& x) {
    return (x.array() == x[0]).all();
}

/// A constant input is a step from zero at the first sample, when the output begins there as well.
bool starts_from_rest(const Eigen::Ref<const Vector>& y) {
    return std::abs(y[0]) < 0.5 * y.cwiseAbs().maxCoeff();
}

void check_input(const std::string& caller, const IdData& data, Index input) {
    const auto all = [&](const auto& holds) {
        return std::all_of(data.experiments.begin(), data.experiments.end(), holds);
    };
    const std::string name = numbered("input", input, data.input_count());
    if (all([&](const Experiment& e) { return e.u.col(input).isZero(0); }))
        throw InvalidArgument(caller + name + " is zero throughout, so it excites nothing and nothing can be learnt");
    if (all([&](const Experiment& e) { return constant(e.u.col(input)) && !starts_from_rest(e.y.col(0)); }))
        throw InvalidArgument(caller + name +
                              " never changes and the output does not start from rest, so there is no excitation to "
                              "learn from: let the input vary, for instance as a prbs");
}

void warn_of_cancellation(TransferEstimate& estimate) {
    for (const TransferFunction& G : estimate.models) {
        const ComplexVector poles = G.poles(), zeros = G.zeros();
        for (const Complex& zero : zeros)
            for (const Complex& pole : poles)
                if (std::abs(zero - pole) < kCancellation * std::abs(pole)) {
                    estimate.warnings.push_back("A pole near " + number_text(pole.real(), 3) +
                                                " and a zero nearly cancel: fewer poles and zeros may be enough.");
                    return;
                }
    }
}

void warn_of_undetermined(TransferEstimate& estimate) {
    std::string names;
    for (Index i = 0; i < estimate.theta.size(); ++i) {
        const std::string& name = estimate.names[static_cast<std::size_t>(i)];
        if (estimate.std[i] > std::abs(estimate.theta[i]) && name.rfind("Td", 0) != 0)
            names += (names.empty() ? "" : ", ") + name;
    }
    if (!names.empty())
        estimate.warnings.push_back("The data hardly determine " + names +
                                    ": the standard error is larger than the value.");
}

void warn_of_instability(TransferEstimate& estimate) {
    for (std::size_t i = 0; i < estimate.models.size(); ++i) {
        const ComplexVector poles = estimate.models[i].poles();
        if ((poles.real().array() > 1e-9 * poles.cwiseAbs().maxCoeff()).any())
            estimate.warnings.push_back("The model" + channel_text(estimate, i) + " is unstable.");
    }
}

}  // namespace

std::string channel_text(const TransferEstimate& estimate, std::size_t channel) {
    if (estimate.models.size() == 1) return "";
    const std::size_t inputs = static_cast<std::size_t>(estimate.structure.inputs);
    return " from input " + std::to_string(channel % inputs + 1) + " to output " + std::to_string(channel / inputs + 1);
}

void check_transfer_data(const char* method, const IdData& data, const TransferStructure& structure) {
    const std::string caller = std::string(method) + ": ";
    structure.validate();
    if (data.input_count() == 0) throw InvalidArgument(caller + "the data have no input");
    if (data.input_count() != structure.inputs || data.output_count() != structure.outputs)
        throw InvalidArgument(caller + "the model has " + std::to_string(structure.inputs) + " input(s) and " +
                              std::to_string(structure.outputs) + " output(s), and the data have " +
                              std::to_string(data.input_count()) + " and " + std::to_string(data.output_count()));
    const Index wanted = kSamplesPerParameter * structure.parameter_count();
    if (data.sample_count() < wanted)
        throw InvalidArgument(caller + "at least " + std::to_string(wanted) + " samples are needed for " +
                              std::to_string(structure.parameter_count()) + " parameters, and the data hold " +
                              std::to_string(data.sample_count()));
    for (const TransferChannel& channel : structure.channels)
        for (std::size_t e = 0; e < data.experiments.size(); ++e) {
            const double length = data.duration(e);
            if (channel.delay >= length)
                throw InvalidArgument(caller + "the delay of " + number_text(channel.delay) +
                                      " s is not shorter than the record of " + number_text(length) + " s");
        }
    for (Index input = 0; input < data.input_count(); ++input) check_input(caller, data, input);
    for (Index output = 0; output < data.output_count(); ++output)
        if (std::all_of(data.experiments.begin(), data.experiments.end(),
                        [&](const Experiment& e) { return constant(e.y.col(output)); }))
            throw InvalidArgument(caller + numbered("output", output, data.output_count()) +
                                  " never changes, so nothing can be learnt");
}

void check_transient(const char* method, const IdData& data, const TransferEstimate& estimate) {
    if (estimate.termination == Termination::kCancelled) return;
    const Index outputs = data.output_count(), N = data.sample_count() * outputs;
    StepFit fit{estimate.loss, 0, 0, N, estimate.theta.size(), 0};
    for (const Experiment& experiment : data.experiments) {
        for (Index input = 0; input < data.input_count(); ++input)
            if (!constant(experiment.u.col(input))) return;
        for (Index output = 0; output < outputs; ++output) {
            const auto y = experiment.y.col(output).array();
            fit.spread += (y - y.mean()).square().sum() / static_cast<double>(N);
            fit.output_power += y.square().sum() / static_cast<double>(N);
        }
        fit.experiments += outputs;
        if (estimate.start.offset) fit.parameters += outputs;
    }
    for (const Vector& values : estimate.initial_values) fit.parameters += values.size();
    require_transient(method, fit);
}

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

void measure_fit(TransferEstimate& estimate, const IdData& data) {
    const TransferStructure& structure = estimate.structure;
    estimate.offsets = Matrix::Zero(static_cast<Index>(data.experiments.size()), structure.outputs);
    const double N = static_cast<double>(data.sample_count());
    estimate.fit_percent.resize(structure.outputs);
    estimate.noise_variance.resize(structure.outputs);
    estimate.loss = 0;
    // Parameters of a common denominator are shared out evenly among the outputs they bear on.
    const double d = static_cast<double>(structure.parameter_count()) / static_cast<double>(structure.outputs);
    for (Index output = 0; output < structure.outputs; ++output) {
        const double squares = simulation_squares(data, structure, estimate.theta, output);
        double spread = 0;
        for (const Experiment& experiment : data.experiments)
            spread += (experiment.y.col(output).array() - experiment.y.col(output).mean()).square().sum();
        estimate.fit_percent[output] = 100 * (1 - std::sqrt(squares / spread));
        estimate.noise_variance[output] = squares / (N - d);
        estimate.loss += squares / N / static_cast<double>(structure.outputs);
    }
}

void report_errors(TransferEstimate& estimate) {
    estimate.names = estimate.structure.parameter_names();
    estimate.models = estimate.structure.models(estimate.theta);
    estimate.std = estimate.covariance.diagonal().cwiseMax(0).cwiseSqrt();
    warn_of_cancellation(estimate);
    warn_of_undetermined(estimate);
    if (!(estimate.condition_number < kBadCondition))
        estimate.warnings.push_back(
            "The equations are badly conditioned: the input excites the system poorly for this many parameters.");
    warn_of_instability(estimate);
}

void set_message(TransferEstimate& estimate, const std::string& first) {
    std::string fits;
    for (Index output = 0; output < estimate.fit_percent.size(); ++output)
        fits += (output == 0 ? ": fit " : " % and ") + number_text(estimate.fit_percent[output], 4);
    estimate.message = first + (fits.empty() ? "." : fits + " % (simulation).");
    for (const std::string& warning : estimate.warnings) estimate.message += " " + warning;
}

}  // namespace dynlab::inline numerics
