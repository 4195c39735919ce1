#include "numerics/models/called_equations.h"

#include <cmath>
#include <utility>

namespace dynlab::inline numerics {
namespace {

constexpr double kDifference = 6e-6;

/// Steps of differences: sizes that each variable has had.
class Steps {
  public:
    double of(Index i, double value) {
        if (i >= sizes_.size()) sizes_.conservativeResizeLike(Vector::Zero(i + 1));
        sizes_[i] = std::max(sizes_[i], std::abs(value));
        return kDifference * (sizes_[i] > 0 ? sizes_[i] : 1);
    }

  private:
    Vector sizes_;
};

class CalledEvaluation final : public GreyEvaluation {
  public:
    CalledEvaluation(const CalledFunctions& functions, std::vector<Index> with_respect_to)
        : functions_(functions), free_(std::move(with_respect_to)) {}

    void set_parameters(const Vector& parameters) override { parameters_ = parameters; }

    void rates(double t, const double* x, const double* u, Derivatives requested, GreyValues& at) override {
        evaluate(functions_.rates, functions_.states, t, x, u, requested, at);
    }
    void outputs(double t, const double* x, const double* u, Derivatives requested, GreyValues& at) override {
        evaluate(functions_.outputs, functions_.outputs_count, t, x, u, requested, at);
    }

    void initial_state(Derivatives requested, GreyValues& at) override {
        at.values = functions_.initial_state(parameters_);
        if (requested == Derivatives::kAll)
            at.by_parameter = by_parameters(functions_.states, [&] { return functions_.initial_state(parameters_); });
    }

  private:
    template <class Function>
    RowMatrix differences(Vector& variables, const std::vector<Index>& places, Steps& steps, Index rows,
                          const Function& function) {
        RowMatrix all(rows, static_cast<Index>(places.size()));
        for (Index q = 0; q < all.cols(); ++q) {
            const Index i = places[static_cast<std::size_t>(q)];
            const double value = variables[i], step = steps.of(i, value);
            variables[i] = value + step;
            const Vector above = function();
            variables[i] = value - step;
            const Vector below = function();
            variables[i] = value;
            all.col(q) = (above - below) / (2 * step);
        }
        return all;
    }

    template <class Function>
    RowMatrix by_parameters(Index rows, const Function& function) {
        return differences(parameters_, free_, parameter_steps_, rows, function);
    }

    void evaluate(const CalledFunctions::Function& function, Index rows, double t, const double* x, const double* u,
                  Derivatives requested, GreyValues& at) {
        Vector state = Eigen::Map<const Vector>(x, functions_.states);
        const Vector input = Eigen::Map<const Vector>(u, functions_.inputs);
        const auto value = [&] { return function(t, state, input, parameters_); };
        at.values = value();
        if (requested == Derivatives::kNone) return;
        std::vector<Index> all(static_cast<std::size_t>(state.size()));
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<Index>(i);
        at.by_state = differences(state, all, state_steps_, rows, value);
        if (requested == Derivatives::kAll) at.by_parameter = by_parameters(rows, value);
    }

    const CalledFunctions& functions_;
    std::vector<Index> free_;
    Vector parameters_;
    Steps state_steps_, parameter_steps_;
};

class CalledEquations final : public GreyEquations {
  public:
    explicit CalledEquations(CalledFunctions functions) : functions_(std::move(functions)) {}
    std::unique_ptr<GreyEvaluation> evaluation(const std::vector<Index>& with_respect_to) const override {
        return std::make_unique<CalledEvaluation>(functions_, with_respect_to);
    }
    Index output_count() const override { return functions_.outputs_count; }
    bool for_several_threads() const override { return false; }

  private:
    CalledFunctions functions_;
};

}  // namespace

std::shared_ptr<const GreyEquations> called_equations(CalledFunctions functions) {
    return std::make_shared<CalledEquations>(std::move(functions));
}

}  // namespace dynlab::inline numerics
