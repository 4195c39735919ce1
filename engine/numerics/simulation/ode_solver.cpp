#include "numerics/simulation/ode_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "numerics/error.h"

namespace dynlab::inline numerics {

void OdeOptions::validate() const {
    const auto positive = [](double value) { return value > 0 && std::isfinite(value); };
    if (!positive(relative_tolerance))
        throw InvalidArgument("the integrator's relative tolerance must be positive, but it is {}", relative_tolerance);
    if (!positive(absolute_tolerance))
        throw InvalidArgument("the integrator's absolute tolerance must be positive, but it is {}", absolute_tolerance);
    if (!positive(first_step))
        throw InvalidArgument("the integrator's first step must be positive, but it is {}", first_step);
}

OdeSolver::OdeSolver(OdeRate rate, const OdeOptions& options)
    : rate_(std::move(rate)), options_(options), next_step_(options.first_step) {
    options.validate();
}

OdeSolver::Step OdeSolver::step(double t, const OdeState& x, double h, const OdeState& k1) const {
    const OdeState k2 = rate_(t + h / 5, x + h / 5 * k1);
    const OdeState k3 = rate_(t + 3 * h / 10, x + h * (3. / 40 * k1 + 9. / 40 * k2));
    const OdeState k4 = rate_(t + 4 * h / 5, x + h * (44. / 45 * k1 - 56. / 15 * k2 + 32. / 9 * k3));
    const OdeState k5 =
        rate_(t + 8 * h / 9, x + h * (19372. / 6561 * k1 - 25360. / 2187 * k2 + 64448. / 6561 * k3 - 212. / 729 * k4));
    const OdeState k6 = rate_(
        t + h, x + h * (9017. / 3168 * k1 - 355. / 33 * k2 + 46732. / 5247 * k3 + 49. / 176 * k4 - 5103. / 18656 * k5));
    Step step;
    step.x = x + h * (35. / 384 * k1 + 500. / 1113 * k3 + 125. / 192 * k4 - 2187. / 6784 * k5 + 11. / 84 * k6);
    step.rate = rate_(t + h, step.x);
    step.error = h * (71. / 57600 * k1 - 71. / 16695 * k3 + 71. / 1920 * k4 - 17253. / 339200 * k5 + 22. / 525 * k6 -
                      1. / 40 * step.rate);
    return step;
}

double OdeSolver::error_of(const Step& step, const OdeState& x) const {
    const auto size = x.array().abs().max(step.x.array().abs());
    const double error =
        (step.error.array().abs() / (options_.absolute_tolerance + options_.relative_tolerance * size)).maxCoeff();
    return step.x.allFinite() && std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
}

double OdeSolver::time_of_event(double t, const OdeState& x, double h, const OdeState& rate,
                                const OdeGuard& guard) const {
    double before = 0, after = h;
    const double resolution = 2 * std::numeric_limits<double>::epsilon() * std::max(std::abs(t), h);
    while (after - before > resolution) {
        const double middle = (before + after) / 2;
        const bool event = guard(t + middle, step(t, x, middle, rate).x).minCoeff() < 0;
        (event ? after : before) = middle;
    }
    return after;
}

bool OdeSolver::advance(double& t, OdeState& x, double t_end, const OdeGuard& guard) {
    constexpr double kSafety = 0.9, kSlowest = 0.2, kFastest = 5, kOrder = 5;
    if (!(t < t_end)) return false;
    OdeState rate = rate_(t, x);
    while (t < t_end) {
        const bool last = next_step_ >= t_end - t;
        const double h = last ? t_end - t : next_step_;
        const Step trial = step(t, x, h, rate);
        const double error = error_of(trial, x);
        const double factor =
            error > 0 ? std::clamp(kSafety * std::pow(error, -1 / kOrder), kSlowest, kFastest) : kFastest;
        if (error > 1) {
            next_step_ = h * factor;
            if (t + next_step_ / 4 == t)
                throw InvalidArgument(
                    "the integrator found no step small enough for its tolerance at t = {}. Check whether the "
                    "equations are discontinuous or the solution grows without bound",
                    t);
            continue;
        }
        if (guard && guard(t + h, trial.x).minCoeff() < 0) {
            const double event = time_of_event(t, x, h, rate, guard);
            x = step(t, x, event, rate).x;
            t += event;
            return true;
        }
        t = last ? t_end : t + h;
        x = trial.x;
        rate = trial.rate;
        next_step_ = last ? std::max(next_step_, h * factor) : h * factor;
    }
    return false;
}

}  // namespace dynlab::inline numerics
