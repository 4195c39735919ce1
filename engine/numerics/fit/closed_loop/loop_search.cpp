#include "numerics/fit/closed_loop/loop_search.h"

#include <cmath>

#include "numerics/criteria/denominator_group.h"
#include "numerics/error.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/simulation_error.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/statistics/robust_covariance.h"

namespace dynlab::inline numerics {

namespace {

constexpr int kHalvings = 12;
constexpr double kMinLossDecrease = 1e-13;  // of the loss: what a step must promise, for rounding not to hide it

/// The loop of a theta and the known controller.
class LoopOutput {
  public:
    LoopOutput(const IdData& data, const TransferStructure& structure, const LoopSignals& signals)
        : data_(data), structure_(structure), signals_(signals) {}

    /// y - x, experiment after experiment; infinite for a loop that is not stable.
    Vector errors(const VectorView& theta) const {
        const ClosedLoop loop = loop_of(theta);
        Vector errors(data_.sample_count());
        if (!loop.stable()) return Vector::Constant(errors.size(), kInfinity);
        Index first = 0;
        for (const Experiment& experiment : data_.experiments) {
            const Index count = experiment.y.rows();
            errors.segment(first, count) = experiment.y.col(0) - loop.to_reference(experiment.r.col(0)).x;
            first += count;
        }
        return errors;
    }

    /// d x/d theta, N x d, of a stable loop.
    Matrix sensitivities(const VectorView& theta) const {
        const ClosedLoop loop = loop_of(theta);
        Matrix psi(data_.sample_count(), structure_.parameter_count());
        Index first = 0;
        for (const Experiment& experiment : data_.experiments) {
            psi.middleRows(first, experiment.y.rows()) =
                loop.sensitivities(experiment.r.col(0), structure_.channels.front().zeros);
            first += experiment.y.rows();
        }
        return psi;
    }

  private:
    ClosedLoop loop_of(const VectorView& theta) const {
        return {structure_.models(theta).front(), *signals_.controller(), data_.Ts, signals_.hold_r()};
    }

    const IdData& data_;
    const TransferStructure& structure_;
    const LoopSignals& signals_;
};

/// The fit of x(r), with the model in its loop; false, and nothing is done, where that is unstable.
bool measure_in_loop(Fit& fit, const IdData& data, const LoopSignals& signals) {
    const Vector errors = LoopOutput(data, fit.structure, signals).errors(fit.theta);
    if (!errors.allFinite()) return false;
    const auto N = static_cast<double>(errors.size()), d = static_cast<double>(fit.theta.size());
    fit.offsets = Matrix::Zero(static_cast<Index>(data.experiments.size()), 1);
    fit.fit_percent = Vector::Constant(1, fit_percent_of_sums(errors.squaredNorm(), output_variations(data)[0]));
    fit.noise_variance = Vector::Constant(1, errors.squaredNorm() / (N - d));
    fit.loss = errors.squaredNorm() / N;
    fit.warnings.push_back(Message(
        "The fit and the noise variance refer to the closed loop with the model, simulated from the reference."));
    return true;
}

}  // namespace

void describe_loop(Fit& fit, const IdData& data, const LoopSignals& signals, bool in_loop) {
    describe_models(fit, UnstableAdvice::kController);
    if (!in_loop || !has_unstable_pole(fit.models.front()) || !measure_in_loop(fit, data, signals))
        measure_simulation(fit, data);
    if (signals.warning()) fit.warnings.push_back(*signals.warning());
    if (signals.controller() && !in_loop)
        fit.warnings.push_back(
            Message("The closed loop of this model and the specified controller is unstable, but the measured closed "
                    "loop was stable: the model or the controller is wrong."));
}

Message instruments_text(const LoopSignals& signals, bool in_loop) {
    if (!in_loop) return Message("with instruments from the projection of the input onto the reference");
    const auto& controller = *signals.controller();
    if (!controller.sampled()) return Message("with instruments from the reference through the closed loop");
    if (controller.computing_delay == 0)
        return Message("with instruments from the reference through the closed loop, with a controller without delay");
    return Message("with instruments from the reference through the closed loop, with a controller delay of {}",
                   plural(controller.computing_delay, "{} sample", "{} samples"));
}

Fit search_loop(Fit start, const IdData& data, const FitOptions& options, const LoopSignals& signals) {
    Fit fit = std::move(start);
    fit.trace.clear();
    const LoopOutput model(data, fit.structure, signals);
    Vector errors = model.errors(fit.theta);
    if (!errors.allFinite())
        throw InvalidArgument(
            "clsrivc: the closed loop of the initial model and the specified controller is unstable, so the indirect "
            "route cannot start: check the controller, or specify lambda");
    fit.termination = Termination::kIterationLimit;
    const double count = static_cast<double>(errors.size());
    for (int pass = 0; pass < options.max_iterations; ++pass) {
        if (options.cancel && options.cancel()) {
            fit.termination = Termination::kCanceled;
            break;
        }
        const Matrix psi = model.sensitivities(fit.theta);
        Vector step = solve_by_pivoted_qr(psi, errors);
        const Vector sizes = fit.theta.array().abs().max(1e-12 * fit.theta.cwiseAbs().maxCoeff());
        const bool settled = step.cwiseQuotient(sizes).cwiseAbs().maxCoeff() <= options.tolerance;
        // Next to the least loss its last digits say nothing of a step.
        const bool is_significant = (psi * step).squaredNorm() > kMinLossDecrease * errors.squaredNorm();
        Vector tried;
        int halvings = 0;
        for (; halvings <= kHalvings; ++halvings, step /= 2) {
            tried = model.errors(fit.theta + step);
            if (tried.squaredNorm() <= errors.squaredNorm() || (!is_significant && tried.allFinite())) break;
        }
        if (halvings > kHalvings) {
            fit.termination = settled ? Termination::kConverged : Termination::kNoProgress;
            break;
        }
        fit.theta += step;
        errors = tried;
        const double change = step.cwiseQuotient(sizes).cwiseAbs().maxCoeff();
        fit.trace.push_back({fit.theta, errors.squaredNorm() / count, change});
        if (!settled) continue;
        fit.termination = Termination::kConverged;
        break;
    }
    std::vector<Index> lengths;
    for (const Experiment& experiment : data.experiments) lengths.push_back(experiment.y.rows());
    fit.covariance = robust_covariance(model.sensitivities(fit.theta), errors, lengths).covariance;
    fit.warnings.clear();
    describe_loop(fit, data, signals, true);
    fit.loss = errors.squaredNorm() / count;
    fit.message = has_settled(fit)
                      ? Message("The output-error search in closed loop (indirect route) converged after {}: {}.",
                                iteration_count(fit), simulation_text(fit))
                      : Message("The output-error search in closed loop (indirect route) stopped after {}: {}.",
                                iteration_count(fit), simulation_text(fit));
    return fit;
}

}  // namespace dynlab::inline numerics
