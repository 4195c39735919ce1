#include "numerics/estimators/hammerstein.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "numerics/criteria/transfer_output.h"
#include "numerics/error.h"
#include "numerics/fit/output_error.h"
#include "numerics/fit/polynomial_estimate.h"
#include "numerics/fit/simulation_report.h"
#include "numerics/fit/transfer_data.h"
#include "numerics/fit/transfer_search.h"
#include "numerics/number_text.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kLeastVisits = 3;  // sum of a hat function over the record, for its edge to be kept

/// The values that the input takes, in order, when they are no more than `most`.
std::optional<Vector> few_values(const IdData& data, Index most) {
    std::set<double> values;
    for (const Experiment& experiment : data.experiments)
        for (const double u : experiment.u.col(0)) {
            values.insert(u);
            if (static_cast<Index>(values.size()) > most) return std::nullopt;
        }
    Vector result(static_cast<Index>(values.size()));
    std::copy(values.begin(), values.end(), result.begin());
    return result;
}

/// Edges that the input visits, of those asked for; the input's own values where these are too few for others.
Vector visited_edges(const IdData& data, const HammersteinOptions& options, std::vector<std::string>& warnings) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Experiment& experiment : data.experiments) {
        low = std::min(low, experiment.u.minCoeff());
        high = std::max(high, experiment.u.maxCoeff());
    }
    Vector edges = options.Breakpoints;
    if (edges.size() == 0) edges = Vector::LinSpaced(options.Bins + 1, low, high);
    const std::optional<Vector> values = few_values(data, edges.size());
    if (values && (values->size() != edges.size() || *values != edges)) {
        edges = *values;
        warnings.push_back("The input takes only " + std::to_string(edges.size()) +
                           " values, so these are the edges of the bins: between them the characteristic is not known, "
                           "and runs on straight lines.");
    }
    Vector visits = Vector::Zero(edges.size());
    for (const Experiment& experiment : data.experiments)
        visits += hat_functions(edges, experiment.u.col(0)).colwise().sum().transpose();
    std::vector<double> kept;
    for (Index i = 0; i < edges.size(); ++i)
        if (visits[i] >= kLeastVisits) kept.push_back(edges[i]);
    if (kept.size() < 2)
        throw InvalidArgument("hammerstein: the input visits only " + std::to_string(kept.size()) +
                              " of the edges of the bins, and two are wanted: excite the system with more levels, or "
                              "give Breakpoints where the input is");
    if (static_cast<Index>(kept.size()) < edges.size())
        warnings.push_back(std::to_string(edges.size() - static_cast<Index>(kept.size())) +
                           " edges of bins were left out, because the input is hardly ever near them.");
    return Vector::Map(kept.data(), static_cast<Index>(kept.size()));
}

/// The data with the hat functions of the input as inputs.
IdData expanded(const IdData& data, const Vector& edges) {
    IdData result = data;
    result.input_names.clear();
    result.input_units.assign(static_cast<std::size_t>(edges.size()), "");
    for (Index i = 0; i < edges.size(); ++i) result.input_names.push_back("f" + std::to_string(i + 1));
    for (Experiment& experiment : result.experiments) experiment.u = hat_functions(edges, Vector(experiment.u.col(0)));
    return result;
}

/// Where the search for one channel per hat function begins. The functions sum up to one, which a system that has come
/// to rest does not answer, so there only what the others do beyond the last one can be told.
Vector channels_start(const IdData& hats, const TransferStructure& channels, const TransferOptions& options) {
    if (options.initial_state == InitialState::kZero) return start_at(hats, channels, options);
    std::vector<Index> others;
    for (Index i = 1; i < channels.inputs; ++i) others.push_back(i);
    const TransferChannel& channel = channels.channels[0];
    const TransferStructure fewer = TransferStructure::grid(1, channels.inputs - 1, Denominators::kPerOutput,
                                                            channels.poles, {channel.zeros}, {channel.delay});
    const Vector found = start_at(without_operating_points(hats.select({1}, others)).data, fewer, options);
    Vector start = Vector::Zero(channels.parameter_count());
    start.head(found.size()) = found;
    return start;
}

