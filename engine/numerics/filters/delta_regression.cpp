#include "numerics/filters/delta_regression.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory_resource>

#include "numerics/filters/delta_products.h"
#include "numerics/filters/delta_sampling.h"

namespace dynlab::inline numerics {

namespace {

template <int n>
StateMatrix<n> companion_of(const VectorView& den) {
    StateMatrix<n> A = StateMatrix<n>::Zero();
    for (int i = 0; i < n; ++i) A(0, i) = -den[i + 1];
    for (int i = 1; i < n; ++i) A(i, i - 1) = 1;
    return A;
}

/// p^highest/A .. 1/A as outputs of the companion form, the n-th by identity.
template <int n>
struct Derivatives {
    Eigen::Matrix<double, Eigen::Dynamic, n, 0, n + 1, n> C;
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, n + 1, 1> D;

    Derivatives(const VectorView& den, int highest) {
        C.setZero(highest + 1, n);
        D.setZero(highest + 1);
        for (int row = 0; row <= highest; ++row)
            if (n - 1 - highest + row >= 0) C(row, n - 1 - highest + row) = 1;
        if (highest < n) return;
        for (int i = 0; i < n; ++i) C(0, i) = -den[i + 1];
        D[0] = 1;
    }
};

/// A filter with the denominator `den`, and its step over a sampling interval.
template <int n>
struct SampledFilter {
    const VectorView& den;
    StateMatrix<n> A;
    SizedStep<n, 1> step;

    SampledFilter(const VectorView& of, double Ts) : den(of), A(companion_of<n>(of)), step(dynlab::step_of<n>(A, Ts)) {}
    SampledFilter(const VectorView& of, const SizedStep<n, 1>& known) : den(of), A(companion_of<n>(of)), step(known) {}
};

/// p^n/A .. 1/A of the output.
template <int n>
DeltaSignal filtered_output(const RegressionRecord& record, const SampledFilter<n>& filter) {
    const DelayedStep<n> step = delayed_step<n>(filter.A, filter.step, record.sampling.Ts, record.hold_y, 0);
    const Derivatives<n> derivatives(filter.den, n);
    return delta_signal<n>(step, expansion<n>, derivatives.C, derivatives.D, record.y, false);
}

/// p^m/A .. 1/A of an input.
template <int n>
DeltaSignal filtered_input(const RegressionRecord& record, std::size_t input, const SampledFilter<n>& filter,
                           bool longer) {
    const DelayedStep<n> step =
        delayed_step<n>(filter.A, filter.step, record.sampling.Ts, record.hold, record.delays[input]);
    const Derivatives<n> derivatives(filter.den, record.zeros[input]);
    return delta_signal<n>(step, expansion<n>, derivatives.C, derivatives.D, record.u[input], longer);
}

template <int n>
DeltaSignal simulated(const RegressionRecord& record, std::size_t input, const VectorView& A, const Vector& B,
                      bool longer) {
    const SampledFilter<n> filter(A, record.sampling.Ts);
    const DelayedStep<n> step =
        delayed_step<n>(filter.A, filter.step, record.sampling.Ts, record.hold, record.delays[input]);
    const Derivatives<n> derivatives(A, static_cast<int>(B.size()) - 1);
    const Eigen::Matrix<double, 1, n> C = B.transpose() * derivatives.C;
    const Eigen::Matrix<double, 1, 1> D(B.dot(derivatives.D));
    return delta_signal<n>(step, expansion<n>, C, D, record.u[input], longer);
}

/// A signal as it is.
DeltaSignal unfiltered(const SampleView& samples) {
    DeltaSignal signal;
    signal.chain.samples = samples.data();
    signal.chain.count = samples.size();
    signal.outputs.setOnes(1, 1);
    return signal;
}

/// z = u/A and w = z/A, each with its derivatives.
template <int n>
struct SampledCascade {
    StateMatrix<2 * n> A = StateMatrix<2 * n>::Zero();
    SizedStep<2 * n, 1> step;

