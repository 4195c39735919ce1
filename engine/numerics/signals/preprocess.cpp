#include "numerics/signals/preprocess.h"

#include "numerics/error.h"

namespace dynlab {

namespace {

struct Line {
    Vector offset, slope;
};

/// Takes the mean or the least-squares line off each column; `t` counts from the first sample.
Line remove_line(Matrix& signals, const Vector& t, TrendKind kind) {
    const Eigen::RowVectorXd mean = signals.colwise().mean();
    signals.rowwise() -= mean;
    if (kind == TrendKind::kConstant) return {mean.transpose(), Vector::Zero(signals.cols())};
    const double mean_time = t.mean();
    const Vector centred = t.array() - mean_time;
    const Eigen::RowVectorXd slope = centred.transpose() * signals / centred.squaredNorm();
    signals -= centred * slope;
    return {(mean - mean_time * slope).transpose(), slope.transpose()};
}

}  // namespace

Detrended detrend(const IdData& data, TrendKind kind) {
    Detrended result{data, {}};
    for (std::size_t i = 0; i < data.experiments.size(); ++i) {
        Experiment& experiment = result.data.experiments[i];
        if (kind == TrendKind::kLinear && experiment.y.rows() < 2)
            throw InvalidArgument("detrend: a straight line needs at least 2 samples, but the experiment has 1");
        const Vector time = data.time(i);
        const Vector since_start = time.array() - time(0);
        const Line output = remove_line(experiment.y, since_start, kind);
        const Line input = remove_line(experiment.u, since_start, kind);
        result.removed.push_back({output.offset, output.slope, input.offset, input.slope});
    }
    return result;
}

}  // namespace dynlab
