// Which way srivc takes: the passes of the method (srivc.cpp), or a search where they do not give the whole answer.
#include "numerics/estimators/srivc.h"
#include "numerics/fit/srivc_search.h"

namespace dynlab::inline numerics {

bool srivc_passes_suffice(const TransferStructure& structure, const FitOptions& options) {
    if (structure.free_delays || options.initial_state != InitialState::kZero || options.offset != Offset::kNone)
        return false;
    if (!options.fixed.empty() || options.output_weights.size() > 0) return false;
    for (Index output = 0; output < structure.outputs; ++output)
        if (!structure.inputs_share_denominator(output)) return false;
    return true;
}

Fit srivc(const IdData& data, const TransferStructure& structure, const FitOptions& options, const SearchAids& aids) {
    options.validate();
    if (!srivc_passes_suffice(structure, options) || aids.start.size() > 0)
        return search_srivc(data, structure, options, aids);
    Fit estimate = srivc_by_passes(data, structure, options);
    if (estimate.termination == Termination::kCancelled) return estimate;
    return search_where_passes_fail(std::move(estimate), data, options, aids);
}

}  // namespace dynlab::inline numerics
