#include "numerics/estimators/learning/dmdc.h"

#include <algorithm>

#include "numerics/error.h"
#include "numerics/estimators/learning/canceled.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/linalg/decompositions.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kRounding = 1e-10;  // of the largest singular value, below which a singular value counts as rounding

Vector root_mean_squares(const IdData& data, Matrix Experiment::*channels) {
    Vector squares = Vector::Zero((data.experiments.front().*channels).cols());
    for (const Experiment& experiment : data.experiments)
        squares += (experiment.*channels).colwise().squaredNorm().transpose();
    return (squares / static_cast<double>(data.sample_count())).cwiseSqrt();
}

struct Scale {
    Vector y, u;
};

/// z(first) .. z(first + count - 1) as columns, sample d - 1 being the first that has a snapshot.
Matrix snapshots(const Experiment& data_set, const Scale& scale, Index d, Index first, Index count) {
    const Index ny = scale.y.size(), nu = scale.u.size();
    Matrix Z(d * ny + (d - 1) * nu, count);
    for (Index i = 0; i < d; ++i)
        Z.middleRows(i * ny, ny) =
            scale.y.cwiseInverse().asDiagonal() * data_set.y.middleRows(first - i, count).transpose();
    for (Index i = 1; i < d; ++i)
        Z.middleRows(d * ny + (i - 1) * nu, nu) =
            scale.u.cwiseInverse().asDiagonal() * data_set.u.middleRows(first - i, count).transpose();
    return Z;
}

/// Snapshots with the inputs below them, and the next ones, of all experiments.
struct Snapshots {
    Matrix now, next;
};

Snapshots neighboring_snapshots(const IdData& data, const Scale& scale, Index d) {
    const Index rows = d * scale.y.size() + (d - 1) * scale.u.size(), nu = scale.u.size();
    Index columns = 0, at = 0;
    for (const Experiment& data_set : data.experiments) columns += std::max<Index>(0, data_set.y.rows() - d);
    if (columns <= rows + nu)
        throw InvalidArgument(
            "dmdc: more than {} snapshots are required, but the data have only {}. Use more data, or fewer delays",
            rows + nu, columns);
    Snapshots pairs{Matrix(rows + nu, columns), Matrix(rows, columns)};
    for (const Experiment& data_set : data.experiments) {
        const Index count = data_set.y.rows() - d;
        if (count <= 0) continue;
        pairs.now.topRows(rows).middleCols(at, count) = snapshots(data_set, scale, d, d - 1, count);
        pairs.now.bottomRows(nu).middleCols(at, count) =
            scale.u.cwiseInverse().asDiagonal() * data_set.u.middleRows(d - 1, count).transpose();
        pairs.next.middleCols(at, count) = snapshots(data_set, scale, d, d, count);
        at += count;
    }
    return pairs;
}

Index distinguishable(const Vector& s) {
    return (s.array() > kRounding * s[0]).count();
}

struct Reduced {
    Matrix A, B, U;
    Vector singular_values;
    double condition_number = 1;  ///< of what the equations are solved with
};

Reduced reduce(const Snapshots& pairs, const DmdcOptions& options) {
    const int rank = options.rank;
    const Index rows = pairs.next.rows(), nu = pairs.now.rows() - rows;
    // [now; next]' = Q [R11 R12; 0 R22]: all inner products are those of the short columns of R.
    Matrix joint(pairs.now.cols(), pairs.now.rows() + rows);
    joint << pairs.now.transpose(), pairs.next.transpose();
    check_canceled("dmdc", options.cancel);
    const Matrix R = triangular_part(joint);
    check_canceled("dmdc", options.cancel);
    const Matrix now = R.leftCols(rows + nu).transpose(), next = R.rightCols(rows).transpose();
    const SingularValues of_next = jacobi_svd(next), of_now = jacobi_svd(now);
    const Index seen = distinguishable(of_next.s), r = rank > 0 ? rank : seen;
    if (r > seen)
        throw InvalidArgument("dmdc: {} is {}, but the data support only {}", OptionName{"rank"}, rank,
                              plural(seen, "{} singular vector", "{} singular vectors"));
    const Index p = std::min(r + nu, distinguishable(of_now.s));
    const Matrix U = of_next.U.leftCols(r);
    const Matrix G = U.transpose() * next * of_now.V.leftCols(p) * of_now.s.head(p).cwiseInverse().asDiagonal() *
                     of_now.U.leftCols(p).transpose();
    return {G.leftCols(rows) * U, G.rightCols(nu), U, of_next.s, of_now.s[0] / of_now.s[p - 1]};
}

