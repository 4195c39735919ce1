#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "numerics/models/grey_model.h"
#include "numerics/models/state_space.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// The inputs of a simulation and its instants.
struct GreyInputs {
    Matrix u;  ///< N x nu
    Vector t;  ///< N instants, in the time unit of the data (s)
    Hold hold = Hold::kZoh;
};

/// A model whose rates and outputs are linear in states and inputs, with constant coefficients and no constants, at
/// these parameters; nothing for any other.
std::optional<StateSpace> linear_system_of(const GreyModel& model, const Vector& parameters);

/// Derivatives that are simulated in addition to the outputs.
struct GreyDirections {
    std::vector<Index> parameters;  ///< d: with respect to which the evaluation differentiates
    std::vector<Index> states;      ///< whose initial values are directions, too
    Index count() const { return static_cast<Index>(parameters.size() + states.size()); }
};

struct GreyTrajectory {
    Matrix y;              ///< N x ny
    Matrix states;         ///< N x n
    Matrix sensitivities;  ///< N ny x D, output after output; empty unless wanted
    bool stiff = false;
    std::vector<double> rough_times;  ///< see SensitivitySolver
};

/// Simulates a model from sample to sample: exactly where its rates are linear with constant coefficients (matrix
/// exponentials), otherwise by SensitivitySolver. One object for one thread; it may be used many times.
class GreySimulator {
  public:
    /// `outputs`: of a model whose outputs are its first states, how many of them. Throws InvalidArgument when there
    /// are not so many.
    GreySimulator(const GreyModel& model, Index outputs, GreyDirections directions, double relative_tolerance);

    /// The model's own x(t_1).
    Vector initial_state(const Vector& parameters);
    struct Start {
        const Vector* replaced = nullptr;  ///< x(t_1) instead of the model's
        Vector estimated = {};             ///< then of the states among the directions
    };
    /// Throws SimulationBreakdown.
    GreyTrajectory run(const Vector& parameters, const GreyInputs& inputs, const Start& from, bool sensitivities);

  private:
    void start(const Start& from, bool sensitivities);
    void write_outputs(const GreyInputs& inputs, Index k, bool sensitivities, GreyTrajectory& result);
    void advance_linear(const GreyInputs& inputs, Index k, bool sensitivities);
    void set_linear_steps(double h);

    const GreyModel& model_;
    Index outputs_;
    GreyDirections directions_;
    double tolerance_;
    std::unique_ptr<GreyEvaluation> evaluation_;
    Vector x_;
    RowMatrix S_;
    GreyValues at_output_, at_start_;
    // Of a linear system: what one step of length step_ does to x, the inputs and one, and its derivatives.
    struct LinearStep {
        Matrix F, H0, H1;
    };
    double step_ = -1;
    LinearStep own_;
    std::vector<LinearStep> by_parameter_;
};

}  // namespace dynlab::inline numerics
