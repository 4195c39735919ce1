#pragma once
#include <vector>

#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// One output of a problem whose outputs share no denominator, as a problem of its own.
struct OutputProblem {
    IdData data;                  ///< all inputs, one output
    TransferStructure structure;  ///< its channels
    std::vector<Index> places;    ///< of its parameters among all
};

/// Whether no denominator serves channels of two outputs.
bool outputs_are_separate(const TransferStructure& structure);

/// The fit of one output (0-based) by itself.
OutputProblem output_problem(const IdData& data, const TransferStructure& structure, Index output);

/// The estimates of all outputs as one estimate of the whole structure: covariance block by block, the worst
/// termination and condition number; iteration k of the trace has each output at its k-th or last iteration. Standard
/// errors, warnings and message are left empty: describe_search writes them.
Fit join_outputs(const TransferStructure& structure, const std::vector<OutputProblem>& problems,
                 const std::vector<Fit>& estimates);

}  // namespace dynlab::inline numerics
