#include "numerics/fit/transfer_data.h"

#include <algorithm>
#include <limits>

#include "numerics/error.h"
#include "numerics/number_text.h"

namespace dynlab::inline numerics {

CentredData without_operating_points(const IdData& data) {
    CentredData centred{data, {}};
    for (Experiment& experiment : centred.data.experiments) {
        auto& removed = centred.removed.emplace_back();
        const Matrix u = experiment.u;
        for (Index output = 0; output < experiment.y.cols(); ++output) {
            removed.push_back(joint_operating_point(u, experiment.y.col(output)));
            experiment.y.col(output).array() -= removed.back().output;
        }
        if (!removed.empty()) experiment.u.rowwise() -= removed.front().inputs.transpose();
    }
    return centred;
}

std::vector<StartCondition> start_conditions(const IdData& data, InitialState state, Offset offset) {
    // Two rows that begin with zero, and change, where some experiment does.
    Matrix summary = Matrix::Zero(2, data.input_count());
    for (const Experiment& experiment : data.experiments) {
        const Eigen::RowVectorXd first = experiment.u.row(0);
        summary.row(0) = summary.row(0).cwiseMax(first.cwiseAbs());
        summary.row(1) = summary.row(1).cwiseMax((experiment.u.rowwise() - first).cwiseAbs().colwise().maxCoeff());
    }
    summary.row(1) += summary.row(0);
    return start_conditions(summary, state, offset);
}

double shortest_record(const IdData& data) {
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t e = 0; e < data.experiments.size(); ++e) shortest = std::min(shortest, data.duration(e));
    return shortest;
}

DelayRange delay_range(const IdData& data, const TransferOptions& options) {
    const double shortest = shortest_record(data);
    const double largest = options.TdMax.value_or(std::max(options.TdMin, shortest / 4));
    if (largest >= shortest)
        throw InvalidArgument("TdMax must be shorter than the record of " + number_text(shortest) + " s, and is " +
                              number_text(largest) + " s");
    return {options.TdMin, largest};
}

}  // namespace dynlab::inline numerics
