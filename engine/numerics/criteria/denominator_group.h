#pragma once
#include <vector>

#include "numerics/filters/transfer_filters.h"
#include "numerics/models/transfer_structure.h"

namespace dynlab::inline numerics {

/// The channels of a model that share one denominator, and the data that they explain. For given filters this part of
/// the problem is one linear regression. Its parameters are a contiguous part of the structure's theta (fixed delays):
/// [a_1..a_n, b of each channel]. The group refers to the signals without a copy; the data must outlive it.
class DenominatorGroup {
  public:
    DenominatorGroup(const IdData& data, const TransferStructure& structure, Index group, Hold hold_y);

    Index order() const { return n_; }
    Index place() const { return place_; }  ///< of its parameters in theta
    Index parameter_count() const { return count_; }
    Index sample_count() const;  ///< over all experiments and outputs
    /// Replaces the measured output of one data set (index: experiments of the first output, then of the next) by y,
    /// the part of the output that this group explains.
    void set_target(std::size_t data_set, const Vector& y);
    void set_weight(Index output, double weight);                   ///< of an output's squares; 1 unless set
    const std::vector<Index>& outputs() const { return outputs_; }  ///< the model's outputs it bears on

    // The equations of this group's theta, summed over all experiments and outputs. filters/transfer_filters.h
    // describes the filters and the instruments. E: n + 1 coefficients, monic, descending powers of s.

    /// Least squares of signals filtered by gain/E (LSSVF): instruments z = phi.
    NormalEquations svf(const VectorView& E, double gain = 1) const;
    /// The same with instruments from the noise-free output of the model `theta` (IVSVF).
    NormalEquations auxiliary(const VectorView& E, const VectorView& theta, double gain = 1) const;
    /// Those of SRIVC: signals filtered by 1/A of `theta`, instruments the sensitivities of the model's output;
    /// `with_gram` also the sums of z z'.
    NormalEquations refined(const VectorView& theta, bool with_gram = false) const;
    Vector denominator(const VectorView& theta) const;  ///< A: n + 1 coefficients, monic; theta of the group
    /// Returns theta with unstable poles mirrored (real part to its negative); sets `any` to whether there were any.
    Vector with_stable_poles(const VectorView& theta, bool* any = nullptr) const;

    /// One output in one experiment.
    struct Member {
        RegressionData data_set;
        std::vector<Index> places;  ///< places of the regression's parameters in the group's theta
        std::size_t output;         ///< in outputs()
    };
    /// The experiments of the first output, then of the next.
    const std::vector<Member>& members() const { return members_; }
    std::vector<Vector> numerators(const Member& member, const VectorView& theta) const;  ///< B of each input

  private:
    template <class Equations>
    NormalEquations sum_over_experiments(const Equations& equations_of) const;

    Index n_, place_, count_;
    std::vector<Member> members_;
    std::vector<Index> outputs_;
    std::vector<double> weights_;
    std::vector<Vector> targets_;
};

/// Output of B/A exp(-delay s) from rest for one input (counted from 0) of an experiment, N values.
Vector response_from_rest(const IdData& data, const Experiment& experiment, const VectorView& B, const VectorView& A,
                          double delay, Index input);

/// Squares of one output's simulation error over all experiments, simulated from rest: what the passes aim at.
double simulation_squares(const IdData& data, const TransferStructure& structure, const VectorView& theta,
                          Index output);

/// theta of z_phi theta = z_y, columns and rows scaled; NaN when it cannot be solved. `condition_number` of the scaled
/// equations.
Vector solve_equations(const NormalEquations& equations, double* condition_number = nullptr);

/// Inverse of a Gram matrix by way of its rows and columns scaled to a diagonal of ones; `condition_number` of that.
Matrix inverse_gram(const Matrix& gram, double* condition_number = nullptr);

/// The monic polynomial whose roots are those of `den` with positive real parts made negative.
Vector reflect_unstable_roots(const VectorView& den, bool* any = nullptr);

/// (s + lambda)^n
Vector filter_denominator(double lambda, Index n);

}  // namespace dynlab::inline numerics
