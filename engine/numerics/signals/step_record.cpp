#include "numerics/signals/step_record.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "numerics/error.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/signals/robust_statistics.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kSamplesAfterStep = 10;

std::vector<double> to_std(const VectorView& x) {
    return {x.begin(), x.end()};
}

double trimmed_mean(const VectorView& x) {
    std::vector<double> values = to_std(x);
    std::sort(values.begin(), values.end());
    const std::size_t dropped = values.size() / 5;
    double sum = 0;
    for (std::size_t i = dropped; i < values.size() - dropped; ++i) sum += values[i];
    return sum / static_cast<double>(values.size() - 2 * dropped);
}

void require_one_record(const IdData& data) {
    if (data.experiments.size() == 1 && data.input_count() == 1 && data.output_count() == 1) return;
    throw InvalidArgument(
        "A step test needs one experiment with one input and one output, but the data have {}, {} and {}: select one "
        "of each",
        plural(std::ssize(data.experiments), "{} experiment", "{} experiments"),
        plural(data.input_count(), "{} input", "{} inputs"), plural(data.output_count(), "{} output", "{} outputs"));
}

// Sets step_index, step_time and the two input levels.
void find_step(StepRecord& record) {
    const Vector& u = record.u;
    const double low = u.minCoeff(), high = u.maxCoeff();
    if (high == low) {
        if (low == 0) throw InvalidArgument("The input is zero throughout, so the data contain no step");
        record.input_after = low;
        record.step_time = record.t[0];
        return;
    }
    const double middle = 0.5 * (low + high);
    const bool starts_high = u[0] > middle;
    Index changes = 0;
    for (Index k = 1; k < u.size(); ++k) {
        if ((u[k] > middle) == (u[k - 1] > middle)) continue;
        if (changes++ == 0) record.step_index = k;
    }
    if (changes == 1) {
        record.step_time = record.t[record.step_index];
        record.input_before = median(u.head(record.step_index));
        record.input_after = median(u.tail(u.size() - record.step_index));
        const double tolerance = 0.1 * std::abs(record.input_change());
        Vector departure = u.array() - record.input_before;
        departure.tail(u.size() - record.step_index).array() -= record.input_change();
        Index worst = 0;
        if (departure.cwiseAbs().maxCoeff(&worst) <= tolerance) return;
        throw InvalidArgument("The input is not a step: at t = {} it is {}, but the two levels are {} and {}",
                              significant(record.t[worst], 6), significant(u[worst], 6),
                              significant(record.input_before, 6), significant(record.input_after, 6));
    }
    if (starts_high)
        throw InvalidArgument(
            "The input is not a step: it changes {} times between high and low levels, but a step test needs exactly "
            "one change. Select one step with data:range(i, j)",
            changes);
    throw InvalidArgument(
        "The input is not a step: it changes {} times between low and high levels, but a step test needs exactly one "
        "change. Select one step with data:range(i, j)",
        changes);
}

Level level_of(const StepRecord& record, Index first, Index count) {
    return {trimmed_mean(record.y.segment(first, count)), record.t[first], record.t[first + count - 1]};
}

void read_levels(StepRecord& record) {
    const Index N = record.y.size(), after = N - record.step_index;
    if (after < kSamplesAfterStep)
        throw InvalidArgument("The data have {} after the step, but at least {} are needed to evaluate the response",
                              plural(after, "{} sample", "{} samples"), kSamplesAfterStep);
    // The sample at the step itself still shows the old level: the output of a system with a lag cannot jump.
    record.initial = level_of(record, 0, record.step_index + 1);
    const Index tail = std::max<Index>(3, after / 10);
    record.final = level_of(record, N - tail, tail);
    record.noise_std = noise_from_differences(record.y.tail(after));
    const double uncertainty = record.noise_std * std::sqrt(1.0 / static_cast<double>(record.step_index + 1) +
                                                            1.0 / static_cast<double>(tail));
    if (std::abs(record.output_change()) > 5 * uncertainty && record.output_change() != 0) return;
    throw InvalidArgument(
        "The output does not respond to the step: it changes from {} to {}, and the noise has a standard deviation of "
        "{}",
        significant(record.initial.value, 6), significant(record.final.value, 6), significant(record.noise_std, 6));
}

