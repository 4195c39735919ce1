#pragma once
#include <vector>

#include "numerics/criteria/discrete_output.h"
#include "numerics/fit/discrete/arma_noise.h"

namespace dynlab::inline numerics {

/// The one-step prediction of A y = sum_i B_i/F_i u_i + C/D e in all experiments, one after the other, as a function of
/// [the parameters of the orders; the initial values and offsets of DiscreteOutput], for the output-error search: what
/// it leaves of y is
///     e = D/C w,   w = A y - sum_i B_i/F_i u_i - free motion - offset.
/// Inputs and offset as in DiscreteOutput. With start condition "estimate" the first max(na, nk + nb - 1 - nf) samples,
/// whose past is not in the data, are left out; otherwise y is zero before the first sample. The nd samples after them
/// are also left out, and the e before the first are taken as zero (the conditional likelihood). Sensitivities are
/// exact:
///     d/da_i = -D/C q^-i y,  d/df, d/db = D/C of those of B/F u,  d/dc_j = q^-j e/C,  d/dd_i = -q^-i w/C.
/// The output is not a number where C or D has roots outside the unit circle, so that the search stays inside.
class PredictionModel : public OutputErrorModel {
  public:
    /// Keeps a reference to the experiments.
    PredictionModel(const PolynomialOrders& orders, const StartCondition& condition,
                    const std::vector<SampledExperiment>& experiments);

    void simulate(const Vector& theta, Vector& output, Matrix* sensitivities) const override;
    OutputErrorProducts products(const Vector& theta, const VectorView& y) const override;
    bool products_are_cheap() const override { return true; }

    Vector target() const;               ///< measured outputs, in the rows of the prediction
    std::vector<Index> lengths() const;  ///< rows of each experiment
    /// The sum of B/F u, free motion and offset divided by A, beginning with the recorded outputs where it needs them.
    Vector simulated(const Vector& theta) const;
    /// `head`, the parameters of the orders, and the initial values and offsets that predict best with them: these
    /// enter linearly.
    Vector completed(const VectorView& head) const;
    Index linear_count() const { return parameter_count() - orders_.parameter_count(); }
    Index offset_index(std::size_t experiment) const;
    const PolynomialOrders& orders() const { return orders_; }
    const std::vector<SampledExperiment>& experiments() const { return experiments_; }

  private:
    Index dynamic_count() const { return orders_.c_start() - orders_.na; }  // coefficients of all F and B
    Index skipped() const { return blind_ + orders_.nd; }
    ArmaNoise noise_at(const Vector& theta) const;
    bool possible(const Vector& theta, const ArmaNoise& noise) const;
    Vector equation_errors(const Vector& theta, std::size_t experiment, const Vector& driven) const;
    Vector driven_parameters(const Vector& theta) const;
    Vector past_output(std::size_t experiment, Index lag) const;

    PolynomialOrders orders_;
    DiscreteOutput driven_;
    const std::vector<SampledExperiment>& experiments_;
    Index blind_ = 0;  // rows of driven_ without a recorded past of y
};

}  // namespace dynlab::inline numerics
