#pragma once
#include <functional>

#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// The state of an ordinary differential equation, at most 8 values, kept without heap memory.
using OdeState = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 8, 1>;

/// dx/dt at instant t.
using OdeRate = std::function<OdeState(double t, const OdeState& x)>;

/// Values that are not negative as long as the present form of the equation holds (a contact open, a body sliding
/// forwards); any of them below zero is an event.
using OdeGuard = std::function<OdeState(double t, const OdeState& x)>;

struct OdeOptions {
    double relative_tolerance = 1e-10;  ///< of the local error of each step and state
    double absolute_tolerance = 1e-12;
    double first_step = 1e-4;  ///< in the unit of t

    /// Throws InvalidArgument naming the first value that is not positive.
    void validate() const;
};

/// Adaptive integration of dx/dt = f(t, x), f smooth between events: the explicit Runge-Kutta pair of orders 5 and 4
/// by Dormand and Prince (1980), local extrapolation, steps by the usual controller. An event inside a step is found by
/// bisection to the resolution of t, so that no step runs across it.
class OdeSolver {
  public:
    explicit OdeSolver(OdeRate rate, const OdeOptions& options = {});

    struct Step {
        OdeState x;      ///< fifth-order result
        OdeState error;  ///< its difference from the fourth-order one
        OdeState rate;   ///< at the end, where the next step may begin
    };
    /// One step of length h from (t, x), whatever its error.
    Step step(double t, const OdeState& x, double h) const { return step(t, x, h, rate_(t, x)); }

    /// Moves (t, x) to t_end. With a guard it may end earlier, just behind the first instant at which a value of the
    /// guard is negative, and returns true; the caller then changes the form of the equation and goes on. Throws
    /// InvalidArgument when the tolerance cannot be met with any step (an equation that is not smooth, an unstable one
    /// that leaves the range of numbers).
    bool advance(double& t, OdeState& x, double t_end, const OdeGuard& guard = {});

  private:
    Step step(double t, const OdeState& x, double h, const OdeState& rate) const;  ///< with the rate at its beginning
    double error_of(const Step& step, const OdeState& x) const;                    ///< in units of the tolerance
    double time_of_event(double t, const OdeState& x, double h, const OdeState& rate, const OdeGuard& guard) const;

    OdeRate rate_;
    OdeOptions options_;
    double next_step_;
};

}  // namespace dynlab::inline numerics
