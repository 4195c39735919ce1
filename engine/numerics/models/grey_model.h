#pragma once
#include <memory>
#include <string>
#include <vector>

#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// An unknown of a grey-box model, in whatever unit its equations have.
struct GreyParameter {
    std::string name;
    double start = 0;  ///< where a search begins; the value of a fixed one
    double lower = -kInfinity, upper = kInfinity;
    bool fixed = false;
};

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

enum class Derivatives { kNone, kState, kAll };

/// Values of a vector function, and its derivatives with respect to the states and to the d parameters of an
/// evaluation; those not wanted keep what they held.
struct GreyValues {
    Vector values;           ///< m
    RowMatrix by_state;      ///< m x n
    RowMatrix by_parameter;  ///< m x d
};

/// dx/dt = A x + B u + c with its derivatives with respect to each parameter of an evaluation.
struct GreyLinearSystem {
    struct Part {
        Matrix A, B;  ///< n x n, n x nu
        Vector c;     ///< n
    };
    Part value;
    std::vector<Part> by_parameter;  ///< d
};

/// The equations at one set of parameters, ready for evaluation. Not thread-safe. t is in the time unit of the data,
/// usually s.
class GreyEvaluation {
  public:
    virtual ~GreyEvaluation() = default;
    virtual void set_parameters(const Vector& parameters) = 0;
    virtual void rates(double t, const double* x, const double* u, Derivatives requested, GreyValues& at) = 0;
    virtual void outputs(double t, const double* x, const double* u, Derivatives requested, GreyValues& at) = 0;
    /// x(t_1), and by_parameter where derivatives are wanted.
    virtual void initial_state(Derivatives requested, GreyValues& at) = 0;
    /// The rates as a linear system where they are one for all parameters, else nothing.
    virtual const GreyLinearSystem* linear_system() { return nullptr; }
};

/// dx/dt = f(t, x, u; p), y = h(t, x, u; p), x(t_1) = x_1(p): the functions of a model.
class GreyEquations {
  public:
    virtual ~GreyEquations() = default;
    /// With derivatives with respect to these parameters (0-based), in this order.
    virtual std::unique_ptr<GreyEvaluation> evaluation(const std::vector<Index>& with_respect_to) const = 0;
    virtual Index output_count() const = 0;
    virtual bool is_linear() const { return false; }  ///< the rates
    virtual bool has_linear_outputs() const { return false; }
    virtual bool for_several_threads() const { return true; }
};

/// A model whose structure physics gives.
struct GreyModel {
    std::shared_ptr<const GreyEquations> equations;
    std::vector<GreyParameter> parameters;
    std::vector<std::string> state_names;  ///< n
    Index inputs = 0;
    bool outputs_are_states = false;      ///< the first states, as many as the data have outputs
    std::vector<bool> estimated_initial;  ///< n: initial values that are estimated, separately for each experiment

    Index order() const { return static_cast<Index>(state_names.size()); }
    Vector start() const;  ///< of all parameters
    std::vector<Index> free_parameters() const;
    /// Throws InvalidArgument naming the parameter whose start or bounds are no numbers or contradict each other.
    void validate() const;
};

}  // namespace dynlab::inline numerics
