#include "numerics/simulation/exact_filter.h"

#include <algorithm>
#include <utility>

namespace dynlab::inline numerics {

namespace {

constexpr Index kWidestWindow = ExactFilter::kBlock + 2;  // u[k-d-1] ... u[k-d+kBlock]

/// How a block of samples depends on [state; widest input window], by running the recursion symbolically.
struct BlockMaps {
    std::vector<Matrix> outputs;
    Matrix step;
};

BlockMaps block_maps(const SampledSystem& system) {
    const Index n = system.F.rows(), p = system.C.rows();
    BlockMaps maps;
    maps.outputs.assign(static_cast<std::size_t>(p), Matrix::Zero(ExactFilter::kBlock, n + kWidestWindow));
    Matrix state = Matrix::Zero(n, n + kWidestWindow);
    state.leftCols(n).setIdentity();
    for (Index i = 0; i < ExactFilter::kBlock; ++i) {
        const Index previous = n + i, now = previous + 1, next = now + 1;
        Matrix output = system.C * state;
        output.col(now) += system.D.col(0);
        output.col(previous) += system.D.col(1);
        for (Index j = 0; j < p; ++j) maps.outputs[static_cast<std::size_t>(j)].row(i) = output.row(j);
        state = system.F * state;
        state.col(next) += system.G.col(0);
        state.col(now) += system.G.col(1);
        state.col(previous) += system.G.col(2);
    }
    maps.step = state;
    return maps;
}

/// Drops the first or last column of the input window where no sample has weight there.
Matrix cut_window(const Matrix& map, Index order, bool sees_previous, bool sees_next) {
    const Index first = sees_previous ? 0 : 1;
    const Index width = kWidestWindow - first - (sees_next ? 0 : 1);
    Matrix cut(map.rows(), order + width);
    cut << map.leftCols(order), map.middleCols(order + first, width);
    return cut;
}

/// map [x; w], with x and w of fixed or dynamic size; the window first, so that the sum waits for x only at its end.
template <class Map, class State>
auto apply(const Map& map, const State& x, const double* w, Index order) {
    constexpr Index kColumns = Map::ColsAtCompileTime;
    const Index window = (kColumns == Eigen::Dynamic ? map.cols() : kColumns) - order;
    Eigen::Matrix<double, Map::RowsAtCompileTime, 1> sum = map.col(order) * w[0];
    for (Index j = 1; j < window; ++j) sum += map.col(order + j) * w[j];
    for (Index j = 0; j < order; ++j) sum += map.col(j) * x(j);
    return sum;
}

}  // namespace

ExactFilter::ExactFilter(SampledSystem system) : system_(std::move(system)) {
    sees_next_ = !system_.G.col(0).isZero(0);
    sees_previous_ = !system_.G.col(2).isZero(0) || !system_.D.col(1).isZero(0);
    const BlockMaps maps = block_maps(system_);
    for (const Matrix& output : maps.outputs)
        block_outputs_.push_back(cut_window(output, order(), sees_previous_, sees_next_));
    block_step_ = cut_window(maps.step, order(), sees_previous_, sees_next_);
}

Matrix ExactFilter::run(const VectorView& u) const {
    Matrix y(u.size(), output_count());
    run(u, Vector::Zero(order()), y);
    return y;
}

void ExactFilter::run(const VectorView& u, Vector x, Eigen::Ref<Matrix> y) const {
    Index k = run_start(u, x, y);
    k = run_blocks(u, k, x, y);
    run_rest(u, k, x, y);
}

/// The free motion before the delayed input arrives, and the step in which it begins. Returns the next sample.
Index ExactFilter::run_start(const VectorView& u, Vector& x, Eigen::Ref<Matrix>& y) const {
    const Index N = u.size();
    Index k = 0;
    for (; k < std::min(system_.delay, N); ++k) {
        y.row(k) = system_.C * x;
        x = system_.F * x;
    }
    if (k == N) return N;
    y.row(k) = system_.C * x + system_.first_D * u(0);
    if (N > 1) x = system_.F * x + system_.first_G.col(0) * u(1) + system_.first_G.col(1) * u(0);
    return k + 1;
}

/// The samples that are left after the last whole block.
void ExactFilter::run_rest(const VectorView& u, Index k, Vector& x, Eigen::Ref<Matrix>& y) const {
    const Index N = u.size();
    for (; k < N; ++k) {
        const Index now = k - system_.delay;
        y.row(k) = system_.C * x + system_.D.col(0) * u(now) + system_.D.col(1) * u(now - 1);
        if (k + 1 == N) return;
        x = system_.F * x + system_.G.col(1) * u(now) + system_.G.col(2) * u(now - 1);
        if (sees_next_) x += system_.G.col(0) * u(now + 1);
    }
}

template <int kOrder, int kWindow>
Index ExactFilter::run_blocks(const VectorView& u, Index k, Vector& x_now, Eigen::Ref<Matrix>& y) const {
    constexpr int kColumns = kOrder == Eigen::Dynamic ? Eigen::Dynamic : kOrder + kWindow;
    using OutputMap = Eigen::Matrix<double, kBlock, kColumns>;
    const Eigen::Matrix<double, kOrder, kColumns> step = block_step_;
    const std::vector<OutputMap> outputs(block_outputs_.begin(), block_outputs_.end());
    const Index n = kOrder == Eigen::Dynamic ? order() : kOrder;
    const Index window_start = -system_.delay - (sees_previous_ ? 1 : 0);
    const Index end = std::min(y.rows(), u.size() + system_.delay - (sees_next_ ? 1 : 0));
    Eigen::Matrix<double, kOrder, 1> x = x_now;
    for (; k + kBlock <= end; k += kBlock) {
        const double* window = u.data() + (k + window_start);
        for (std::size_t j = 0; j < outputs.size(); ++j)
            y.col(static_cast<Index>(j)).template segment<kBlock>(k) = apply(outputs[j], x, window, n);
        x = apply(step, x, window, n);
    }
    x_now = x;
    return k;
}

template <int kOrder>
Index ExactFilter::run_blocks(const VectorView& u, Index k, Vector& x, Eigen::Ref<Matrix>& y) const {
    const Index window = block_step_.cols() - order();
    if (window == kBlock) return run_blocks<kOrder, kBlock>(u, k, x, y);
    if (window == kBlock + 1) return run_blocks<kOrder, kBlock + 1>(u, k, x, y);
    return run_blocks<kOrder, kBlock + 2>(u, k, x, y);
}

Index ExactFilter::run_blocks(const VectorView& u, Index k, Vector& x, Eigen::Ref<Matrix>& y) const {
    switch (order()) {
        case 1:
            return run_blocks<1>(u, k, x, y);
        case 2:
            return run_blocks<2>(u, k, x, y);
        case 3:
            return run_blocks<3>(u, k, x, y);
        case 4:
            return run_blocks<4>(u, k, x, y);
        case 5:
            return run_blocks<5>(u, k, x, y);
        case 6:
            return run_blocks<6>(u, k, x, y);
        case 7:
            return run_blocks<7>(u, k, x, y);
        case 8:  // four poles and their sensitivities
            return run_blocks<8>(u, k, x, y);
        default:
            return run_blocks<Eigen::Dynamic, Eigen::Dynamic>(u, k, x, y);
    }
}

}  // namespace dynlab::inline numerics
