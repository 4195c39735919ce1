#include "numerics/fit/assessment.h"

#include <cmath>
#include <span>
#include <utility>

#include "numerics/criteria/process_output.h"
#include "numerics/error.h"
#include "numerics/filters/transfer_sensitivity.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/discrete/discrete_fit.h"
#include "numerics/fit/discrete/prediction_model.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/simulation/time_response.h"
#include "numerics/statistics/robust_covariance.h"

namespace dynlab::inline numerics {

namespace {

// One output of one experiment.
struct AssessedData {
    Matrix u;
    Vector y, t;
    double Ts;
    Hold hold;
};

// Response to u and its derivatives with respect to [a_1..a_n b_0..b_m delay].
Matrix driven_sensitivities(const AssessedData& data_set, const TransferFunction& G, const VectorView& u) {
    return data_set.Ts > 0 ? transfer_sensitivities(G.num(), G.den(), G.delay(), u, data_set.Ts, data_set.hold)
                           : transfer_sensitivities(G.num(), G.den(), G.delay(), u, data_set.t, data_set.hold);
}

// The same for a system at rest at the first input value before the first sample; a model with an integrator has no
// such rest and starts from zero input.
Matrix channel_sensitivities(const AssessedData& data_set, const TransferFunction& G, Index input, InitialState state) {
    const double gain = G.dc_gain();
    const double resting = state == InitialState::kZero || !std::isfinite(gain) ? 0 : data_set.u(0, input);
    Matrix columns = driven_sensitivities(data_set, G, data_set.u.col(input).array() - resting);
    if (resting == 0) return columns;
    const Index n = G.pole_count(), m = G.zero_count();
    const double a_n = G.den()[n];
    columns.col(0).array() += gain * resting;
    columns.col(n).array() -= gain / a_n * resting;
    columns.col(n + 1 + m).array() += resting / a_n;
    return columns;
}

// The free motions of 1/A: the impulse responses of s^i/A, i = 0 .. n-1.
Matrix free_motions(const AssessedData& data_set, const Vector& den) {
    const Index n = den.size() - 1;
    const Vector since_start = data_set.t.array() - data_set.t[0];
    Matrix motions(data_set.y.size(), n);
    for (Index i = 0; i < n; ++i)
        motions.col(i) = impulse_response(TransferFunction(Vector::Unit(i + 1, 0), den), since_start).y;
    return motions;
}

// Derivatives with respect to a_1..a_n of the free motion P/A, P = sum weights_i s^i: the impulse responses of
// -s^(n-i) P/A^2.
Matrix free_sensitivities_of(const AssessedData& data_set, const Vector& den, const Vector& weights) {
    const Index n = den.size() - 1;
    const Vector since_start = data_set.t.array() - data_set.t[0], square = multiply(den, den);
    Matrix columns(data_set.y.size(), n);
    for (Index i = 1; i <= n; ++i) {
        const Vector num = multiply(-weights.reverse(), Vector::Unit(n - i + 1, 0));
        columns.col(i - 1) = impulse_response(TransferFunction(num, square), since_start).y;
    }
    return columns;
}

// Where the derivatives of one channel go among the parameters.
struct ChannelPlaces {
    TransferFunction G;
    Index denominator = 0;  // channels with the same number share theirs
    Index a = 0, b = 0, delay = -1;
};

struct Linearized {
    Matrix Psi;  // N x d, without what the linear unknowns can do
    Vector errors;
    Index linear_unknowns = 0;
};

// The distinct denominators of an output's channels: one channel for each.
std::vector<const ChannelPlaces*> free_systems(std::span<const ChannelPlaces> channels) {
    std::vector<const ChannelPlaces*> systems;
    for (const ChannelPlaces& channel : channels) {
        bool known = false;
        for (const ChannelPlaces* other : systems) known = known || other->denominator == channel.denominator;
        if (!known) systems.push_back(&channel);
    }
    return systems;
}

Linearized linearize(const AssessedData& data_set, std::span<const ChannelPlaces> channels, const StartCondition& start,
                     Index parameters) {
    const Index N = data_set.y.size();
    Linearized result{Matrix::Zero(N, parameters), data_set.y, 0};
    for (std::size_t j = 0; j < channels.size(); ++j) {
        const ChannelPlaces& channel = channels[j];
        const Index n = channel.G.pole_count(), b_count = channel.G.num().size();
        const Matrix columns = channel_sensitivities(data_set, channel.G, static_cast<Index>(j), start.state);
        result.errors -= columns.col(0);
        result.Psi.middleCols(channel.a, n) += columns.middleCols(1, n);
        result.Psi.middleCols(channel.b, b_count) += columns.middleCols(1 + n, b_count);
        if (channel.delay >= 0) result.Psi.col(channel.delay) = columns.rightCols(1);
    }
    Matrix linear(N, 0);
    const auto systems = free_systems(channels);
    if (start.state == InitialState::kEstimate)
        for (const ChannelPlaces* system : systems) {
            const Index n = system->G.pole_count();
            linear.conservativeResize(N, linear.cols() + n);
            linear.rightCols(n) = free_motions(data_set, system->G.den());
        }
    if (start.offset) {
        linear.conservativeResize(N, linear.cols() + 1);
        linear.rightCols(1).setOnes();
    }
    result.linear_unknowns = linear.cols();
    if (linear.cols() == 0) return result;
    const LeastSquares fit = solve_least_squares(linear, result.errors);
    result.errors = fit.residuals;
    Index place = 0;
    if (start.state == InitialState::kEstimate)
        for (const ChannelPlaces* system : systems) {
            const Index n = system->G.pole_count();
            result.Psi.middleCols(system->a, n) +=
                free_sensitivities_of(data_set, system->G.den(), fit.solution.segment(place, n));
            place += n;
        }
    for (Index i = 0; i < parameters; ++i) result.Psi.col(i) = solve_least_squares(linear, result.Psi.col(i)).residuals;
    return result;
}

// Why standard errors of the model mean little, however they are worked out; empty where they do not.
Message worthlessness(const Fit& fit) {
    if (std::any_of(fit.models.begin(), fit.models.end(), has_unstable_pole))
        return Message("The standard errors are unreliable, because the model is unstable.");
    for (const double percent : fit.fit_percent)
        if (explains_little(percent))
            return Message("The standard errors are unreliable, because the model explains little of the output.");
    return Message();
}

Message residual_summary(const Assessment& assessment, const Fit& fit, const IdData& data) {
    constexpr Index kFewSamples = 100;  // correlated errors: the intervals of 95 % hold 86 to 91 % up to here
    const std::vector<std::string>& names = data.output_names;
    std::vector<Message> all;
    for (std::size_t i = 0; i < assessment.whiteness.size(); ++i) {
        const WhitenessTest& test = assessment.whiteness[i];
        if (test.verdict.empty()) continue;
        all.push_back(assessment.whiteness.size() > 1 ? Message("{}: {}", names[i], test.verdict) : test.verdict);
    }
    const Message worthless = fit.polynomial ? Message() : worthlessness(fit);
    if (!worthless.empty())
        all.push_back(worthless);
    else if (!assessment.white)
        all.push_back(data.sample_count() < kFewSamples
                          ? Message("Use the robust standard errors as a lower bound: {} samples are too few to "
                                    "estimate the correlation of the errors.",
                                    data.sample_count())
                          : Message("Use the robust standard errors."));
    return sentences(std::move(all));
}

// Robust covariance and standard errors, with the whiteness known. Psi and errors hold one block for each output.
void finish(Assessment& assessment, const Matrix& Psi, const Vector& errors, const std::vector<Index>& lengths,
            Index outputs, const MatrixView& plain, Index linear_unknowns) {
    const Index N = Psi.rows(), q = Psi.cols();
    std::vector<Index> free;
    for (Index i = 0; i < q; ++i)
        if (plain(i, i) > 0) free.push_back(i);
    const auto known = static_cast<Index>(free.size()) + linear_unknowns;
    assessment.covariance = Matrix::Zero(q, q);
    if (!free.empty() && N > known) {
        const RobustCovariance robust = robust_covariance(Psi(Eigen::all, free), errors, lengths, outputs);
        const double freedom =
            static_cast<double>(N - static_cast<Index>(free.size())) / static_cast<double>(N - known);
        assessment.covariance(free, free) = freedom * robust.covariance;
        assessment.bandwidth = robust.bandwidth;
    }
    assessment.std = assessment.covariance.diagonal().cwiseSqrt();
}

// One output's rows, weighted as the fit weighted them: as was asked for, or with one over the size of the errors.
void weigh(Eigen::Ref<Matrix> Psi, Eigen::Ref<Vector> errors, const Fit& fit, Index output) {
    const double size = errors.norm();
    if (fit.output_weights.size() == 0 && size == 0) return;
    const double weight = fit.output_weights.size() > 0 ? fit.output_weights[output] : 1 / size;
    Psi *= weight;
    errors *= weight;
}

// `by_parameter` (columns of Psi x q) leads from the channels' coefficients to the parameters of the estimate.
Assessment assess_channels(const IdData& data, const std::vector<ChannelPlaces>& channels, const Fit& fit,
                           const MatrixView& by_parameter, const ResidualOptions& options) {
    const Index ny = data.output_count(), nu = data.input_count(), q = by_parameter.cols();
    if (static_cast<Index>(channels.size()) != ny * nu)
        throw InvalidArgument("The estimate has {}, but the data have {} and {}",
                              plural(static_cast<std::int64_t>(channels.size()), "{} channel", "{} channels"),
                              plural(ny, "{} output", "{} outputs"), plural(nu, "{} input", "{} inputs"));
    const Index N = data.sample_count();
    Matrix Psi(N * ny, q);
    Vector errors(N * ny);
    std::vector<Index> lengths;
    for (std::size_t k = 0; k < data.experiments.size(); ++k) lengths.push_back(data.sample_count(k));
    Assessment assessment;
    Index first = 0, linear_unknowns = 0;
    for (Index i = 0; i < ny; ++i) {
        std::vector<Vector> own_errors;
        for (std::size_t k = 0; k < data.experiments.size(); ++k) {
            const Experiment& experiment = data.experiments[k];
            const AssessedData data_set{experiment.u, experiment.y.col(i), data.time(k), data.Ts, data.hold};
            const std::span<const ChannelPlaces> own(channels.data() + i * nu, static_cast<std::size_t>(nu));
            const Linearized part = linearize(data_set, own, fit.start, by_parameter.rows());
            Psi.middleRows(first, lengths[k]) = part.Psi * by_parameter;
            errors.segment(first, lengths[k]) = part.errors;
            first += lengths[k];
            linear_unknowns += part.linear_unknowns;
            own_errors.push_back(part.errors);
        }
        weigh(Psi.middleRows(i * N, N), errors.segment(i * N, N), fit, i);
        assessment.whiteness.push_back(whiteness_test(own_errors, options));
        assessment.white = assessment.white && assessment.whiteness.back().white;
    }
    finish(assessment, Psi, errors, lengths, ny, fit.covariance, linear_unknowns);
    assessment.verdict = residual_summary(assessment, fit, data);
    return assessment;
}

/// The data as the estimator counted them.
IdData counted_data(const IdData& data, const Fit& fit) {
    IdData counted = data;
    if (fit.removed.empty()) return counted;
    if (fit.removed.size() != counted.experiments.size())
        throw InvalidArgument("The estimate comes from {}, but the data have {}",
                              plural(static_cast<std::int64_t>(fit.removed.size()), "{} experiment", "{} experiments"),
                              counted.experiments.size());
    for (std::size_t e = 0; e < fit.removed.size(); ++e) {
        const auto& points = fit.removed[e];
        counted.experiments[e].u.rowwise() -= points.front().inputs.transpose();
        for (std::size_t o = 0; o < points.size(); ++o)
            counted.experiments[e].y.col(static_cast<Index>(o)).array() -= points[o].output;
    }
    return counted;
}

Assessment assess_transfer(const IdData& data, const Fit& fit, const ResidualOptions& options) {
    const TransferStructure& structure = fit.structure;
    const std::vector<TransferFunction> models = structure.models(fit.theta);
    std::vector<ChannelPlaces> channels;
    for (Index i = 0; i < structure.outputs; ++i)
        for (Index j = 0; j < structure.inputs; ++j) {
            const Index denominator = structure.channel(i, j).denominator;
            channels.push_back({models[channels.size()], denominator, structure.denominator_start(denominator),
                                structure.numerator_start(i, j), structure.delay_index(i, j)});
        }
    const Index d = structure.parameter_count();
    return assess_channels(data, channels, fit, Matrix::Identity(d, d), options);
}

Assessment assess_process(const IdData& data, const Fit& fit, const ResidualOptions& options) {
    const TransferFunction G = fit.process->transfer_function();
    const Index n = G.pole_count(), b_count = G.num().size();
    const ChannelPlaces channel{G, 0, 0, n, fit.process->structure.delay ? n + b_count : -1};
    return assess_channels(data, {channel}, fit, coefficients_by_parameter(*fit.process), options);
}

Assessment assess_prediction(const IdData& data, const Fit& fit, const ResidualOptions& options) {
    check_polynomial_data("assess", data, *fit.orders);
    const std::vector<SampledExperiment> experiments = sampled_experiments(data);
    const PredictionModel model(*fit.orders, fit.start, experiments);
    const Index d = fit.theta.size(), linear_unknowns = model.linear_count();
    const Vector theta = model.completed(fit.theta);
    Vector output;
    Matrix sensitivities;
    model.simulate(theta, output, &sensitivities);
    if (!output.allFinite() || !sensitivities.allFinite())
        throw InvalidArgument(
            "The simulation of the model diverges, so the errors of the estimate cannot be assessed. Check the data "
            "and the structure");
    Matrix Psi = sensitivities.leftCols(d);
    const Matrix linear = sensitivities.rightCols(linear_unknowns);
    for (Index i = 0; i < d && linear_unknowns > 0; ++i) Psi.col(i) = solve_least_squares(linear, Psi.col(i)).residuals;
    const Vector errors = model.target() - output;
    Assessment assessment;
    std::vector<Vector> data_sets;
    const std::vector<Index> lengths = model.lengths();
    Index first = 0;
    for (const Index length : lengths) {
        data_sets.push_back(errors.segment(first, length));
        first += length;
    }
    assessment.whiteness = {whiteness_test(data_sets, options)};
    assessment.white = assessment.whiteness.front().white;
    finish(assessment, Psi, errors, lengths, 1, fit.covariance, linear_unknowns);
    assessment.verdict = residual_summary(assessment, fit, data);
    return assessment;
}

}  // namespace

Assessment assess(const IdData& data, const Fit& fit, const ResidualOptions& options) {
    const IdData counted = counted_data(data, fit);
    Assessment assessment = fit.polynomial ? assess_prediction(counted, fit, options)
                            : fit.process  ? assess_process(counted, fit, options)
                                           : assess_transfer(counted, fit, options);
    for (Index i = 0; i < std::min(fit.std.size(), assessment.std.size()); ++i)
        if (std::isinf(fit.std[i])) assessment.std[i] = kInfinity;  // what the data do not determine
    return assessment;
}

std::optional<Assessment> assess_if_affordable(const IdData& data, const Fit& fit) {
    if (fit.termination == Termination::kCanceled || fit.covariance.rows() != fit.theta.size()) return std::nullopt;
    if (!fit.process && data.sample_count() > kMaxAssessedSamples) return std::nullopt;
    if (fit.polynomial && !fit.covariance.allFinite()) return std::nullopt;
    try {
        return assess(data, fit);
    } catch (const InvalidArgument&) {
        return std::nullopt;  // its output is not finite
    }
}

}  // namespace dynlab::inline numerics
