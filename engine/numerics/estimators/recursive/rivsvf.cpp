#include "numerics/estimators/recursive/rivsvf.h"

#include "numerics/estimators/ivsvf.h"

namespace dynlab::inline numerics {

Fit rivsvf(const IdData& data, const TransferStructure& structure, const RecursiveOptions& options) {
    Fit fit = recursive_pass({"rivsvf", Message("Instrumental variables on filtered signals")},
                             RecursiveMethod::kInstruments, data, structure, options);
    // Without forgetting, the last estimate is a batch estimate: its covariance follows from the color of all errors,
    // not from blocks as in the pass.
    if (options.forgetting == 1 && options.drift.size() == 0 && data.sample_count() <= kMaxColoredSamples &&
        fit.termination != Termination::kCanceled)
        color_covariance(fit, data, {options.lambda, options.hold_y, {}}, true);
    return fit;
}

}  // namespace dynlab::inline numerics
