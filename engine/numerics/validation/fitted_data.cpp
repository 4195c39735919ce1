#include "numerics/validation/fitted_data.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "numerics/error.h"
#include "numerics/estimators/srivc.h"
#include "numerics/signals/robust_statistics.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kShortSamples = 5000, kMaxSearchSamples = 2500, kMaxSecondSearchSamples = 16000;  // samples
constexpr double kFineSampling = 40;       // samples per turn of the fastest pole that a search can do with
constexpr double kStraight = 1e-3;         // of the input's standard deviation: largest error of linear interpolation
constexpr double kSearchTolerance = 1e-4;  // relative, of parameters
constexpr double kSlowCycles = 20;         // over the window, below which a movement counts as slow
constexpr double kSlightlyWorse = 1.05;

/// Where to begin: the first stretch with half of the usual movement.
Index lively_start(const VectorView& u, Index length) {
    const Index stretches = u.size() / length;
    std::vector<double> movement;
    for (Index i = 0; i < stretches; ++i) movement.push_back(standard_deviation(u.segment(i * length, length)));
    double enough = 0.5 * median(movement);
    if (!(enough > 0)) enough = 0.5 * *std::max_element(movement.begin(), movement.end());
    const auto found = std::find_if(movement.begin(), movement.end(), [&](double m) { return m >= enough; });
    return found == movement.end() ? 0 : length * static_cast<Index>(found - movement.begin());
}

/// Samples per turn of the fastest pole, by a quick model of two poles; 0 when there is none.
double samples_per_turn(const IdData& data) {
    FitOptions options;
    options.initial_state = InitialState::kSteady;
    options.offset = Offset::kEstimate;
    try {
        const Fit quick = srivc(data, TransferStructure::single(2, 0), options);
        if (!(quick.fit_percent[0] > 20)) return 0;
        return 2 * std::numbers::pi / (data.Ts * quick.models[0].poles().cwiseAbs().maxCoeff());
    } catch (const InvalidArgument&) {
        return 0;  // no model, no hint
    }
}

/// The largest number of samples of which all intervals between changes of u are multiples.
Index held_samples(const VectorView& u) {
    Index common = 0, last = -1;
    for (Index k = 1; k < u.size() && common != 1; ++k) {
        if (u[k] == u[k - 1]) continue;
        if (last >= 0) common = std::gcd(common, k - last);
        last = k;
    }
    return common;
}

Index first_change(const VectorView& u) {
    Index k = 1;
    while (k < u.size() && u[k] == u[k - 1]) ++k;
    return k;
}

bool is_straight_between(const VectorView& u, Index step) {
    const double max_deviation = kStraight * standard_deviation(u);
    for (Index k = 0; k + step < u.size(); ++k) {
        const Index before = k - k % step;
        const double part = static_cast<double>(k - before) / static_cast<double>(step);
        if (before + step >= u.size()) break;
        if (std::abs(u[k] - (1 - part) * u[before] - part * u[before + step]) > max_deviation) return false;
    }
    return true;
}

IdData every(const IdData& data, Index first, Index step, Hold hold, Index max_samples = kMaxSearchSamples) {
    const Experiment& whole = data.experiments.front();
    const Index count = std::min(max_samples, (data.sample_count() - first + step - 1) / step);
    const auto rows = Eigen::seqN(first, count, step);
    IdData thin = data;
    thin.Ts = data.Ts * static_cast<double>(step);
    thin.hold = hold;
    thin.experiments.front().y = Matrix(whole.y(rows, Eigen::all));
    thin.experiments.front().u = Matrix(whole.u(rows, Eigen::all));
    return thin;
}

Vector high_passed(const VectorView& x, double corner) {
    const double keep = std::exp(-corner);
    Vector y(x.size());
    y[0] = 0;
    for (Index k = 1; k < x.size(); ++k) y[k] = keep * y[k - 1] + (x[k] - x[k - 1]);
    return y;
}

IdData without_slow_movement(const IdData& data) {
    IdData fast = data;
    Experiment& data_set = fast.experiments.front();
    const double corner = 2 * std::numbers::pi * kSlowCycles / static_cast<double>(data_set.y.rows());
    data_set.y = Matrix(high_passed(data_set.y.col(0), corner));
    data_set.u = Matrix(high_passed(data_set.u.col(0), corner));
    return fast;
}

