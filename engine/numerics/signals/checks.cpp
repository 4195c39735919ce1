#include "numerics/signals/checks.h"

#include <cmath>

#include "base/number_text.h"
#include "numerics/error.h"

namespace dynlab::inline numerics {

namespace {

[[noreturn]] void report_sample(const std::string& caller, const std::string& name, const MatrixView& samples) {
    for (Index column = 0; column < samples.cols(); ++column)
        for (Index row = 0; row < samples.rows(); ++row) {
            const double value = samples(row, column);
            if (std::isfinite(value)) continue;
            const std::string channel = samples.cols() > 1 ? " of channel " + std::to_string(column + 1) : "";
            throw InvalidArgument(
                caller + ": sample " + std::to_string(row + 1) + channel + " of " + name +
                (std::isnan(value) ? " is not a number (NaN); fillmissing(x) mends missing samples" : " is infinite"));
        }
    throw InvalidArgument(caller + ": " + name + " holds samples too large to work with");
}

constexpr double kLargest = 1e100, kSmallest = 1e-100;  // whose squares can still be summed

}  // namespace

void check_samples(const std::string& caller, const std::string& name, const MatrixView& samples) {
    if (samples.rows() == 0) throw InvalidArgument(caller + ": " + name + " has no samples");
    if (!std::isfinite(samples.sum())) report_sample(caller, name, samples);
}

void check_magnitudes(const std::string& caller, const std::string& name, const MatrixView& samples) {
    for (Index column = 0; column < samples.cols(); ++column) {
        const double largest = samples.col(column).cwiseAbs().maxCoeff();
        if (largest == 0 || (largest > kSmallest && largest < kLargest)) continue;
        throw InvalidArgument(caller + ": the largest sample of " + name + " is " + number_text(largest) +
                              ", which is too " + (largest < 1 ? "small" : "large") +
                              " to compute with squares: use another unit");
    }
}

void check_sampling_time(const std::string& caller, double Ts) {
    if (Ts > 0 && std::isfinite(Ts)) return;
    throw InvalidArgument(caller + ": the sampling time must be a positive number of seconds, but it is " +
                          number_text(Ts));
}

void check_instants(const std::string& caller, const VectorView& t) {
    for (Index k = 0; k < t.size(); ++k) {
        if (!std::isfinite(t(k)))
            throw InvalidArgument(caller + ": instant " + std::to_string(k + 1) +
                                  " of the time vector is not a finite number");
        if (k > 0 && t(k) <= t(k - 1))
            throw InvalidArgument(caller + ": the time must increase from sample to sample, but instant " +
                                  std::to_string(k + 1) + " is " + number_text(t(k), 9) + " after " +
                                  number_text(t(k - 1), 9));
    }
}

}  // namespace dynlab::inline numerics
