#include "figures/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "figures/figure_text.h"

namespace dynlab::inline figures {
namespace {

constexpr double kMaxAxisValue = 1e300;                   // keeps spans and margins finite
constexpr double kMaxAxisEnd = 1e305, kMinSpan = 1e-305;  // of an axis

std::string with_minus_sign(std::string text) {
    if (!text.empty() && text.front() == '-') text.replace(0, 1, "−");
    return text;
}

double round_step(double rough) {
    const double decade = std::pow(10.0, std::floor(std::log10(rough)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * decade >= rough * 0.999) return factor * decade;
    return 10 * decade;
}

/// Power of ten to take out of the labels: none while they stay short.
int common_exponent(double largest, double step) {
    const int magnitude = static_cast<int>(std::floor(std::log10(largest)));
    const int finest = static_cast<int>(std::floor(std::log10(step) + 1e-9));
    return magnitude >= 5 || (magnitude < 0 && finest <= -4) ? magnitude : 0;
}

/// Decimals with which multiples of a step such as 0.25 are written out.
int decimals_of(double step) {
    constexpr int kMax = 12;
    int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, kMax);
    const auto left_over = [step](int digits) {
        const double scaled = step * std::pow(10.0, digits);
        return std::abs(scaled - std::round(scaled)) / scaled;
    };
    if (left_over(decimals) > 1e-6 && decimals < kMax && left_over(decimals + 1) < 1e-6) ++decimals;
    return decimals;
}

void add_linear_ticks(Axis& axis, double count, std::optional<double> wanted_step) {
    const double span = axis.high - axis.low;
    double step = wanted_step.value_or(round_step(span / std::max(count, 1.0)));
    if (span / step > 4 * count + 4) step = round_step(span / count);
    const double largest = std::max(std::abs(axis.low), std::abs(axis.high));
    axis.exponent = common_exponent(largest, step);
    const double unit = std::pow(10.0, axis.exponent);
    const int decimals = decimals_of(step / unit);
    const double slack = 1e-9 * span;
    for (double k = std::ceil((axis.low - slack) / step); k * step <= axis.high + slack; ++k) {
        axis.ticks.push_back(
            {k * step, with_minus_sign(fmt::format("{:.{}f}", k == 0 ? 0.0 : k * step / unit, decimals))});
        if (axis.ticks.size() > 100) break;  // neighboring floating-point numbers: k no longer advances
    }
}

/// The digits 1 to 9 that are numbered in every decade, from few to many.
constexpr std::array<std::string_view, 4> kNumberedDigits = {"1", "13", "125", "12357"};

bool numbers_digit(std::string_view digits, int digit) {
    return digits.find(static_cast<char>('0' + digit)) != std::string_view::npos;
}

int count_of_digits(const Axis& axis, std::string_view digits) {
    int count = 0;
    for (int k = static_cast<int>(std::floor(std::log10(axis.low))); k <= std::log10(axis.high) + 1e-9; ++k)
        for (const char digit : digits) {
            const double value = (digit - '0') * std::pow(10.0, k);
            count += value >= axis.low * (1 - 1e-9) && value <= axis.high * (1 + 1e-9);
        }
    return count;
}

void add_log_ticks(Axis& axis, double count) {
    constexpr int kMinCount = 4;
    const double first = std::log10(axis.low), last = std::log10(axis.high);
    const double decades = last - first;
    if (decades < 0.35) return add_linear_ticks(axis, count, {});
    std::string_view digits = kNumberedDigits.front();
    for (const std::string_view more : kNumberedDigits)
        if (count_of_digits(axis, digits) < std::min<double>(kMinCount, count)) digits = more;
    const int stride = digits.size() > 1 ? 1 : std::max(1, static_cast<int>(std::ceil(decades / std::max(count, 2.0))));
    const bool plain = first > -3.01 && last < 4.01 && (decades < 2.1 || digits.size() > 1);
    for (int k = static_cast<int>(std::floor(first)); k <= static_cast<int>(std::ceil(last)); ++k) {
        for (int digit = 1; digit <= 9; ++digit) {
            const double value = digit * std::pow(10.0, k);
            if (value < axis.low * (1 - 1e-9) || value > axis.high * (1 + 1e-9)) continue;
            const bool numbered = numbers_digit(digits, digit) && k % stride == 0;
            if (!numbered && (stride == 1 || digit == 1)) axis.minor.push_back(value);
            if (!numbered) continue;
            const std::string power = with_minus_sign(std::to_string(k));
            axis.ticks.push_back({value, plain        ? fmt::format("{:.{}f}", value, std::max(0, -k))
                                         : digit == 1 ? fmt::format("10^{{{}}}", power)
                                                      : fmt::format("{}·10^{{{}}}", digit, power)});
        }
    }
}

}  // namespace

double Axis::position(double value) const {
    if (!std::isfinite(value) || (log && value <= 0)) return std::numeric_limits<double>::quiet_NaN();
    if (!log) return (value - low) / (high - low);
    return (std::log(value) - std::log(low)) / (std::log(high) - std::log(low));  // a ratio may lie beyond all numbers
}

double Axis::widest_label(double size) const {
    double widest = 0;
    for (const Tick& tick : ticks) widest = std::max(widest, text_width(tick.label, size));
    return widest;
}

void Extent::include(double value) {
    if (low_ && value >= *low_ && value <= *high_) return;  // as for most samples of long data
    if (!std::isfinite(value) || (log_ && value <= 0)) return;
    value = std::clamp(value, -kMaxAxisValue, kMaxAxisValue);
    low_ = std::min(low_.value_or(value), value);
    high_ = std::max(high_.value_or(value), value);
}

void Extent::include(const Vector& values) {
    for (const double value : values) include(value);
}

std::pair<double, double> Extent::padded(double margin) const {
    if (!low_) return log_ ? std::pair{1.0, 10.0} : std::pair{0.0, 1.0};
    const double low = *low_, high = *high_;
    if (log_) {
        const double decades = std::log10(high) - std::log10(low);
        const double padding = decades < 1e-6 ? 0.5 : margin * decades;
        return usable_range({low * std::pow(10.0, -padding), high * std::pow(10.0, padding)}, true);
    }
    const double size = std::max(std::abs(low), std::abs(high));
    const double padding = high - low > 1e-9 * size ? margin * (high - low) : size > 0 ? 0.1 * size : 1.0;
    return usable_range({low - padding, high + padding}, false);
}

std::pair<double, double> usable_range(std::pair<double, double> range, bool log) {
    const double least = log ? 1 / kMaxAxisEnd : -kMaxAxisEnd;
    double low = std::clamp(range.first, least, kMaxAxisEnd), high = std::clamp(range.second, least, kMaxAxisEnd);
    if (log && !(low < high)) (high > 1 ? low : high) = high > 1 ? high / 10 : high * 10;
    if (!log && !(high - low >= kMinSpan)) {
        const double padding = std::max(kMinSpan, 1e-9 * std::abs(high));
        low -= padding, high += padding;
    }
    return {low, high};
}

Axis make_axis(std::pair<double, double> range, bool log, double count, std::optional<double> step) {
    range = usable_range(range, log);
    Axis axis{range.first, range.second, log, {}, {}, 0};
    if (log)
        add_log_ticks(axis, count);
    else
        add_linear_ticks(axis, count, step);
    return axis;
}

}  // namespace dynlab::inline figures
