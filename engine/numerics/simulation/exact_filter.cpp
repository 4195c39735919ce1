#include "numerics/simulation/exact_filter.h"

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

namespace dynlab::inline numerics {

namespace {

constexpr Index kWidestWindow = ExactFilter::kBlock + 2;  // u[k-d-1] ... u[k-d+kBlock]

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

/// use(order), as a number that the compiler knows where there is a loop of that size: up to six poles with their
/// sensitivities.
template <class Use>
auto with_known_order(Index order, const Use& use) {
    switch (order) {
        case 1:
            return use(std::integral_constant<int, 1>());
        case 2:
            return use(std::integral_constant<int, 2>());
        case 3:
            return use(std::integral_constant<int, 3>());
        case 4:
            return use(std::integral_constant<int, 4>());
        case 5:
            return use(std::integral_constant<int, 5>());
        case 6:
            return use(std::integral_constant<int, 6>());
        case 7:
            return use(std::integral_constant<int, 7>());
        case 8:
            return use(std::integral_constant<int, 8>());
        case 10:
            return use(std::integral_constant<int, 10>());
        case 12:
            return use(std::integral_constant<int, 12>());
        default:
            return use(std::integral_constant<int, Eigen::Dynamic>());
    }
}

}  // namespace

ExactFilter::ExactFilter(SampledSystem system) : system_(std::move(system)) {
    sees_next_ = !system_.G.col(0).isZero(0);
    sees_previous_ = !system_.G.col(2).isZero(0) || !system_.D.col(1).isZero(0);
    with_known_order(order(), [&](auto known) { prepare_blocks<known>(); });
}

/// How a block of samples depends on [state; input window], by running the recursion symbolically.
template <int kOrder>
void ExactFilter::prepare_blocks() {
    constexpr int kColumns = kOrder == Eigen::Dynamic ? Eigen::Dynamic : kOrder + static_cast<int>(kWidestWindow);
    const Index n = order(), first = n + (sees_previous_ ? 0 : 1), last = n + kWidestWindow - (sees_next_ ? 0 : 1);
    const Index columns = n + last - first;  // the first and the last of the widest window have no weight in most
    const Eigen::Matrix<double, kOrder, kOrder> F = system_.F;
    Eigen::Matrix<double, kOrder, kColumns> state =
        Eigen::Matrix<double, kOrder, kColumns>::Identity(n, n + kWidestWindow);
    block_outputs_.resize(kBlock, output_count() * columns);
    for (Index i = 0; i < kBlock; ++i) {
        const Index previous = n + i, now = previous + 1, next = now + 1;
        Eigen::Matrix<double, Eigen::Dynamic, kColumns> output = system_.C.lazyProduct(state);
        output.col(now) += system_.D.col(0);
        output.col(previous) += system_.D.col(1);
        for (Index j = 0; j < output_count(); ++j)
            block_outputs_.row(i).segment(j * columns, columns) << output.row(j).head(n),
                output.row(j).segment(first, last - first);
        state = F.lazyProduct(state).eval();
        state.col(next) += system_.G.col(0);
        state.col(now) += system_.G.col(1);
        state.col(previous) += system_.G.col(2);
    }
    block_step_.resize(n, columns);
    block_step_ << state.leftCols(n), state.middleCols(first, last - first);
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
    if (x.isZero(0)) {
        k = std::min(system_.delay, N);
        y.topRows(k).setZero();
    }
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
    const Index n = kOrder == Eigen::Dynamic ? order() : kOrder, columns = step.cols();
    std::vector<OutputMap> outputs(static_cast<std::size_t>(output_count()));
    for (std::size_t j = 0; j < outputs.size(); ++j)
        outputs[j] = block_outputs_.middleCols(static_cast<Index>(j) * columns, columns);
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

Index ExactFilter::run_blocks(const VectorView& u, Index k, Vector& x, Eigen::Ref<Matrix>& y) const {
    const Index window = block_step_.cols() - order();
    return with_known_order(order(), [&](auto known) {
        if (window == kBlock) return run_blocks<known, kBlock>(u, k, x, y);
        if (window == kBlock + 1) return run_blocks<known, kBlock + 1>(u, k, x, y);
        return run_blocks<known, kBlock + 2>(u, k, x, y);
    });
}

}  // namespace dynlab::inline numerics
