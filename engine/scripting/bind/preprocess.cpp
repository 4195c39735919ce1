#include <algorithm>
#include <array>

#include "numerics/signals/butterworth.h"
#include "numerics/signals/preprocess.h"
#include "numerics/signals/repair.h"
#include "numerics/signals/resample.h"
#include "scripting/bind/bindings.h"
#include "scripting/bind/preprocess_bindings.h"
#include "scripting/conversions/option_member.h"
#include "scripting/objects/data_object.h"

namespace dynlab::inline scripting {
namespace {

constexpr OptionEntry kTrendOptions[] = {
    {"samples", ValueKind::kCount,
     about(
         "for \"start\", number of samples to average for the level; by default all samples before an input changes")}};
constexpr std::array kFilterStarts = {"zero", "steady"};
constexpr OptionEntry kFilterStart = {
    "start",
    ValueKind::kChoice,
    about("signal before its first sample: zero (\"zero\"), or constant at the value of the first sample (\"steady\")"),
    {.initial = "\"zero\"", .choices = kFilterStarts}};
constexpr OptionEntry kButterworthOptions[] = {
    option<&FilterOptions::order>(
        "order", about("order of the low-pass prototype; a band with two edges has twice as many poles"),
        {.minimum = 1, .maximum = 20}),
    option<&FilterOptions::zero_phase>(
        "zero_phase",
        about("true filters forward and then backward, which avoids a phase shift and squares the magnitude response")),
    option<&FilterOptions::stop>("stop", about("true removes the band instead of passing it")),
    kFilterStart,
    {"Ts", ValueKind::kNumber, about("sampling time of a vector"), {.initial = "1", .unit = "s"}}};
constexpr std::array kFillMethods = {"linear", "previous"};
constexpr OptionEntry kFillMethod = {
    "method",
    ValueKind::kChoice,
    about("linear interpolation between the adjacent samples (\"linear\", for outputs), or the sample before the gap "
          "(\"previous\", for inputs that are logged only when they change)"),
    {.initial = "\"linear\"", .choices = kFillMethods}};
constexpr OptionEntry kGapOptions[] = {
    kFillMethod,
    {"t", ValueKind::kVector, about("increasing sampling instants of irregularly sampled data")},
    {"longest", ValueKind::kCount,
     about("longest gap in samples to fill; by default, 10 for \"linear\" and no limit for \"previous\"")}};
constexpr std::array kOutlierOptions = {
    option<&OutlierOptions::window>("window",
                                    about("window length of the moving median, an odd number of samples, at least 3")),
    option<&OutlierOptions::threshold>(
        "threshold",
        about("distance from the median, in robust standard deviations, above which a sample is an outlier"))};
constexpr OptionTable kTrendTables[] = {kTrendOptions}, kButterworthTables[] = {kButterworthOptions},
                      kGapsTables[] = {kGapOptions}, kOutliersTables[] = {kOutlierOptions};

constexpr ArgumentEntry kAnySignals = {"data", ValueKind::kAny, about("data object, or one signal as a vector")},
                        kRegularSignals = {"data", ValueKind::kAny,
                                           about("data object, sampled regularly, or one signal as a vector")};
constexpr ArgumentEntry kTrendArguments[] = {
    kAnySignals,
    {"kind", ValueKind::kChoice,
     about("\"linear\" (the default), \"mean\", or \"start\"; 1 and 0 are equivalent to \"linear\" and \"mean\"")}};
constexpr ArgumentEntry kButterworthArguments[] = {kRegularSignals,
                                                   {"{lower, upper}", ValueKind::kVector,
                                                    about("edges of the band in rad/s; {0, w} specifies a low-pass "
                                                          "filter, and {w, math.huge} specifies a high-pass filter")}};
constexpr ArgumentEntry kResampleArguments[] = {kRegularSignals,
                                                {"up, down", ValueKind::kCount, about("whole numbers from 1 to 1000")}};
constexpr ArgumentEntry kMergeArguments[] = {
    {"data1, ...", ValueKind::kData, about("data objects with the same channels and sampling time")}};
constexpr ArgumentEntry kGapArguments[] = {
    {"x", ValueKind::kVector, about("signal with missing samples (NaN): vector or table of numbers")}};
constexpr ArgumentEntry kOutlierArguments[] = {
    {"x", ValueKind::kAny, about("signal, or data object; for a data object, the outputs are cleaned")}};

/// What a function works on: a data object, or one signal, which becomes the output of one.
struct Signals {
    IdData data;
    bool bare;
};

Signals signals_argument(const Call& call, double Ts) {
    if (call.holds_vector(1)) return {IdData(Matrix(call.vector(1, "x")), Matrix(), Ts), true};
    if (const IdData* data = to_object<IdData>(call.state(), 1)) return {*data, false};
    wrong_argument(call.state(), 1, "data", Message("a data object or a vector"));
}

int give_signals(const Call& call, const Signals& kind, IdData result) {
    if (kind.bare) return call.give_vector(result.experiments.front().y.col(0));
    return give_data(call, std::move(result));
}

std::vector<Segment> segments_argument(const Call& call) {
    const MatrixMap rows = call.matrix(2, "{{first, last}, ...}");
    if (rows.cols() != 2 || (rows.array() != rows.array().floor()).any() || !(rows.array().abs() < 1e15).all())
        throw InvalidArgument(
            "the ranges must be pairs of sample numbers {first, last}, such as {{1, 200}, {350, 900}}");
    std::vector<Segment> segments;
    for (const auto& row : rows.rowwise()) segments.push_back({index_of_whole(row[0]), index_of_whole(row[1])});
    return segments;
}

/// {lower, upper}; 0 and math.huge are the ends of the axis.
PassBand band_argument(const Call& call) {
    const VectorMap edges = call.vector(2, "{lower, upper}");
    if (edges.size() != 2)
        throw InvalidArgument("the band must be {lower, upper} in rad/s ({0, w} is a low-pass filter), not {}",
                              plural(edges.size(), "{} number", "{} numbers"));
    return {edges[0], edges[1]};
}

/// MATLAB's degrees 0 and 1 are the mean and the straight line.
std::string trend_kind(const Call& call) {
    if (!call.given(2)) return "linear";
    if (call.type(2) != LUA_TNUMBER) return call.text(2, "kind");
    const double degree = call.number(2, "kind");
    if (degree == 0) return "mean";
    if (degree == 1) return "linear";
    throw InvalidArgument("a trend must have degree 0 (\"mean\") or 1 (\"linear\"), but {} was given",
                          significant(degree, 10));
}

/// The signal, and the indices of what was replaced.
int give_repaired(const Call& call, const RepairedSignal& repaired) {
    Vector indices(static_cast<Index>(repaired.replaced.size()));
    std::copy(repaired.replaced.begin(), repaired.replaced.end(), indices.begin());
    return call.give_vector(repaired.signal) + call.give_vector(indices);
}

int fill_gaps(Call& call) {
    call.at_most(2);
    const Options options(call, 2, kGapsTables);
    const Vector t = options.has("t") ? Vector(options.vector("t")) : Vector();
    const auto max_gap = options.has("longest") ? std::optional(options.size("longest", 0)) : std::nullopt;
    const auto method =
        options.has("method") ? static_cast<FillMethod>(options.choice(kFillMethod)) : FillMethod::kLinear;
    return give_repaired(call, fill_missing(call.vector(1, "x"), t, max_gap, method));
}

int remove_outliers(Call& call) {
    call.at_most(2);
    const Options options(call, 2, kOutliersTables);
    OutlierOptions requested;
    options.read(requested);
    if (const IdData* data = to_object<IdData>(call.state(), 1)) {
        IdData cleaned = *data;
        Index count = 0;
        for (Experiment& experiment : cleaned.experiments)
            for (Index output = 0; output < experiment.y.cols(); ++output) {
                const RepairedSignal repaired = replace_outliers(experiment.y.col(output), requested);
                experiment.y.col(output) = repaired.signal;
                count += static_cast<Index>(repaired.replaced.size());
            }
        return give_data(call, std::move(cleaned)) + call.give(static_cast<double>(count));
    }
    return give_repaired(call, replace_outliers(call.vector(1, "x"), requested));
}

constexpr FunctionEntry kPreprocessFunctions[] = {
    {"detrend", "data", "detrend(data, \"linear\" | \"mean\" | \"start\", {options}) -> result",
     "Remove the linear trend, the mean, or the level before the input changes", guarded<detrend_signals>, kTrendTables,
     kTrendArguments},
    {"idfilt", "data", "idfilt(data, {lower, upper}, {options}) -> data",
     "Filter inputs and outputs with the same Butterworth filter", guarded<filter_signals>, kButterworthTables,
     kButterworthArguments},
    {"resample", "data", "resample(data, up, down) -> data",
     "Change the sampling rate by the factor up/down, with an anti-aliasing filter", guarded<resample_signals>,
     kNoOptions, kResampleArguments},
    {"merge", "data", "merge(data1, data2, ...) -> data", "Combine experiments in one data object", guarded<merge_data>,
     kNoOptions, kMergeArguments},
    {"fillmissing", "data", "fillmissing(x, {options}) -> filled, places",
     "Fill missing samples by linear interpolation or with the previous sample", guarded<fill_gaps>, kGapsTables,
     kGapArguments},
    {"filloutliers", "data",
     "filloutliers(x, {options}) -> cleaned, places; filloutliers(data, {options}) -> cleaned, count",
     "Replace outliers by linear interpolation", guarded<remove_outliers>, kOutliersTables, kOutlierArguments},
};

}  // namespace

int detrend_signals(Call& call) {
    call.at_most(3);
    const Signals signals = signals_argument(call, 1);
    const std::string kind = trend_kind(call);
    const Options options(call, 3, kTrendTables);
    if (kind == "start")
        return give_signals(call, signals, remove_initial_level(signals.data, options.size("samples", 0)));
    if (kind != "linear" && kind != "mean")
        throw InvalidArgument("{} must be {}, but \"{}\" was given", Message("the kind of trend"),
                              Message("\"linear\", \"mean\" or \"start\""), kind);
    if (options.has("samples"))
        throw InvalidArgument(
            "option 'samples', the number of samples before the step, requires the kind \"start\"; specify \"start\", "
            "or omit 'samples'");
    return give_signals(call, signals,
                        detrend(signals.data, kind == "linear" ? TrendKind::kLinear : TrendKind::kConstant));
}

int filter_signals(Call& call) {
    call.at_most(3);
    const Options options(call, 3, kButterworthTables);
    const Signals signals = signals_argument(call, options.number("Ts", 1));
    if (!signals.bare && options.has("Ts"))
        throw InvalidArgument(
            "option 'Ts' applies only to a vector, because a data object already has a sampling time");
    FilterOptions requested;
    options.read(requested);
    requested.steady_start = options.has("start") && options.choice(kFilterStart) == 1;
    if (requested.zero_phase && options.has("start"))
        throw InvalidArgument(
            "option 'start' applies only to the causal filter; with option 'zero_phase', the signal is extended at "
            "both ends");
    return give_signals(call, signals, filter_data(signals.data, band_argument(call), requested));
}

int resample_signals(Call& call) {
    call.at_most(3);
    const Signals signals = signals_argument(call, 1);
    return give_signals(call, signals, resample(signals.data, call.integer(2, "up"), call.integer(3, "down")));
}

int keep_parts(Call& call) {
    call.at_most(2);
    return give_data(call, keep_segments(signals_of_argument(call, 1, "data"), segments_argument(call)));
}

int discard_parts(Call& call) {
    call.at_most(2);
    return give_data(call, discard_segments(signals_of_argument(call, 1, "data"), segments_argument(call)));
}

int merge_data(Call& call) {
    std::vector<IdData> parts;
    for (int i = 1; i <= call.count(); ++i) parts.push_back(signals_of_argument(call, i, "data"));
    return give_data(call, IdData::merge(parts));
}

FunctionEntries preprocess_functions() {
    return kPreprocessFunctions;
}

}  // namespace dynlab::inline scripting
