#include "numerics/linalg/tall_gram.h"

#include <algorithm>
#include <array>
#include <vector>

namespace dynlab::inline numerics {

namespace {

constexpr Index kGramRows = 256, kGramTile = 4;  // rows in cache; columns of which all products are taken together
using EightRows = Eigen::Array<double, 8, 1>;
using GramTile = std::array<EightRows, kGramTile * kGramTile>;

/// Adds the products of kGramTile columns from `a` with those from `b`, each kGramRows long.
void add_tile(const double* a, const double* b, GramTile& sums) {
    GramTile parts = sums;
    for (Index k = 0; k < kGramRows; k += EightRows::RowsAtCompileTime) {
        std::array<EightRows, kGramTile> right;
        for (std::size_t j = 0; j < kGramTile; ++j)
            right[j] = EightRows::MapAligned(b + static_cast<Index>(j) * kGramRows + k);
        for (std::size_t i = 0; i < kGramTile; ++i) {
            const EightRows left = EightRows::MapAligned(a + static_cast<Index>(i) * kGramRows + k);
            for (std::size_t j = 0; j < kGramTile; ++j) parts[i * kGramTile + j] += left * right[j];
        }
    }
    sums = parts;
}

}  // namespace

Matrix tall_gram(const MatrixView& J, const VectorView& e) {
    const Index N = J.rows(), d = J.cols(), tiles = (d + kGramTile) / kGramTile;  // of d + 1 columns
    Matrix block = Matrix::Zero(kGramRows, tiles * kGramTile);
    GramTile none;
    none.fill(EightRows::Zero());
    std::vector<GramTile> sums(static_cast<std::size_t>(tiles * tiles), none);
    for (Index row = 0; row < N; row += kGramRows) {
        const Index rows = std::min(kGramRows, N - row);
        block.topLeftCorner(rows, d) = J.middleRows(row, rows);
        block.col(d).head(rows) = e.segment(row, rows);
        if (rows < kGramRows) block.bottomRows(kGramRows - rows).setZero();
        for (Index p = 0; p < tiles; ++p)
            for (Index q = p; q < tiles; ++q)
                add_tile(block.col(p * kGramTile).data(), block.col(q * kGramTile).data(),
                         sums[static_cast<std::size_t>(p * tiles + q)]);
    }
    Matrix gram(d + 1, d + 1);
    for (Index j = 0; j <= d; ++j)
        for (Index i = 0; i <= j; ++i) {
            const GramTile& tile = sums[static_cast<std::size_t>(i / kGramTile * tiles + j / kGramTile)];
            const auto place = static_cast<std::size_t>(i % kGramTile * kGramTile + j % kGramTile);
            gram(i, j) = gram(j, i) = tile[place].sum();
        }
    return gram;
}

}  // namespace dynlab::inline numerics
