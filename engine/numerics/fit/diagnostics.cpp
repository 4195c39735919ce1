#include "numerics/fit/diagnostics.h"

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

std::optional<StructureAdvice> missed_by(const Fit& fit, const IdData& data, const FitOptions& options) {
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

DeferredDiagnostics::DeferredDiagnostics(Diagnostics known)
    : missed_(std::move(known.missed)), assessment_(std::move(known.assessment)) {}

DeferredDiagnostics::DeferredDiagnostics(Fit fit, std::shared_ptr<const IdData> data, FitOptions options) {
    fit.trace.clear();
    fit.output.resize(0);
    options.cancel = nullptr;  // it may refer to what is gone by then
    struct Estimation {
        Fit fit;
        std::shared_ptr<const IdData> data;
        FitOptions options;
    };
    const auto of = std::make_shared<const Estimation>(Estimation{std::move(fit), std::move(data), std::move(options)});
    missed_ = decltype(missed_)::later([of] { return missed_by(of->fit, *of->data, of->options); });
    assessment_ = decltype(assessment_)::later([of] { return assessment_of(of->fit, *of->data, of->options); });
}

}  // namespace dynlab::inline numerics
