#pragma once
#include <array>
#include <cmath>

#include "numerics/simulation/eight_steps.h"
#include "numerics/simulation/separate_modes.h"

namespace dynlab::inline numerics {

/// What EightSteps does, with the modes of a system as its states: steps of any length cost the same, and each mode
/// goes its own way. Of x = pole * length a mode takes the functions
///     f_1 = (e^x - 1)/x,   f_2 = (f_1 - 1)/x,   f_3 = (f_2 - 1/2)/x
/// (Hochbruck and Ostermann 2010), of which f_3 is a series of a few terms for |x| < 1, and from which the others
/// follow without loss; beyond, they follow from e^x.
template <int kPoles, bool kTwice>
class EightModes {
  public:
    static constexpr int kStates = (kTwice ? 2 : 1) * kPoles;
    using States = Eigen::Array<double, kSideBySide, kStates>;

    EightModes(const SeparateModes& modes, bool ramps) : poles_(modes.poles.array()), ramps_(ramps) {}

    Index states() const { return kStates; }
    Index entries() const { return kPoles * kOfMode; }

    /// The next steps are none longer than this (s).
    void prepare(double max_step) {
        double largest = 0;
        for (Index i = 0; i < kPoles; ++i) {
            const double x = std::abs(poles_[i]) * max_step;
            beyond_series_[i] = x > kOfSeries;
            largest = std::max(largest, std::min(x, kOfSeries));
        }
        last_term_ = 0;
        for (double term = 1; last_term_ + 1 < kTerms && term > 2e-17; ++last_term_) term *= largest / (last_term_ + 4);
    }

    /// For steps of `length` (s).
    [[gnu::always_inline]] void set(const Eight& length, Eight* map) const {
        std::array<Eight, kPoles> x, third;
        for (Index i = 0; i < kPoles; ++i) {
            x[i] = poles_[i] * length;
            third[i].setZero();
        }
        // ... + x^2/5! + x/4! + 1/3!
        for (int k = last_term_; k >= 0; --k)
            for (Index i = 0; i < kPoles; ++i) third[i] = third[i] * x[i] + kInverseFactorials[k + 3];
        for (Index i = 0; i < kPoles; ++i) {
            Eight second = 0.5 + x[i] * third[i], first = 1 + x[i] * second, growth = x[i] * first;
            if (beyond_series_[i]) {
                const Eight of_exponential = x[i].exp() - 1, one = of_exponential / x[i], two = (one - 1) / x[i],
                            three = (two - 0.5) / x[i];
                for (Index lane = 0; lane < kSideBySide; ++lane) {
                    const bool by_series = std::abs(x[i][lane]) < kOfSeries;
                    growth[lane] = by_series ? growth[lane] : of_exponential[lane];
                    first[lane] = by_series ? first[lane] : one[lane];
                    second[lane] = by_series ? second[lane] : two[lane];
                    third[i][lane] = by_series ? third[i][lane] : three[lane];
                }
            }
            set_mode(length, growth, first, second, x[i], third[i], map + i * kOfMode);
        }
    }

    /// The states behind the steps.
    [[gnu::always_inline]] void advance(const Eight* map, const Eight& u, const Eight& slope, States& states) const {
        for (Index i = 0; i < kPoles; ++i, map += kOfMode) {
            const Eight z = states.col(i);
            Eight next = z + (map[kGrowth] * z + map[kInput] * u);
            if (ramps_) next += map[kRamp] * slope;
            states.col(i) = next;
            if (!kTwice) continue;
            const Eight w = states.col(kPoles + i);
            next = w + (map[kGrowth] * w + map[kShare] * z + map[kInputOfSecond] * u);
            if (ramps_) next += map[kRampOfSecond] * slope;
            states.col(kPoles + i) = next;
        }
    }

    /// Where stretches begin that follow each other, as EightSteps has it.
    void chain(const Eight* map, const States& from_rest, States& begin) const {
        for (Index i = 0; i < kPoles; ++i, map += kOfMode)
            for (Index lane = 0; lane + 1 < kSideBySide; ++lane) {
                const double z = begin(lane, i), growth = map[kGrowth][lane];
                begin(lane + 1, i) = from_rest(lane, i) + z + growth * z;
                if (!kTwice) continue;
                const double w = begin(lane, kPoles + i);
                begin(lane + 1, kPoles + i) = from_rest(lane, kPoles + i) + w + growth * w + map[kShare][lane] * z;
            }
    }

  private:
    /// Of a mode: its growth less one, what constant inputs and ramps of one a second make of it; and of the second
    /// system's mode: what the first one's, constant inputs and ramps make of it.
    enum Entry : Index { kGrowth, kInput, kRamp, kShare, kInputOfSecond, kRampOfSecond };
    static constexpr Index kOfMode = kTwice ? 6 : 3;

    static constexpr int kTerms = 20;
    static constexpr std::array<double, kTerms + 3> inverse_factorials() {
        std::array<double, kTerms + 3> inverse{1};
        for (std::size_t k = 1; k < inverse.size(); ++k) inverse[k] = inverse[k - 1] / static_cast<double>(k);
        return inverse;
    }
    static constexpr std::array<double, kTerms + 3> kInverseFactorials = inverse_factorials();

    [[gnu::always_inline]] void set_mode(const Eight& length, const Eight& growth, const Eight& first,
                                         const Eight& second, const Eight& x, const Eight& third, Eight* mode) const {
        mode[kGrowth] = growth;
        mode[kInput] = length * first;
        const Eight squared = length * length;
        if (ramps_) mode[kRamp] = squared * second;
        if (!kTwice) return;
        mode[kShare] = length + length * growth;
        mode[kInputOfSecond] = squared * (first - second);
        if (ramps_) mode[kRampOfSecond] = squared * length * (0.5 + (x - 2) * third);
    }

    static constexpr double kOfSeries = 1;  // |x| up to which the series is taken
    Eigen::Array<double, kPoles, 1> poles_;
    std::array<bool, kPoles> beyond_series_ = {};
    int last_term_ = 0;  // what is left out is 2e-17 of f_3
    bool ramps_;
};

}  // namespace dynlab::inline numerics
