#pragma once
#include "numerics/fit/transfer_search.h"

namespace dynlab::inline numerics {

/// Continuous-time output error, for the COE structure y_i = sum_j B_ij(p)/F_ij(p) u_j(t - delay_ij) + e_i:
///     minimize sum_k (y(k) - simulated output(k))^2
/// over all parameters, free delays, initial values and offsets jointly, by Levenberg-Marquardt with exact
/// sensitivities from the start that srivc also uses; free delays are first looked for on a grid. Efficient for white
/// e; its optimum is srivc's fixed point. Structures, options, warnings and errors as for srivc. Reference: Ljung
/// (1999), sections 4.2 and 10.2; Garnier and Wang (2008), chapter 1. `aids`: what is known already.
Fit coe(const IdData& data, const TransferStructure& structure, const FitOptions& options = {},
        const SearchAids& aids = {});

}  // namespace dynlab::inline numerics
