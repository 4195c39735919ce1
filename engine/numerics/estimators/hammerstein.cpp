#include "numerics/estimators/hammerstein.h"

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <optional>
#include <set>

#include "numerics/criteria/reparametrized.h"
#include "numerics/criteria/transfer_output.h"
#include "numerics/error.h"
#include "numerics/fit/delay_scan.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/first_estimate.h"
#include "numerics/fit/operating_points.h"
#include "numerics/fit/output_error.h"
#include "numerics/fit/transfer_search.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kLeastVisits = 3;  // least sum of a hat function over the data for which its edge is kept

/// The values that the input takes, in order, when they are no more than `max_count`.
std::optional<Vector> few_values(const IdData& data, Index max_count) {
    std::set<double> values;
    for (const Experiment& experiment : data.experiments)
        for (const double u : experiment.u.col(0)) {
            values.insert(u);
            if (static_cast<Index>(values.size()) > max_count) return std::nullopt;
        }
    Vector result(static_cast<Index>(values.size()));
    std::copy(values.begin(), values.end(), result.begin());
    return result;
}

/// Edges that the input visits, of those asked for; the input's own values where these are too few for others.
Vector visited_edges(const IdData& data, const HammersteinOptions& options, std::vector<Message>& warnings) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Experiment& experiment : data.experiments) {
        low = std::min(low, experiment.u.minCoeff());
        high = std::max(high, experiment.u.maxCoeff());
    }
    Vector edges = options.breakpoints;
    if (edges.size() == 0) edges = Vector::LinSpaced(options.bins + 1, low, high);
    const std::optional<Vector> values = few_values(data, edges.size());
    if (values && (values->size() != edges.size() || *values != edges)) {
        edges = *values;
        warnings.push_back(
            options.breakpoints.size() == 0
                ? Message("The input has only {} distinct values, which are the bin edges. Between these values, the "
                          "characteristic is unknown and linearly interpolated.",
                          edges.size())
                : Message("The input has only {} distinct values, which are the bin edges; {} is ignored. Between "
                          "these values, the characteristic is unknown and linearly interpolated.",
                          edges.size(), OptionName{"breakpoints"}));
    }
    Vector visits = Vector::Zero(edges.size());
    for (const Experiment& experiment : data.experiments)
        visits += hat_functions(edges, experiment.u.col(0)).colwise().sum().transpose();
    std::vector<double> kept;
    for (Index i = 0; i < edges.size(); ++i)
        if (visits[i] >= kLeastVisits) kept.push_back(edges[i]);
    if (kept.size() < 2)
        throw InvalidArgument(
            "hammerstein: the input reaches only {} of the bin edges, but at least two are required: use an input with "
            "more levels, or specify {} near the values of the input",
            kept.size(), OptionName{"breakpoints"});
    if (static_cast<Index>(kept.size()) < edges.size())
        warnings.push_back(plural(edges.size() - static_cast<Index>(kept.size()),
                                  "{} bin edge is omitted, because it has too few input values nearby.",
                                  "{} bin edges are omitted, because they have too few input values nearby."));
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

/// Start of the search with one channel per hat function. The functions add up to one, to which a system at rest does
/// not respond. From such a start, only the effects of the other functions relative to one of them are therefore
/// identifiable.
Vector channels_start(const IdData& hats, const TransferStructure& channels, const FitOptions& options) {
    if (options.initial_state == InitialState::kZero) return start_from_rest(hats, channels, options);
    std::vector<Index> others;
    for (Index i = 1; i < channels.inputs; ++i) others.push_back(i);
    const TransferChannel& channel = channels.channels[0];
    const TransferStructure fewer = TransferStructure::grid(1, channels.inputs - 1, Denominators::kPerOutput,
                                                            channels.poles, {channel.zeros}, {channel.delay});
    const Vector found = start_from_rest(without_operating_points(hats.select({1}, others)).data, fewer, options);
    Vector start = Vector::Zero(channels.parameter_count());
    start.head(found.size()) = found;
    return start;
}

/// Where the parameters [a_1..a_n, b_0..b_(m-1), c_1..c_K, delay] lie; the last coefficient of B is given.
struct Layout {
    Index n, m, K;
    bool delay;

    Index gains() const { return n + m; }
    Index count() const { return n + m + K + (delay ? 1 : 0); }
    std::vector<std::string> names() const {
        std::vector<std::string> all;
        const auto add = [&](const char* letter, Index first, Index number) {
            for (Index i = 0; i < number; ++i) all.push_back(letter + std::to_string(first + i));
        };
        add("a", 1, n);
        add("b", 0, m);
        add("f", 1, K);
        if (delay) all.push_back("Td");
        return all;
    }
};

Vector numerator(const Layout& at, const Vector& theta, double last_b) {
    Vector b(at.m + 1);
    b << theta.segment(at.n, at.m), last_b;
    return b;
}

