#include "numerics/filters/cascade_moments.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "numerics/filters/cascade_basis.h"
#include "numerics/filters/cascade_products.h"
#include "numerics/filters/sample_moments.h"

namespace dynlab::inline numerics {

namespace {

/// A signal and its basis.
struct Source {
    CascadeBasis basis;
    CascadeSource lanes;
};
template <int kOrder, bool kFed, bool kTap, bool kRepeated = false>
using Shape = CascadeShape<kOrder, kFed, kTap, kRepeated>;

using Summation = Matrix (*)(const std::array<CascadeSource, 2>&, Index);
template <class First, class Second, int kWanted>
Matrix all_products(const std::array<CascadeSource, 2>& sources, Index segment) {
    return sum_products<First, Second, kWanted>(sources, 0, segment);
}
template <int value>
using Constant = std::integral_constant<int, value>;

/// The function for these shapes; null where there is none.
template <class First>
Summation summation_for(Index order, bool fed, bool tap, int wanted) {
    Summation found = nullptr;
    const auto try_shape = [&]<class Second>(Second, auto w) {
        if (order == Second::kOrder && fed == Second::kFed && tap == Second::kTap && wanted == w)
            found = &all_products<First, Second, w>;
    };
    if constexpr (First::kRepeated) {
        try_shape(Shape<2, false, false, true>(), Constant<kFirstWithSample>());
        try_shape(Shape<2, false, true, true>(), Constant<kFirstWithSample>());
        try_shape(Shape<2, true, false, true>(), Constant<kFirstWithSample>());
    } else {
        const auto try_wanted = [&](auto w) {
            try_shape(Shape<1, false, false>(), w);
            try_shape(Shape<1, false, true>(), w);
            try_shape(Shape<2, false, false>(), w);
            try_shape(Shape<2, false, true>(), w);
            try_shape(Shape<2, true, false>(), w);
            try_shape(Shape<4, false, false>(), w);
            try_shape(Shape<4, false, true>(), w);
        };
        try_wanted(Constant<0>());
        try_wanted(Constant<kSecondPairAlone>());
        if constexpr (First::kColumns > 0) {
            try_wanted(Constant<kFirstAlone>());
            try_wanted(Constant<kFirstAlone | kSecondPairAlone>());
        }
    }
    return found;
}

/// Outputs as combinations of columns.
struct Outputs {
    Matrix weights;  ///< outputs x columns
    Index of_first = 0, first_columns = 0;

