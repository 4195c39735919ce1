#pragma once
#include <functional>
#include <vector>

#include "numerics/models/polynomial_model.h"
#include "numerics/models/transfer_structure.h"
#include "numerics/signals/iddata.h"
#include "numerics/signals/random.h"
#include "numerics/validation/uncertainty.h"

namespace dynlab::inline numerics {

/// Simulated outputs of models whose parameters are drawn from the normal distribution of an estimate.
struct SimulationSpread {
    Vector output;       ///< N, of the estimate itself
    Vector std;          ///< N, standard deviations about the mean of the drawn outputs
    Matrix drawn;        ///< N x runs
    Index unstable = 0;  ///< how many of the drawn models are
};

/// What the model of a parameter vector makes of each input.
using ModelsOfParameters = std::function<std::vector<TransferFunction>(const Vector& theta)>;

/// `runs` draws of theta with this covariance, simulated from rest for the inputs u (N x inputs, samples every Ts s).
/// Unlike the first-order bands of validation/uncertainty.h it shows what a large uncertainty does to the shape of the
/// output. Throws InvalidArgument for fewer than two runs or more than 5e7 samples in all, a covariance of another size
/// or one that is not finite, another number of inputs, and as lsim(). Draws run by run, one normal number for each
/// parameter.
SimulationSpread simulation_spread(const ModelsOfParameters& models, const Vector& theta, const Matrix& covariance,
                                   const MatrixView& u, double Ts, Hold hold, Index runs, RandomStream& random);

/// Of the coefficients [a_1..a_n b_0..b_m], with a free delay (s) also of that; drawn delays below zero count as zero.
SimulationSpread simulation_spread(const UncertainModel& model, const VectorView& u, double Ts, Hold hold, Index runs,
                                   RandomStream& random);
/// Of all parameters of a structure with one output; drawn delays below zero count as zero.
SimulationSpread simulation_spread(const TransferStructure& structure, const Vector& theta, const Matrix& covariance,
                                   const MatrixView& u, double Ts, Hold hold, Index runs, RandomStream& random);
/// Of all parameters of a difference equation; covariance as PolynomialOrders has them.
SimulationSpread simulation_spread(const PolynomialModel& model, const Matrix& covariance, const MatrixView& u,
                                   Index runs, RandomStream& random);

}  // namespace dynlab::inline numerics
