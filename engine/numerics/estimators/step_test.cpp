#include "numerics/estimators/step_test.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "numerics/error.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/linalg/polynomial.h"

namespace dynlab::inline numerics {

namespace {

constexpr int kDigits = 6;  // of readings in messages

StepTestResult begin_reading(const IdData& data, std::vector<std::string> names, double widest_window) {
    StepTestResult result;
    result.step_data = read_step_data(data, widest_window);
    result.names = std::move(names);
    result.parameters = Vector::Zero(static_cast<Index>(result.names.size()));
    result.parameters[0] = result.step_data.output_change() / result.step_data.input_change();
    return result;
}

double output_at(const StepData& step_data, double rise) {
    return step_data.initial.value + rise * step_data.output_change();
}

double highest_rise(const StepData& step_data) {
    double highest = 0;
    for (Index k = step_data.step_index; k < step_data.smoothed.size(); ++k)
        highest = std::max(highest, step_data.rise(k));
    return highest;
}

// The last instant at which the smoothed response lies outside the band, by linear interpolation.
ReadingPoint settling_point(const StepData& step_data, double band) {
    Index k = step_data.smoothed.size() - 1;
    while (k > step_data.step_index && std::abs(step_data.rise(k) - 1) <= band) --k;
    const double outside = step_data.rise(k), inside = step_data.rise(k + 1);
    const double edge = outside < 1 ? 1 - band : 1 + band;
    const double part = (edge - outside) / (inside - outside);
    return {"settling", step_data.t[k] + part * (step_data.t[k + 1] - step_data.t[k]), output_at(step_data, edge)};
}

// Where the cubic through the upper quarter of the overshoot is highest; one sample alone would follow the noise.
ReadingPoint peak_around(const StepData& step_data, Index top) {
    const double floor = 1 + 0.75 * (step_data.rise(top) - 1);
    Index first = top - 2, last = std::min(top + 2, step_data.smoothed.size() - 1);
    while (first > step_data.step_index && step_data.rise(first - 1) > floor) --first;
    while (last + 1 < step_data.smoothed.size() && step_data.rise(last + 1) > floor) ++last;
    const Index count = last - first + 1;
    const double span = step_data.t[last] - step_data.t[first];
    const Vector x = (step_data.t.segment(first, count).array() - step_data.t[top]) / span;
    Matrix basis(count, 4);
    basis << x.array().cube(), x.cwiseAbs2(), x, Vector::Ones(count);
    const Vector c = solve_least_squares(basis, step_data.smoothed.segment(first, count)).solution;
    // Newton on the slope 3 c0 x^2 + 2 c1 x + c2 from the highest sample.
    double peak = 0;
    for (int i = 0; i < 20; ++i) {
        const double curvature = 6 * c[0] * peak + 2 * c[1];
        if (curvature == 0) break;
        peak = std::clamp(peak - (3 * c[0] * peak * peak + 2 * c[1] * peak + c[2]) / curvature, x[0], x[count - 1]);
    }
    return {"overshoot", step_data.t[top] + peak * span, evaluate(c, peak)};
}

ReadingPoint overshoot_point(const StepData& step_data) {
    const Index N = step_data.smoothed.size();
    Index top = step_data.step_index;
    for (Index k = top; k < N; ++k)
        if (step_data.rise(k) > step_data.rise(top)) top = k;
    // The level of rounding and of what the smoothing leaves of the noise; below it a peak means nothing.
    const double least = std::max(0.01, 2 * step_data.noise_std / std::abs(step_data.output_change()));
    if (step_data.rise(top) - 1 < least || top == N - 1)
        throw InvalidArgument(
            "The response does not overshoot its final level by more than {} %, so the damping cannot be determined: "
            "use step_first_order or step_delayed",
            significant(100 * least, kDigits));
    if (top < step_data.step_index + 3)
        throw InvalidArgument("The response peaks within three samples after the step: sample faster");
    return peak_around(step_data, top);
}

}  // namespace

StepTestResult step_first_order(const IdData& data) {
    StepTestResult result = begin_reading(data, {"K", "T"}, 2);
    const StepData& step_data = result.step_data;
    const ReadingPoint settling = settling_point(step_data, 0.05);
    const double settling_time = settling.time - step_data.step_time;
    if (settling.time <= step_data.t[std::min(step_data.step_index + 2, step_data.t.size() - 1)])
        throw InvalidArgument("The response settles within two samples after the step: sample faster");
    const double K = result.parameters[0], T = settling_time / 3;
    result.parameters << K, T;
    result.points = {settling};
    result.model = TransferFunction(Vector::Constant(1, K), Vector{{T, 1.0}});
    const Message reading =
        Message("The 5 % settling time of the smoothed response is {} {}, which equals three time constants.",
                significant(settling_time, kDigits), data.time_unit);
    result.message =
        highest_rise(step_data) > 1.05
            ? sentences({reading, Message("The response overshoots: a second-order model would be better.")})
            : reading;
    return result;
}

StepTestResult step_second_order(const IdData& data) {
    StepTestResult result = begin_reading(data, {"K", "z", "w0"}, 2);
    const StepData& step_data = result.step_data;
    const ReadingPoint peak = overshoot_point(step_data);
    const double D1 = (peak.value - step_data.final.value) / step_data.output_change();
    const double logarithm = std::log(D1), pi = std::numbers::pi;
    if (D1 >= 1)
        throw InvalidArgument(
            "The first overshoot is at least as large as the change of the output, which is impossible for a damped "
            "second-order system. Check the data for a disturbance or a drift");
    const double z = std::sqrt(logarithm * logarithm / (logarithm * logarithm + pi * pi));
    const double w0 = pi / ((peak.time - step_data.step_time) * std::sqrt(1 - z * z));
    const double K = result.parameters[0];
    result.parameters << K, z, w0;
    result.points = {peak};
    result.model = TransferFunction(Vector::Constant(1, K * w0 * w0), Vector{{1.0, 2 * z * w0, w0 * w0}});
    result.message =
        Message("The first overshoot is {} % of the change of the output, {} {} after the step.",
                significant(100 * D1, kDigits), significant(peak.time - step_data.step_time, kDigits), data.time_unit);
    return result;
}

namespace {

/// The time between the samples around `time`, which is not after the last sample.
double interval_around(const Vector& t, double time) {
    const Index after = std::max<Index>(1, std::lower_bound(t.begin(), t.end(), time) - t.begin());
    return t[after] - t[after - 1];
}

}  // namespace

StepTestResult step_delayed(const IdData& data) {
    // A wider window would reach from the first point across the corner where the delay ends.
    StepTestResult result = begin_reading(data, {"K", "T", "D"}, 1);
    const StepData& step_data = result.step_data;
    const double rise1 = -std::expm1(-1.0 / 3), rise2 = -std::expm1(-1.0);
    const double t1 = step_data.crossing_time(rise1), t2 = step_data.crossing_time(rise2);
    const double K = result.parameters[0], T = 1.5 * (t2 - t1);
    if (t2 - t1 < interval_around(step_data.t, t2))
        throw InvalidArgument("The response rises from 28.3 % to 63.2 % within one sample: sample faster");
    const double D = std::max(0.0, t2 - step_data.step_time - T);
    result.parameters << K, T, D;
    result.points = {{"28.3 %", t1, output_at(step_data, rise1)}, {"63.2 %", t2, output_at(step_data, rise2)}};
    result.model = TransferFunction(Vector::Constant(1, K), Vector{{T, 1.0}}, 0, D);
    const Message reading = Message(
        "The smoothed response reaches 28.3 % and 63.2 % of its change {} and {} {} after the step.",
        significant(t1 - step_data.step_time, kDigits), significant(t2 - step_data.step_time, kDigits), data.time_unit);
    result.message =
        D == 0 ? sentences({reading, Message("The response shows no delay: use step_first_order.")}) : reading;
    return result;
}

}  // namespace dynlab::inline numerics
