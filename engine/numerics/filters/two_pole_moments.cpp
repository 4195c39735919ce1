#include "numerics/filters/two_pole_moments.h"

#include "numerics/filters/cascade_products.h"
#include "numerics/filters/newton_basis.h"
#include "numerics/linalg/short_step.h"

namespace dynlab::inline numerics {

namespace {

template <int rows, int columns>
using Sized = Eigen::Matrix<double, rows, columns>;

/// dx/dt = A x + [1; 0; ..] v, y = C x + D v with n states, one input and p outputs.
template <int n, int p>
struct System {
    Sized<n, n> A;
    Sized<p, n> C = Sized<p, n>::Zero();
    Sized<p, 1> D = Sized<p, 1>::Zero();
};

/// x[k+1] = F x[k] + next v[k+1] + now v[k], y[k] = C x[k] + D v[k], at rest at the first sample; before it v is zero,
/// not a ramp.
template <int n, int p>
struct SampledSystem {
    Sized<n, n> F;
    Sized<n, 1> next, now;
    Sized<p, n> C;
    Sized<p, 1> D;
};

template <int n>
using Step = SizedStep<n, 1>;

template <int n, int p>
std::optional<Step<n>> step_of(const System<n, p>& system, double Ts) {
    return short_step<n, 1>(system.A, Sized<n, 1>::Unit(0), Ts);
}

template <int n, int p>
SampledSystem<n, p> sampled(const System<n, p>& system, const Step<n>& step, Hold hold) {
    if (hold == Hold::kZoh) return {step.F, Sized<n, 1>::Zero(), step.G, system.C, system.D};
    return {step.F, step.H1, step.H0, system.C, system.D};
}

/// The Newton basis of a system at rest.
template <int n, int p>
struct Basis {
    std::array<PolePair, 2> pairs = {};
    Sized<p, n + 1> outputs;  ///< of the states, then the sample
    Sized<n, 1> start;        ///< state at the first sample, for a sample of one

