#include "numerics/signals/lagged_gram.h"

#include "numerics/signals/correlation.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kLargestLoss = 0.1;  // of a sum of squares that may cancel on the way from lag to lag

/// sum_k s(k - lag) over the rows.
struct RowRange {
    Index first, count;
    double product(const LaggedColumns& a, Index i, const LaggedColumns& b, Index j) const {
        const Index late_a = a.first_lag + i, late_b = b.first_lag + j;
        return a.signal.segment(first - late_a, count).dot(b.signal.segment(first - late_b, count));
    }
};

/// Products of a's first column with all columns of b.
Vector first_products(const LaggedColumns& a, const LaggedColumns& b, const RowRange& rows) {
    const Index start = rows.first - b.first_lag;
    return products_behind(a.signal.segment(rows.first - a.first_lag, rows.count), b.signal.data() + start,
                           b.count - 1);
}

/// The products of all columns of two signals, a.count x b.count.
Matrix pair_products(const LaggedColumns& a, const LaggedColumns& b, const RowRange& rows) {
    Matrix G(a.count, b.count);
    G.row(0) = first_products(a, b, rows).transpose();
    G.col(0) = first_products(b, a, rows);
    const Index end = rows.first + rows.count - 1;
    for (Index i = 1; i < a.count; ++i)
        for (Index j = 1; j < b.count; ++j) {
            const Index late_a = a.first_lag + i, late_b = b.first_lag + j;
            G(i, j) = G(i - 1, j - 1) + a.signal[rows.first - late_a] * b.signal[rows.first - late_b] -
                      a.signal[end + 1 - late_a] * b.signal[end + 1 - late_b];
        }
    return G;
}

/// Whether the squares of a signal's columns stay of one size, so that nothing cancels between them.
bool keeps_its_size(const Matrix& own) {
    return own.diagonal().minCoeff() >= kLargestLoss * own.diagonal().maxCoeff();
}

Matrix products_one_by_one(const LaggedColumns& a, const LaggedColumns& b, const RowRange& rows) {
    Matrix G(a.count, b.count);
    for (Index i = 0; i < a.count; ++i)
        for (Index j = 0; j < b.count; ++j) G(i, j) = rows.product(a, i, b, j);
    return G;
}

}  // namespace

Matrix lagged_gram(const std::vector<LaggedColumns>& columns, Index first, Index rows) {
    Index total = 0;
    for (const LaggedColumns& one : columns) total += one.count;
    Matrix gram = Matrix::Zero(total, total);
    if (rows <= 0) return gram;
    const RowRange range{first, rows};
    std::vector<bool> steady;
    for (const LaggedColumns& one : columns)
        steady.push_back(one.count > 0 && keeps_its_size(pair_products(one, one, range)));
    Index row = 0;
    for (std::size_t a = 0; a < columns.size(); ++a) {
        Index column = row;
        for (std::size_t b = a; b < columns.size(); ++b) {
            const LaggedColumns &left = columns[a], &right = columns[b];
            if (left.count > 0 && right.count > 0) {
                const Matrix G = left.weight * right.weight *
                                 (steady[a] && steady[b] ? pair_products(left, right, range)
                                                         : products_one_by_one(left, right, range));
                gram.block(row, column, left.count, right.count) = G;
                gram.block(column, row, right.count, left.count) = G.transpose();
            }
            column += right.count;
        }
        row += columns[a].count;
    }
    return gram;
}

}  // namespace dynlab::inline numerics