// Value at t[k] of the least-squares parabola through samples first..last of y.
double local_parabola(const StepRecord& record, const Vector& y, Index k, Index first, Index last) {
    const Index count = last - first + 1;
    const double span = record.t[last] - record.t[first];
    const Vector x = (record.t.segment(first, count).array() - record.t[k]) / span;
    Matrix basis(count, 3);
    basis << Vector::Ones(count), x, x.cwiseAbs2();
    return solve_semidefinite(basis.transpose() * basis, basis.transpose() * y.segment(first, count))[0];
}

// Samples from 28.3 % to 63.2 % of the rise, from a running median of five that no single outlier can pass.
Index rough_rise(const StepRecord& record) {
    const Index N = record.y.size();
    Index from = -1;
    for (Index k = record.step_index; k < N; ++k) {
        const Index first = std::max(record.step_index, k - 2), count = std::min(N - 1, k + 2) - first + 1;
        const double rise = (median(record.y.segment(first, count)) - record.initial.value) / record.output_change();
        if (from < 0 && rise > 0.283) from = k;
        if (rise > 0.632) return k - from;
    }
    return 0;
}

Index smoothing_window(const StepRecord& record, double widest_window) {
    // The center of a parabola through w samples has the variance 9/4 noise^2/w.
    const double requested = 2.25 * std::pow(record.noise_std / (0.0025 * record.output_change()), 2);
    return static_cast<Index>(std::min(requested, widest_window * static_cast<double>(rough_rise(record))));
}

// The output with single outliers replaced by the median of three neighbors.
Vector without_outliers(const StepRecord& record) {
    const double allowed = 6 * record.noise_std + 0.25 * std::abs(record.output_change());
    Vector y = record.y;
    for (Index k = 1; k + 1 < y.size(); ++k) {
        const double middle = median(record.y.segment(k - 1, 3));
        if (std::abs(record.y[k] - middle) > allowed) y[k] = middle;
    }
    return y;
}

void smooth(StepRecord& record, Index window) {
    const Index N = record.y.size(), half = window / 2;
    const Vector y = without_outliers(record);
    record.smoothed = y;
    record.smoothed.head(record.step_index).setConstant(record.initial.value);
    if (half < 2) return;
    for (Index k = record.step_index; k < N; ++k) {
        const Index first = std::max(record.step_index, k - half), last = std::min(N - 1, k + half);
        record.smoothed[k] = local_parabola(record, y, k, first, last);
    }
}

// A response that still moves over its last fifth has no final level to read.
void require_settled(const StepRecord& record) {
    const Index N = record.y.size(), tail = std::max<Index>(3, (N - record.step_index) / 10);
    const double change = std::abs(record.output_change());
    const double drift = std::abs(trimmed_mean(record.y.segment(N - 2 * tail, tail)) - record.final.value);
    const double uncertainty = record.noise_std * std::sqrt(2.0 / static_cast<double>(tail));
    const Vector last = record.smoothed.tail(tail);
    const double swing = last.maxCoeff() - last.minCoeff();
    const bool drifts = drift > 0.015 * change + 3 * uncertainty;
    const bool swings = swing > 0.1 * change + 3 * record.noise_std;
    if (!drifts && !swings) return;
    throw InvalidArgument(
        "The response has not settled at the end of the data: it still changes by {} % of its total change, so the "
        "final level is unknown. Use data of a longer experiment",
        significant(100 * (drifts ? drift : swing) / change, 6));
}

}  // namespace

double StepRecord::crossing_time(double part) const {
    for (Index k = std::max<Index>(step_index, 1); k < smoothed.size(); ++k) {
        if (rise(k) < part) continue;
        if (k == step_index) return t[k];
        const double before = rise(k - 1), after = rise(k);
        return t[k - 1] + (t[k] - t[k - 1]) * (part - before) / (after - before);
    }
    throw InvalidArgument("The response never reaches the required fraction of its change");
}

StepRecord read_step_record(const IdData& data, double widest_window) {
    require_one_record(data);
    StepRecord record;
    record.t = data.time();
    record.u = data.experiments.front().u.col(0);
    record.y = data.experiments.front().y.col(0);
    find_step(record);
    read_levels(record);
    smooth(record, smoothing_window(record, widest_window));
    require_settled(record);
    return record;
}

}  // namespace dynlab::inline numerics