/// Both signals averaged over blocks of so many samples: the same linear system lies between them.
IdData block_averages(const IdData& data, Index block) {
    const Experiment& whole = data.experiments.front();
    const Index count = whole.y.rows() / block;
    const auto averaged = [&](const Matrix& x) -> Matrix {
        return x.col(0).head(count * block).reshaped(block, count).colwise().mean().transpose();
    };
    IdData shortened_data = data;
    shortened_data.Ts = data.Ts * static_cast<double>(block);
    shortened_data.hold = Hold::kFoh;
    shortened_data.experiments.front().y = averaged(whole.y);
    shortened_data.experiments.front().u = averaged(whole.u);
    return shortened_data;
}

/// The model from all samples, with the start and the constant that BIC selects, from the end of the search.
void choose_start(DelaySearch& search, const IdData& data, FitOptions options) {
    Fit& found = search.candidate.estimate;
    options.initial_state = InitialState::kAuto;
    options.offset = Offset::kAuto;
    SearchAids aids;
    aids.start = found.theta;
    aids.lower_order = {&found};
    found = srivc(data, found.structure, options, aids);
    search.delay = found.models.front().delay();
    search.std = found.std[found.std.size() - 1];
}

std::optional<DelaySearch> search_model(const IdData& data, const std::function<bool()>& cancel) {
    const VectorView u = data.experiments.front().u.col(0);
    const bool constant = (u.array() == u[0]).all();  // then a free start and a constant exclude each other
    const Index block = data.sample_count() / kShortSamples;
    DelaySearchOptions options;
    options.estimation.initial_state = constant ? InitialState::kAuto : InitialState::kEstimate;
    options.estimation.offset = constant ? Offset::kAuto : Offset::kEstimate;
    options.estimation.tolerance = kSearchTolerance;
    options.profile = false;
    options.cancel = cancel;
    try {
        DelaySearch search = search_delay(block > 1 ? block_averages(data, block) : data, options);
        if (search.canceled) return std::nullopt;
        choose_start(search, data, options.estimation);
        return search;
    } catch (const InvalidArgument&) {
        // nothing could be fitted: the findings on the signals say why
    }
    return std::nullopt;
}

double relative_error(const IdData& data, const TransferFunction& G) {
    return 1 - compare(data, G).fit_percent / 100;
}

void simulate(FittedData& fit) {
    fit.simulation = compare(fit.data, fit.model());
    fit.error = fit.y() - fit.simulation.output;
}

/// A pole whose natural frequency times the duration of the window is less than this.
bool has_slow_pole(const FittedData& fit, double turns) {
    const double duration = static_cast<double>(fit.window.data.sample_count()) * fit.window.data.Ts;
    const ComplexVector poles = fit.model().poles();
    return std::any_of(poles.begin(), poles.end(), [&](Complex p) { return std::abs(p) * duration < turns; });
}

/// Whether the input alone explains the output: with a slow pole, a free motion from before the first sample is as good
/// as a straight line.
bool explains_from_rest(const FittedData& fit, double percent) {
    if (fit.simulation.start.state == InitialState::kZero) return fit.simulation.fit_percent > percent;
    return compare(fit.data, fit.model(), {InitialState::kZero, Offset::kEstimate}).fit_percent > percent;
}

/// What moves for so long is not seen behind a high-pass filter.
bool is_integrator(const FittedData& fit) {
    return has_slow_pole(fit, 1) && explains_from_rest(fit, 80);
}

/// Whether the window lacks motion that the data contain: a chirp begins slowly.
bool is_not_typical(const FittedData& fit) {
    constexpr double kMore = 2;  // times the mean square error
    const bool longer = fit.data.sample_count() > fit.window.step * fit.window.data.sample_count();
    const double everywhere = fit.error.squaredNorm() / static_cast<double>(fit.error.size());
    return longer && everywhere > kMore * fit.search.loss();
}

/// A longer window, from the beginning of the data.
SearchWindow longer_window(const IdData& data, const SearchWindow& window) {
    const Index first = window.first % window.step;
    return {every(data, first, window.step, window.data.hold, kMaxSecondSearchSamples), first, window.step};
}

bool is_doubtful(const FittedData& fit) {
    constexpr double kSlowPole = 3;
    return fit.simulation.fit_percent < 50 || fit.simulation.start.state == InitialState::kEstimate ||
           has_slow_pole(fit, kSlowPole) || !fit.model().stable() || wanders(fit.error);
}

