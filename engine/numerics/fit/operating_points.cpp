#include "numerics/fit/operating_points.h"

#include <utility>

namespace dynlab::inline numerics {

CenteredData without_operating_points(const IdData& data) {
    CenteredData centered{data, {}};
    for (Experiment& experiment : centered.data.experiments) {
        auto& removed = centered.removed.emplace_back();
        const Matrix u = experiment.u;
        for (Index output = 0; output < experiment.y.cols(); ++output) {
            removed.push_back(joint_operating_point(u, experiment.y.col(output)));
            experiment.y.col(output).array() -= removed.back().output;
        }
        if (!removed.empty()) experiment.u.rowwise() -= removed.front().inputs.transpose();
    }
    return centered;
}

CenteredData centered_for(const IdData& data, Offset offset) {
    return offset == Offset::kRemove ? without_operating_points(data) : CenteredData{data, {}};
}

void add_operating_points(Fit& fit, std::vector<std::vector<JointOperatingPoint>> removed) {
    for (std::size_t e = 0; e < removed.size(); ++e)
        for (std::size_t o = 0; o < removed[e].size(); ++o)
            fit.offsets(static_cast<Index>(e), static_cast<Index>(o)) += removed[e][o].output;
    fit.removed = std::move(removed);
}

}  // namespace dynlab::inline numerics
