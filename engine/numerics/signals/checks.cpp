#include "numerics/signals/checks.h"

#include <array>
#include <cmath>

#include "numerics/error.h"

namespace dynlab::inline numerics {

namespace {

// Whole sentences for the input, the output, the reference and the signal, because languages decline their names.

Message of(SignalName name, const std::array<Message, 4>& all) {
    return all[static_cast<std::size_t>(name)];
}

Message not_a_number(SignalName name, Index sample) {
    return of(
        name,
        {{Message("sample {} of the input is not a number (NaN); fillmissing(u, {method = \"previous\"}) repeats the "
                  "previous value",
                  sample),
          Message("sample {} of the output is not a number (NaN); fillmissing(y) interpolates missing samples", sample),
          Message("sample {} of the reference is not a number (NaN); fillmissing(r, {method = \"previous\"}) repeats "
                  "the previous value",
                  sample),
          Message("sample {} of the signal is not a number (NaN); fillmissing(x) interpolates missing samples",
                  sample)}});
}

Message not_a_number(SignalName name, Index sample, Index channel) {
    return of(name, {{Message("sample {} of channel {} of the input is not a number (NaN); fillmissing(u, {method = "
                              "\"previous\"}) repeats the previous value",
                              sample, channel),
                      Message("sample {} of channel {} of the output is not a number (NaN); fillmissing(y) "
                              "interpolates missing samples",
                              sample, channel),
                      Message("sample {} of channel {} of the reference is not a number (NaN); fillmissing(r, {method "
                              "= \"previous\"}) repeats the previous value",
                              sample, channel),
                      Message("sample {} of channel {} of the signal is not a number (NaN); fillmissing(x) "
                              "interpolates missing samples",
                              sample, channel)}});
}

Message infinite(SignalName name, Index sample) {
    return of(name, {{Message("sample {} of the input is infinite", sample),
                      Message("sample {} of the output is infinite", sample),
                      Message("sample {} of the reference is infinite", sample),
                      Message("sample {} of the signal is infinite", sample)}});
}

Message infinite(SignalName name, Index sample, Index channel) {
    return of(name, {{Message("sample {} of channel {} of the input is infinite", sample, channel),
                      Message("sample {} of channel {} of the output is infinite", sample, channel),
                      Message("sample {} of channel {} of the reference is infinite", sample, channel),
                      Message("sample {} of channel {} of the signal is infinite", sample, channel)}});
}

Message too_large(SignalName name) {
    return of(
        name,
        {{Message("the sum of the samples of the input overflows: use a larger unit, so that the values are smaller"),
          Message("the sum of the samples of the output overflows: use a larger unit, so that the values are smaller"),
          Message(
              "the sum of the samples of the reference overflows: use a larger unit, so that the values are smaller"),
          Message(
              "the sum of the samples of the signal overflows: use a larger unit, so that the values are smaller")}});
}

Message no_samples(SignalName name) {
    return of(name, {{Message("the input has no samples"), Message("the output has no samples"),
                      Message("the reference has no samples"), Message("the signal has no samples")}});
}

Message largest_too_small(SignalName name, double largest) {
    return of(name, {{Message("the largest sample of the input is {}, which is too small for sums of squares: use a "
                              "smaller unit, so that the values are larger",
                              largest),
                      Message("the largest sample of the output is {}, which is too small for sums of squares: use a "
                              "smaller unit, so that the values are larger",
                              largest),
                      Message("the largest sample of the reference is {}, which is too small for sums of squares: use "
                              "a smaller unit, so that the values are larger",
                              largest),
                      Message("the largest sample of the signal is {}, which is too small for sums of squares: use a "
                              "smaller unit, so that the values are larger",
                              largest)}});
}

Message largest_too_large(SignalName name, double largest) {
    return of(name, {{Message("the largest sample of the input is {}, which is too large for sums of squares: use a "
                              "larger unit, so that the values are smaller",
                              largest),
                      Message("the largest sample of the output is {}, which is too large for sums of squares: use a "
                              "larger unit, so that the values are smaller",
                              largest),
                      Message("the largest sample of the reference is {}, which is too large for sums of squares: use "
                              "a larger unit, so that the values are smaller",
                              largest),
                      Message("the largest sample of the signal is {}, which is too large for sums of squares: use a "
                              "larger unit, so that the values are smaller",
                              largest)}});
}

Message error_in_sample(SignalName name, const MatrixView& samples) {
    for (Index column = 0; column < samples.cols(); ++column)
        for (Index row = 0; row < samples.rows(); ++row) {
            const double value = samples(row, column);
            if (std::isfinite(value)) continue;
            if (samples.cols() == 1) return std::isnan(value) ? not_a_number(name, row + 1) : infinite(name, row + 1);
            return std::isnan(value) ? not_a_number(name, row + 1, column + 1) : infinite(name, row + 1, column + 1);
        }
    return too_large(name);
}

constexpr double kMaxValue = 1e100, kMinValue = 1e-100;  // whose squares can still be summed

}  // namespace

Message error_in_samples(SignalName name, const MatrixView& samples) {
    if (samples.rows() == 0) return no_samples(name);
    return std::isfinite(samples.sum()) ? Message() : error_in_sample(name, samples);
}

void check_samples(const std::string& caller, SignalName name, const MatrixView& samples) {
    if (const Message error = error_in_samples(name, samples); !error.empty())
        throw InvalidArgument("{}: {}", caller, error);
}

void check_magnitudes(const std::string& caller, SignalName name, const MatrixView& samples) {
    for (Index column = 0; column < samples.cols(); ++column) {
        const double largest = samples.col(column).cwiseAbs().maxCoeff();
        if (largest == 0 || (largest > kMinValue && largest < kMaxValue)) continue;
        throw InvalidArgument("{}: {}", caller,
                              largest < 1 ? largest_too_small(name, largest) : largest_too_large(name, largest));
    }
}

bool valid_sampling_time(double Ts) {
    return Ts > 0 && std::isfinite(Ts);
}

void check_sampling_time(const std::string& caller, double Ts) {
    if (valid_sampling_time(Ts)) return;
    throw InvalidArgument("{}: the sampling time must be a positive number of seconds, but it is {}", caller, Ts);
}

void check_instants(const std::string& caller, const VectorView& t) {
    for (Index k = 0; k < t.size(); ++k) {
        if (!std::isfinite(t(k)))
            throw InvalidArgument("{}: instant {} of the time vector is not a finite number", caller, k + 1);
        if (k > 0 && t(k) <= t(k - 1))
            throw InvalidArgument(
                "{}: the time vector must be increasing, but instant {} is {} and the previous instant is {}", caller,
                k + 1, significant(t(k), 9), significant(t(k - 1), 9));
    }
}

}  // namespace dynlab::inline numerics