/// The output as a function of [a_1..a_n, b_0..b_(m-1), c_1..c_K, delay], with b_m given: that of K inputs with the
/// numerators c_i B and all else in common.
class HammersteinOutput : public OutputErrorModel {
  public:
    HammersteinOutput(const TransferOutput& channels, const TransferStructure& structure, double last_b)
        : channels_(channels),
          structure_(structure),
          n_(structure.poles[0]),
          m_(structure.channels[0].zeros),
          K_(structure.inputs),
          last_b_(last_b) {
        const Index d = n_ + m_ + K_ + (structure.free_delays ? 1 : 0);
        lower_ = Vector::Constant(d, -std::numeric_limits<double>::infinity());
        upper_ = -lower_;
        if (structure.free_delays) {
            lower_[d - 1] = channels.lower()[structure.delay_place(0, 0)];
            upper_[d - 1] = channels.upper()[structure.delay_place(0, 0)];
        }
    }

    Index parameter_count() const override { return lower_.size(); }
    const Vector& lower() const override { return lower_; }
    const Vector& upper() const override { return upper_; }

    Vector numerator(const Vector& theta) const {
        Vector b(m_ + 1);
        b << theta.segment(n_, m_), last_b_;
        return b;
    }

    void simulate(const Vector& theta, Vector& output, Matrix* sensitivities) const override {
        const Vector b = numerator(theta), c = theta.segment(n_ + m_, K_);
        Vector all = Vector::Zero(channels_.parameter_count());
        all.head(n_) = theta.head(n_);
        for (Index i = 0; i < K_; ++i) {
            all.segment(structure_.b_place(0, i), m_ + 1) = c[i] * b;
            if (structure_.free_delays) all[structure_.delay_place(0, i)] = theta[theta.size() - 1];
        }
        Matrix of_all;
        channels_.simulate(all, output, sensitivities != nullptr ? &of_all : nullptr);
        if (sensitivities != nullptr) *sensitivities = of_all * chain(b, c);
    }

  private:
    /// Derivatives of the channels' parameters with respect to these.
    Matrix chain(const Vector& b, const Vector& c) const {
        Matrix T = Matrix::Zero(channels_.parameter_count(), parameter_count());
        T.topLeftCorner(n_, n_).setIdentity();
        for (Index i = 0; i < K_; ++i) {
            const Index place = structure_.b_place(0, i);
            T.block(place, n_, m_, m_).diagonal().setConstant(c[i]);
            T.col(n_ + m_ + i).segment(place, m_ + 1) = b;
            if (structure_.free_delays) T(structure_.delay_place(0, i), parameter_count() - 1) = 1;
        }
        return T;
    }

    const TransferOutput& channels_;
    const TransferStructure& structure_;
    Index n_, m_, K_;
    double last_b_;
    Vector lower_, upper_;
};

/// B and c of the product c_i b_j closest to the coefficients, with B's last coefficient a_n, so that the gain is one.
struct Product {
    Vector b, c;
};

/// The last coefficients, the gains, tell c. Those before are known up to a constant that all channels have in common,
/// for a system at rest does not answer the sum of the hat functions, which is one.
Product closest_product(const Matrix& coefficients, double a_n) {
    const Index m = coefficients.rows() - 1;
    Product product{Vector::Zero(m + 1), coefficients.row(m).transpose() / a_n};
    const Vector slope = product.c.array() - product.c.mean();
    const double spread = slope.squaredNorm();
    if (spread > 0) product.b = coefficients * slope / spread;
    product.b[m] = a_n;
    return product;
}

