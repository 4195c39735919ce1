#include "numerics/signals/butterworth.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "numerics/error.h"
#include "numerics/signals/extension.h"

namespace dynlab::inline numerics {

namespace {

constexpr int kMaxFilterOrder = 20;
constexpr double kTransientLeft = 1e-6;  // part of a transient that remains after the continuation of a signal

/// The filter in the plane s = (z - 1)/(z + 1): edges tan(w Ts/2), and the kind of band.
struct Analog {
    double low, high;
    bool stop;

    bool low_pass() const { return low == 0; }
    bool high_pass() const { return std::isinf(high); }
    double center() const { return std::sqrt(low * high); }
    double width() const { return high - low; }
};

/// A stop band below one edge is a pass band above it.
Analog analog_of(const PassBand& band, double Ts, bool stop) {
    const double end = std::numbers::pi / Ts;
    const bool from_zero = band.low == 0, to_end = band.high >= end * (1 - 1e-12);
    if (!(band.low >= 0) || !(band.low < band.high) || band.low >= end || (from_zero && to_end))
        throw InvalidArgument(
            "the band of the filter must have an edge between 0 and pi/Ts = {} rad per time unit, but it is {} to {}. "
            "Specify the lower edge first; {0, w} is a low-pass filter",
            end, band.low, band.high);
    const double infinity = std::numeric_limits<double>::infinity();
    const double low = std::tan(band.low * Ts / 2), high = to_end ? infinity : std::tan(band.high * Ts / 2);
    if (!stop || (!from_zero && !to_end)) return {low, high, stop};
    return from_zero ? Analog{high, infinity, false} : Analog{0, low, false};
}

/// Poles of the section pair that one prototype pole (Re < 0) becomes; of conjugate ones only the upper is given here.
std::vector<Complex> mapped_poles(Complex prototype, const Analog& filter) {
    if (filter.low_pass()) return {prototype * filter.high};
    if (filter.high_pass()) return {filter.low / prototype};
    // (s^2 + w0^2)/(B s) = p, or its inverse for a stop band
    const Complex half = 0.5 * filter.width() * (filter.stop ? 1.0 / prototype : prototype);
    const Complex root = std::sqrt(half * half - filter.center() * filter.center());
    return {half + root, half - root};
}

Complex to_z(Complex s) {
    return (1.0 + s) / (1.0 - s);
}

Complex section_response(const FilterSection& f, Complex z) {
    return (f.b0 * z * z + f.b1 * z + f.b2) / (z * z + f.a1 * z + f.a2);
}

/// With these two poles and the zeros of the kind of filter; magnitude one at `reference`.
FilterSection two_poles(Complex p, Complex q, const Analog& filter, Complex reference) {
    FilterSection section{1, 0, -1, -(p + q).real(), (p * q).real()};
    if (filter.low_pass())
        section.b1 = 2, section.b2 = 1;
    else if (filter.high_pass())
        section.b1 = -2, section.b2 = 1;
    else if (filter.stop)
        section.b1 = -2 * to_z(Complex(0, filter.center())).real(), section.b2 = 1;
    const double gain = 1 / std::abs(section_response(section, reference));
    section.b0 *= gain, section.b1 *= gain, section.b2 *= gain;
    return section;
}

FilterSection one_pole(double p, const Analog& filter) {
    const double zero = filter.low_pass() ? -1 : 1, at = -zero;
    const double gain = (at - p) / (at - zero);
    return {gain, -gain * zero, 0, -p, 0};
}

Complex reference_of(const Analog& filter) {
    if (filter.low_pass() || (filter.stop && !filter.high_pass())) return 1;
    return filter.high_pass() ? Complex(-1) : to_z(Complex(0, filter.center()));
}

/// Adds the sections of one prototype pole and its conjugate.
void add_sections(Complex prototype, const Analog& filter, FilterSections& sections) {
    const bool real = prototype.imag() == 0;
    const auto poles = mapped_poles(prototype, filter);
    const Complex reference = reference_of(filter);
    if (!real) {
        for (const Complex pole : poles)
            sections.push_back(two_poles(to_z(pole), to_z(std::conj(pole)), filter, reference));
    } else if (poles.size() == 1) {
        sections.push_back(one_pole(to_z(poles[0]).real(), filter));
    } else {
        sections.push_back(two_poles(to_z(poles[0]), to_z(poles[1]), filter, reference));
    }
}

/// Transposed direct form of one section, in place. `past` is the input before the first sample.
void run_section(const FilterSection& f, Vector& x, double past) {
    const double gain = (f.b0 + f.b1 + f.b2) / (1 + f.a1 + f.a2), level = gain * past;
    double s1 = level - f.b0 * past, s2 = f.b2 * past - f.a2 * level;
    for (double& value : x) {
        const double out = f.b0 * value + s1;
        s1 = f.b1 * value - f.a1 * out + s2;
        s2 = f.b2 * value - f.a2 * out;
        value = out;
    }
}

void run_forwards(const FilterSections& sections, Vector& x, bool steady_start) {
    for (const FilterSection& section : sections) run_section(section, x, steady_start ? x[0] : 0);
}

/// Samples after which the slowest pole has forgotten its past.
Index memory_of(const FilterSections& sections) {
    double slowest = 0;
    for (const FilterSection& f : sections) {
        const double discriminant = f.a1 * f.a1 / 4 - f.a2;
        const double radius = discriminant < 0 ? std::sqrt(f.a2) : std::abs(f.a1 / 2) + std::sqrt(discriminant);
        slowest = std::max(slowest, radius);
    }
    const double samples = slowest > 0 ? std::log(kTransientLeft) / std::log(std::min(slowest, 1 - 1e-15)) : 0;
    return static_cast<Index>(std::min(samples, 1e9)) + 2;
}

}  // namespace

void FilterOptions::validate() const {
    if (order < 1 || order > kMaxFilterOrder)
        throw InvalidArgument("the order of the filter must be between 1 and {}, but it is {}", kMaxFilterOrder, order);
}

FilterSections butterworth(const PassBand& band, double Ts, const FilterOptions& options) {
    options.validate();
    const Analog filter = analog_of(band, Ts, options.stop);
    FilterSections sections;
    const int n = options.order;
    for (int k = 0; k < n / 2; ++k) {
        const double angle = std::numbers::pi * (2 * k + n + 1) / (2.0 * n);
        add_sections(std::polar(1.0, angle), filter, sections);
    }
    if (n % 2 == 1) add_sections(Complex(-1, 0), filter, sections);
    return sections;
}

ComplexVector response(const FilterSections& sections, const VectorView& w, double Ts) {
    ComplexVector H = ComplexVector::Ones(w.size());
    for (Index i = 0; i < w.size(); ++i) {
        const Complex z = std::polar(1.0, w[i] * Ts);
        for (const FilterSection& section : sections) {
            const bool first_order = section.b2 == 0 && section.a2 == 0;
            H[i] *= first_order ? (section.b0 * z + section.b1) / (z + section.a1) : section_response(section, z);
        }
    }
    return H;
}

Vector filter_signal(const FilterSections& sections, const VectorView& x, bool steady_start) {
    Vector filtered = x;
    if (x.size() > 0) run_forwards(sections, filtered, steady_start);
    return filtered;
}

Vector filter_zero_phase(const FilterSections& sections, const VectorView& x) {
    const Index N = x.size();
    if (N < 2) return x;
    const Index margin = std::min(memory_of(sections), 3 * N);
    Vector extended = point_reflected(x, margin);
    run_forwards(sections, extended, true);
    extended.reverseInPlace();
    run_forwards(sections, extended, true);
    return extended.segment(margin, N).reverse();
}

IdData filter_data(const IdData& data, const PassBand& band, const FilterOptions& options) {
    if (!data.regular())
        throw InvalidArgument("irregularly sampled data cannot be filtered: interpolate them first (interp1)");
    const FilterSections sections = butterworth(band, data.Ts, options);
    IdData result = data;
    for (Experiment& experiment : result.experiments)
        for (Matrix* signals : {&experiment.y, &experiment.u, &experiment.r})
            for (auto column : signals->colwise()) {
                const Vector x = column;
                column = options.zero_phase ? filter_zero_phase(sections, x)
                                            : filter_signal(sections, x, options.steady_start);
            }
    return result;
}

}  // namespace dynlab::inline numerics
