#pragma once
#include <array>
#include <string>
#include <vector>

#include "numerics/error.h"
#include "numerics/models/grey_model.h"

namespace dynlab::inline numerics {

/// A simulation that came to no end: a state left the range of numbers, or a rate is none. The message says when and
/// which.
class SimulationBreakdown : public InvalidArgument {
  public:
    using InvalidArgument::InvalidArgument;
};

/// Adaptive integration of dx/dt = f(t, x, u(t); p) from sample to sample, with the sensitivities S = dx/dtheta (n x D,
/// of the parameters of the evaluation first) by the variational equations dS/dt = f_x S + f_p with the same steps: S
/// is the derivative of the computed states (discretize, then differentiate).
/// Explicit pair of orders 5 and 4 (Dormand and Prince 1980) until its steps are bound by stability instead of accuracy
/// (test of Hairer and Wanner 1996, section IV.2), from then on the L-stable ESDIRK pair of orders 4 and 3 by Kennedy
/// and Carpenter (2003), table 5.
/// Errors of a state are weighed by its largest value so far, so that units have no say.
class SensitivitySolver {
  public:
    /// `directions`: D, at least the parameters of the evaluation; 0 for the states alone.
    SensitivitySolver(GreyEvaluation& evaluation, const std::vector<std::string>& state_names, Index inputs,
                      Index directions, double relative_tolerance);

    Vector x;     ///< n
    RowMatrix S;  ///< n x D
    /// Advances from t_begin to t_end (time unit of the data) with inputs linearly interpolated between these values.
    /// Throws SimulationBreakdown.
    void advance(double t_begin, double t_end, const double* u_begin, const double* u_end);
    bool is_stiff() const { return implicit_; }
    /// The first times at which no step was short enough for the tolerance (an equation with jumps).
    const std::vector<double>& rough_times() const { return rough_times_; }

  private:
    struct Stage {
        GreyValues at;
        Vector x, k;     ///< its state and rate
        RowMatrix S, K;  ///< and their derivatives
    };
    struct Interval {
        double t_begin, length;
        const double *u_begin, *u_end;
    };
    void evaluate(const Interval& over, double t, const Vector& state, GreyValues& at, Derivatives requested);
    double take_explicit_step(const Interval& over, double t, double h);
    double take_implicit_step(const Interval& over, double t, double h);
    bool solve_stage(const Interval& over, double t, double h, Stage& stage, const Vector& known);
    void set_derivatives(Stage& stage, const RowMatrix& sensitivities) const;
    double scaled_error(const double* weights, std::size_t stages, double h, const Vector& end);
    void look_for_stiffness(double h);
    void accept(const Stage& last);
    [[noreturn]] void break_down(const Interval& over, double t, double h);
    void refuse_undefined_rate(double t, double h) const;
    MessageList states_text(const Vector& at) const;
    Derivatives all_requested() const { return directions_ > 0 ? Derivatives::kAll : Derivatives::kNone; }

    GreyEvaluation& evaluation_;
    const std::vector<std::string>& names_;
    Index n_, directions_;
    double tolerance_, next_step_ = 0;
    Vector size_, input_, sum_, error_;
    RowMatrix sensitivity_sum_;
    std::array<Stage, 7> stages_;
    bool implicit_ = false, first_is_known_ = false;
    bool has_jumps_ = false;  ///< in the present interval, where neither method finds a step
    int stiff_steps_ = 0, other_steps_ = 0;
    std::vector<double> rough_times_;
};

}  // namespace dynlab::inline numerics