/// Everything in seconds, the gain of the linear part made one, with the covariance that belongs to it.
void set_parameters(HammersteinEstimate& estimate, const OutputErrorSolution& solution, const Vector& b,
                    const Vector& seconds, Index n, Index K, double fixed_delay) {
    const Index m = b.size() - 1, d = solution.theta.size();
    const Vector& theta = solution.theta;
    const double a_n = theta[n - 1], gain = b[m] / a_n;
    Vector scaled = theta;
    scaled.segment(n, m) /= gain;
    scaled.segment(n + m, K) *= gain;
    Matrix T = Matrix::Identity(d, d);
    T.diagonal().segment(n, m).setConstant(1 / gain);
    T.diagonal().segment(n + m, K).setConstant(gain);
    T.col(n - 1).segment(n, m) = theta.segment(n, m) / b[m];
    T.col(n - 1).segment(n + m, K) = -theta.segment(n + m, K) * gain / a_n;
    estimate.theta = scaled.cwiseProduct(seconds);
    estimate.covariance = seconds.asDiagonal() * (T * solution.covariance * T.transpose()) * seconds.asDiagonal();
    estimate.std = estimate.covariance.diagonal().cwiseMax(0).cwiseSqrt();
    estimate.levels = estimate.theta.segment(n + m, K);
    estimate.levels_std = estimate.std.segment(n + m, K);
    Vector num(m + 1), den(n + 1);
    den << 1, estimate.theta.head(n);
    num << estimate.theta.segment(n, m), den[n];
    const double delay = d > n + m + K ? estimate.theta[d - 1] : fixed_delay;
    estimate.model = TransferFunction(num, den, 0, std::max(0.0, delay));
    for (Index i = 1; i <= n; ++i) estimate.names.push_back("a" + std::to_string(i));
    for (Index i = 0; i < m; ++i) estimate.names.push_back("b" + std::to_string(i));
    for (Index i = 1; i <= K; ++i) estimate.names.push_back("f" + std::to_string(i));
    if (d > n + m + K) estimate.names.push_back("Td");
}

void add_warnings(HammersteinEstimate& estimate, const HammersteinOptions& options) {
    auto& warnings = estimate.warnings;
    if (estimate.termination == Termination::kIterationLimit)
        warnings.push_back("It had not settled after MaxIter = " + std::to_string(options.MaxIter) +
                           " iterations; the best point on the way is given.");
    if (estimate.termination == Termination::kCancelled)
        warnings.push_back("It was stopped before its end; the best point on the way is given.");
    if (!estimate.model.stable()) warnings.push_back("The linear part is unstable.");
    if (estimate.condition_number > kAmbiguousCondition)
        warnings.push_back("The data do not tell all parameters apart: fewer bins or a richer input are wanted.");
    if (estimate.fit_percent < estimate.linear_fit_percent + 1)
        warnings.push_back("A linear model fits as well (" + number_text(estimate.linear_fit_percent, 4) +
                           " %): the static characteristic is hardly bent.");
}

void check(const IdData& data, const TransferStructure& structure, const HammersteinOptions& options) {
    options.validate();
    if (structure.channels.size() != 1 || data.input_count() > 1 || data.output_count() > 1)
        throw InvalidArgument("hammerstein needs one input and one output, and the data hold " +
                              std::to_string(data.input_count()) + " and " + std::to_string(data.output_count()) +
                              ": select one of each");
    check_transfer_data("hammerstein", data, structure);
    if (data.hold != Hold::kZoh)
        throw InvalidArgument(
            "hammerstein needs a held input (InterSample zoh): a bent characteristic makes no "
            "straight lines of straight lines");
    for (const Experiment& experiment : data.experiments)
        if ((experiment.u.array() != experiment.u(0, 0)).any()) return;
    throw InvalidArgument("hammerstein: the input never changes, so there is no excitation to learn from");
}

}  // namespace

void HammersteinOptions::validate() const {
    TransferOptions::validate();
    if (Breakpoints.size() == 0 && (Bins < 1 || Bins > 1000))
        throw InvalidArgument("Bins must lie between 1 and 1000, and is " + std::to_string(Bins));
    if (Breakpoints.size() == 1) throw InvalidArgument("Breakpoints must hold two values at least, and holds one");
    for (Index i = 1; i < Breakpoints.size(); ++i)
        if (!(Breakpoints[i] > Breakpoints[i - 1]))
            throw InvalidArgument("Breakpoints must increase, and value " + std::to_string(i + 1) + " is " +
                                  number_text(Breakpoints[i]) + " after " + number_text(Breakpoints[i - 1]));
    if (initial_state != InitialState::kZero && initial_state != InitialState::kSteady)
        throw InvalidArgument("InitialState must be \"zero\" or \"steady\" for hammerstein");
    if (offset != Offset::kNone)
        throw InvalidArgument("Offset must be \"none\" for hammerstein: a constant is part of its characteristic");
}

