#include "data_io/counted_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace dynlab::inline data_io {
namespace {

constexpr double kDayOfSeconds = 86400;
constexpr TimeUnitOfNumbers kSecond{1, "s"}, kMilli{1e-3, "ms"}, kMicro{1e-6, "us"}, kNano{1e-9, "ns"},
    kDayUnit{kDayOfSeconds, "days"};

/// Whether a number is one that people choose: of two digits, or one over such a number.
bool is_short(double number) {
    constexpr double kClose = 2e-4;
    const auto close = [](double value) {
        const double written = std::stod(fmt::format("{:.2g}", value));
        return std::abs(written - value) <= kClose * std::abs(value);
    };
    return number > 0 && (close(number) || close(1 / number));
}

class CountedUnit {
  public:
    CountedUnit(const Vector& values, std::optional<double> Ts, bool is_called_time)
        : first_(values[0]),
          step_(median_step(values)),
          last_(values[values.size() - 1]),
          whole_((values.array() == values.array().round()).all()),
          even_(std::abs((last_ - first_) / static_cast<double>(values.size() - 1) - step_) < 1e-3 * step_),
          Ts_(Ts),
          called_(is_called_time) {}

    Counted find() const {
        if (const auto stated = stated_unit()) return {*stated};
        if (is_days()) return {kDayUnit, true, true};
        if (is_of_sheet() && whole_ && step_ < 32) return {kDayUnit, true, true, kSecond};
        if (is_part_of_day()) return {kDayUnit, false, true, kSecond};
        for (const TimeUnitOfNumbers unit : {kSecond, kMilli, kMicro, kNano})
            if (is_since_1970(unit.seconds)) return {unit, true, true};
        if (!whole_) return {kSecond, false, !called_ || step_ >= 5 || may_be_slow()};
        constexpr std::array<double, 23> kSeconds = {1,    2,    3,     4,     30,    60,    120,  180,
                                                     240,  300,  360,   600,   720,   900,   1200, 1800,
                                                     3600, 7200, 10800, 14400, 21600, 43200, 86400};
        if (std::ranges::find(kSeconds, step_) != kSeconds.end()) return {kSecond, false, true};
        constexpr double kThousand = 1e3, kMillion = 1e6;
        if (step_ < kThousand) return {kMilli, false, true, kSecond};
        if (step_ < kMillion) return {kMicro, false, true, kMilli};
        return {kNano, false, true, kMicro};
    }

  private:
    /// With which the samples follow each other as the file states.
    std::optional<TimeUnitOfNumbers> stated_unit() const {
        constexpr double kClose = 0.01;
        for (const TimeUnitOfNumbers unit : {kSecond, kMilli, kMicro, kNano})
            if (Ts_ && std::abs(step_ * unit.seconds - *Ts_) < kClose * *Ts_) return unit;
        return std::nullopt;
    }
    /// Whether seconds are no step that people choose, but minutes, hours or days are.
    bool may_be_slow() const {
        return !is_short(step_) && (is_short(step_ * 60) || is_short(step_ * 3600) || is_short(step_ * kDayOfSeconds));
    }
    bool is_since_1970(double seconds) const {
        constexpr double kFirst = 5e8, kLast = 4.1e9, kMonth = 31 * kDayOfSeconds, kSlow = 100;
        const double since = first_ * seconds, step = step_ * seconds;
        const bool likely = step <= kSlow || std::fmod(step, 60) == 0;
        return since > kFirst && since < kLast && step <= kMonth && likely;
    }
    bool is_of_sheet() const { return first_ > 20'000 && 80'000 > first_; }  // since 1900
    /// Of spreadsheets, or of MATLAB, since the year 0.
    bool is_days() const {
        const bool matlab = first_ > 700'000 && 780'000 > first_;
        if (!(is_of_sheet() || matlab) || whole_ || step_ >= 1) return false;
        return is_short(step_ * kDayOfSeconds) || !is_short(step_);
    }
    /// A spreadsheet's times of day: even steps that are whole seconds in days, and no number that people choose.
    bool is_part_of_day() const {
        const double seconds = step_ * kDayOfSeconds;
        return even_ && last_ < 1 && !is_short(step_) && std::abs(seconds - std::round(seconds)) < 2e-4 * seconds;
    }

    double first_, step_, last_;
    bool whole_, even_;
    std::optional<double> Ts_;
    bool called_;
};

}  // namespace

double quantum_of(const Vector& values) {
    constexpr double kClose = 1e-3, kMin = 1e-9;
    for (double quantum = 1; quantum > kMin / 2; quantum /= 10) {
        const auto count = values.array() / quantum;
        if (((count - count.round()).abs() < kClose).all()) return quantum;
    }
    return 0;
}

double median_step(const Vector& values) {
    std::vector<double> steps;
    for (Index i = 0; i + 1 < values.size(); ++i)
        if (values[i + 1] > values[i]) steps.push_back(values[i + 1] - values[i]);
    if (steps.empty()) return 0;
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    return *middle;
}

double count_on(Vector& values, std::span<const double> ranges) {
    const double usual = median_step(values), largest = values.maxCoeff(), least = values.minCoeff();
    constexpr double kMaxLength = 10;  // usual steps across the end of the range
    const auto fits = [&](double range) {
        if (largest - least >= range) return false;
        bool wraps = false;
        for (Index i = 0; i + 1 < values.size(); ++i) {
            const double step = values[i + 1] - values[i];
            if (step >= 0 || std::isnan(step)) continue;
            wraps = true;
            if (step + range <= 0 || step + range > kMaxLength * usual) return false;
        }
        return wraps;
    };
    const auto range = std::ranges::find_if(ranges, fits);
    if (usual == 0 || range == ranges.end()) return 0;
    double lost = 0, before = values[0];
    for (double& value : values) {
        if (value < before) lost += *range;
        before = value;
        value += lost;
    }
    return *range;
}

Counted counted_unit(const Vector& values, std::optional<double> Ts, bool is_called_time) {
    return CountedUnit(values, Ts, is_called_time).find();
}

}  // namespace dynlab::inline data_io
