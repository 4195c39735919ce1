#include "numerics/validation/intervals/bootstrap.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include "numerics/error.h"
#include "numerics/signals/random.h"
#include "numerics/signals/robust_statistics.h"
#include "numerics/simulation/noise.h"
#include "numerics/statistics/autoregression.h"
#include "numerics/validation/residual_tests.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kReal = 1 - 1e-12;  // a damping of one, but for rounding

/// Names and values of what follows from a model.
struct Derived {
    std::vector<std::string> names;
    std::vector<double> values;
};

Derived derived_quantities(const FittedOutput& fitted) {
    const TransferFunction G = fitted.model();
    Derived derived;
    const auto add = [&](const std::string& name, double value) {
        derived.names.push_back(name);
        derived.values.push_back(value);
    };
    if (!fitted.process) add("gain", G.dc_gain());
    std::vector<double> times;
    std::vector<std::pair<double, double>> pairs;
    for (const PoleDescription& pole : damping(G)) {
        if (pole.pole.imag() > 0) pairs.emplace_back(pole.natural_frequency, pole.damping_ratio);
        if (std::abs(pole.damping_ratio) >= kReal && pole.pole.real() != 0) times.push_back(-1 / pole.pole.real());
    }
    if (fitted.process) return derived;  // its parameters are these
    std::sort(times.rbegin(), times.rend());
    std::sort(pairs.begin(), pairs.end());
    for (std::size_t i = 0; i < times.size(); ++i) add("T" + std::to_string(i + 1), times[i]);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        add("w" + std::to_string(i + 1), pairs[i].first);
        add("zeta" + std::to_string(i + 1), pairs[i].second);
    }
    return derived;
}

/// What is drawn: errors of all experiments, one after the other.
class ErrorSource {
  public:
    ErrorSource(const RefittedOutput& model, const Vector& errors, BootstrapKind kind, double variance, bool white)
        : kind_(kind), lengths_(model.lengths()), sigma_(std::sqrt(variance)) {
        const double size = std::sqrt(errors.squaredNorm() / static_cast<double>(errors.size()));
        pool_ = errors.array() - errors.mean();
        if (size > 0) pool_ *= sigma_ / size;
        if (kind == BootstrapKind::kResidual || white) return;
        const Autoregression found = fit_autoregression(errors, lengths_, highest_autoregressive_order(errors.size()));
        noise_.D = found.filter();
        sigma_ /= noise_.gain();
    }

    Vector draw(std::uint32_t seed) const {
        RandomStream random(seed);
        Vector errors(pool_.size());
        if (kind_ == BootstrapKind::kResidual) {
            for (double& error : errors)
                error = pool_[static_cast<Index>(random.uniform() * static_cast<double>(pool_.size()))];
            return errors;
        }
        Index row = 0;
        for (const Index length : lengths_) {
            errors.segment(row, length) = noise_.draw(length, sigma_, random);
            row += length;
        }
        return errors;
    }

  private:
    BootstrapKind kind_;
    std::vector<Index> lengths_;
    double sigma_;
    Vector pool_;
    ColoredNoise noise_;
};

void summarise(Bootstrap& study, double confidence) {
    const Index d = study.values.cols();
    study.mean = study.std = study.low = study.high = Vector::Constant(d, kNaN);
    for (Index i = 0; i < d; ++i) {
        std::vector<double> values;
        for (const double value : study.values.col(i))
            if (std::isfinite(value)) values.push_back(value);
        if (values.size() < 2) continue;
        std::sort(values.begin(), values.end());
        const auto all = Vector::Map(values.data(), static_cast<Index>(values.size()));
        study.mean[i] = all.mean();
        study.std[i] = std::sqrt((all.array() - all.mean()).square().sum() / static_cast<double>(values.size() - 1));
        study.low[i] = quantile_of_sorted(all, (1 - confidence) / 2);
        study.high[i] = quantile_of_sorted(all, (1 + confidence) / 2);
    }
}