Matrix hat_functions(const VectorView& edges, const VectorView& u) {
    const Index K = edges.size();
    Matrix hats = Matrix::Zero(u.size(), K);
    for (Index k = 0; k < u.size(); ++k) {
        const Index above = std::upper_bound(edges.begin(), edges.end(), u[k]) - edges.begin();
        if (above == 0 || above == K) {
            hats(k, above == 0 ? 0 : K - 1) = 1;
            continue;
        }
        const double share = (u[k] - edges[above - 1]) / (edges[above] - edges[above - 1]);
        hats(k, above - 1) = 1 - share;
        hats(k, above) = share;
    }
    return hats;
}

HammersteinEstimate hammerstein(const IdData& data, const TransferStructure& structure,
                                const HammersteinOptions& options) {
    check(data, structure, options);
    HammersteinEstimate estimate;
    estimate.breakpoints = visited_edges(data, options, estimate.warnings);
    const Index K = estimate.breakpoints.size();
    const int n = structure.poles[0], m = structure.channels[0].zeros;

    TransferOptions linear_options = options;
    linear_options.offset = Offset::kEstimate;
    const TransferEstimate linear = search_transfer("hammerstein", data, structure, linear_options);
    estimate.linear_fit_percent = linear.fit_percent[0];
    const double delay = linear.models[0].delay();

    const IdData hats = expanded(data, estimate.breakpoints);
    TransferStructure channels = TransferStructure::grid(1, K, Denominators::kPerOutput, {n}, {m}, {delay});
    const TransferEstimate start =
        search_transfer("hammerstein", hats, channels, options, channels_start(hats, channels, options));
    channels.free_delays = structure.free_delays;
    const DelayRange range = structure.free_delays ? delay_range(data, options) : DelayRange{};
    const TransferOutput output(channels, {options.initial_state, false}, hats, range.least, range.largest);
    const Vector& seconds = output.seconds();
    Matrix coefficients(m + 1, K);
    const Vector b_seconds = seconds.segment(channels.b_place(0, 0), m + 1);
    for (Index i = 0; i < K; ++i)
        coefficients.col(i) = start.theta.segment(start.structure.b_place(0, i), m + 1).cwiseQuotient(b_seconds);
    Vector theta(n + m + K + (channels.free_delays ? 1 : 0)), units(theta.size());
    theta.head(n) = start.theta.head(n).cwiseQuotient(seconds.head(n));
    const Product product = closest_product(coefficients, theta[n - 1]);
    theta.segment(n, m) = product.b.head(m);
    theta.segment(n + m, K) = product.c;
    units << seconds.head(n), b_seconds.head(m), Vector::Ones(K), seconds.tail(channels.free_delays ? 1 : 0);
    if (channels.free_delays) theta[theta.size() - 1] = delay / units[units.size() - 1];

    const HammersteinOutput model(output, channels, product.b[m]);
    const Vector y = output.target();
    const OutputErrorSolution solution =
        minimise_output_error(model, y, theta, {options.MaxIter, options.Tol, options.cancel});
    set_parameters(estimate, solution, model.numerator(solution.theta), units, n, K, delay);
    double variation = 0;
    for (const Experiment& experiment : data.experiments)
        variation += (experiment.y.array() - experiment.y.mean()).square().sum();
    estimate.loss = solution.loss;
    estimate.noise_variance = solution.noise_variance;
    estimate.condition_number = solution.condition_number;
    estimate.fit_percent = fit_percent_of_sums(solution.loss * static_cast<double>(y.size()), variation);
    estimate.termination = solution.termination;
    estimate.iterations = static_cast<Index>(solution.trace.size());
    add_warnings(estimate, options);
    estimate.message = "Hammerstein model with " + std::to_string(K) + " values of the characteristic, after " +
                       iterations_text(solution.trace.size()) + ": fit " + number_text(estimate.fit_percent, 4) +
                       " % (simulation), against " + number_text(estimate.linear_fit_percent, 4) +
                       " % of the best linear model.";
    for (const std::string& warning : estimate.warnings) estimate.message += ' ' + warning;
    return estimate;
}

}  // namespace dynlab::inline numerics
