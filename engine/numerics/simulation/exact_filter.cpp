#include "numerics/simulation/exact_filter.h"

#include <algorithm>
#include <utility>

#include "numerics/linalg/known_order.h"
#include "numerics/linalg/state_matrix.h"
#include "numerics/simulation/sampled_recursion.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kMaxWindow = ExactFilter::kBlock + 2;  // u[k-d-1] ... u[k-d+kBlock]

/// The first columns of A B by plain loops: Eigen's take several times as long where the sizes are small and not known
/// to the compiler.
void multiply(const Matrix& A, const Matrix& B, Index columns, Matrix& product) {
    constexpr int kCapacity = 4;
    if (A.rows() <= kCapacity && A.cols() <= kCapacity) {
        StateMatrix<kCapacity> small;
        for (int k = 0; k < A.cols(); ++k)
            for (int i = 0; i < A.rows(); ++i) small(i, k) = A(i, k);
        for (Index j = 0; j < columns; ++j) {
            StateVector<kCapacity> column;
            for (int k = 0; k < A.cols(); ++k) column.add(B(k, j), small.column[k]);
            for (int i = 0; i < A.rows(); ++i) product(i, j) = column[i];
        }
        return;
    }
    product.setZero();
    for (Index j = 0; j < columns; ++j)
        for (Index k = 0; k < A.cols(); ++k)
            for (Index i = 0; i < A.rows(); ++i) product(i, j) += A(i, k) * B(k, j);
}

}  // namespace

ExactFilter::ExactFilter(SampledSystem system) : system_(std::move(system)) {
    sees_next_ = !system_.G.col(0).isZero(0);
    sees_previous_ = !system_.G.col(2).isZero(0) || !system_.D.col(1).isZero(0);
    prepare_blocks();
}

/// How a block of samples depends on [state; input window], by running the recursion symbolically.
void ExactFilter::prepare_blocks() {
    const Index n = order(), first = n + (sees_previous_ ? 0 : 1), last = n + kMaxWindow - (sees_next_ ? 0 : 1);
    const Index columns = n + last - first;  // the first and the last of the widest window have no weight in most
    // Without the columns of the window between n and `first`, and beyond `last`.
    const auto keep = [&](const Matrix& from, Index row, Matrix& to, Index to_row, Index place) {
        for (Index j = 0; j < n; ++j) to(to_row, place + j) = from(row, j);
        for (Index j = first; j < last; ++j) to(to_row, place + n + j - first) = from(row, j);
    };
    Matrix state = Matrix::Identity(n, n + kMaxWindow), next = Matrix::Zero(n, n + kMaxWindow),
           output = Matrix::Zero(output_count(), n + kMaxWindow);
    block_outputs_.resize(kBlock, output_count() * columns);
    for (Index i = 0; i < kBlock; ++i) {
        const Index previous = n + i, now = previous + 1, after = now + 1;
        multiply(system_.C, state, after, output);
        output.col(now) += system_.D.col(0);
        output.col(previous) += system_.D.col(1);
        for (Index j = 0; j < output_count(); ++j) keep(output, j, block_outputs_, i, j * columns);
        multiply(system_.F, state, after, next);
        next.col(after) += system_.G.col(0);
        next.col(now) += system_.G.col(1);
        next.col(previous) += system_.G.col(2);
        state.swap(next);
    }
    block_step_.resize(n, columns);
    for (Index i = 0; i < n; ++i) keep(state, i, block_step_, i, 0);
}

Matrix ExactFilter::run(const VectorView& u) const {
    Matrix y(u.size(), output_count());
    run(u, Vector::Zero(order()), y);
    return y;
}

void ExactFilter::run(const VectorView& u, Vector x, Eigen::Ref<Matrix> y) const {
    advance(u, 0, x, y);
}

/// Blocks do all samples but those before the delayed input has begun, its first one and what is left at the end.
void ExactFilter::advance(const VectorView& u, Index from, Vector& x, Eigen::Ref<Matrix> y) const {
    const Index to = from + y.rows();
    SampledRecursion recursion(system_, {u.data(), u.size()});
    Vector row(output_count());
    const auto recur = [&](Index k, Index end) {
        recursion.set_state(x);
        for (; k < end; ++k) {
            recursion.output(k, row);
            for (Index j = 0; j < row.size(); ++j) y(k - from, j) = row[j];
            recursion.step(k);
        }
        x = recursion.state();
    };
    Index k = from;
    if (k < system_.delay && x.isZero(0)) {
        k = std::min(system_.delay, to);
        y.topRows(k - from).setZero();
    }
    const Index begin = std::clamp(system_.delay + 1, k, to);
    recur(k, begin);
    k = begin;
    const Index end = std::min(to, u.size() + system_.delay - (sees_next_ ? 1 : 0));
    if (const Index blocks = std::max<Index>(0, end - k) / kBlock; blocks > 0) {
        const double* const window = u.data() + (k - system_.delay - (sees_previous_ ? 1 : 0));
        with_known_order<Eigen::Dynamic, 1, 2, 3, 4, 5, 6, 8, 10>(
            order(), [&](auto known) { run_blocks<known>(window, blocks, x, y.data() + (k - from), y.outerStride()); });
        k += blocks * kBlock;
    }
    if (k < to) recur(k, to);
}

/// The window comes first, so that a sum waits for the state only at its end.
template <int kOrder, int kWindow>
void ExactFilter::run_blocks(const double* window, Index blocks, Vector& x_now, double* y, Index stride) const {
    using Block = Eigen::Array<double, kBlock, 1>;
    constexpr int kColumns = kOrder == Eigen::Dynamic ? Eigen::Dynamic : kOrder + kWindow;
    const Eigen::Matrix<double, kOrder, kColumns> step = block_step_;
    Eigen::Matrix<double, kOrder, 1> x = x_now, next = x;
    const Index n = kOrder == Eigen::Dynamic ? order() : kOrder, outputs = output_count();
    for (; blocks > 0; --blocks, window += kBlock, y += kBlock) {
        const double* map = block_outputs_.data();
        for (Index j = 0; j < outputs; ++j, map += kBlock * (n + kWindow)) {
            Block sum = Block::Map(map + kBlock * n) * window[0];
            for (int i = 1; i < kWindow; ++i) sum += Block::Map(map + kBlock * (n + i)) * window[i];
            for (Index i = 0; i < n; ++i) sum += Block::Map(map + kBlock * i) * x[i];
            Block::Map(y + j * stride) = sum;
        }
        next = step.col(n) * window[0];
        for (int j = 1; j < kWindow; ++j) next += step.col(n + j) * window[j];
        for (Index j = 0; j < n; ++j) next += step.col(j) * x[j];
        x = next;
    }
    x_now = x;
}

template <int kOrder>
void ExactFilter::run_blocks(const double* window, Index blocks, Vector& x, double* y, Index stride) const {
    if (block_step_.cols() == order() + kBlock) return run_blocks<kOrder, kBlock>(window, blocks, x, y, stride);
    if (block_step_.cols() == order() + kBlock + 1) return run_blocks<kOrder, kBlock + 1>(window, blocks, x, y, stride);
    run_blocks<kOrder, kBlock + 2>(window, blocks, x, y, stride);
}

}  // namespace dynlab::inline numerics
