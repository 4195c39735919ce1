#include "numerics/linalg/products.h"

namespace dynlab::inline numerics {

namespace {

using Eigen::Dynamic;
using Eigen::Index;
using Eigen::InnerStride;
using Eigen::Map;

template <class Number>
using Column = Eigen::Matrix<Number, Dynamic, 1>;

template <class A, class B, int kMode>
using EigenProduct = Eigen::internal::generic_product_impl<A, B, Eigen::DenseShape, Eigen::DenseShape, kMode>;

constexpr Index kSmall = 20;  // rows, columns and depth together: EIGEN_GEMM_TO_COEFFBASED_THRESHOLD

/// work(A), of an order that the compiler knows. Complex matrices, which are few and small, are brought to columns.
template <class Number, class Work>
void with_order(const StoredMatrix<const Number>& A, const Work& work) {
    using ByRows = ProductOperand<Number, Eigen::RowMajor>;
    using ByColumns = ProductOperand<Number, Eigen::ColMajor>;
    const Eigen::OuterStride<> stride(A.stride);
    if (!A.by_rows) return work(ByColumns(A.data, A.rows, A.cols, stride));
    const ByRows rows(A.data, A.rows, A.cols, stride);
    if constexpr (std::same_as<Number, double>) {
        work(rows);
    } else {
        const Eigen::Matrix<Number, Dynamic, Dynamic> columns = rows;
        work(ByColumns(columns.data(), A.rows, A.cols, Eigen::OuterStride<>(A.rows)));
    }
}

/// y += factor A x, entries side by side.
template <class A, class Number>
void add_packed(const A& a, const Number* x, Number factor, Number* y) {
    using Operand = Map<const Column<Number>>;
    Map<Column<Number>> sums(y, a.rows());
    EigenProduct<A, Operand, Eigen::GemvProduct>::scaleAndAddTo(sums, a, Operand(x, a.cols()), factor);
}

}  // namespace

template <class Number>
void add_product(const StoredMatrix<const Number>& A, const StoredVector<const Number>& x, Number factor,
                 const StoredVector<Number>& y) {
    if (A.rows == 0 || A.cols == 0) return;
    if (x.step != 1) {
        const Column<Number> packed =
            Map<const Column<Number>, 0, InnerStride<>>(x.data, x.size, InnerStride<>(x.step));
        return add_product<Number>(A, StoredVector<const Number>{packed.data(), x.size, 1}, factor, y);
    }
    with_order(A, [&](const auto& a) {
        if (y.step == 1) return add_packed(a, x.data, factor, y.data);
        Column<Number> sums = Column<Number>::Zero(A.rows);
        add_packed(a, x.data, factor, sums.data());
        Map<Column<Number>, 0, InnerStride<>>(y.data, A.rows, InnerStride<>(y.step)) += sums;
    });
}

template <class Number>
void add_product(const StoredMatrix<const Number>& A, const StoredMatrix<const Number>& B, Number factor,
                 const StoredMatrix<Number>& C) {
    if (C.by_rows) return add_product<Number>(B.transposed(), A.transposed(), factor, C.transposed());
    if (A.rows == 0 || A.cols == 0 || B.cols == 0) return;
    using Sums = Map<Eigen::Matrix<Number, Dynamic, Dynamic>, 0, Eigen::OuterStride<>>;
    Sums sums(C.data, C.rows, C.cols, Eigen::OuterStride<>(C.stride));
    with_order(A, [&]<class Lhs>(const Lhs& a) {
        with_order(B, [&]<class Rhs>(const Rhs& b) {
            if (A.rows + A.cols + B.cols < kSmall)
                sums += factor * a.lazyProduct(b);
            else
                EigenProduct<Lhs, Rhs, Eigen::GemmProduct>::scaleAndAddTo(sums, a, b, factor);
        });
    });
}

template void add_product(const StoredMatrix<const double>&, const StoredVector<const double>&, double,
                          const StoredVector<double>&);
template void add_product(const StoredMatrix<const double>&, const StoredMatrix<const double>&, double,
                          const StoredMatrix<double>&);
using Complex = std::complex<double>;
template void add_product(const StoredMatrix<const Complex>&, const StoredVector<const Complex>&, Complex,
                          const StoredVector<Complex>&);
template void add_product(const StoredMatrix<const Complex>&, const StoredMatrix<const Complex>&, Complex,
                          const StoredMatrix<Complex>&);

}  // namespace dynlab::inline numerics