    SampledCascade(const VectorView& den, double Ts) {
        A.template topLeftCorner<n, n>() = A.template bottomRightCorner<n, n>() = companion_of<n>(den);
        A(n, n - 1) = 1;
        step = step_of<2 * n>(A, Ts);
    }
};

/// SRIVC's instruments -p^(n-1) B/A^2 .. -B/A^2, p^m/A .. 1/A of one input.
template <int n>
DeltaSignal sensitivities(const RegressionRecord& record, std::size_t input, const SampledCascade<n>& cascade,
                          const VectorView& A, const Vector& B, bool longer) {
    const int m = static_cast<int>(B.size()) - 1;
    // Row r: p^r w, from A(p) w = z for r >= n.
    StateMatrix<2 * n> derivatives_of_w = StateMatrix<2 * n>::Zero();
    for (int r = 0; r < 2 * n; ++r) {
        derivatives_of_w(r, 2 * n - 1 - r) = 1;
        if (r >= n)
            for (int i = 1; i <= n; ++i) derivatives_of_w.row(r) -= A[i] * derivatives_of_w.row(r - i);
    }
    const Derivatives<n> derivatives_of_z(A, m);
    Eigen::Matrix<double, Eigen::Dynamic, 2 * n, 0, 2 * n + 1, 2 * n> C;
    C.setZero(n + m + 1, 2 * n);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j <= m; ++j) C.row(i) -= B[j] * derivatives_of_w.row(n - 1 - i + m - j);
    C.bottomLeftCorner(m + 1, n) = derivatives_of_z.C;
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 2 * n + 1, 1> D;
    D.setZero(n + m + 1);
    D.tail(m + 1) = derivatives_of_z.D;
    const DelayedStep<2 * n> step =
        delayed_step<2 * n>(cascade.A, cascade.step, record.sampling.Ts, record.hold, record.delays[input]);
    return delta_signal<2 * n>(step, cascade_expansion<n>, C, D, record.u[input], longer);
}

/// p^(n-1)/E .. 1/E of the sampled output of B/A, then p^m/E .. 1/E of the input, which is held: products of the
/// sampled systems' numerators over A E.
template <int n>
DeltaSignal auxiliary(const RegressionRecord& record, std::size_t input, const SampledFilter<n>& filter,
                      const VectorView& A, const Vector& B, const DeltaSignal& filtered_y) {
    const DeltaSignal of_u = filtered_input<n>(record, input, filter, false);
    const DeltaSignal model = simulated<n>(record, input, A, B, false);
    const auto polynomial = [](const DeltaChain& chain) {
        StateVector<n> alpha;
        std::copy_n(chain.alpha.data(), n, alpha.data());
        return alpha;
    };
    const StateVector<n> of_filter = polynomial(of_u.chain), of_model = polynomial(model.chain);
    const StateVector<2 * n> alpha = delta_product<n, n>(of_filter, of_model);
    DeltaSignal signal{model.chain, {}};
    signal.chain.order = 2 * n;
    std::copy_n(alpha.data(), 2 * n, signal.chain.alpha.data());
    const Index inputs = of_u.outputs.rows();
    signal.outputs.setZero(n + inputs, 2 * n + 1);
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i)
            signal.outputs.col(i + j).template head<n>() +=
                model.outputs(0, j) * filtered_y.outputs.col(i).template tail<n>();
        signal.outputs.middleCols(j, n + 1).bottomRows(inputs) += (j < n ? of_model[j] : 1) * of_u.outputs;
    }
    return signal;
}

/// The signals of an equation; those of one input need no memory on the heap.
class DeltaSignals {
  public:
    explicit DeltaSignals(std::size_t count) { signals_.reserve(count); }

    /// The number of its first output, all being numbered through.
    Index add(const DeltaSignal& signal) {
        const Index first = outputs_;
        outputs_ += signal.outputs.rows();
        signals_.push_back(signal);
        return first;
    }
    const DeltaSignal& operator[](std::size_t i) const { return signals_[i]; }

    /// Of two signals or more: the sums of products of all outputs, or of all but the first signal's among themselves
    /// (first_alone = false); nothing where a pair has no loop.
    std::optional<Matrix> products(Index N, bool first_alone = true) const {
        Matrix total(outputs_, outputs_);
        const std::size_t last = signals_.size() - 1;
        Index row = 0;
        for (std::size_t i = 0; i < last; row += signals_[i++].outputs.rows()) {
            Index column = row;
            for (std::size_t j = i + 1; j <= last; ++j) {
                const bool own = j == i + 1 && (i > 0 || first_alone);
                const bool highest = !signals_[j].outputs.rightCols<1>().isZero(0);
                const auto products = delta_products(signals_[i].chain, signals_[j].chain, N, {own, highest});
                if (!products) return {};
                if (own) set(products->first, i, row, i, row, total);
                column += signals_[j - 1].outputs.rows();
                set(products->both, i, row, j, column, total);
                if (i + 1 == j && j == last) set(products->second, j, column, j, column, total);
            }
        }
        return total;
    }