void measure_fit(DmdcFit& found, const IdData& data, const Scale& scale, const Matrix& U) {
    const StateSpace& system = found.system;
    const Index d = found.delays, ny = data.output_count();
    Vector errors = Vector::Zero(ny);
    Index count = 0;
    for (const Experiment& data_set : data.experiments) {
        if (data_set.y.rows() < d) continue;
        Vector x = U.transpose() * snapshots(data_set, scale, d, d - 1, 1);
        for (Index k = d - 1; k < data_set.y.rows(); ++k, ++count) {
            errors += (data_set.y.row(k).transpose() - system.C * x).cwiseAbs2();
            x = system.A * x + system.B * data_set.u.row(k).transpose();
        }
    }
    found.fit.loss = errors.sum() / static_cast<double>(count * ny);
    found.fit.fit_percent = errors.binaryExpr(output_variations(data), &fit_percent_of_sums);
}

void describe(DmdcFit& found) {
    Fit& fit = found.fit;
    if (found.eigenvalues.cwiseAbs().maxCoeff() > 1)
        fit.warnings.push_back(Message("The model is unstable: an eigenvalue is outside the unit circle."));
    fit.message = Message("Dynamic mode decomposition of snapshots of {}, rank {}: {}.",
                          plural(found.delays, "{} sample", "{} samples"), found.rank, simulation_text(fit));
}

}  // namespace

void DmdcOptions::validate() const {
    if (rank < 0) throw InvalidArgument("dmdc: {} must be nonnegative, but is {}", OptionName{"rank"}, rank);
    if (delays < 1) throw InvalidArgument("dmdc: {} must be at least 1, but is {}", OptionName{"delays"}, delays);
}

DmdcFit dmdc(const IdData& data, const DmdcOptions& options) {
    options.validate();
    check_sampled_data("dmdc", data);
    const Scale scale{root_mean_squares(data, &Experiment::y), root_mean_squares(data, &Experiment::u)};
    const Index ny = data.output_count();
    const Snapshots pairs = neighboring_snapshots(data, scale, options.delays);
    if (options.rank > pairs.next.rows())
        throw InvalidArgument("dmdc: {} is {}, but a snapshot has only {}", OptionName{"rank"}, options.rank,
                              plural(pairs.next.rows(), "{} value", "{} values"));
    const Reduced reduced = reduce(pairs, options);
    DmdcFit found;
    found.rank = static_cast<int>(reduced.A.rows());
    found.delays = options.delays;
    found.singular_values = reduced.singular_values;
    found.fit.condition_number = reduced.condition_number;
    found.eigenvalues = eigenvalues(reduced.A);
    found.system = StateSpace(reduced.A, reduced.B * scale.u.cwiseInverse().asDiagonal(),
                              scale.y.asDiagonal() * reduced.U.topRows(ny), Matrix::Zero(ny, scale.u.size()), data.Ts);
    found.fit.start = {InitialState::kEstimate, false};
    for (Index output = 0; output < ny; ++output)
        for (Index input = 0; input < scale.u.size(); ++input)
            found.fit.models.push_back(to_transfer_function(found.system, output, input));
    measure_fit(found, data, scale, reduced.U);
    describe(found);
    return found;
}

}  // namespace dynlab::inline numerics
