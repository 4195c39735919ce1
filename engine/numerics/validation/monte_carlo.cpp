#include "numerics/validation/monte_carlo.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>

#include "numerics/error.h"
#include "numerics/linalg/side_by_side.h"
#include "numerics/signals/random.h"
#include "numerics/signals/robust_statistics.h"
#include "numerics/simulation/closed_loop.h"
#include "numerics/simulation/lsim.h"
#include "numerics/validation/cramer_rao.h"

namespace dynlab::inline numerics {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

using Outcome = MonteCarloOutcome;

Message failure_of(const MonteCarloEstimate& estimate) {
    if (estimate.theta.size() == 0) return Message("the estimator returned no parameters");
    if (!estimate.theta.allFinite()) return Message("a parameter is not finite");
    return {};
}

Outcome outcome_of(const MonteCarloMethod& method, const IdData& data) {
    Outcome outcome;
    try {
        outcome.estimate = method.estimate(data);
        outcome.failure = failure_of(outcome.estimate);
    } catch (const std::exception& error) {
        outcome.failure = message_of(error);
    }
    outcome.done = true;
    return outcome;
}

/// The components of the data of a study: the noise-free data, and how the noise enters.
class NoisyData {
  public:
    explicit NoisyData(const MonteCarloStudy& study) : r_(study.u), Ts_(study.Ts), hold_(study.hold) {
        if (!study.controller) {
            clean_ = {study.u, lsim(study.system, study.u, study.Ts, study.hold)};
        } else {
            loop_.emplace(study.system, *study.controller, study.Ts, study.hold);
            if (!loop_->stable())
                throw InvalidArgument("the loop of system and controller is unstable: decrease the controller's gain");
            clean_ = loop_->to_reference(study.u);
            hold_ = study.controller->sampled() ? Hold::kZoh : Hold::kFoh;
        }
        if (!clean_.x.allFinite())
            throw InvalidArgument(
                "the output of the system diverges, because the system is unstable. Use a stable system, or a closed "
                "loop (option 'controller')");
    }

    const Vector& noise_free_output() const { return clean_.x; }
    IdData empty_data() const {
        IdData data_set(Matrix(clean_.x), Matrix(clean_.u), Ts_);
        data_set.hold = hold_;
        return loop_ ? data_set.with_reference(Matrix(r_)) : data_set;
    }
    void draw(RandomStream& random, double sigma, IdData& data_set) const {
        Experiment& one = data_set.experiments.front();
        Vector v(one.y.rows());
        for (double& value : v) value = sigma * random.normal();
        one.y.col(0) = clean_.x + v;
        if (!loop_) return;
        const ClosedLoop::Response response = loop_->to_disturbance(v);
        one.y.col(0) += response.x;
        one.u.col(0) = clean_.u + response.u;
    }

  private:
    Vector r_;
    double Ts_;
    Hold hold_;
    std::optional<ClosedLoop> loop_;
    ClosedLoop::Response clean_;
};

/// Combines the objects that the threads of a study share: the noise-free data, the outcomes, progress and the request
/// to stop.
class Runner {
  public:
    /// Of `count` runs from `first` on.
    Runner(const MonteCarloStudy& study, const std::vector<MonteCarloMethod>& methods, const NoisyData& noisy_data,
           double sigma, std::size_t first, std::size_t count)
        : study_(study),
          methods_(methods),
          noisy_data_(noisy_data),
          sigma_(sigma),
          first_(static_cast<int>(first)),
          runs_(count, MonteCarloRun{std::vector<Outcome>(methods.size())}) {}

    void run() {
        if (any(true)) run_concurrently();
        if (!any(false)) return;
        IdData data_set = noisy_data_.empty_data();
        for (int k = first_; k < end(); ++k) one_run(k, false, data_set);
    }

    std::vector<MonteCarloRun> take() { return std::move(runs_); }
    bool canceled() const { return canceled_; }

  private:
    int end() const { return first_ + static_cast<int>(runs_.size()); }
    bool any(bool concurrent) const {
        return std::any_of(methods_.begin(), methods_.end(),
                           [&](const MonteCarloMethod& method) { return method.concurrent == concurrent; });
    }

    void run_concurrently() {
        tbb::enumerable_thread_specific<IdData> noisy_data([this] { return noisy_data_.empty_data(); });
        tbb::task_arena arena(thread_count(study_.threads));
        arena.execute([&] {
            tbb::parallel_for(
                tbb::blocked_range<int>(first_, end(), 1),
                [&](const tbb::blocked_range<int>& runs) {
                    // A nested parallel loop of a method must not start another run that uses this thread's data.
                    for (int k = runs.begin(); k < runs.end(); ++k)
                        tbb::this_task_arena::isolate([&] { one_run(k, true, noisy_data.local()); });
                },
                tbb::simple_partitioner());
        });
    }