    CascadeSource source(const SampleView& v) const {
        CascadeSource source{pairs, 0, v.data()};
        source.state.template head<n>() = v[0] * start;
        return source;
    }
};

template <int n, int p>
Basis<n, p> basis_of(const SampledSystem<n, p>& system, const std::array<PolePair, 2>& pairs, bool in_order) {
    Basis<n, p> basis;
    basis.pairs = pairs;
    const Sized<n, 1> g = system.F.lazyProduct(system.next) + system.now;
    const Sized<n, n> to_state = newton_columns<n>(system.F, g, pairs.data(), in_order);
    basis.outputs << system.C.lazyProduct(to_state), system.C.lazyProduct(system.next) + system.D;
    basis.start.setZero();
    if (!system.next.isZero(0)) basis.start = solve_scaled<n>(to_state, -system.next);
    return basis;
}

/// Of a system with two poles, or of two in series that have the same.
template <int n, int p>
Basis<n, p> basis_of(const SampledSystem<n, p>& system) {
    const PolePair pair = pair_of(system.F.template topLeftCorner<2, 2>());
    return basis_of(system, {pair, pair}, true);
}

/// 1/A with the first derivative of its output, and the output, as states.
template <int p>
System<2, p> all_pole(const VectorView& A) {
    System<2, p> system;
    system.A << -A[1], -A[2], 1, 0;
    return system;
}

/// p^2/A, p/A, 1/A
System<2, 3> output_filter(const VectorView& A) {
    System<2, 3> system = all_pole<3>(A);
    system.C << -A[1], -A[2], 1, 0, 0, 1;
    system.D[0] = 1;
    return system;
}

/// p^m/A .. 1/A, m < 2
template <int m>
System<2, m + 1> input_filter(const VectorView& A) {
    System<2, m + 1> system = all_pole<m + 1>(A);
    system.C = Sized<2, 2>::Identity().template bottomRows<m + 1>();
    return system;
}

System<2, 1> model(const VectorView& A, const VectorView& B) {
    System<2, 1> system = all_pole<1>(A);
    system.C.rightCols(B.size()) = B.transpose();
    return system;
}

/// SRIVC's instruments -p B/A^2, -B/A^2, p^m/A .. 1/A: the cascade of z = v/A and w = z/A, each with its derivative.
template <int m>
System<4, m + 3> instruments(const VectorView& A, const VectorView& B) {
    System<4, m + 3> system;
    system.A << -A[1], -A[2], 0, 0,  //
        1, 0, 0, 0,                  //
        0, 1, -A[1], -A[2],          //
        0, 0, 1, 0;
    const Eigen::RowVector4d w2(0, 1, -A[1], -A[2]), w1(0, 0, 1, 0), w0(0, 0, 0, 1);
    if constexpr (m == 0) {
        system.C.row(0) = -B[0] * w1;
        system.C.row(1) = -B[0] * w0;
    } else {
        system.C.row(0) = -B[0] * w2 - B[1] * w1;
        system.C.row(1) = -B[0] * w1 - B[1] * w0;
    }
    system.C.template bottomLeftCorner<m + 1, 2>() = Sized<2, 2>::Identity().template bottomRows<m + 1>();
    return system;
}

/// p/E and 1/E of what the model `front` makes of a held input.
SampledSystem<4, 2> in_series(const SampledSystem<2, 1>& front, const SampledSystem<2, 3>& filter) {
    const Eigen::RowVector2d c = front.C;
    SampledSystem<4, 2> chain;
    chain.F << front.F, Sized<2, 2>::Zero(), filter.now * c + filter.next * c.lazyProduct(front.F), filter.F;
    chain.next.setZero();
    chain.now << front.now, filter.next * c.dot(front.now);
    chain.C << Sized<2, 2>::Zero(), Sized<2, 2>::Identity();
    chain.D.setZero();
    return chain;
}

bool fits(const RegressionRecord& record, Index poles, Index zeros) {
    return poles == 2 && zeros <= 1 && record.u.size() == 1 && record.delays[0] == 0 && record.sampling.Ts > 0 &&
           record.y.size() >= kCascadeLanes * kShortestCascadeSegment;
}

/// f(m, held) for the degree m of the numerator, 0 or 1, and how the input behaves.
template <class Function>
auto by_kind(const RegressionRecord& record, Index m, const Function& f) {
    using Zero = std::integral_constant<int, 0>;
    using One = std::integral_constant<int, 1>;
    const bool held = record.hold == Hold::kZoh;
    if (m == 0) return held ? f(Zero(), std::true_type()) : f(Zero(), std::false_type());
    return held ? f(One(), std::true_type()) : f(One(), std::false_type());
}

template <class First, class Second, int kWanted>
ColumnProducts<First, Second> sums_of(const std::array<CascadeSource, 2>& sources, Index N) {
    const Index segment = N / kCascadeLanes;
    return sum_products<First, Second, kWanted>(sources, N - kCascadeLanes * segment, segment);
}

using OutputShape = CascadeShape<2, false, true>;  ///< the filtered output needs the sample as well
template <int m, bool kHeld>
using InputShape = CascadeShape<2, m == 0 && kHeld, !kHeld>;

/// An input through two poles: its source, and its outputs as combinations of the columns.
template <int m, bool kHeld, int p>
struct Input {
    using Shape = InputShape<m, kHeld>;
    CascadeSource source;
    Sized<p, Shape::kColumns> outputs;

