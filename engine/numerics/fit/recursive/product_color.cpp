#include "numerics/fit/recursive/product_color.h"

#include "numerics/linalg/decompositions.h"

namespace dynlab::inline numerics {

Matrix color_ratio(const ProductSums& sums) {
    const Index d = sums.gram.rows();
    const Matrix none = Matrix::Identity(d, d);
    if (!(sums.blocks > 0 && sums.variance > 0) || !std::isfinite(sums.variance)) return none;
    const double complete = (sums.rows - sums.open) / sums.rows;
    const auto root = cholesky_root(sums.gram * (complete * sums.variance));
    if (!root) return none;
    const Matrix half = solve_by_lu(*root, sums.products).x;
    const Matrix whole = solve_by_lu(*root, half.transpose()).x;
    const double chance = static_cast<double>(d * (d + 1)) / sums.blocks;  // of |T - I|^2 with white errors
    const double believed = std::max(0.0, 1 - chance / (whole - none).squaredNorm());
    return none + believed * (whole - none);
}

}  // namespace dynlab::inline numerics