    void one_run(int k, bool concurrent, IdData& data_set) {
        if (asked_to_stop()) return;
        RandomStream random(study_.seed + static_cast<std::uint32_t>(k));
        noisy_data_.draw(random, sigma_, data_set);
        for (std::size_t j = 0; j < methods_.size(); ++j) {
            if (methods_[j].concurrent != concurrent) continue;
            Outcome outcome = outcome_of(methods_[j], data_set);
            if (asked_to_stop()) return;  // the method may have been stopped half way
            runs_[static_cast<std::size_t>(k - first_)].outcomes[j] = std::move(outcome);
            report_progress();
        }
    }

    bool asked_to_stop() {
        if (!study_.cancel) return false;
        const std::scoped_lock lock(callbacks_);
        if (!canceled_ && study_.cancel()) canceled_ = true;
        return canceled_;
    }

    void report_progress() {
        if (!study_.progress) return;
        const std::scoped_lock lock(callbacks_);
        study_.progress(++estimations_);
    }

    const MonteCarloStudy& study_;
    const std::vector<MonteCarloMethod>& methods_;
    const NoisyData& noisy_data_;
    double sigma_;
    int first_;
    std::vector<MonteCarloRun> runs_;
    std::mutex callbacks_;
    std::atomic<bool> canceled_ = false;
    std::size_t estimations_ = 0;
};

std::vector<std::string> names_for(const MonteCarloEstimate& estimate, const TransferFunction& system) {
    const std::size_t d = static_cast<std::size_t>(estimate.theta.size());
    if (estimate.names.size() == d) return estimate.names;
    std::vector<std::string> names = system_parameter_names(system);
    if (estimate.continuous && names.size() == d) return names;
    names.clear();
    for (std::size_t i = 1; i <= d; ++i) names.push_back("theta" + std::to_string(i));
    return names;
}

/// Statistics of parameter i over the runs that gave an estimate.
void describe_parameter(MonteCarloResult& result, Index i) {
    std::vector<double> values, reported;
    for (Index k = 0; k < result.theta.rows(); ++k) {
        if (std::isfinite(result.theta(k, i))) values.push_back(result.theta(k, i));
        if (std::isfinite(result.std(k, i))) reported.push_back(result.std(k, i));
    }
    const auto as_vector = [](const std::vector<double>& list) -> Vector {
        return Eigen::Map<const Vector>(list.data(), static_cast<Index>(list.size()));
    };
    // Sums over vectors of Eigen's own, aligned alike: those over a list depend on where it lies in memory.
    const Vector v = as_vector(values);
    const Index count = v.size();
    result.mean[i] = v.mean();
    result.spread[i] = std::sqrt((v.array() - v.mean()).square().sum() / std::max(1.0, static_cast<double>(count - 1)));
    result.low[i] = v.minCoeff();
    result.high[i] = v.maxCoeff();
    if (!reported.empty()) result.reported[i] = as_vector(reported).mean();
    result.median[i] = median(values);
}

void fill_runs(MonteCarloResult& result, const std::vector<Outcome>& outcomes, Index d) {
    const auto runs = static_cast<Index>(outcomes.size());
    result.theta = result.std = Matrix::Constant(runs, d, kNothing);
    for (Index k = 0; k < runs; ++k) {
        const Outcome& outcome = outcomes[static_cast<std::size_t>(k)];
        if (!outcome.done) continue;
        const MonteCarloEstimate& estimate = outcome.estimate;
        Message failure = outcome.failure;
        if (failure.empty() && estimate.theta.size() != d)
            failure = plural(estimate.theta.size(), "the estimator returned {} parameter, but {} in an earlier run",
                             "the estimator returned {} parameters, but {} in an earlier run", d);
        if (!failure.empty()) {
            if (result.failed++ == 0) result.first_failure = failure;
            continue;
        }
        ++result.estimated;
        if (!estimate.converged) ++result.not_converged;
        result.theta.row(k) = estimate.theta.transpose();
        if (estimate.std.size() == d) result.std.row(k) = estimate.std.transpose();
    }
}

std::vector<Outcome> outcomes_of_method(std::vector<MonteCarloRun>& runs, std::size_t method) {
    std::vector<Outcome> outcomes;
    for (MonteCarloRun& run : runs) {
        if (run.outcomes.size() <= method)
            throw InvalidArgument("a run of the study has no result for one of the estimators");
        outcomes.push_back(std::move(run.outcomes[method]));
    }
    return outcomes;
}

const MonteCarloEstimate* first_estimate(const std::vector<Outcome>& outcomes) {
    for (const Outcome& outcome : outcomes)
        if (outcome.done && outcome.failure.empty()) return &outcome.estimate;
    return nullptr;
}

void add_truth(MonteCarloResult& result, const MonteCarloStudy& study, double sigma) {
    result.truth = true_parameters(study.system, result.names);
    if (result.truth.size() == 0) return;
    result.bias = result.mean - result.truth;
    if (study.controller) return;  // the information in the noise of u is not part of the bound
    const bool free_delay = result.names.back() == "Td";
    const Index coefficients = result.truth.size() - study.system.pole_count() - (free_delay ? 1 : 0);
    if (free_delay && coefficients > study.system.pole_count()) return;  // no bound: the output jumps with the input
    result.bound = cramer_rao_bound(study.system, study.u, study.Ts, study.hold, sigma, result.names);
}

MonteCarloResult result_of(const MonteCarloStudy& study, const MonteCarloMethod& method,
                           const std::vector<Outcome>& outcomes, double sigma) {
    MonteCarloResult result;
    result.label = method.label;
    const MonteCarloEstimate* sample = first_estimate(outcomes);
    fill_runs(result, outcomes, sample == nullptr ? 0 : sample->theta.size());
    if (sample == nullptr && result.failed > 0)
        throw InvalidArgument("every run of '{}' failed; the first error: {}", method.label, result.first_failure);
    if (sample == nullptr) return result;
    result.names = names_for(*sample, study.system);
    for (Vector* statistic :
         {&result.mean, &result.spread, &result.median, &result.low, &result.high, &result.reported})
        *statistic = Vector::Constant(sample->theta.size(), kNothing);
    for (Index i = 0; i < sample->theta.size(); ++i) describe_parameter(result, i);
    if (sample->continuous) add_truth(result, study, sigma);
    return result;
}

void check_methods(const std::vector<MonteCarloMethod>& methods) {
    if (methods.empty()) throw InvalidArgument("a study needs at least one estimator");
    for (std::size_t i = 0; i < methods.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (methods[i].label == methods[j].label)
                throw InvalidArgument("two estimators are named '{}': give each a different label", methods[i].label);
}

}  // namespace

void MonteCarloStudy::validate() const {
    if (!system.continuous())
        throw InvalidArgument("the system must be a continuous-time model; convert it with d2c(G)");
    if (runs < 2 || runs > 1'000'000)
        throw InvalidArgument("the number of runs must be between 2 and 1000000, but {} was given", runs);
    if (threads < 0) throw InvalidArgument("the number of threads must be nonnegative, but {} was given", threads);
    if (sigma.has_value() == snr.has_value())
        throw InvalidArgument("specify either sigma (the standard deviation of the noise) or snr (in dB)");
    if (sigma && !(*sigma >= 0 && std::isfinite(*sigma)))
        throw InvalidArgument("sigma must be nonnegative, but {} was given", *sigma);
    if (snr && !std::isfinite(*snr)) throw InvalidArgument("snr must be a finite number in dB, but {} was given", *snr);
}

Vector MonteCarloResult::least_spread() const {
    return bound.diagonal().cwiseSqrt();
}

MonteCarlo monte_carlo(const MonteCarloStudy& study, const std::vector<MonteCarloMethod>& methods) {
    study.validate();
    check_methods(methods);
    const NoisyData noisy_data(study);
    const double scale = standard_deviation(noisy_data.noise_free_output());
    if (study.snr && !(scale > 0)) throw InvalidArgument("snr needs a noise-free output that changes; specify sigma");
    MonteCarlo all;
    all.runs = study.runs;
    all.sigma = study.sigma ? *study.sigma : scale * std::pow(10.0, -*study.snr / 20);
    all.snr = 20 * std::log10(scale / all.sigma);
    const auto some = [&](std::size_t first, std::size_t count) {
        Runner runner(study, methods, noisy_data, all.sigma, first, count);
        runner.run();
        all.canceled = all.canceled || runner.canceled();
        return runner.take();
    };
    const auto count = static_cast<std::size_t>(study.runs);
    std::vector<MonteCarloRun> runs = study.in_parts ? study.in_parts(count, some) : some(0, count);
    for (std::size_t j = 0; j < methods.size(); ++j)
        all.results.push_back(result_of(study, methods[j], outcomes_of_method(runs, j), all.sigma));
    return all;
}

}  // namespace dynlab::inline numerics
