#include "numerics/estimators/n4sid.h"

#include <algorithm>
#include <cmath>

#include "numerics/error.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/linalg/triangular_factor.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kBlock = 512;  // equations worked on together
constexpr Index kUsualBlockRows = 15;
constexpr double kNoSignal = 1e-10;  // of a singular value against the largest
constexpr int kMaxStates = 100;

struct Sizes {
    Index n, nu, ny, s;
    Index future_inputs() const { return s * nu; }
    Index past() const { return s * (nu + ny); }
    Index future_outputs() const { return s * ny; }
    Index columns() const { return 2 * s * (nu + ny); }
};

Index places(const IdData& data, Index s) {
    Index count = 0;
    for (const Experiment& experiment : data.experiments) count += std::max<Index>(0, experiment.y.rows() - 2 * s + 1);
    return count;
}

bool fits(const IdData& data, Index s) {
    return places(data, s) >= 2 * s * (data.input_count() + data.output_count());
}

Index chosen_block_rows(const IdData& data, int order, int requested) {
    const Index least = order + 1;
    Index s = requested > 0 ? requested : std::max(kUsualBlockRows, 2 * least - 2);
    if (requested > 0 && requested < least)
        throw InvalidArgument("n4sid: {} must be greater than the order, {}, but is {}", OptionName{"block_rows"},
                              order, requested);
    while (requested == 0 && s > least && !fits(data, s)) --s;
    if (fits(data, s)) return s;
    throw InvalidArgument(
        "n4sid: the {} samples of the data are too few for order {} and {} block rows, because they provide only {} "
        "equations for {} unknowns. Use more data or a lower order",
        data.sample_count(), order, s, places(data, s), 2 * s * (data.input_count() + data.output_count()));
}

/// Divides every output by its largest value, which is returned.
Vector scale_outputs(IdData& data) {
    Vector scale = Vector::Zero(data.output_count());
    for (const Experiment& experiment : data.experiments)
        scale = scale.cwiseMax(experiment.y.cwiseAbs().colwise().maxCoeff().transpose());
    for (Experiment& experiment : data.experiments) experiment.y = experiment.y * scale.cwiseInverse().asDiagonal();
    return scale;
}

/// The triangular factor of [future inputs, past inputs, past outputs, future outputs], a row for each place between
/// past and future.
Matrix past_and_future(const IdData& data, const Sizes& sizes) {
    const Index s = sizes.s;
    TriangularFactor factor(sizes.columns());
    Matrix block(kBlock, sizes.columns());
    for (const Experiment& experiment : data.experiments) {
        const Index last = experiment.y.rows() - s;
        for (Index k = s; k <= last; k += kBlock) {
            const Index rows = std::min(kBlock, last - k + 1);
            Index column = 0;
            const auto append = [&](const Matrix& signal, Index first) {
                for (Index i = 0; i < s; ++i, column += signal.cols())
                    block.block(0, column, rows, signal.cols()) = signal.middleRows(first + i, rows);
            };
            append(experiment.u, k);
            append(experiment.u, k - s);
            append(experiment.y, k - s);
            append(experiment.y, k);
            factor.add(block.topRows(rows));
        }
    }
    return factor.R();
}

void require_rich_inputs(const Matrix& R, const Sizes& sizes) {
    const Index f = sizes.future_inputs();
    const Matrix inputs = R.topLeftCorner(f, f);
    if (solve_least_squares(inputs, Vector::Zero(f)).condition_number < kAmbiguousCondition) return;
    throw InvalidArgument(
        "n4sid: the input is not persistently exciting for {} block rows (a constant or a few sines are not "
        "sufficient). Excite the system with a richer input, such as prbs, or decrease {}",
        sizes.s, OptionName{"block_rows"});
}

struct Observability {
    Matrix directions;  ///< s ny x n
    Vector singular_values;
};