  private:
    /// The block of two signals' outputs, and its mirror image. (Loops, for Eigen's are slow where sizes are as small
    /// as here but not known to the compiler.)
    void set(const ColumnMatrix& products, std::size_t left, Index row, std::size_t right, Index column,
             Matrix& total) const {
        const ColumnMatrix &L = signals_[left].outputs, &R = signals_[right].outputs;
        const Index columns = products.rows();
        double weighted[kMostDeltaOrder + 1];
        for (Index j = 0; j < R.rows(); ++j) {
            for (Index a = 0; a < columns; ++a) {
                double sum = 0;
                for (Index b = 0; b < products.cols(); ++b) sum += R(j, b) * products(a, b);
                weighted[a] = sum;
            }
            for (Index i = 0; i < L.rows(); ++i) {
                double sum = 0;
                for (Index a = 0; a < columns; ++a) sum += L(i, a) * weighted[a];
                total(row + i, column + j) = total(column + j, row + i) = sum;
            }
        }
    }

    std::array<std::byte, 3 * sizeof(DeltaSignal)> room_;
    std::pmr::monotonic_buffer_resource memory_{room_.data(), room_.size()};
    std::pmr::vector<DeltaSignal> signals_{&memory_};
    Index outputs_ = 0;
};

/// Which outputs the equation is made of.
struct EquationOutputs {
    Index n = 0;
    std::vector<Index> instruments;  ///< where the first n instruments of each input begin
    double sign = 1;                 ///< of these
    std::vector<Index> inputs;       ///< the derivatives of all inputs; p^n y_f .. y_f are the first outputs

    NormalEquations equations(const Matrix& products, double gain, bool with_gram) const {
        const Index d = n + static_cast<Index>(inputs.size());
        // Rows of z: of p^n y_f .. y_f, then of all inputs' derivatives, then of z itself.
        const auto times_z = [&](Index output, auto&& column) {
            for (Index i = 0; i < n; ++i) {
                double sum = 0;
                for (const Index first : instruments) sum += products(first + i, output);
                column[i] = gain * gain * sign * sum;
            }
            for (Index i = n; i < d; ++i)
                column[i] = gain * gain * products(inputs[static_cast<std::size_t>(i - n)], output);
        };
        NormalEquations sums{Matrix(d, d), Vector(d), Matrix(), 0};
        times_z(0, sums.z_y);
        for (Index j = 0; j < n; ++j) {
            times_z(1 + j, sums.z_phi.col(j));
            sums.z_phi.col(j) *= -1;
        }
        for (Index j = n; j < d; ++j) times_z(inputs[static_cast<std::size_t>(j - n)], sums.z_phi.col(j));
        if (!with_gram) return sums;
        sums.z_z = Matrix::Zero(d, d);
        Vector column(d);
        for (Index j = 0; j < n; ++j)
            for (const Index first : instruments) {
                times_z(first + j, column);
                sums.z_z.col(j) += sign * column;
            }
        sums.z_z.rightCols(d - n) = sums.z_phi.rightCols(d - n);
        return sums;
    }
};

/// Regularly sampled, and not so slowly that the filter 1/A forgets everything from one sample to the next: states that
/// follow their input at once are no combinations of its differences.
bool is_sampled_for(const RegressionRecord& record, const VectorView& A) {
    constexpr double kFastestPole = 5;  // mean of the poles times the sampling time
    const double Ts = record.sampling.Ts;
    return Ts > 0 && record.y.size() > 1 && A.allFinite() && A.size() > 1 &&
           std::abs(A[1]) * Ts < kFastestPole * static_cast<double>(A.size() - 1);
}

/// Whether an input's chain needs another column (delta_signal): all then have one.
bool needs_longer(const RegressionRecord& record) {
    return record.hold == Hold::kFoh && std::any_of(record.delays.begin(), record.delays.end(), [&](double delay) {
               return split_delay(delay, record.sampling.Ts).rest > 0;
           });
}

/// f(n) for the number of poles as a constant; nothing for other numbers.
template <class Result, class Function>
std::optional<Result> for_order(Index poles, const Function& f) {
    switch (poles) {
        case 1:
            return f(std::integral_constant<int, 1>());
        case 2:
            return f(std::integral_constant<int, 2>());
        case 3:
            return f(std::integral_constant<int, 3>());
        case 4:
            return f(std::integral_constant<int, 4>());
        default:
            return {};
    }
}

void append_range(std::vector<Index>& places, Index first, Index count) {
    for (Index i = 0; i < count; ++i) places.push_back(first + i);
}

}  // namespace

