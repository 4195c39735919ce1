#include "numerics/fit/output_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "numerics/error.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/linalg/side_by_side.h"

namespace dynlab::inline numerics {

namespace {

constexpr int kRoughIterations = 15;
constexpr double kRoughTolerance = 1e-3;
constexpr double kFirstDamping = 1e-3, kLeastDamping = 1e-14, kLargestDamping = 1e12;

class Search {
  public:
    Search(const OutputErrorModel& model, const VectorView& y, const FitOptions& options)
        : model_(model), y_(y), options_(options) {
        spread_ = (y.array() - y.mean()).matrix().norm();
        if (spread_ == 0) spread_ = y.norm();
        rounding_ = std::pow(std::numeric_limits<double>::epsilon() * y.norm(), 2);
    }

    /// The end of the search, and its trace.
    Fit run(const Vector& start) {
        theta_ = start.cwiseMax(model_.lower()).cwiseMin(model_.upper());
        evaluate_here();
        Termination termination = Termination::kIterationLimit;
        for (int iteration = 0; iteration < options_.max_iterations; ++iteration) {
            if (options_.cancel && options_.cancel()) {
                termination = Termination::kCanceled;
                break;
            }
            const double change = improve();
            if (change < 0) {
                termination = Termination::kNoProgress;
                break;
            }
            trace_.push_back({theta_, square_sum_ / samples(), change});
            if (change <= options_.tolerance) {
                termination = Termination::kConverged;
                break;
            }
        }
        Fit result;
        result.theta = theta_;
        result.loss = square_sum_ / samples();
        result.termination = termination;
        result.trace = trace_;
        return result;
    }

    /// Adds what the sensitivities at the end say of it.
    Fit complete(Fit result) const {
        const Index count = theta_.size();
        std::vector<Index> free;
        for (Index i = 0; i < count; ++i)
            if (!held_[static_cast<std::size_t>(i)]) free.push_back(i);
        result.at_bound = held_;
        const double variance = square_sum_ / (samples() - static_cast<double>(free.size()));
        result.noise_variance = Vector::Constant(1, variance);
        result.covariance = Matrix::Zero(count, count);
        if (!options_.precision) return result;
        const Matrix gram = scale_.asDiagonal() * gram_ * scale_.asDiagonal();
        const SensitivityPrecision precision = sensitivity_precision(model_, theta_, gram, free);
        if (precision.inverse_gram.size() == 0) return result;
        result.covariance(free, free) = variance * precision.inverse_gram;
        result.condition_number = precision.condition_number;
        return result;
    }

  private:
    double samples() const { return static_cast<double>(y_.size() - model_.masked_rows()); }

    void evaluate_here() { set_products(model_.products(theta_, y_)); }

    void set_products(const OutputErrorProducts& sums) {
        square_sum_ = sums.squares;
        scale_ = sums.gram.diagonal().cwiseSqrt();
        for (double& value : scale_)
            if (!(value > 0)) value = 1;
        const auto scaling = scale_.cwiseInverse().asDiagonal();
        gram_ = scaling * sums.gram * scaling;
        descent_ = scaling * sums.descent;
        hold_at_bounds();
    }

    void hold_at_bounds() {
        held_.assign(static_cast<std::size_t>(theta_.size()), false);
        for (Index i = 0; i < theta_.size(); ++i) {
            const bool outwards = model_.lower()[i] == model_.upper()[i] ||
                                  (theta_[i] <= model_.lower()[i] && descent_[i] < 0) ||
                                  (theta_[i] >= model_.upper()[i] && descent_[i] > 0);
            held_[static_cast<std::size_t>(i)] = outwards;
        }
    }

    // The damped Gauss-Newton point, cut back to the bounds.
    Vector candidate() const {
        Matrix system = gram_;
        Vector right = descent_;
        system.diagonal().array() += damping_;
        for (Index i = 0; i < theta_.size(); ++i) {
            if (!held_[static_cast<std::size_t>(i)]) continue;
            system.row(i).setZero();
            system.col(i).setZero();
            system(i, i) = 1;
            right[i] = 0;
        }
        const Vector step = solve_semidefinite(system, right).cwiseQuotient(scale_);
        return (theta_ + step).cwiseMax(model_.lower()).cwiseMin(model_.upper());
    }

    double relative_change(const Vector& next) const {
        const Vector size = theta_.cwiseAbs() + spread_ * scale_.cwiseInverse();
        return (next - theta_).cwiseAbs().cwiseQuotient(size).maxCoeff();
    }

    // The sums at `next`, unless its errors are larger. A step after an accepted step is mostly accepted, too: only
    // after a rejected step the output is computed alone first.
    std::optional<OutputErrorProducts> products_below(double squares, const Vector& next) const {
        if (!model_.products_are_cheap() && !last_was_taken_) {
            if (!((y_ - model_.output_at(next)).squaredNorm() <= squares)) return std::nullopt;
            return model_.products(next, y_);
        }
        OutputErrorProducts sums = model_.products(next, y_);
        if (!(sums.squares <= squares)) return std::nullopt;
        return sums;
    }

    // One accepted step; returns the largest relative change, or -1 when no damping helps.
    double improve() {
        while (damping_ <= kLargestDamping) {
            const Vector next = candidate();
            const double change = relative_change(next);
            if (next.allFinite()) {
                // Close to the solution the decrease drowns in rounding, and the step is right all the same.
                const double limit = square_sum_ * (1 + 1e-12) + rounding_;
                if (const std::optional<OutputErrorProducts> sums = products_below(limit, next)) {
                    theta_ = next;
                    set_products(*sums);
                    damping_ = std::max(kLeastDamping, damping_ / 10);
                    last_was_taken_ = true;
                    return change;
                }
                if (change <= 1e-3 * options_.tolerance) return change;
            }
            damping_ = std::max(kFirstDamping, damping_ * 8);
            last_was_taken_ = false;
        }
        return -1;
    }