Observability observability(const Matrix& R, const Sizes& sizes, SubspaceWeighting weighting) {
    const Index f = sizes.future_inputs(), p = sizes.past(), q = sizes.future_outputs();
    const auto rest = R.block(f + p, f + p, q, q);
    // Only directions that the past excites: directions of rounding size, as in noise-free data, are arbitrary.
    Vector unscale = R.middleCols(f, p).colwise().norm().transpose();
    for (double& value : unscale) value = value > 0 ? 1 / value : 1;
    const SingularValues span = jacobi_svd(R.block(f, f, p, p) * unscale.asDiagonal());
    const Index rank = (span.s.array() > kNoSignal * span.s[0]).count();
    const Matrix basis = span.U.leftCols(rank).transpose();
    const Matrix past = basis * R.block(f, f, p, p), by_past = basis * R.block(f, f + p, p, q);
    Matrix weighed = by_past, unweigh = Matrix::Identity(q, q);
    if (weighting == SubspaceWeighting::kN4sid) {
        const Matrix on_past = minimum_norm_solution(past, by_past);
        weighed.resize(f + rank, q);
        weighed << R.block(0, f, f, p) * on_past, past * on_past;
    } else if (weighting == SubspaceWeighting::kCva) {
        Matrix future(rank + q, q);
        future << by_past, rest;
        const SingularValues spread = jacobi_svd(future);
        const Vector& root = spread.s;
        Vector inverse = Vector::Zero(q);
        for (Index i = 0; i < q && root[i] > kNoSignal * root[0]; ++i) inverse[i] = 1 / root[i];
        const Matrix& E = spread.V;
        weighed = by_past * E * inverse.asDiagonal() * E.transpose();
        unweigh = E * root.asDiagonal() * E.transpose();
    }
    const SingularValues svd = jacobi_svd(weighed);
    return {unweigh * svd.V.leftCols(sizes.n), svd.s};
}

/// Returns A with eigenvalues outside the unit circle mirrored into it; sets `reflected` to whether there were any.
Matrix with_stable_eigenvalues(const Matrix& A, bool& reflected) {
    auto [values, V] = eigenvectors(A);
    reflected = values.cwiseAbs().maxCoeff() > 1;
    if (!reflected) return A;
    const auto inverse = inverse_of_regular(V);
    if (!inverse) return A / values.cwiseAbs2().maxCoeff();  // defective: the outermost eigenvalue counts for all
    for (Complex& value : values)
        if (std::abs(value) > 1) value = 1.0 / std::conj(value);
    return (V * values.asDiagonal() * *inverse).real();
}

/// B, D and the initial states by least squares: the simulated output is linear in them.
class InputEquations {
  public:
    InputEquations(const IdData& data, const Sizes& sizes, const Matrix& A, const Matrix& C, bool feedthrough)
        : data_(data),
          sizes_(sizes),
          A_(A),
          C_(C),
          feedthrough_(feedthrough),
          unknowns_(sizes.n * sizes.nu + (feedthrough ? sizes.ny * sizes.nu : 0) +
                    sizes.n * static_cast<Index>(data.experiments.size())) {}

    Index unknowns() const { return unknowns_; }

    LeastSquares solve() const {
        TriangularFactor factor(unknowns_ + 1);
        for (std::size_t e = 0; e < data_.experiments.size(); ++e) add_equations(e, factor);
        const Matrix& R = factor.R();
        return solve_least_squares(R.leftCols(unknowns_), R.col(unknowns_));
    }

    StateSpace system(const Vector& solution) const {
        const Index n = sizes_.n, nu = sizes_.nu, ny = sizes_.ny;
        Matrix D = Matrix::Zero(ny, nu);
        if (feedthrough_) D = solution.segment(n * nu, ny * nu).reshaped(ny, nu);
        return StateSpace(A_, solution.head(n * nu).reshaped(n, nu), C_, D, data_.Ts);
    }
    Matrix initial_states(const Vector& solution) const {
        const auto count = static_cast<Index>(data_.experiments.size());
        return solution.tail(sizes_.n * count).reshaped(sizes_.n, count);
    }

  private:
    void add_equations(std::size_t e, TriangularFactor& factor) const {
        const Experiment& experiment = data_.experiments[e];
        const Index n = sizes_.n, nu = sizes_.nu, ny = sizes_.ny;
        Matrix block = Matrix::Zero(kBlock * ny, unknowns_ + 1);
        Matrix driven = Matrix::Zero(n, n * nu), free = Matrix::Identity(n, n);  // d x/d B, d x/d x(0)
        const Index free_column = unknowns_ - n * (static_cast<Index>(data_.experiments.size() - e));
        Index row = 0;
        for (Index k = 0; k < experiment.y.rows(); ++k, row += ny) {
            if (row == block.rows()) {
                factor.add(block);
                row = 0;
            }
            block.block(row, 0, ny, n * nu) = C_ * driven;
            for (Index j = 0; feedthrough_ && j < nu; ++j)
                block.block(row, n * nu + j * ny, ny, ny).diagonal().setConstant(experiment.u(k, j));
            block.block(row, free_column, ny, n) = C_ * free;
            block.col(unknowns_).segment(row, ny) = experiment.y.row(k).transpose();
            driven = A_ * driven;
            for (Index j = 0; j < nu; ++j) driven.middleCols(j * n, n).diagonal().array() += experiment.u(k, j);
            free = A_ * free;
        }
        factor.add(block.topRows(row));
    }

