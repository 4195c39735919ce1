#include "numerics/fit/transfer_report.h"

#include "numerics/fit/simulation_report.h"
#include "numerics/number_text.h"

namespace dynlab::inline numerics {

namespace {

void warn_of_search(TransferEstimate& estimate, const TransferOptions& options) {
    if (estimate.termination == Termination::kIterationLimit)
        estimate.warnings.push_back("The search had not settled after MaxIter = " + std::to_string(options.MaxIter) +
                                    " iterations; the best point so far is given.");
    if (estimate.termination == Termination::kCancelled)
        estimate.warnings.push_back("The search was stopped before its end; the best point so far is given.");
}

/// A step of a held input reaches the output through the direct term at the next sampling instant, wherever between
/// two instants it arrives, and n + 1 weights of the sampled response cannot tell n + 1 coefficients and a delay.
void warn_of_ambiguous_delays(TransferEstimate& estimate, const IdData& data) {
    if (!estimate.structure.free_delays || data.hold != Hold::kZoh || !data.regular()) return;
    for (std::size_t i = 0; i < estimate.models.size(); ++i)
        if (estimate.models[i].zero_count() == estimate.models[i].pole_count() && estimate.models[i].delay() > 0)
            estimate.warnings.push_back("The delay" + channel_text(estimate, i) +
                                        " is only known to within one sampling time, and its standard error means "
                                        "nothing: the input is held and the model has as many zeros as poles. Fix the "
                                        "delay with IODelay, or take one zero fewer.");
}

void warn_of_delays(TransferEstimate& estimate, const DelayRange& range) {
    if (!estimate.structure.free_delays || !(range.largest > range.least)) return;
    const double edge = 1e-9 * range.largest;
    for (std::size_t i = 0; i < estimate.models.size(); ++i) {
        const double delay = estimate.models[i].delay();
        const std::string subject = "The delay" + channel_text(estimate, i) + " lies at ";
        if (delay >= range.largest - edge)
            estimate.warnings.push_back(subject + "TdMax = " + number_text(range.largest) +
                                        " s, the edge of what was searched: raise TdMax.");
        else if (delay <= range.least + edge && range.least > 0)
            estimate.warnings.push_back(subject + "TdMin = " + number_text(range.least) +
                                        " s, the edge of what was searched: lower TdMin.");
        else if (delay <= edge)
            estimate.warnings.push_back("No delay" + channel_text(estimate, i) +
                                        " is visible: a model without one suits.");
    }
}

}  // namespace

void describe_refinement(TransferEstimate& estimate, const IdData& data, const std::string& method,
                         const TransferOptions& options, const DelayRange& range) {
    warn_of_search(estimate, options);
    report_errors(estimate);
    warn_of_delays(estimate, range);
    warn_of_ambiguous_delays(estimate, data);
    const bool settled =
        estimate.termination == Termination::kConverged || estimate.termination == Termination::kNoProgress;
    set_message(estimate, method + (settled ? " converged" : " stopped") + " after " +
                              iterations_text(estimate.trace.size()) + ", simulated " + description(estimate.start));
}

}  // namespace dynlab::inline numerics
