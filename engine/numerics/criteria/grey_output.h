#pragma once
#include <optional>
#include <vector>

#include "numerics/criteria/output_error_model.h"
#include "numerics/simulation/grey_simulation.h"

namespace dynlab::inline numerics {

/// The simulated outputs of a grey-box model on a record as functions of
///     theta = [free parameters, initial values that are estimated, experiment by experiment].
/// Rows: experiment after experiment, in each output after output, each output times its weight. Where a simulation
/// breaks down the outputs are NaN, which a search takes for a step too far. Not for several threads at once.
class GreyOutput final : public OutputErrorModel {
  public:
    /// `initial`: x(t_1) of each experiment (n x experiments) in the place of the model's own, or nothing; of the
    /// states that are estimated it is where the search begins. `parameters`: all of the model's; the fixed ones count.
    /// Throws InvalidArgument for data of other channels than the model.
    GreyOutput(const IdData& data, const GreyModel& model, const Vector& parameters, std::optional<Matrix> initial,
               const Vector& weights, double relative_tolerance);

    void simulate(const Vector& theta, Vector& output, Matrix* sensitivities) const override;

    Vector measured() const;                       ///< the data's outputs, as the rows are
    Vector start() const;                          ///< theta where the search begins
    Vector parameters(const Vector& theta) const;  ///< all of the model's
    /// x(t_1) of each experiment, n x experiments.
    Matrix initial_states(const Vector& theta) const;
    /// The trajectories without weights. Throws SimulationBreakdown.
    std::vector<GreyTrajectory> trajectories(const Vector& theta, bool sensitivities) const;
    /// Number of places in theta before the initial values of the first experiment.
    Index free_count() const { return static_cast<Index>(free_.size()); }
    const std::vector<Index>& estimated_states() const { return estimated_; }

  private:
    const GreyModel& model_;
    Vector parameters_, weights_;
    std::optional<Matrix> initial_;
    std::vector<Index> free_, estimated_;
    std::vector<GreyInputs> inputs_;
    std::vector<Matrix> measured_;
    mutable GreySimulator simulator_;
};

}  // namespace dynlab::inline numerics