/// The output of K inputs with the numerators c_i B and all else in common.
Reparametrized hammerstein_output(const TransferOutput& channels, const TransferStructure& structure, const Layout& at,
                                  double last_b) {
    const Index d = at.count(), inner = channels.parameter_count();
    Vector lower = Vector::Constant(d, -std::numeric_limits<double>::infinity()), upper = -lower;
    if (at.delay) {
        lower[d - 1] = channels.lower()[structure.delay_index(0, 0)];
        upper[d - 1] = channels.upper()[structure.delay_index(0, 0)];
    }
    const auto products = [=](const Vector& theta) {
        const Vector b = numerator(at, theta, last_b);
        Reparametrized::Point point{Vector::Zero(inner), Matrix::Zero(inner, d)};
        point.inner.head(at.n) = theta.head(at.n);
        point.derivatives.topLeftCorner(at.n, at.n).setIdentity();
        for (Index i = 0; i < at.K; ++i) {
            const Index place = structure.numerator_start(0, i);
            const double c = theta[at.gains() + i];
            point.inner.segment(place, at.m + 1) = c * b;
            point.derivatives.block(place, at.n, at.m, at.m).diagonal().setConstant(c);
            point.derivatives.col(at.gains() + i).segment(place, at.m + 1) = b;
            if (!at.delay) continue;
            point.inner[structure.delay_index(0, i)] = theta[d - 1];
            point.derivatives(structure.delay_index(0, i), d - 1) = 1;
        }
        return point;
    };
    return Reparametrized(channels, products, lower, upper);
}

/// B and c of the product c_i b_j closest to the coefficients, with B's last coefficient a_n, so that the gain is one.
struct Product {
    Vector b, c;
};

/// The last coefficients, the gains, determine c. The earlier coefficients are known except for a constant that all
/// channels share, because a system at rest does not respond to the sum of the hat functions, which is one.
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
void set_parameters(Fit& fit, const Layout& at, double last_b, const Vector& seconds, double fixed_delay) {
    const Index d = at.count();
    const Vector theta = fit.theta;
    const double a_n = theta[at.n - 1], gain = last_b / a_n;
    Vector scaled = theta;
    scaled.segment(at.n, at.m) /= gain;
    scaled.segment(at.gains(), at.K) *= gain;
    Matrix T = Matrix::Identity(d, d);
    T.diagonal().segment(at.n, at.m).setConstant(1 / gain);
    T.diagonal().segment(at.gains(), at.K).setConstant(gain);
    T.col(at.n - 1).segment(at.n, at.m) = theta.segment(at.n, at.m) / last_b;
    T.col(at.n - 1).segment(at.gains(), at.K) = -theta.segment(at.gains(), at.K) * gain / a_n;
    fit.theta = scaled.cwiseProduct(seconds);
    fit.names = at.names();
    fit.covariance = (seconds.asDiagonal() * (T * fit.covariance * T.transpose()) * seconds.asDiagonal()).eval();
    fit.std = fit.covariance.diagonal().cwiseMax(0).cwiseSqrt();
    fit.characteristic->levels = fit.theta.segment(at.gains(), at.K);
    fit.characteristic->levels_std = fit.std.segment(at.gains(), at.K);
    Vector den(at.n + 1);
    den << 1, fit.theta.head(at.n);
    const double delay = at.delay ? fit.theta[d - 1] : fixed_delay;
    fit.models = {TransferFunction(numerator(at, fit.theta, den[at.n]), den, 0, std::max(0.0, delay))};
}

void add_warnings(Fit& fit, const HammersteinOptions& options) {
    const double linear = fit.characteristic->linear_fit_percent;
    warn_of_search(fit, options);
    if (!fit.models.front().stable()) fit.warnings.push_back(Message("The linear part is unstable."));
    if (fit.condition_number > kAmbiguousCondition) warn_of_doubtful_parameters(fit, SimplerModel::kFewerBins);
    if (fit.fit_percent[0] < linear + 1)
        fit.warnings.push_back(
            Message("A linear model fits equally well ({} %): the static characteristic is almost linear.",
                    significant(linear, 4)));
}

void check(const IdData& data, const TransferStructure& structure, const HammersteinOptions& options) {
    options.validate();
    if (structure.channels.size() != 1 || data.input_count() > 1 || data.output_count() > 1)
        throw InvalidArgument(
            "hammerstein needs one input and one output, but the data have {} and {}: select one of each",
            data.input_count(), data.output_count());
    check_transfer_data("hammerstein", data, structure);
    if (data.hold != Hold::kZoh)
        throw InvalidArgument(
            "hammerstein needs an input with zero-order hold (zoh): the characteristic would distort a linearly "
            "interpolated input");
    for (const Experiment& experiment : data.experiments)
        if ((experiment.u.array() != experiment.u(0, 0)).any()) return;
    throw InvalidArgument(
        "hammerstein: the input never changes, so it does not excite the system. Use data in which the input varies");
}

}  // namespace

