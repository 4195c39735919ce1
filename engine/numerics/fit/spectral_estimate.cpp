#include "numerics/fit/spectral_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/error.h"
#include "numerics/signals/preprocess.h"

namespace dynlab::inline numerics {

namespace {

void check_channels(const std::string& caller, const IdData& data) {
    if (data.input_count() == 0)
        throw InvalidArgument("{}: the data have no input, so no response can be estimated. Add an input with iddata",
                              caller);
    if (data.input_count() != 1 || data.output_count() != 1)
        throw InvalidArgument(
            "{}: the data must have one input and one output, but they have {} and {}; select a pair with "
            "data:select(output, input)",
            caller, data.input_count(), data.output_count());
    if (!data.regular())
        throw InvalidArgument(
            "{}: the data are sampled irregularly; interpolate them at equally spaced instants (interp1)", caller);
}

bool changes(const Matrix& signal) {
    return signal.maxCoeff() > signal.minCoeff();
}

/// Where the estimated noise is not positive, its variance is unknown: estimators must give such a frequency the least
/// weight, not an infinite one.
Vector usable_variances(const Vector& variance) {
    if (variance.size() == 0 || !(variance.maxCoeff() > 0)) return {};
    return (variance.array() > 0).select(variance, variance.maxCoeff());
}

}  // namespace

FrequencyData frequency_data_of(const SpectralEstimate& estimate, const IdData& data, const std::string& method,
                                bool smoothed) {
    FrequencyData response;
    response.w = estimate.w, response.response = estimate.response;
    response.variance = usable_variances(2 * estimate.std.cwiseAbs2());  // of both parts
    response.Ts = data.Ts, response.inter_sample = inter_sample_of(data.hold);
    response.input_name = data.input_names.front(), response.output_name = data.output_names.front();
    response.input_unit = data.input_units.front(), response.output_unit = data.output_units.front();
    response.neighbors_share_errors = smoothed;
    response.coherence = estimate.coherence, response.noise_spectrum = estimate.noise_spectrum;
    response.method = method, response.message = estimate.message, response.warnings = estimate.warnings;
    return response;
}

IdData nonparametric_data(const std::string& caller, const IdData& data, Index min_samples, bool remove_means) {
    check_channels(caller, data);
    bool input_changes = false, output_changes = false;
    for (const Experiment& experiment : data.experiments) {
        if (experiment.y.rows() < min_samples)
            throw InvalidArgument("{}: an experiment needs at least {} samples, but one has {}", caller, min_samples,
                                  experiment.y.rows());
        input_changes = input_changes || changes(experiment.u);
        output_changes = output_changes || changes(experiment.y);
    }
    if (!input_changes)
        throw InvalidArgument(
            "{}: the input never changes, so it does not excite the dynamics. Use data with a varying input, for "
            "instance from prbs",
            caller);
    if (!output_changes)
        throw InvalidArgument(
            "{}: the output never changes, so no dynamics can be estimated. Use data in which the output varies",
            caller);
    return remove_means ? remove_mean(data) : data;
}

SpectralPoint spectral_point(double input, double output, Complex cross, double averages, double real_share) {
    SpectralPoint point;
    point.response = cross / input;
    const double explained = std::norm(cross) / input;
    point.coherence = output > 0 ? std::clamp(explained / output, 0.0, 1.0) : 0;
    // the response took one of the averages for itself
    const double degrees = averages > 1 ? averages / (averages - 1) : std::numeric_limits<double>::infinity();
    point.noise = std::max(output - explained, 0.0) * degrees;
    point.std = std::sqrt(point.noise / input / averages * real_share);
    return point;
}

}  // namespace dynlab::inline numerics
