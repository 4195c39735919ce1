#pragma once
#include <vector>

#include "numerics/criteria/initial_conditions.h"
#include "numerics/criteria/output_error_model.h"
#include "numerics/criteria/prediction_error_products.h"
#include "numerics/models/polynomial_model.h"

namespace dynlab::inline numerics {

struct SampledExperiment {
    Matrix u;  ///< N x inputs
    Vector y;  ///< N
};

/// The signal divided by 1 + f_1 q^-1 + ..., with `f` = [f_1 ...], from the zero state.
Vector all_pole_filter(const VectorView& f, const VectorView& signal);

/// Poles outside the unit circle are mirrored into it: the coefficients f_1 ... of the stable polynomial with equal
/// magnitude but for a gain. Returns `f` itself when there are none.
Vector reflect_poles_into_unit_circle(const VectorView& f);

/// What the inputs of one experiment do: the output and its derivatives, each the late copy of one of few signals.
struct DrivenSignals {
    Vector output;                    ///< N, the samples without a recorded past too
    std::vector<Vector> signals;      ///< those that the columns refer to
    std::vector<LateColumn> columns;  ///< derivatives, a row for each sample
    std::vector<Index> places;        ///< the parameter of each column
};

/// Sums of products of the errors e = y - output, the sensitivities Psi of the output (the instruments) and the
/// regressors Phi: the sensitivities computed with the measured instead of the simulated outputs, as in the equation F
/// (y/F) = B (u/F). In Phi, column j of F_i is that of Psi minus q^-j/F_i e.
struct InstrumentProducts {
    double squares = 0;                ///< e'e
    Matrix psi_psi, psi_phi, phi_phi;  ///< d x d
    Vector psi_e, phi_e;
};

/// The output sum_i B_i/F_i u_i of a discrete-time model in all experiments, one after the other, as a function of [the
/// parameters of the orders; for each experiment its initial values; for each experiment its offset], for the
/// output-error search and for the instruments of SRIV. Start conditions: zero: inputs and outputs are zero before the
/// first sample; steady: at rest with the first input values; estimate: the unknown past acts through nf initial values
/// for each input (which drive 1/F_i as pulses do), and the first head() samples, where unrecorded inputs act directly,
/// are left out of output and target. Exact for any past. Sensitivities are exact: with x = B/F u
///     dx/df_j = -q^-j/F x,   dx/db_j = q^-j/F u.
class DiscreteOutput : public OutputErrorModel {
  public:
    /// Keeps a reference to the experiments. `orders` hold nb, nf and nk only.
    DiscreteOutput(const PolynomialOrders& orders, const StartCondition& condition,
                   const std::vector<SampledExperiment>& experiments);

    void simulate(const Vector& theta, Vector& output, Matrix* sensitivities) const override;
    OutputErrorProducts products(const Vector& theta, const VectorView& y) const override;
    bool products_are_cheap() const override { return true; }
    /// One experiment's share; its derivatives only when they are wanted.
    DrivenSignals driven(const Vector& theta, std::size_t experiment, bool with_derivatives) const;

    InstrumentProducts instrument_products(const Vector& theta, const VectorView& y) const;
    /// `theta` with every F reflected into the unit circle.
    Vector with_stable_poles(Vector theta) const;

    Vector target() const;                ///< measured outputs, in the rows of output
    double target_variation() const;      ///< sum of squares about the mean of each experiment, same rows
    Index head() const { return head_; }  ///< samples left out of each experiment
    Index left_out() const;               ///< of all experiments
    Index offset_index(std::size_t experiment) const;
    const PolynomialOrders& orders() const { return orders_; }
    const StartCondition& condition() const { return condition_; }
    const std::vector<SampledExperiment>& experiments() const { return experiments_; }

  private:
    bool free_state() const { return condition_.state == InitialState::kEstimate; }
    bool steady() const { return condition_.state == InitialState::kSteady; }
    Index rows(const SampledExperiment& experiment) const;
    Index initial_start(std::size_t experiment, std::size_t input) const;
    void add_channel(const Vector& theta, std::size_t experiment, std::size_t input, bool with_derivatives,
                     DrivenSignals& all) const;

    PolynomialOrders orders_;
    StartCondition condition_;
    const std::vector<SampledExperiment>& experiments_;
    Index head_ = 0, values_ = 0;  // values_: initial values of one experiment
};

}  // namespace dynlab::inline numerics
