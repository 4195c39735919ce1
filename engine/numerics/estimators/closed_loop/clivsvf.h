#pragma once
#include "numerics/estimators/lssvf.h"
#include "numerics/fit/closed_loop/loop_signals.h"

namespace dynlab::inline numerics {

/// Instrumental variables on state-variable filtered signals for closed-loop data, u = C (r - y), and the CARX
/// structure A(p) y = B(p) u(t - delay) + e: theta solves
///     sum_k z(k) (p^n y_f - phi' theta) = 0,  z = [-p^(n-1) x_f .. -x_f, p^m w_f .. w_f]
/// where x and w are the parts of y and u that the reference alone explains (fit/closed_loop/loop_signals.h). With a
/// controller they come from the loop of the current model, without one from the projection of u on r and the model's
/// response to it. clivsvf makes three passes; the first uses the model of lssvf. The estimate is consistent for any
/// noise that is independent of the reference. lssvf and ivsvf are not: their regressors or instruments are correlated
/// with the noise through u. Standard errors are valid for colored errors, too. Data: one input, one output, one
/// reference, any number of experiments, regular sampling, from rest. Throws InvalidArgument for data without a
/// reference that changes (check_loop_data), a controller that does not match them, and equations without a unique
/// solution. Reference: Gilson, Garnier, Young and Van den Hof in Garnier and Wang (2008), chapter 5.
Fit clivsvf(const IdData& data, const TransferStructure& structure, const SvfOptions& options,
            const LoopKnowledge& known = {});

}  // namespace dynlab::inline numerics