    Input(const Basis<2, p>& basis, const SampleView& u) : source(basis.source(u)) {
        if constexpr (Shape::kFed) {
            source.feed = basis.outputs(0, 0) / basis.outputs(0, 1);
            outputs = basis.outputs.col(1);
        } else {
            outputs = basis.outputs.template leftCols<Shape::kColumns>();
        }
    }
};

/// [-p y_f, -y_f, the m + 1 derivatives of the input, p^2 y_f]' from the output's and the input's combinations.
template <int inputs, int columns>
Sized<inputs + 3, columns + 3> regressors(const Sized<3, 3>& of_y, const Sized<inputs, columns>& of_u) {
    Sized<inputs + 3, columns + 3> rows = Sized<inputs + 3, columns + 3>::Zero();
    rows.template topLeftCorner<2, 3>() = -of_y.template bottomRows<2>();
    rows.template block<inputs, columns>(2, 3) = of_u;
    rows.template bottomLeftCorner<1, 3>() = of_y.row(0);
    return rows;
}

template <int d, int columns>
RegressionMoments with_instruments(const Sized<d, columns>& z, const Sized<d + 1, columns>& phi,
                                   const Sized<columns, columns>& products, double gain, bool with_gram) {
    const Sized<d, columns> weighted = gain * gain * z.lazyProduct(products);
    const Sized<d, d + 1> sums = weighted.lazyProduct(phi.transpose());
    return {sums.template leftCols<d>(), sums.col(d),
            with_gram ? Matrix(weighted.lazyProduct(z.transpose())) : Matrix(), 0};
}

/// Squares of the filtered output from how they grow, where that loses no digits.
template <class Second>
ColumnProducts<OutputShape, Second> filtered_sums(const std::array<CascadeSource, 2>& sources, Index N) {
    if (sources[0].pairs[0].square == 0) {
        using Repeated = CascadeShape<2, false, true, true>;
        using SecondRepeated = CascadeShape<2, Second::kFed, Second::kTap, true>;
        auto sums = sums_of<Repeated, SecondRepeated, kFirstWithSample>(sources, N);
        if (complete_squares(sums, sources[0].pairs[0].centre)) return sums;
    }
    return sums_of<OutputShape, Second, kFirstAlone>(sources, N);
}

}  // namespace

std::optional<RegressionMoments> two_pole_svf_moments(const RegressionRecord& record, const VectorView& E,
                                                      double gain) {
    if (!fits(record, E.size() - 1, record.zeros[0])) return {};
    const auto step = step_of(output_filter(E), record.sampling.Ts);
    if (!step) return {};
    const auto sum = [&](auto m, auto held) -> std::optional<RegressionMoments> {
        constexpr int d = m + 3;
        const auto of_y = basis_of(sampled(output_filter(E), *step, record.hold_y));
        const Input<m, held, m + 1> u(basis_of(sampled(input_filter<m>(E), *step, record.hold)), record.u[0]);
        if (!std::isfinite(u.source.feed)) return {};
        const auto sums = filtered_sums<InputShape<m, held>>({of_y.source(record.y), u.source}, record.y.size());
        const auto phi = regressors(of_y.outputs, u.outputs);
        const Sized<d + 1, d + 1> all = gain * gain * phi.lazyProduct(sums).eval().lazyProduct(phi.transpose());
        const Matrix gram = all.template topLeftCorner<d, d>();
        return RegressionMoments{gram, all.col(d).template head<d>(), gram, all(d, d)};
    };
    return by_kind(record, record.zeros[0], sum);
}

std::optional<RegressionMoments> two_pole_auxiliary_moments(const RegressionRecord& record, const VectorView& E,
                                                            const VectorView& A, const VectorView& B, double gain) {
    if (!fits(record, E.size() - 1, B.size() - 1) || A.size() != 3 || record.hold != Hold::kZoh) return {};
    const auto step = step_of(output_filter(E), record.sampling.Ts),
               of_model = step_of(model(A, B), record.sampling.Ts);
    if (!step || !of_model) return {};
    const auto sum = [&](auto m, auto) -> std::optional<RegressionMoments> {
        const auto y = sampled(output_filter(E), *step, record.hold_y);
        const auto of_y = basis_of(y);
        const auto of_u = basis_of(sampled(input_filter<m>(E), *step, Hold::kZoh));
        const auto of_x = basis_of(in_series(sampled(model(A, B), *of_model, Hold::kZoh), y),
                                   {of_u.pairs[0], pair_of(of_model->F)}, false);
        Sized<m + 1, 4> inputs = Sized<m + 1, 4>::Zero();
        inputs.template leftCols<2>() = of_u.outputs.template leftCols<2>();
        const auto sums = sums_of<OutputShape, CascadeShape<4, false, false>, kSecondPairAlone>(
            {of_y.source(record.y), of_x.source(record.u[0])}, record.y.size());
        Sized<m + 3, 7> z = Sized<m + 3, 7>::Zero();
        z.template topRightCorner<2, 4>() = -of_x.outputs.template leftCols<4>();
        z.template bottomRightCorner<m + 1, 4>() = inputs;
        return with_instruments<m + 3, 7>(z, regressors(of_y.outputs, inputs), sums, gain, true);
    };
    return by_kind(record, record.zeros[0], sum);
}

std::optional<RegressionMoments> two_pole_refined_moments(const RegressionRecord& record, const VectorView& A,
                                                          const VectorView& B, bool with_gram) {
    if (!fits(record, A.size() - 1, B.size() - 1)) return {};
    const auto sum = [&](auto m, auto held) -> std::optional<RegressionMoments> {
        using Second = CascadeShape<4, false, !held>;
        constexpr int of_input = Second::kColumns, columns = 3 + of_input;
        const System<4, m + 3> cascade = instruments<m>(A, B);
        const auto step = step_of(cascade, record.sampling.Ts);
        if (!step) return {};
        const Step<2> of_filter{step->F.template topLeftCorner<2, 2>(), step->G.template head<2>(),
                                step->H0.template head<2>(), step->H1.template head<2>(),
                                step->E.template topLeftCorner<2, 2>()};
        const auto of_y = basis_of(sampled(output_filter(A), of_filter, record.hold_y));
        const auto of_u = basis_of(sampled(cascade, *step, record.hold));
        const Sized<m + 3, of_input> outputs = of_u.outputs.template leftCols<of_input>();
        const std::array<CascadeSource, 2> sources{of_y.source(record.y), of_u.source(record.u[0])};
        const auto sums = with_gram ? sums_of<OutputShape, Second, kSecondPairAlone>(sources, record.y.size())
                                    : sums_of<OutputShape, Second, 0>(sources, record.y.size());
        Sized<m + 3, columns> z = Sized<m + 3, columns>::Zero();
        z.template rightCols<of_input>() = outputs;
        const Sized<m + 1, of_input> inputs = outputs.template bottomRows<m + 1>();
        return with_instruments<m + 3, columns>(z, regressors(of_y.outputs, inputs), sums, 1, with_gram);
    };
    return by_kind(record, B.size() - 1, sum);
}

std::optional<Eigen::Matrix2d> two_pole_output_moments(const RegressionRecord& record, const VectorView& A,
                                                       const VectorView& B) {
    if (!fits(record, A.size() - 1, B.size() - 1)) return {};
    const auto step = step_of(model(A, B), record.sampling.Ts);
    if (!step) return {};
    const auto sum = [&](auto, auto held) -> std::optional<Eigen::Matrix2d> {
        using Sample = CascadeShape<0, false, true>;
        const Input<0, held, 1> u(basis_of(sampled(model(A, B), *step, record.hold)), record.u[0]);
        if (!std::isfinite(u.source.feed)) return {};
        CascadeSource y;
        y.v = record.y.data();
        const auto sums = sums_of<Sample, InputShape<0, held>, kFirstAlone>({y, u.source}, record.y.size());
        constexpr int columns = InputShape<0, held>::kColumns;
        Sized<2, columns + 1> outputs = Sized<2, columns + 1>::Zero();
        outputs(0, 0) = 1;
        outputs.template bottomRightCorner<1, columns>() = u.outputs;
        return outputs.lazyProduct(sums).eval().lazyProduct(outputs.transpose());
    };
    return by_kind(record, 0, sum);
}

}  // namespace dynlab::inline numerics