    /// Whether one of the chosen outputs needs one of these columns.
    bool need(const std::vector<Index>& chosen, Index column, Index count) const {
        return std::any_of(chosen.begin(), chosen.end(),
                           [&](Index output) { return !weights.row(output).segment(column, count).isZero(0); });
    }
};

Outputs outputs_of(const std::array<Source, 2>& sources, bool two, bool fed, bool tap) {
    const CascadeBasis &first = sources[0].basis, &last = sources[1].basis;
    const Index columns = fed ? 1 : last.order + (tap ? 1 : 0), rows = last.outputs.rows();
    Outputs outputs;
    outputs.of_first = two ? first.outputs.rows() : 0;
    outputs.first_columns = two ? first.order + 1 : 0;
    outputs.weights = Matrix::Zero(outputs.of_first + rows, outputs.first_columns + columns);
    if (two) outputs.weights.topLeftCorner(outputs.of_first, outputs.first_columns) = first.outputs;
    outputs.weights.bottomRightCorner(rows, columns) = last.outputs.middleCols(fed ? 1 : 0, columns);
    return outputs;
}

/// Of these products of outputs; `order` is that of the second cascade.
int wanted_products(const Outputs& outputs, Index order, const std::vector<Index>& left,
                    const std::vector<Index>& right) {
    const auto both_need = [&](Index column, Index count) {
        return outputs.need(left, column, count) && outputs.need(right, column, count);
    };
    int wanted = 0;
    if (both_need(0, outputs.first_columns)) wanted |= kFirstAlone;
    if (order == 4 && both_need(outputs.first_columns + 2, 2)) wanted |= kSecondPairAlone;
    return wanted;
}

Summation summation_for(const std::array<Source, 2>& sources, const Outputs& outputs, bool fed, bool tap, int wanted) {
    const Index order = sources[1].basis.order;
    switch (outputs.first_columns) {
        case 0:
            return summation_for<NoCascade>(order, fed, tap, wanted);
        case 1:
            return summation_for<Shape<0, false, true>>(order, fed, tap, wanted);
        case 2:
            return summation_for<Shape<1, false, true>>(order, fed, tap, wanted);
        case 3:
            return summation_for<Shape<2, false, true>>(order, fed, tap, wanted);
        default:
            return nullptr;
    }
}

std::array<CascadeSource, 2> lanes_of(const std::array<Source, 2>& sources) {
    return {sources[0].lanes, sources[1].lanes};
}

/// With the wanted products of the first source's columns among themselves from how they grow, where its poles and the
/// second's are repeated and this loses no digits; nothing otherwise.
std::optional<Matrix> sum_by_growth(const std::array<Source, 2>& sources, const Outputs& outputs, bool fed, bool tap,
                                    int wanted, Index segment) {
    const auto repeated = [](const CascadeBasis& basis) { return basis.order == 2 && basis.pairs[0].square == 0; };
    if (wanted != kFirstAlone || outputs.first_columns != 3 || !repeated(sources[0].basis) ||
        !repeated(sources[1].basis))
        return {};
    Matrix total =
        summation_for<Shape<2, false, true, true>>(2, fed, tap, kFirstWithSample)(lanes_of(sources), segment);
    if (!complete_squares(total, sources[0].basis.pairs[0].centre)) return {};
    return total;
}

/// The two sources, the second alone for one signal; false where there are none.
bool find_bases(const std::vector<FilteredSignal>& signals, std::array<Source, 2>& sources) {
    const auto take = [](std::optional<CascadeBasis> basis, Source& source) {
        if (basis) source.basis = *std::move(basis);
        return basis.has_value();
    };
    const bool joint = signals.size() == 3;
    if (joint && signals[1].signal.data() != signals[2].signal.data()) return false;
    if (signals.size() > 1 && !take(cascade_basis(signals[0].system), sources[0])) return false;
    return take(joint ? joint_basis(signals[1].system, signals[2].system) : cascade_basis(signals.back().system),
                sources[1]);
}

/// Whether the state of the shorter of two systems with a joint basis is what the longer's says of it: the very first
/// samples are not everywhere filtered alike.
bool agree_on_state(const Eigen::Vector2d& joint_state, const FilteredSignal& shorter, const Vector& x, double v) {
    constexpr double kRounding = 1e-9;
    const Vector own = cascade_basis(shorter.system)->from_state(x, v);
    return (joint_state - own).cwiseAbs().maxCoeff() <= kRounding * own.cwiseAbs().maxCoeff();
}

}  // namespace

std::optional<Matrix> cascade_moments(const std::vector<FilteredSignal>& signals, const std::vector<Index>& left,
                                      const std::vector<Index>& right) {
    if (signals.size() > 3) return {};
    std::array<Source, 2> sources;
    if (!find_bases(signals, sources)) return {};
    Index latest = 0;
    for (const FilteredSignal& signal : signals) latest = std::max(latest, signal.system.delay);
    const Index N = signals.front().signal.size(), segment = std::max<Index>(0, N - latest - 1) / kCascadeLanes;
    if (segment < kShortestCascadeSegment) return {};
    const Index first = N - kCascadeLanes * segment;

    const CascadeBasis& last = sources[1].basis;
    const bool tap = last.sees_tap();
    const bool fed = !tap && last.order == 2 && last.outputs.rows() == 1 && last.outputs(0, 1) != 0;
    CascadeSource& of_last = sources[1].lanes;
    if (fed) of_last.feed = last.outputs(0, 0) / last.outputs(0, 1);
    const bool two = signals.size() > 1;
    const Outputs outputs = outputs_of(sources, two, fed, tap);
    const int wanted = wanted_products(outputs, last.order, left, right);
    const Summation sum = summation_for(sources, outputs, fed, tap, wanted);
    if (!sum) return {};

    const std::vector<OutputSum> no_sums;
    SampleMoments samples(signals, left, right, no_sums);
    samples.run(0, first);
    // Each source begins where the last signal that it stands for is.
    const auto begin_at = [&](Source& source, std::size_t signal) {
        CascadeSource& lanes = source.lanes;
        std::copy(source.basis.pairs.begin(), source.basis.pairs.end(), lanes.pairs.begin());
        lanes.v = signals[signal].signal.data() + (first - source.basis.delay);
        lanes.state.head(source.basis.order) = source.basis.from_state(samples.recursion(signal).state(), *lanes.v);
        // With the feed, p stands for p + feed square q, and q for q + feed p.
        if (lanes.feed != 0)
            lanes.state.head<2>() +=
                lanes.feed * Eigen::Vector2d(lanes.pairs[0].square * lanes.state[1], lanes.state[0]);
    };
    begin_at(sources[1], signals.size() - 1);
    if (two)
        begin_at(sources[0], 0);
    else
        sources[0].lanes.v = of_last.v;
    if (signals.size() == 3 &&
        !agree_on_state(of_last.state.head(2), signals[1], samples.recursion(1).state(), *of_last.v))
        return {};
    std::optional<Matrix> products = sum_by_growth(sources, outputs, fed, tap, wanted, segment);
    if (!products) products = sum(lanes_of(sources), segment);
    const Matrix with_outputs = products->lazyProduct(outputs.weights.transpose());
    Matrix moments = samples.total();
    for (Index j = 0; j < moments.cols(); ++j)
        for (Index i = 0; i < moments.rows(); ++i)
            moments(i, j) += outputs.weights.row(left[static_cast<std::size_t>(i)])
                                 .dot(with_outputs.col(right[static_cast<std::size_t>(j)]));
    return moments;
}

}  // namespace dynlab::inline numerics
