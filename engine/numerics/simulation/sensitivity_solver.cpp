#include "numerics/simulation/sensitivity_solver.h"

#include <algorithm>
#include <cmath>

#include "numerics/linalg/decompositions.h"

namespace dynlab::inline numerics {
namespace {

// Dormand and Prince (1980): the row of stage 7 is the fifth-order result, kExplicitError its difference from the
// fourth-order one.
constexpr std::size_t kExplicitStages = 7;
constexpr double kExplicitNodes[kExplicitStages] = {0, 1. / 5, 3. / 10, 4. / 5, 8. / 9, 1, 1};
constexpr double kExplicit[kExplicitStages][6] = {{},
                                                  {1. / 5},
                                                  {3. / 40, 9. / 40},
                                                  {44. / 45, -56. / 15, 32. / 9},
                                                  {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
                                                  {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656},
                                                  {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84}};
constexpr double kExplicitError[kExplicitStages] = {71. / 57600,      0,         -71. / 16695, 71. / 1920,
                                                    -17253. / 339200, 22. / 525, -1. / 40};

// ARK4(3)6L[2]SA-ESDIRK of Kennedy and Carpenter (2003): the row of stage 6 is the fourth-order result.
constexpr std::size_t kImplicitStages = 6;
constexpr double kDiagonal = 1. / 4;
constexpr double kImplicitNodes[kImplicitStages] = {0, 1. / 2, 83. / 250, 31. / 50, 17. / 20, 1};
constexpr double kImplicit[kImplicitStages][5] = {
    {},
    {1. / 4},
    {8611. / 62500, -1743. / 31250},
    {5012029. / 34652500, -654441. / 2922500, 174375. / 388108},
    {15267082809. / 155376265600, -71443401. / 120774400, 730878875. / 902184768, 2285395. / 8070912},
    {82889. / 524892, 0, 15625. / 83664, 69875. / 102672, -2260. / 8211}};
constexpr double kImplicitError[kImplicitStages] = {
    82889. / 524892 - 4586570599. / 29645900160, 0,
    15625. / 83664 - 178811875. / 945068544,     69875. / 102672 - 814220225. / 1159782912,
    -2260. / 8211 + 3700637. / 11593932,         1. / 4 - 61727. / 225920};

constexpr double kSafety = 0.9, kSlowest = 0.2, kFastest = 5;
/// Steps of an interval, those tried in vain, and those that no step short enough was found for: beyond, its equation
/// has jumps.
constexpr int kMaxSteps = 20'000, kMaxRejectedSteps = 200, kMaxMisses = 20;
constexpr double kRoughShare = 1. / 64,
                 kLeastShare = 1e-10;  // of an interval, for steps taken whatever their error
constexpr std::size_t kRoughTimes = 10;
constexpr double kLostState = 1e100;      // beyond, rates are no numbers because states are none
constexpr double kStabilityBound = 3.25;  // of h times the largest eigenvalue, of the explicit pair
constexpr int kStiffSteps = 15, kOtherSteps = 6, kNewtonSteps = 12;

}  // namespace

SensitivitySolver::SensitivitySolver(GreyEvaluation& evaluation, const std::vector<std::string>& state_names,
                                     Index inputs, Index directions, double relative_tolerance)
    : evaluation_(evaluation),
      names_(state_names),
      n_(static_cast<Index>(state_names.size())),
      directions_(directions),
      tolerance_(relative_tolerance),
      size_(Vector::Zero(n_)),
      input_(inputs),
      sum_(n_),
      error_(n_) {
    for (Stage& stage : stages_) {
        stage.x = stage.k = stage.at.values = Vector::Zero(n_);
        stage.S = stage.K = RowMatrix::Zero(n_, directions);
    }
    x = Vector::Zero(n_);
    S = sensitivity_sum_ = RowMatrix::Zero(n_, directions);
}

void SensitivitySolver::evaluate(const Interval& over, double t, const Vector& state, GreyValues& at,
                                 Derivatives requested) {
    const double* u = over.u_begin;
    if (over.u_begin != over.u_end) {
        const double share = (t - over.t_begin) / over.length;
        for (Index i = 0; i < input_.size(); ++i)
            input_[i] = over.u_begin[i] + share * (over.u_end[i] - over.u_begin[i]);
        u = input_.data();
    }
    evaluation_.rates(t, state.data(), u, requested, at);
}

// K = f_x S + f_p
void SensitivitySolver::set_derivatives(Stage& stage, const RowMatrix& sensitivities) const {
    const Index own = stage.at.by_parameter.cols();
    stage.K.leftCols(own) = stage.at.by_parameter;
    stage.K.rightCols(directions_ - own).setZero();
    for (Index i = 0; i < n_; ++i)
        for (Index j = 0; j < n_; ++j)
            if (const double slope = stage.at.by_state(i, j); slope != 0)
                stage.K.row(i) += slope * sensitivities.row(j);
}

double SensitivitySolver::scaled_error(const double* weights, std::size_t stages, double h, const Vector& end) {
    error_.setZero();
    for (std::size_t j = 0; j < stages; ++j)
        if (weights[j] != 0) error_ += weights[j] * stages_[j].k;
    double largest = 0;
    for (Index i = 0; i < n_; ++i) {
        const double size = std::max(size_[i], std::abs(end[i]));
        const double error = std::abs(h * error_[i]);
        if (!std::isfinite(end[i]) || !std::isfinite(error)) return kInfinity;
        if (error > 0) largest = std::max(largest, error / (tolerance_ * size));
    }
    return largest;
}

double SensitivitySolver::take_explicit_step(const Interval& over, double t, double h) {
    if (!first_is_known_) {
        stages_[0].x = x;
        evaluate(over, t, x, stages_[0].at, all_requested());
        stages_[0].k = stages_[0].at.values;
        if (directions_ > 0) set_derivatives(stages_[0], S);
        first_is_known_ = true;
    }
    for (std::size_t i = 1; i < kExplicitStages; ++i) {
        Stage& stage = stages_[i];
        stage.x = x;
        if (directions_ > 0) stage.S = S;
        for (std::size_t j = 0; j < i; ++j) {
            const double weight = h * kExplicit[i][j];
            if (weight == 0) continue;
            stage.x += weight * stages_[j].k;
            if (directions_ > 0) stage.S += weight * stages_[j].K;
        }
        evaluate(over, t + h * kExplicitNodes[i], stage.x, stage.at, all_requested());
        stage.k = stage.at.values;
        if (directions_ > 0) set_derivatives(stage, stage.S);
    }
    return scaled_error(kExplicitError, kExplicitStages, h, stages_.back().x);
}

// Newton's iteration for X = known + h/4 f(X); then the derivative of its solution.
bool SensitivitySolver::solve_stage(const Interval& over, double t, double h, Stage& stage, const Vector& known) {
    const double weight = h * kDiagonal;
    const auto system = [&]() -> Matrix { return Matrix::Identity(n_, n_) - weight * Matrix(stage.at.by_state); };
    bool solved = false;
    for (int iteration = 0; iteration < kNewtonSteps && !solved; ++iteration) {
        evaluate(over, t, stage.x, stage.at, Derivatives::kState);
        const Vector residual = known + weight * stage.at.values - stage.x;
        const Matrix A = system();
        if (!residual.allFinite() || !A.allFinite()) return false;
        const Vector step = solve_by_lu(A, residual).x;
        if (!step.allFinite()) return false;
        stage.x += step;
        const auto size = size_.array().max(stage.x.array().abs()).max(1e-300);
        solved = (step.array().abs() <= 1e-3 * tolerance_ * size).all();
    }
    if (!solved) return false;
    stage.k = (stage.x - known) / weight;
    if (directions_ == 0) return true;
    evaluate(over, t, stage.x, stage.at, Derivatives::kAll);
    Matrix right = sensitivity_sum_;
    right.leftCols(stage.at.by_parameter.cols()) += weight * Matrix(stage.at.by_parameter);
    stage.S = solve_by_lu(system(), right).x;
    stage.K = (stage.S - sensitivity_sum_) / weight;
    return true;
}

double SensitivitySolver::take_implicit_step(const Interval& over, double t, double h) {
    stages_[0].x = x;
    evaluate(over, t, x, stages_[0].at, all_requested());
    stages_[0].k = stages_[0].at.values;
    if (directions_ > 0) set_derivatives(stages_[0], S);
    for (std::size_t i = 1; i < kImplicitStages; ++i) {
        sum_ = x;
        if (directions_ > 0) sensitivity_sum_ = S;
        for (std::size_t j = 0; j < i; ++j) {
            const double weight = h * kImplicit[i][j];
            sum_ += weight * stages_[j].k;
            if (directions_ > 0) sensitivity_sum_ += weight * stages_[j].K;
        }
        stages_[i].x = stages_[i - 1].x;
        if (!solve_stage(over, t + h * kImplicitNodes[i], h, stages_[i], sum_)) return kInfinity;
    }
    return scaled_error(kImplicitError, kImplicitStages, h, stages_[kImplicitStages - 1].x);
}

// h |k_7 - k_6| / |x_7 - x_6| is about h times the largest eigenvalue.
void SensitivitySolver::look_for_stiffness(double h) {
    double rates = 0, states = 0;
    for (Index i = 0; i < n_; ++i) {
        if (size_[i] == 0) continue;
        rates += std::pow((stages_[6].k[i] - stages_[5].k[i]) / size_[i], 2);
        states += std::pow((stages_[6].x[i] - stages_[5].x[i]) / size_[i], 2);
    }
    const bool bound = !has_jumps_ && states > 0 && h * std::sqrt(rates / states) > kStabilityBound;
    if (bound) {
        other_steps_ = 0;
        if (++stiff_steps_ >= kStiffSteps) implicit_ = true;
    } else if (++other_steps_ >= kOtherSteps) {
        stiff_steps_ = 0;
    }
}

void SensitivitySolver::accept(const Stage& last) {
    x = last.x;
    if (directions_ > 0) S = last.S;
    size_ = size_.cwiseMax(x.cwiseAbs());
}

/// Where a step that fails first met a rate that is no number, though the states were: outside of what a root or a
/// logarithm is defined for.
void SensitivitySolver::refuse_undefined_rate(double t, double h) const {
    for (std::size_t i = 0; i < kExplicitStages; ++i) {
        const Stage& stage = stages_[i];
        if (!(stage.x.cwiseAbs().maxCoeff() < kLostState)) return;
        for (Index j = 0; j < n_; ++j)
            if (std::isnan(stage.k[j]))
                throw SimulationBreakdown(
                    "At t = {}, the derivative of the state {} is NaN for {}. Check for a root or a logarithm of a "
                    "negative number; sqrt(max(x, 0)) is defined for every x",
                    t + h * kExplicitNodes[i], names_[static_cast<std::size_t>(j)], states_text(stage.x));
        if (!stage.k.allFinite()) return;
    }
}

MessageList SensitivitySolver::states_text(const Vector& at) const {
    MessageList states;
    for (Index i = 0; i < n_; ++i)
        states.items.push_back(Message("{} = {}", names_[static_cast<std::size_t>(i)], at[i]));
    return states;
}

void SensitivitySolver::break_down(const Interval& over, double t, double h) {
    refuse_undefined_rate(t, h);
    evaluate(over, t, x, stages_[0].at, Derivatives::kNone);
    const MessageList states = states_text(x);
    for (Index i = 0; i < n_; ++i)
        if (!std::isfinite(stages_[0].at.values[i]))
            throw SimulationBreakdown(
                "At t = {}, the derivative of the state {} is {} for {}. Check the equations, for example for a "
                "division by zero",
                t, names_[static_cast<std::size_t>(i)], stages_[0].at.values[i], states);
    Index fastest = 0;
    (stages_[0].at.values.array().abs() / size_.array().max(1e-300)).maxCoeff(&fastest);
    throw SimulationBreakdown(
        "At t = {}, the state {} becomes infinite (last values: {}). Check the equations, or use other "
        "parameter values",
        t, names_[static_cast<std::size_t>(fastest)], states);
}

void SensitivitySolver::advance(double t_begin, double t_end, const double* u_begin, const double* u_end) {
    const Interval over{t_begin, t_end - t_begin, u_begin, u_end};
    const double least = kLeastShare * over.length;
    size_ = size_.cwiseMax(x.cwiseAbs());
    first_is_known_ = has_jumps_ = false;
    double t = t_begin;
    if (!(next_step_ > 0)) next_step_ = over.length;
    for (int steps = 0, missed = 0, rejected = 0; t < t_end; ++steps) {
        const double left = t_end - t;
        const bool rough = steps >= kMaxSteps || rejected >= kMaxRejectedSteps || missed >= kMaxMisses;
        const bool last = next_step_ >= left;
        double h = last ? left : std::min(next_step_, 0.5 * left);
        if (rough) h = std::min(left, std::max(h, kRoughShare * over.length));
        const bool by_implicit = implicit_;
        const double error = by_implicit ? take_implicit_step(over, t, h) : take_explicit_step(over, t, h);
        const double order = by_implicit ? 4 : 5;
        const double factor =
            error > 0 ? std::clamp(kSafety * std::pow(error, -1 / order), kSlowest, kFastest) : kFastest;
        const bool tolerated = error <= 1;
        if (!tolerated && !rough && h > least) {
            next_step_ = std::max(least, h * factor);
            ++rejected;
            continue;
        }
        if (!tolerated && by_implicit) {  // it finds no step, however short: an equation with jumps
            implicit_ = false;
            has_jumps_ = true;
            first_is_known_ = false;
            continue;
        }
        if (!std::isfinite(error)) break_down(over, t, h);
        if (!tolerated) {
            ++missed;
            if (rough_times_.size() < kRoughTimes) rough_times_.push_back(t);
        }
        if (!by_implicit) look_for_stiffness(h);
        accept(stages_[by_implicit ? kImplicitStages - 1 : kExplicitStages - 1]);
        if (!by_implicit) std::swap(stages_[0], stages_[kExplicitStages - 1]);  // its last rate is the next one's first
        t = h == left ? t_end : t + h;
        next_step_ = last ? std::max(next_step_, h * factor) : h * factor;
    }
}

}  // namespace dynlab::inline numerics