std::optional<NormalEquations> delta_svf_equations(const RegressionRecord& record, const VectorView& E, double gain) {
    if (!is_sampled_for(record, E)) return {};
    return for_order<NormalEquations>(E.size() - 1, [&](auto n) -> std::optional<NormalEquations> {
        const bool longer = needs_longer(record);
        EquationOutputs equation{n, {1}, -1, {}};
        DeltaSignals signals(1 + record.u.size());
        const SampledFilter<n> filter(E, record.sampling.Ts);
        signals.add(filtered_output<n>(record, filter));
        for (std::size_t j = 0; j < record.u.size(); ++j)
            append_range(equation.inputs, signals.add(filtered_input<n>(record, j, filter, longer)),
                         record.zeros[j] + 1);
        const std::optional<Matrix> products = signals.products(record.y.size());
        if (!products) return {};
        NormalEquations sums = equation.equations(*products, gain, false);
        sums.z_z = sums.z_phi;
        sums.y_y = gain * gain * (*products)(0, 0);
        return sums;
    });
}

std::optional<NormalEquations> delta_auxiliary_equations(const RegressionRecord& record, const VectorView& E,
                                                         const VectorView& A, const std::vector<Vector>& B,
                                                         double gain) {
    if (!is_sampled_for(record, E) || record.hold != Hold::kZoh || A.size() != E.size() || !is_sampled_for(record, A))
        return {};
    for (const Vector& numerator : B)
        if (numerator.size() >= A.size()) return {};
    return for_order<NormalEquations>(E.size() - 1, [&](auto n) -> std::optional<NormalEquations> {
        EquationOutputs equation{n, {}, -1, {}};
        DeltaSignals signals(1 + record.u.size());
        const SampledFilter<n> filter(E, record.sampling.Ts);
        signals.add(filtered_output<n>(record, filter));
        for (std::size_t j = 0; j < record.u.size(); ++j) {
            const Index first = signals.add(auxiliary<n>(record, j, filter, A, B[j], signals[0]));
            equation.instruments.push_back(first);
            append_range(equation.inputs, first + n, record.zeros[j] + 1);
        }
        const std::optional<Matrix> products = signals.products(record.y.size(), false);
        if (!products) return {};
        return equation.equations(*products, gain, true);
    });
}

namespace {

/// Whether products of the sensitivities, which have each pole twice, would lose more than half of the digits: the
/// product of the poles is small beside a power of their sum then.
template <int n>
bool poles_far_apart(const VectorView& A, double Ts) {
    constexpr double kFarApart = 1e4;
    if constexpr (n <= 2) return false;
    const StateVector<n> alpha = delta_polynomial<n>(step_of<n>(companion_of<n>(A), Ts).E);
    return std::abs(alpha[0]) * kFarApart < std::pow(alpha[n - 1], n);
}

}  // namespace

std::optional<NormalEquations> delta_refined_equations(const RegressionRecord& record, const VectorView& A,
                                                       const std::vector<Vector>& B, bool with_gram) {
    if (!is_sampled_for(record, A)) return {};
    return for_order<NormalEquations>(A.size() - 1, [&](auto n) -> std::optional<NormalEquations> {
        if (poles_far_apart<n>(A, record.sampling.Ts)) return {};
        EquationOutputs equation{n, {}, 1, {}};
        DeltaSignals signals(1 + record.u.size());
        const SampledCascade<n> cascade(A, record.sampling.Ts);
        signals.add(filtered_output<n>(record, {A, step_of_first<n>(cascade.step)}));
        const bool longer = needs_longer(record);
        for (std::size_t j = 0; j < record.u.size(); ++j) {
            const Index first = signals.add(sensitivities<n>(record, j, cascade, A, B[j], longer));
            equation.instruments.push_back(first);
            append_range(equation.inputs, first + n, B[j].size());
        }
        const std::optional<Matrix> products = signals.products(record.y.size(), false);
        if (!products) return {};
        return equation.equations(*products, 1, with_gram);
    });
}

std::optional<Matrix> delta_output_products(const RegressionRecord& record, const std::vector<Vector>& A,
                                            const std::vector<Vector>& B) {
    const auto fits = [&](const Vector& den) { return den.size() == A[0].size() && is_sampled_for(record, den); };
    if (!std::all_of(A.begin(), A.end(), fits)) return {};
    return for_order<Matrix>(A[0].size() - 1, [&](auto n) {
        const bool longer = needs_longer(record);
        DeltaSignals signals(1 + record.u.size());
        signals.add(unfiltered(record.y));
        for (std::size_t j = 0; j < record.u.size(); ++j) signals.add(simulated<n>(record, j, A[j], B[j], longer));
        return signals.products(record.y.size());
    });
}

}  // namespace dynlab::inline numerics
