#pragma once
#include <optional>
#include <vector>

#include "numerics/criteria/output_error_model.h"
#include "numerics/simulation/grey_simulation.h"

namespace dynlab::inline numerics {

/// The simulated outputs of a grey-box model for given data, as functions of
///     theta = [free parameters, initial values that are estimated, experiment by experiment].
/// Rows are stacked by experiment, and within an experiment by output; each output is multiplied by its weight. If a
/// simulation fails, the outputs are NaN, and a search rejects the step. Not thread-safe.
class GreyOutput final : public OutputErrorModel {
  public:
    /// `initial`: x(t_1) of each experiment (n x experiments) instead of the model's initial states, or no value. For
    /// estimated states it is the start of the search. `parameters`: all parameters of the model, of which the fixed
    /// ones keep their value. Throws InvalidArgument if the channels of the data and the model differ.
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