    const OutputErrorModel& model_;
    const VectorView& y_;
    const FitOptions& options_;
    double spread_ = 0, rounding_ = 0, square_sum_ = 0, damping_ = kFirstDamping;
    Vector theta_, scale_, descent_;
    Matrix gram_;  // of the sensitivities with their columns scaled to norm one
    bool last_was_taken_ = true;
    std::vector<bool> held_;
    std::vector<FitIteration> trace_;
};

}  // namespace

SensitivityPrecision sensitivity_precision(const OutputErrorModel& model, const Vector& theta, const Matrix& gram,
                                           const std::vector<Index>& free) {
    constexpr double kGramLimit = 1e3;
    if (free.empty() || !gram.allFinite()) return {};
    Vector lengths = gram.diagonal()(free).cwiseSqrt();
    for (double& value : lengths)
        if (!(value > 0)) value = 1;
    const Matrix unscale = lengths.cwiseInverse().asDiagonal();
    const auto [values, vectors] = symmetric_eigen(unscale * gram(free, free) * unscale);
    const double condition = std::sqrt(values[values.size() - 1] / std::max(values[0], 1e-300));
    if (condition < kGramLimit) {
        const Matrix V = unscale * vectors;
        return {V * values.cwiseInverse().asDiagonal() * V.transpose(), condition};
    }
    Vector output;
    Matrix sensitivities;
    model.simulate(theta, output, &sensitivities);
    if (!sensitivities.allFinite()) return {};
    const LeastSquares fit = solve_least_squares(sensitivities(Eigen::all, free), Vector::Zero(output.size()));
    return {fit.inverse_gram, fit.condition_number};
}

Matrix covariance_of_unequal_rows(const Matrix& covariance, double variance, const Matrix& J, const Vector& variances) {
    if (!(variance > 0) || !J.allFinite()) return covariance;
    const Matrix inverse_gram = covariance / variance;
    return inverse_gram * (J.transpose() * variances.asDiagonal() * J) * inverse_gram;
}

void check_output_weights(const Vector& weights, Index outputs) {
    if (weights.size() == 0) return;
    if (weights.size() != outputs)
        throw InvalidArgument("{} needs one positive number for each of the {}, but has {}",
                              OptionName{"output_weights"}, plural(outputs, "{} output", "{} outputs"), weights.size());
    for (const double weight : weights)
        if (!(weight > 0) || !std::isfinite(weight))
            throw InvalidArgument("{} must be positive, but one value is {}", OptionName{"output_weights"}, weight);
}

namespace {

Search search_for(const OutputErrorModel& model, const VectorView& y, const Vector& start, const FitOptions& options) {
    options.validate();
    const Index count = model.parameter_count();
    if (start.size() != count)
        throw InvalidArgument("The number of initial values must be {}, but is {}", count, start.size());
    if (y.size() <= count)
        throw InvalidArgument("The number of samples, {}, must be greater than the number of parameters, {}", y.size(),
                              count);
    return Search(model, y, options);
}

}  // namespace

Fit minimize_output_error(const OutputErrorModel& model, const VectorView& y, const Vector& start,
                          const FitOptions& options) {
    Search search = search_for(model, y, start, options);
    return search.complete(search.run(start));
}

Fit minimize_output_error(const OutputErrorModel& model, const VectorView& y, const std::vector<Vector>& starts,
                          const FitOptions& options) {
    if (starts.size() == 1) return minimize_output_error(model, y, starts.front(), options);
    const FitOptions rough = options.limited(std::min(kRoughIterations, options.max_iterations),
                                             std::max(kRoughTolerance, options.tolerance));
    std::vector<Fit> trials(starts.size());
    side_by_side(starts.size(),
                 [&](std::size_t i) { trials[i] = search_for(model, y, starts[i], rough).run(starts[i]); });
    Fit best = std::move(trials.front());
    for (std::size_t i = 1; i < trials.size() && best.termination != Termination::kCanceled; ++i)
        if (trials[i].loss < (1 - kRoughTolerance) * best.loss) best = std::move(trials[i]);
    Fit end = minimize_output_error(model, y, best.theta, options);
    end.trace.insert(end.trace.begin(), best.trace.begin(), best.trace.end());
    return end;
}

double bic_of(const Fit& fit, const IdData& data, Index values) {
    const Index N = data.sample_count(), outputs = data.output_count();
    const Vector power = output_powers(data);
    if (outputs == 1) return bic_of_loss(fit.loss, power[0], N, values);
    const Vector variation = output_variations(data);
    double sum = 0;
    for (Index output = 0; output < outputs; ++output) {
        const double share = 1 - fit.fit_percent[output] / 100;
        sum += bic_of_loss(share * share * variation[output] / static_cast<double>(N), power[output], N, values);
        values = 0;  // counted once
    }
    return sum;
}

Fit fit_output_error(const FitProblem& problem) {
    const Index samples = problem.data.sample_count() * problem.data.output_count();
    Fit best;
    double smallest = kInfinity;
    for (const StartCondition& condition : problem.conditions) {
        const bool first = &condition == &problem.conditions.front();
        const Index values = problem.value_count(condition);
        if (!first && (samples <= values || samples < problem.samples_per_value * values)) continue;
        Fit fit = problem.fit(condition);
        const double bic = bic_of(fit, problem.data, values);
        if (first || bic < smallest) {
            best = std::move(fit);
            smallest = bic;
        }
        if (best.termination == Termination::kCanceled) break;
    }
    check_transient(problem.method, problem.data, best, problem.value_count(best.start));
    return best;
}

}  // namespace dynlab::inline numerics