/// For regularly sampled data with one input and one output: all samples up to 5000; of longer data the first 2500
/// samples in a row whose input varies at least half as much as the median of such stretches. If the data are sampled
/// more than 40 times faster than the response of a first model of two poles, only every `step`th sample is used,
/// provided that nothing is lost: if a held input changes at these samples only, or if linear interpolation between
/// them follows the input to within 1e-3 of its standard deviation (the window then has hold foh).
SearchWindow search_window(const IdData& data) {
    const Index N = data.sample_count();
    if (N <= kShortSamples) return {data, 0, 1};
    const VectorView u = data.experiments.front().u.col(0);
    const Index first = lively_start(u, kMaxSearchSamples);
    const Index max_step = std::max<Index>(1, (N - first) / kMaxSearchSamples);
    const double turn = samples_per_turn(data.range(first + 1, first + kMaxSearchSamples));
    const Index requested = std::min(max_step, static_cast<Index>(turn / kFineSampling));
    const Index held = held_samples(u);
    const auto ahead = [&](Index step) { return first + (first_change(u) % step + step - first % step) % step; };
    for (Index step = requested; step > 1 && data.hold == Hold::kZoh && held > 1; --step)
        if (held % step == 0) return {every(data, ahead(step), step, Hold::kZoh), ahead(step), step};
    for (Index step = requested; step > 1; step /= 2)
        if (is_straight_between(u.tail(N - first), step)) return {every(data, first, step, Hold::kFoh), first, step};
    return {every(data, first, 1, data.hold), first, 1};
}

}  // namespace

Message FittedData::with_unit(double value, int digits) const {
    return numerics::with_unit(rounded(value, digits), data.output_units.front());
}

bool FittedData::runs_away() const {
    constexpr double kFar = 3, kHalf = 50;  // times the range of the output; per cent of fit
    if (!model().stable()) return !explains_from_rest(*this, kHalf);
    if (simulation.fit_percent > kHalf) return false;
    const auto range = [](const auto& x) { return x.maxCoeff() - x.minCoeff(); };
    return !(range(simulation.output) < kFar * range(y()));
}

double FittedData::deviation() const {
    return standard_deviation(y());
}

void FittedData::take_off(const VectorView& part) {
    data.experiments.front().y.col(0) -= part;
    simulate(*this);
}

std::optional<FittedData> fitted_data(const IdData& data, const std::function<bool()>& cancel) {
    SearchWindow window = search_window(data);
    std::optional<DelaySearch> search = search_model(window.data, cancel);
    if (!search) return std::nullopt;
    FittedData fit{data, std::move(window), std::move(*search), {}, {}};
    simulate(fit);
    if (is_not_typical(fit)) {
        fit.window = longer_window(data, fit.window);
        search = search_model(fit.window.data, cancel);
        if (!search) return std::nullopt;
        fit.search = std::move(*search);
        simulate(fit);
    }
    fit.movement_error = 1 - fit.simulation.fit_percent / 100;
    if (!is_doubtful(fit) || is_integrator(fit)) return fit;
    const IdData fast = without_slow_movement(fit.window.data);
    std::optional<DelaySearch> second = search_model(fast, cancel);
    fit.movement_error = relative_error(fast, fit.model());
    if (!second) return fit;
    const double error = relative_error(fast, second->candidate.estimate.models.front());
    if (!(error < kSlightlyWorse * fit.movement_error)) return fit;
    constexpr double kSenseless = -50;  // per cent of fit
    const double before = fit.simulation.fit_percent;
    std::swap(fit.search, *second);
    simulate(fit);
    if (fit.simulation.fit_percent > std::min(kSenseless, before)) {
        fit.movement_error = error;
        return fit;
    }
    std::swap(fit.search, *second);  // slow movement is the response here, not a disturbance
    simulate(fit);
    return fit;
}

DataIssue about(const FittedData& fit, const char* code, Weight weight, const Message& message, double value) {
    return {code, weight, fit.output(), message, value, 0, {}};
}

MessageList listed_places(const std::vector<Segment>& segments) {
    constexpr std::size_t kMax = 4;
    MessageList places;
    for (std::size_t i = 0; i < std::min(kMax, segments.size()); ++i) {
        const auto [first, last] = segments[i];
        places.items.push_back(last > first ? Message("{} to {}", first, last) : Message("{}", first));
    }
    if (segments.size() > kMax) places.items.push_back(Message::verbatim("..."));
    return places;
}

Message with_unit(Number number, const std::string& unit) {
    return unit.empty() ? Message("{}", number) : Message("{} {}", number, unit);
}

Number rounded(double value, int digits) {
    if (value == 0 || !std::isfinite(value)) return Number{value};
    const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) + 1 - digits);
    return significant(unit < 1 ? std::round(value / unit) / std::round(1 / unit) : std::round(value / unit) * unit, 6);
}

Number rounded_to(double value, double resolution) {
    const double digits = std::ceil(std::log10(std::abs(value) / resolution));
    return rounded(value, std::isfinite(digits) ? static_cast<int>(std::clamp(digits, 1.0, 4.0)) : 2);
}

}  // namespace dynlab::inline numerics
