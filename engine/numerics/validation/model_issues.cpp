#include "numerics/validation/model_issues.h"

#include <algorithm>

namespace dynlab::inline numerics {

namespace {

constexpr Index kMinCount = 60;               // samples below which a model would say little
constexpr Index kMaxSamplesToCheck = 200000;  // that are checked individually
constexpr double kSomething = 25;             // per cent of fit below which what the model leaves is no sign of a curve

DataIssue too_short(Index samples) {
    return {"short",
            Weight::kWarning,
            "",
            plural(samples,
                   "The data have only {} sample. A model needs about ten samples per parameter: collect more data, or "
                   "use a model with one pole.",
                   "The data have only {} samples. A model needs about ten samples per parameter: collect more data, "
                   "or use a model with one pole."),
            static_cast<double>(samples),
            0,
            {}};
}

/// Then what the model leaves is no noise.
bool has_nonlinearity(const DataIssues& findings) {
    return std::any_of(findings.begin(), findings.end(), [](const DataIssue& f) {
        return f.code == "nonlinear" || f.code == "saturation" || f.code == "changing_gain";
    });
}

}  // namespace

ModelAdvice model_advice(const IdData& data, const std::function<bool()>& cancel) {
    ModelAdvice advice;
    DataIssues& findings = advice.findings;
    if (data.sample_count(0) < kMinCount) {
        findings.push_back(too_short(data.sample_count(0)));
        return advice;
    }
    IdData first = data;
    first.experiments.resize(1);
    std::optional<FittedData> fit = fitted_data(first, cancel);
    if (!fit) return advice;
    const bool answered_backwards = find_exchange(*fit, cancel, findings);
    if (answered_backwards && !fit->runs_away()) return advice;
    if (!answered_backwards && find_late_input(*fit, findings)) return advice;  // its errors look like outliers
    const bool checks_each_sample = fit->error.size() <= kMaxSamplesToCheck;
    if (checks_each_sample) find_error_outliers(*fit, cancel, findings);
    advice.checks_outliers = fit->trusted() && checks_each_sample;
    if (!answered_backwards && find_load(*fit, findings)) return advice;
    if (find_runaway(*fit, findings)) {
        find_feedback(*fit, findings);
        return advice;
    }
    const bool strange = fit->trusted() && find_strange_sections(*fit, findings);
    if (!strange && !gain_explains_error(*fit)) find_disturbance(*fit, findings);
    if (fit->simulation.fit_percent > kSomething && !strange) find_nonlinearity(*fit, findings);
    if (!has_nonlinearity(findings)) find_feedback(*fit, findings);
    find_noise(*fit, findings);
    if (!fit->trusted()) return advice;
    find_dead_time(*fit, findings);
    find_offset(*fit, findings);
    find_running_start(*fit, findings);
    find_sampling_rate(*fit, findings);
    find_integrator(*fit, findings);
    advice.error = std::move(fit->error);
    return advice;
}

}  // namespace dynlab::inline numerics
