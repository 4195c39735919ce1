#pragma once
#include <string>
#include <vector>

#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// G(s) = num(s)/den(s) exp(-delay s), or with Ts > 0 G(z) = num(z)/den(z) z^-(delay/Ts). One input, one
/// output. Coefficients highest power first; leading zeros are stripped and den is made monic on
/// construction. Throws InvalidArgument for an empty or zero denominator, negative delay, non-finite
/// coefficients, and in discrete time for a delay that is not a multiple of Ts.
class TransferFunction {
  public:
    TransferFunction() : TransferFunction(Vector::Ones(1), Vector::Ones(1)) {}
    TransferFunction(const VectorView& num, const VectorView& den, double Ts = 0, double delay = 0);
    static TransferFunction variable(double Ts = 0);  ///< s, or z with Ts > 0

    const Vector& num() const { return num_; }
    const Vector& den() const { return den_; }
    double Ts() const { return Ts_; }        ///< seconds, 0 for continuous time
    double delay() const { return delay_; }  ///< seconds
    bool continuous() const { return Ts_ == 0; }
    bool proper() const { return num_.size() <= den_.size(); }
    Index pole_count() const { return den_.size() - 1; }
    Index zero_count() const { return num_.size() - 1; }

    ComplexVector poles() const;
    ComplexVector zeros() const;
    /// G(0) or G(z = 1); with an integrator infinite, of the sign that G has just above; NaN where nothing is left of
    /// both.
    double dc_gain() const;
    bool stable() const;              ///< poles strictly inside the left half plane or the unit circle
    Complex at(Complex point) const;  ///< value at s or z, delay included
    TransferFunction with_delay(double delay) const;

  private:
    Vector num_, den_;
    double Ts_ = 0, delay_ = 0;
};

/// Sums need equal delays; all need equal sampling times (a gain fits any). No pole-zero cancellation is
/// made.
TransferFunction operator+(const TransferFunction& a, const TransferFunction& b);
TransferFunction operator-(const TransferFunction& a, const TransferFunction& b);
TransferFunction operator*(const TransferFunction& a, const TransferFunction& b);
TransferFunction operator/(const TransferFunction& a,
                           const TransferFunction& b);  ///< throws when b is delayed more than a
TransferFunction pow(const TransferFunction& base, int exponent);
/// forward/(1 + forward backward), sign = +1 for positive feedback. Both without delay.
TransferFunction feedback(const TransferFunction& forward, const TransferFunction& backward, int sign = -1);

/// One row per pole: natural frequency (rad/s), damping ratio, time constant (s); discrete poles by
/// log(z)/Ts.
struct PoleDescription {
    Complex pole;
    double natural_frequency;
    double damping_ratio;  ///< NaN for an integrator
    double time_constant;  ///< infinite without damping, negative for an unstable pole
};
std::vector<PoleDescription> damping(const TransferFunction& G);

/// Distances from the origin (rad/s, ascending) of the poles and zeros away from it; discrete ones by log(z)/Ts.
Vector corner_frequencies(const TransferFunction& G);

/// First frequency (rad/s) at which |G| falls 3 dB below its dc gain; infinite when it never does, NaN when the dc
/// gain is zero or infinite.
double bandwidth(const TransferFunction& G);

/// Three lines, numerator over denominator, as a terminal shows it: names the delay and Ts.
std::string to_text(const TransferFunction& G, int significant_digits = 5);
/// G as a formula of LaTeX, "G(s) = \frac{2}{s + 1} e^{-0.5 s}", without what sets it apart from text.
std::string to_latex(const TransferFunction& G, int significant_digits = 5);

}  // namespace dynlab::inline numerics
