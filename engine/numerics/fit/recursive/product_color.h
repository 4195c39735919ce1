#pragma once
#include <algorithm>
#include <cmath>

#include "numerics/fit/recursive/small_equations.h"
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// Sums over the rows of d instruments z and errors e.
struct ProductSums {
    Matrix gram, products;  ///< of z, and of the blocks' sums of z e: d x d
    double rows = 0, blocks = 0;
    double variance = 0;  ///< of e
    double open = 0;      ///< rows of the block that is not complete: products are of complete ones
};

/// T as ProductColor::ratio has it.
Matrix color_ratio(const ProductSums& sums);

/// How the products z(k) e(k) of instruments and errors add up if the errors are colored, at constant cost a sample.
/// The products are summed within blocks of samples, and the squares of the sums are compared with those of white
/// errors of the same size (batch means; the blocks must outlast the errors' memory, and grow with the cube root of the
/// data's length). Only the last half to three quarters of the samples count, all with the same weight: the first
/// errors belong to a theta that is still imprecise, and a forgetting that leaves few blocks could not show any color.
/// An estimate that forgets follows the noise, which shortens the sums of a block of L samples: by (1 - w^L)/(L (1 -
/// w)) for white errors in the scalar case, where e is w times the change of a first-order lag. The sums are compared
/// with this shortened value.
template <std::size_t kMax>
class ProductColor {
  public:
    /// `block`: samples, above zero.
    explicit ProductColor(double block) : min_length_(block), length_(block) {}

    /// The weights of all samples before were multiplied by `weight`.
    void add(const SmallRow<kMax>& z, double error, std::size_t d, double weight) {
        for (std::size_t i = 0; i < d; ++i) {
            block_[i] += z[i] * error;
            for (std::size_t j = i; j < d; ++j) now_.gram[i][j] += z[i] * z[j];
        }
        now_.squares += error * error;
        now_.rows += 1;
        samples_ += 1;
        in_block_ += 1;
        block_weight_ = weight * block_weight_ + 1;
        if (in_block_ >= length_) close(d);
    }

    /// T with sum_kl z(k) z(l)' cov(e(k), e(l)) = variance R' T R, R upper triangular with sum_k z z' = R'R: the
    /// identity for white errors, and towards it T is drawn by as much as chance takes part in it (James and Stein).
    Matrix ratio(Index d) const {
        const double rows = now_.rows + earlier_.rows;
        ProductSums sums{
            Matrix(d, d), Matrix(d, d), rows, now_.blocks + earlier_.blocks, (now_.squares + earlier_.squares) / rows,
            in_block_};
        for (Index i = 0; i < d; ++i)
            for (Index j = 0; j < d; ++j) {
                const auto row = static_cast<std::size_t>(std::min(i, j)),
                           column = static_cast<std::size_t>(std::max(i, j));
                sums.gram(i, j) = now_.gram[row][column] + earlier_.gram[row][column];
                sums.products(i, j) = now_.products[row][column] + earlier_.products[row][column];
            }
        return color_ratio(sums);
    }

  private:
    static constexpr double kFewBlocks = 50;  // from here on blocks grow

    struct Sums {
        SmallMatrix<kMax> gram{}, products{};  // upper triangles
        double squares = 0, rows = 0, blocks = 0;
    };

    void close(std::size_t d) {
        const double shortened = block_weight_ / in_block_;
        for (std::size_t i = 0; i < d; ++i)
            for (std::size_t j = i; j < d; ++j) now_.products[i][j] += block_[i] * block_[j] / shortened;
        now_.blocks += 1;
        block_ = {};
        in_block_ = block_weight_ = 0;
        if (now_.blocks < 2 * earlier_.blocks) return;
        earlier_ = now_;
        now_ = {};
        length_ = min_length_ * std::max(1.0, std::cbrt(samples_ / (kFewBlocks * min_length_)));
    }

    double min_length_, length_, in_block_ = 0, block_weight_ = 0, samples_ = 0;
    SmallRow<kMax> block_{};
    Sums now_, earlier_;
};

}  // namespace dynlab::inline numerics