/// All runs, each into its row.
void repeat(Bootstrap& study, const RefittedOutput& model, const Fit& base, const ErrorSource& source,
            const BootstrapOptions& options) {
    const Vector output = model.simulated(base);
    std::atomic<bool> canceled = false;
    std::atomic<int> failed = 0;
    std::mutex mutex;
    std::size_t done = 0;
    const auto run = [&](int k) {
        {
            const std::lock_guard lock(mutex);
            if (options.cancel && !canceled && options.cancel()) canceled = true;
        }
        if (canceled) return;
        const Vector outputs = output + source.draw(options.seed + static_cast<std::uint32_t>(k));
        try {
            const Fit fit = model.fit({}, &base, &outputs);
            const Derived derived = derived_quantities(model.fitted().at(fit.theta));
            study.values.row(k).head(fit.theta.size()) = fit.theta.transpose();
            for (std::size_t i = 0; i < derived.names.size(); ++i)
                for (Index j = study.parameters; j < study.values.cols(); ++j)
                    if (study.names[static_cast<std::size_t>(j)] == derived.names[i])
                        study.values(k, j) = derived.values[i];
        } catch (const InvalidArgument&) {
            ++failed;
        }
        const std::lock_guard lock(mutex);
        ++done;
        if (options.progress) options.progress(done);
    };
    tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
    arena.execute([&] { tbb::parallel_for(0, options.runs, run); });
    study.failed = failed;
    study.canceled = canceled;
}

/// What was done, without its doubts.
Message summary_of(const BootstrapOptions& options, bool white) {
    const Message runs = plural(options.runs, "{} run", "{} runs");
    const Number percent = significant(100 * options.confidence, 4);
    if (options.kind == BootstrapKind::kResidual)
        return Message("Residual bootstrap with {}; {} % confidence intervals.", runs, percent);
    return white ? Message("Parametric bootstrap with {}; {} % confidence intervals.", runs, percent)
                 : Message("Parametric bootstrap with {} and colored noise; {} % confidence intervals.", runs, percent);
}

bool are_white(const RefittedOutput& model, const Vector& errors) {
    std::vector<Vector> data_sets;
    Index row = 0;
    for (const Index length : model.lengths()) {
        data_sets.emplace_back(errors.segment(row, length));
        row += length;
    }
    return whiteness_test(data_sets).white;
}

}  // namespace

void BootstrapOptions::validate() const {
    if (runs < 20) throw InvalidArgument("bootstrap: {} must be at least 20, but is {}", OptionName{"runs"}, runs);
    if (!(confidence > 0 && confidence < 1))
        throw InvalidArgument("bootstrap: {} must be between 0 and 1, such as 0.95, but is {}",
                              OptionName{"confidence"}, confidence);
}

Bootstrap bootstrap(const RefittedOutput& model, const BootstrapOptions& options) {
    options.validate();
    const Fit base = model.fit();
    const Vector errors = model.measured() - model.simulated(base);
    const double N = static_cast<double>(errors.size());
    const double variance = errors.squaredNorm() / (N - static_cast<double>(model.value_count()));
    const bool white = are_white(model, errors);
    const Derived derived = derived_quantities(model.fitted().at(base.theta));
    Bootstrap study;
    study.names = model.fitted().names();
    study.parameters = base.theta.size();
    study.names.insert(study.names.end(), derived.names.begin(), derived.names.end());
    study.estimate.resize(static_cast<Index>(study.names.size()));
    study.estimate << base.theta, Vector::Map(derived.values.data(), static_cast<Index>(derived.values.size()));
    study.values = Matrix::Constant(options.runs, study.estimate.size(), kNaN);
    repeat(study, model, base, ErrorSource(model, errors, options.kind, variance, white), options);
    if (study.failed == options.runs) throw InvalidArgument("bootstrap: none of the runs could be fitted");
    summarise(study, options.confidence);
    if (const auto moved = model.moved(base)) study.warnings.push_back(*moved);
    if (!white && options.kind == BootstrapKind::kResidual)
        study.warnings.push_back(
            Message("The residuals are not white, and the residual bootstrap ignores their correlation: use the "
                    "parametric bootstrap."));
    if (study.failed > 0)
        study.warnings.push_back(plural(study.failed, "{} run could not be fitted and is excluded from all results.",
                                        "{} runs could not be fitted and are excluded from all results."));
    std::vector<Message> all = study.warnings;
    all.insert(all.begin(), summary_of(options, white));
    study.message = sentences(std::move(all));
    return study;
}

}  // namespace dynlab::inline numerics