void HammersteinOptions::validate() const {
    FitOptions::validate();
    if (breakpoints.size() == 0 && (bins < 1 || bins > 1000))
        throw InvalidArgument("{} must be between 1 and 1000, but is {}", OptionName{"bins"}, bins);
    if (breakpoints.size() == 1)
        throw InvalidArgument("{} must have at least two values, but has one", OptionName{"breakpoints"});
    for (Index i = 1; i < breakpoints.size(); ++i)
        if (!(breakpoints[i] > breakpoints[i - 1]))
            throw InvalidArgument("{} must increase, but value {} is {} and the previous value is {}",
                                  OptionName{"breakpoints"}, i + 1, breakpoints[i], breakpoints[i - 1]);
    if (initial_state == InitialState::kEstimate)
        throw InvalidArgument("{} must be \"none\", \"steady\" or \"auto\" for hammerstein",
                              OptionName{"initial_state"});
    if (offset != Offset::kNone)
        throw InvalidArgument("{} must be \"none\" for hammerstein, because the characteristic includes a constant",
                              OptionName{"offset"});
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

Fit hammerstein(const IdData& data, const TransferStructure& structure, const HammersteinOptions& options) {
    check(data, structure, options);
    if (options.initial_state == InitialState::kAuto) {
        HammersteinOptions zero = options, steady = options;
        zero.initial_state = InitialState::kZero;
        steady.initial_state = InitialState::kSteady;
        Fit from_zero = hammerstein(data, structure, zero), from_rest = hammerstein(data, structure, steady);
        return from_zero.loss < from_rest.loss ? from_zero : from_rest;
    }
    std::vector<Message> warnings;
    StaticCharacteristic characteristic;
    characteristic.breakpoints = visited_edges(data, options, warnings);
    const Layout at{structure.poles[0], structure.channels[0].zeros, characteristic.breakpoints.size(),
                    structure.free_delays};

    FitOptions linear_options = options;
    linear_options.offset = Offset::kEstimate;
    const Fit linear = search_transfer("hammerstein", data, structure, linear_options);
    characteristic.linear_fit_percent = linear.fit_percent[0];
    const double delay = linear.models[0].delay();

    const IdData hats = expanded(data, characteristic.breakpoints);
    TransferStructure channels = TransferStructure::grid(1, at.K, Denominators::kPerOutput, structure.poles,
                                                         {structure.channels[0].zeros}, {delay});
    const Fit start =
        search_transfer("hammerstein", hats, channels, options, {channels_start(hats, channels, options), {}});
    channels.free_delays = structure.free_delays;
    const DelayRange range = structure.free_delays ? delay_range(data, options) : DelayRange{};
    const TransferOutput output(channels, {options.initial_state, false}, hats, range.least, range.largest);
    const Vector& seconds = output.seconds();
    const Vector b_seconds = seconds.segment(channels.numerator_start(0, 0), at.m + 1);
    Matrix coefficients(at.m + 1, at.K);
    for (Index i = 0; i < at.K; ++i)
        coefficients.col(i) =
            start.theta.segment(start.structure.numerator_start(0, i), at.m + 1).cwiseQuotient(b_seconds);
    Vector theta(at.count()), units(at.count());
    units << seconds.head(at.n), b_seconds.head(at.m), Vector::Ones(at.K), seconds.tail(at.delay ? 1 : 0);
    theta.head(at.n) = start.theta.head(at.n).cwiseQuotient(seconds.head(at.n));
    const Product product = closest_product(coefficients, theta[at.n - 1]);
    theta.segment(at.n, at.m) = product.b.head(at.m);
    theta.segment(at.gains(), at.K) = product.c;
    if (at.delay) theta[at.count() - 1] = delay / units[at.count() - 1];

    const Vector y = output.target();
    Fit fit = minimize_output_error(hammerstein_output(output, channels, at, product.b[at.m]), y, theta, options);
    fit.characteristic = std::move(characteristic);
    fit.warnings = std::move(warnings);
    set_parameters(fit, at, product.b[at.m], units, delay);
    fit.fit_percent =
        Vector::Constant(1, fit_percent_of_sums(fit.loss * static_cast<double>(y.size()), output_variations(data)[0]));
    fit.start = {options.initial_state, false};
    add_warnings(fit, options);
    if (at.delay) {
        const double found = fit.theta[at.count() - 1];
        if (found > 0.5 * range.largest) warn_of_delay(fit, found, range);  // only of the upper limit
        warn_of_later_response(fit, data, 0, 0, found, range.largest);
    }
    fit.message = Message(
        "Hammerstein model with {} values of the characteristic, after {}: {}, compared with {} % for the best linear "
        "model.",
        at.K, iteration_count(fit), simulation_text(fit), significant(fit.characteristic->linear_fit_percent, 4));
    return fit;
}

}  // namespace dynlab::inline numerics
