#include "numerics/signals/step_data.h"

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

void require_one_experiment(const IdData& data) {
    if (data.experiments.size() == 1 && data.input_count() == 1 && data.output_count() == 1) return;
    throw InvalidArgument(
        "A step test needs one experiment with one input and one output, but the data have {}, {} and {}: select one "
        "of each",
        plural(std::ssize(data.experiments), "{} experiment", "{} experiments"),
        plural(data.input_count(), "{} input", "{} inputs"), plural(data.output_count(), "{} output", "{} outputs"));
}

// Sets step_index, step_time and the two input levels.
void find_step(StepData& step_data) {
    const Vector& u = step_data.u;
    const double low = u.minCoeff(), high = u.maxCoeff();
    if (high == low) {
        if (low == 0)
            throw InvalidArgument(
                "The input is zero in all samples, so the data contain no step. Use data of a step experiment");
        step_data.input_after = low;
        step_data.step_time = step_data.t[0];
        return;
    }
    const double middle = 0.5 * (low + high);
    const bool starts_high = u[0] > middle;
    Index changes = 0;
    for (Index k = 1; k < u.size(); ++k) {
        if ((u[k] > middle) == (u[k - 1] > middle)) continue;
        if (changes++ == 0) step_data.step_index = k;
    }
    if (changes == 1) {
        step_data.step_time = step_data.t[step_data.step_index];
        step_data.input_before = median(u.head(step_data.step_index));
        step_data.input_after = median(u.tail(u.size() - step_data.step_index));
        const double tolerance = 0.1 * std::abs(step_data.input_change());
        Vector departure = u.array() - step_data.input_before;
        departure.tail(u.size() - step_data.step_index).array() -= step_data.input_change();
        Index worst = 0;
        if (departure.cwiseAbs().maxCoeff(&worst) <= tolerance) return;
        throw InvalidArgument(
            "The input is not a step: at t = {} it is {}, but the two levels are {} and {}. Select one step with "
            "data:range(i, j)",
            significant(step_data.t[worst], 6), significant(u[worst], 6), significant(step_data.input_before, 6),
            significant(step_data.input_after, 6));
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

Level level_of(const StepData& step_data, Index first, Index count) {
    return {trimmed_mean(step_data.y.segment(first, count)), step_data.t[first], step_data.t[first + count - 1]};
}

void read_levels(StepData& step_data) {
    const Index N = step_data.y.size(), after = N - step_data.step_index;
    if (after < kSamplesAfterStep)
        throw InvalidArgument(
            "The data have {} after the step, but at least {} are needed to evaluate the response. Use data of a "
            "longer experiment",
            plural(after, "{} sample", "{} samples"), kSamplesAfterStep);
    // The sample at the step itself still shows the old level: the output of a system with a lag cannot jump.
    step_data.initial = level_of(step_data, 0, step_data.step_index + 1);
    const Index tail = std::max<Index>(3, after / 10);
    step_data.final = level_of(step_data, N - tail, tail);
    step_data.noise_std = noise_from_differences(step_data.y.tail(after));
    const double uncertainty = step_data.noise_std * std::sqrt(1.0 / static_cast<double>(step_data.step_index + 1) +
                                                               1.0 / static_cast<double>(tail));
    if (std::abs(step_data.output_change()) > 5 * uncertainty && step_data.output_change() != 0) return;
    throw InvalidArgument(
        "The output does not respond to the step by more than the noise: it changes from {} to {}, and the noise has a "
        "standard deviation of {}. Check the columns, or use a larger step",
        significant(step_data.initial.value, 6), significant(step_data.final.value, 6),
        significant(step_data.noise_std, 6));
}

// Value at t[k] of the least-squares parabola through samples first..last of y.
double local_parabola(const StepData& step_data, const Vector& y, Index k, Index first, Index last) {
    const Index count = last - first + 1;
    const double span = step_data.t[last] - step_data.t[first];
    const Vector x = (step_data.t.segment(first, count).array() - step_data.t[k]) / span;
    Matrix basis(count, 3);
    basis << Vector::Ones(count), x, x.cwiseAbs2();
    return solve_semidefinite(basis.transpose() * basis, basis.transpose() * y.segment(first, count))[0];
}

// Samples from 28.3 % to 63.2 % of the rise, from a running median of five that no single outlier can pass.
Index rough_rise(const StepData& step_data) {
    const Index N = step_data.y.size();
    Index from = -1;
    for (Index k = step_data.step_index; k < N; ++k) {
        const Index first = std::max(step_data.step_index, k - 2), count = std::min(N - 1, k + 2) - first + 1;
        const double rise =
            (median(step_data.y.segment(first, count)) - step_data.initial.value) / step_data.output_change();
        if (from < 0 && rise > 0.283) from = k;
        if (rise > 0.632) return k - from;
    }
    return 0;
}

Index smoothing_window(const StepData& step_data, double widest_window) {
    // The center of a parabola through w samples has the variance 9/4 noise^2/w.
    const double requested = 2.25 * std::pow(step_data.noise_std / (0.0025 * step_data.output_change()), 2);
    return static_cast<Index>(std::min(requested, widest_window * static_cast<double>(rough_rise(step_data))));
}

// The output with single outliers replaced by the median of three neighbors.
Vector without_outliers(const StepData& step_data) {
    const double allowed = 6 * step_data.noise_std + 0.25 * std::abs(step_data.output_change());
    Vector y = step_data.y;
    for (Index k = 1; k + 1 < y.size(); ++k) {
        const double middle = median(step_data.y.segment(k - 1, 3));
        if (std::abs(step_data.y[k] - middle) > allowed) y[k] = middle;
    }
    return y;
}

void smooth(StepData& step_data, Index window) {
    const Index N = step_data.y.size(), half = window / 2;
    const Vector y = without_outliers(step_data);
    step_data.smoothed = y;
    step_data.smoothed.head(step_data.step_index).setConstant(step_data.initial.value);
    if (half < 2) return;
    for (Index k = step_data.step_index; k < N; ++k) {
        const Index first = std::max(step_data.step_index, k - half), last = std::min(N - 1, k + half);
        step_data.smoothed[k] = local_parabola(step_data, y, k, first, last);
    }
}

// A response that still moves over its last fifth has no final level to read.
void require_settled(const StepData& step_data) {
    const Index N = step_data.y.size(), tail = std::max<Index>(3, (N - step_data.step_index) / 10);
    const double change = std::abs(step_data.output_change());
    const double drift = std::abs(trimmed_mean(step_data.y.segment(N - 2 * tail, tail)) - step_data.final.value);
    const double uncertainty = step_data.noise_std * std::sqrt(2.0 / static_cast<double>(tail));
    const Vector last = step_data.smoothed.tail(tail);
    const double swing = last.maxCoeff() - last.minCoeff();
    const bool drifts = drift > 0.015 * change + 3 * uncertainty;
    const bool swings = swing > 0.1 * change + 3 * step_data.noise_std;
    if (!drifts && !swings) return;
    throw InvalidArgument(
        "The response has not settled at the end of the data: it still changes by {} % of its total change, so the "
        "final level is unknown. Use data of a longer experiment",
        significant(100 * (drifts ? drift : swing) / change, 6));
}

}  // namespace

double StepData::crossing_time(double part) const {
    for (Index k = std::max<Index>(step_index, 1); k < smoothed.size(); ++k) {
        if (rise(k) < part) continue;
        if (k == step_index) return t[k];
        const double before = rise(k - 1), after = rise(k);
        return t[k - 1] + (t[k] - t[k - 1]) * (part - before) / (after - before);
    }
    throw InvalidArgument(
        "The response never reaches the fraction of its change that this method evaluates. Use data of a longer "
        "experiment");
}

StepData read_step_data(const IdData& data, double widest_window) {
    require_one_experiment(data);
    StepData step_data;
    step_data.t = data.time();
    step_data.u = data.experiments.front().u.col(0);
    step_data.y = data.experiments.front().y.col(0);
    find_step(step_data);
    read_levels(step_data);
    smooth(step_data, smoothing_window(step_data, widest_window));
    require_settled(step_data);
    return step_data;
}

}  // namespace dynlab::inline numerics
