#pragma once
#include <vector>

#include "numerics/criteria/initial_conditions.h"
#include "numerics/fit/transfer_estimate.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// The data counted from each experiment's operating point, and those points: [experiment][output].
struct CentredData {
    IdData data;
    std::vector<std::vector<JointOperatingPoint>> removed;
};
CentredData without_operating_points(const IdData& data);

/// The start conditions (kernels/initial_conditions.h) that the options allow and the inputs of all experiments
/// together can tell apart.
std::vector<StartCondition> start_conditions(const IdData& data, InitialState state, Offset offset);

double shortest_record(const IdData& data);  ///< s, of all experiments

struct DelayRange {
    double least = 0, largest = 0;  ///< s
};
/// Between which a free delay is looked for: TdMin and TdMax; without TdMax a quarter of the shortest record. Throws
/// InvalidArgument for a TdMax that is not shorter than the shortest record.
DelayRange delay_range(const IdData& data, const TransferOptions& options);

}  // namespace dynlab::inline numerics