    const IdData& data_;
    Sizes sizes_;
    const Matrix &A_, &C_;
    bool feedthrough_;
    Index unknowns_;
};

void measure_fit(SubspaceFit& found, const IdData& data) {
    const StateSpace& system = found.system;
    const Index ny = data.output_count();
    Vector errors = Vector::Zero(ny);
    for (std::size_t e = 0; e < data.experiments.size(); ++e) {
        const Experiment& experiment = data.experiments[e];
        Vector x = found.initial_states.col(static_cast<Index>(e));
        for (Index k = 0; k < experiment.y.rows(); ++k) {
            const Vector u = experiment.u.row(k).transpose();
            errors += (experiment.y.row(k).transpose() - system.C * x - system.D * u).cwiseAbs2();
            x = system.A * x + system.B * u;
        }
    }
    const Vector variation = output_variations(data);
    found.fit.loss = errors.sum() / static_cast<double>(data.sample_count() * ny);
    found.fit.fit_percent.resize(ny);
    for (Index i = 0; i < ny; ++i) found.fit.fit_percent[i] = fit_percent_of_sums(errors[i], variation[i]);
}

void describe(SubspaceFit& found, bool reflected) {
    Fit& fit = found.fit;
    const auto seen = (found.singular_values.array() > kNoSignal * found.singular_values[0]).count();
    if (seen < found.system.order())
        fit.warnings.push_back(plural(
            seen, "The data support only {} state; the other singular values are rounding errors. Use a lower order.",
            "The data support only {} states; the other singular values are rounding errors. Use a lower order."));
    if (reflected)
        fit.warnings.push_back(Message("Eigenvalues outside the unit circle were reflected into the unit circle."));
    if (fit.condition_number > kAmbiguousCondition)
        fit.warnings.push_back(
            Message("The data do not determine all entries of B separately (condition number {}): use a richer input.",
                    significant(fit.condition_number, 2)));
    fit.message =
        Message("Subspace method with {} block rows, order {}: fit {} % for simulation from estimated initial states.",
                found.block_rows, found.system.order(), fits_text(fit));
}

}  // namespace

void SubspaceOptions::validate() const {
    if (block_rows < 0)
        throw InvalidArgument("{} must be nonnegative, but is {}", OptionName{"block_rows"}, block_rows);
}

SubspaceFit n4sid(const IdData& data, int order, const SubspaceOptions& options) {
    options.validate();
    if (order < 1 || order > kMaxStates)
        throw InvalidArgument("n4sid: the order, which is the number of states, must be between 1 and {}, but is {}",
                              kMaxStates, order);
    check_sampled_data("n4sid", data);
    const Sizes sizes{order, data.input_count(), data.output_count(),
                      chosen_block_rows(data, order, options.block_rows)};
    IdData scaled = data;
    const Vector scale = scale_outputs(scaled);
    const Matrix R = past_and_future(scaled, sizes);
    require_rich_inputs(R, sizes);

    const auto [directions, singular_values] = observability(R, sizes, options.weighting);
    const Index shifted = (sizes.s - 1) * sizes.ny;
    bool reflected = false;
    const Matrix A = with_stable_eigenvalues(
        solve_by_pivoted_qr(directions.topRows(shifted), directions.bottomRows(shifted)), reflected);
    const Matrix C = directions.topRows(sizes.ny);

    const InputEquations equations(scaled, sizes, A, C, options.feedthrough);
    if (data.sample_count() * sizes.ny <= equations.unknowns())
        throw InvalidArgument(
            "n4sid estimates {} and needs more samples than that, but the data have {}. Use more data or a lower order",
            plural(equations.unknowns(), "{} value", "{} values"), data.sample_count());
    const LeastSquares solution = equations.solve();
    SubspaceFit found;
    found.system = equations.system(solution.solution);
    found.system.C = scale.asDiagonal() * found.system.C;
    found.system.D = scale.asDiagonal() * found.system.D;
    found.initial_states = equations.initial_states(solution.solution);
    found.singular_values = singular_values;
    found.block_rows = static_cast<int>(sizes.s);
    found.fit.start = {InitialState::kEstimate, false};
    found.fit.condition_number = solution.condition_number;
    for (Index output = 0; output < sizes.ny; ++output)
        for (Index input = 0; input < sizes.nu; ++input)
            found.fit.models.push_back(to_transfer_function(found.system, output, input));
    measure_fit(found, data);
    describe(found, reflected);
    return found;
}

}  // namespace dynlab::inline numerics
