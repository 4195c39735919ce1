#include "numerics/fit/diagnostics.h"

#include <mutex>
#include <utility>

#include "numerics/fit/integrated_input.h"

namespace dynlab::inline numerics {

namespace {

/// The data as the estimation saw them.
class SeenData {
  public:
    SeenData(const Fit& fit, const IdData& data, const FitOptions& options) : data_(data) {
        if (!options.integration) return;
        integrated_ = fit.polynomial ? summed_inputs(data) : integrated_inputs(data);
        is_integrated_ = true;
    }
    const IdData& get() const { return is_integrated_ ? integrated_ : data_; }

  private:
    const IdData& data_;
    IdData integrated_;
    bool is_integrated_ = false;
};

std::optional<MissedStructure> missed_by(const Fit& fit, const IdData& data, const FitOptions& options) {
    if (fit.polynomial || fit.process || (fit.noise && options.integration)) return std::nullopt;
    return missed_structure(SeenData(fit, data, options).get(), fit, options);
}

std::shared_ptr<const Assessment> assessment_of(const Fit& fit, const IdData& data, const FitOptions& options) {
    if (fit.noise) return nullptr;
    auto assessment = assess_if_affordable(SeenData(fit, data, options).get(), fit);
    return assessment ? std::make_shared<const Assessment>(std::move(*assessment)) : nullptr;
}

}  // namespace

std::vector<Message> Diagnostics::warnings() const {
    if (!missed) return {};
    return {sentence_of(*missed)};
}

Diagnostics diagnose(const Fit& fit, const IdData& data, const FitOptions& options) {
    return {missed_by(fit, data, options), assessment_of(fit, data, options)};
}

struct DeferredDiagnostics::State {
    Fit fit;
    std::shared_ptr<const IdData> data;
    FitOptions options;
    std::mutex mutex = {};
    Diagnostics found = {};
    bool knows_missed = false, knows_assessment = false;

    void forget_data() {
        if (!knows_missed || !knows_assessment) return;
        data.reset();
        fit = {};
    }
};

DeferredDiagnostics::DeferredDiagnostics(Diagnostics known) : state_(std::make_shared<State>()) {
    state_->found = std::move(known);
    state_->knows_missed = state_->knows_assessment = true;
}

DeferredDiagnostics::DeferredDiagnostics(Fit fit, std::shared_ptr<const IdData> data, FitOptions options)
    : state_(std::make_shared<State>()) {
    fit.trace.clear();
    fit.output.resize(0);
    options.cancel = nullptr;  // it may refer to what is gone by then
    state_->fit = std::move(fit);
    state_->data = std::move(data);
    state_->options = std::move(options);
}

std::optional<MissedStructure> DeferredDiagnostics::missed() const {
    if (!state_) return std::nullopt;
    const std::scoped_lock lock(state_->mutex);
    if (!state_->knows_missed) state_->found.missed = missed_by(state_->fit, *state_->data, state_->options);
    state_->knows_missed = true;
    state_->forget_data();
    return state_->found.missed;
}

std::shared_ptr<const Assessment> DeferredDiagnostics::assessment() const {
    if (!state_) return nullptr;
    const std::scoped_lock lock(state_->mutex);
    if (!state_->knows_assessment)
        state_->found.assessment = assessment_of(state_->fit, *state_->data, state_->options);
    state_->knows_assessment = true;
    state_->forget_data();
    return state_->found.assessment;
}

}  // namespace dynlab::inline numerics
