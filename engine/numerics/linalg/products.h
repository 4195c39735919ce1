#pragma once
#include <Eigen/Core>
#include <complex>
#include <concepts>
#include <type_traits>

// Products of matrices and vectors whose sizes are known at run time only are compiled once, in products.cpp: Eigen
// would compile its loops again for every pair of operand types, for up to two seconds each. A * B is written as ever;
// the specializations below take it, as those of Eigen/src/Core/products/GeneralMatrixMatrix_BLAS.h do for a BLAS
// library.

namespace dynlab::inline numerics {

/// Entry (i, j) is at data[i + j * stride], or with `by_rows` at data[i * stride + j].
template <class Number>
struct StoredMatrix {
    Number* data;
    Eigen::Index rows, cols, stride;
    bool by_rows;

    StoredMatrix transposed() const { return {data, cols, rows, stride, !by_rows}; }
};

/// Entry i is at data[i * step].
template <class Number>
struct StoredVector {
    Number* data;
    Eigen::Index size, step;
};

/// C += factor A B, of double or std::complex<double>. C shares no memory with A and B.
template <class Number>
void add_product(const StoredMatrix<const Number>& A, const StoredMatrix<const Number>& B, Number factor,
                 const StoredMatrix<Number>& C);
/// y += factor A x, of double or std::complex<double>. y shares no memory with A and x.
template <class Number>
void add_product(const StoredMatrix<const Number>& A, const StoredVector<const Number>& x, Number factor,
                 const StoredVector<Number>& y);

/// What products.cpp hands to Eigen.
template <class Number, int kOrder>
using ProductOperand =
    Eigen::Map<const Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic, kOrder>, 0, Eigen::OuterStride<>>;

template <class Factor, class Number = typename Factor::Scalar>
concept ProductFactor =
    (std::same_as<Number, double> ||
     std::same_as<Number, std::complex<double>>)&&!std::same_as<Factor, ProductOperand<Number, Eigen::ColMajor>> &&
    !std::same_as<Factor, ProductOperand<Number, Eigen::RowMajor>>;

template <class Lhs, class Rhs>
concept ProductFactors =
    ProductFactor<Lhs> && ProductFactor<Rhs> && std::same_as<typename Lhs::Scalar, typename Rhs::Scalar>;

}  // namespace dynlab::inline numerics

namespace Eigen::internal {

/// A factor of a product, in memory: where it is, or evaluated where it is nowhere.
template <class Factor>
class FactorInMemory {
    using Traits = blas_traits<Factor>;
    static constexpr bool kIsThere = Traits::HasUsableDirectAccess && !Traits::NeedToConjugate;
    using Stored = std::conditional_t<kIsThere, typename Traits::ExtractType, const typename Factor::PlainObject>;
    using Number = typename Factor::Scalar;

  public:
    explicit FactorInMemory(const Factor& factor) : stored_(extract(factor)) {}

    auto matrix() const {
        constexpr bool by_rows = (int(std::remove_cvref_t<Stored>::Flags) & RowMajorBit) != 0;
        return dynlab::StoredMatrix<const Number>{stored_.data(), stored_.rows(), stored_.cols(), stored_.outerStride(),
                                                  by_rows};
    }
    auto vector() const {
        return dynlab::StoredVector<const Number>{stored_.data(), stored_.size(), stored_.innerStride()};
    }
    /// The scalar factor of the operand.
    static Number scalar(const Factor& factor) {
        if constexpr (kIsThere) return Traits::extractScalarFactor(factor);
        return Number(1);
    }

  private:
    static decltype(auto) extract(const Factor& factor) {
        if constexpr (kIsThere)
            return Traits::extract(factor);
        else
            return (factor);
    }
    Stored stored_;
};

template <class Lhs, class Rhs>
requires dynlab::ProductFactors<Lhs, Rhs>
struct generic_product_impl<Lhs, Rhs, DenseShape, DenseShape, GemmProduct>
    : generic_product_impl_base<Lhs, Rhs, generic_product_impl<Lhs, Rhs, DenseShape, DenseShape, GemmProduct>> {
    using Number = typename Lhs::Scalar;

    template <class Target>
    static void scaleAndAddTo(Target& C, const Lhs& A, const Rhs& B, Number factor) {
        if constexpr (blas_traits<Target>::HasUsableDirectAccess) {
            const FactorInMemory<Lhs> a(A);
            const FactorInMemory<Rhs> b(B);
            dynlab::add_product<Number>(a.matrix(), b.matrix(), factor * a.scalar(A) * b.scalar(B),
                                        {C.data(), C.rows(), C.cols(), C.outerStride(), bool(Target::IsRowMajor)});
        } else {
            Matrix<Number, Dynamic, Dynamic> product = Matrix<Number, Dynamic, Dynamic>::Zero(A.rows(), B.cols());
            scaleAndAddTo(product, A, B, factor);
            C += product;
        }
    }
};

template <class Lhs, class Rhs>
requires dynlab::ProductFactors<Lhs, Rhs>
struct generic_product_impl<Lhs, Rhs, DenseShape, DenseShape, GemvProduct>
    : generic_product_impl_base<Lhs, Rhs, generic_product_impl<Lhs, Rhs, DenseShape, DenseShape, GemvProduct>> {
    using Number = typename Lhs::Scalar;

    template <class Target>
    static void scaleAndAddTo(Target& y, const Lhs& A, const Rhs& B, Number factor) {
        const FactorInMemory<Lhs> a(A);
        const FactorInMemory<Rhs> b(B);
        const Number weight = factor * a.scalar(A) * b.scalar(B);
        if constexpr (Lhs::IsVectorAtCompileTime)
            dynlab::add_product<Number>(b.matrix().transposed(), a.vector(), weight,
                                        {y.data(), y.size(), y.innerStride()});
        else
            dynlab::add_product<Number>(a.matrix(), b.vector(), weight, {y.data(), y.size(), y.innerStride()});
    }
};

}  // namespace Eigen::internal
