#include "numerics/filters/filter_products.h"

#include <algorithm>

#include "numerics/linalg/tall_gram.h"
#include "numerics/simulation/exact_filter.h"

namespace dynlab::inline numerics {

Matrix stored_products(Matrix& outputs, const std::vector<Index>& left, const std::vector<Index>& right,
                       const std::vector<OutputSum>& sums) {
    const Index last = outputs.cols() - 1;
    Index place = outputs.cols() - static_cast<Index>(sums.size());
    for (const OutputSum& sum : sums) {
        outputs.col(place).setZero();
        for (const OutputSum::Term& term : sum.terms) outputs.col(place) += term.weight * outputs.col(term.output);
        ++place;
    }
    const Matrix gram = tall_gram(outputs.leftCols(last), outputs.col(last));
    Matrix products(left.size(), right.size());
    for (Index i = 0; i < products.rows(); ++i)
        for (Index j = 0; j < products.cols(); ++j)
            products(i, j) = gram(left[static_cast<std::size_t>(i)], right[static_cast<std::size_t>(j)]);
    return products;
}

Matrix filter_products(const std::vector<FilteredSignal>& signals, const std::vector<Index>& left,
                       const std::vector<Index>& right, const std::vector<OutputSum>& sums) {
    constexpr Index kPiece = 2048;  // samples of which the outputs stay in the processor's cache
    const Index N = signals.front().signal.size();
    std::vector<ExactFilter> filters;
    std::vector<Vector> states;
    Index count = static_cast<Index>(sums.size());
    for (const FilteredSignal& signal : signals) {
        filters.emplace_back(signal.system);
        states.push_back(Vector::Zero(filters.back().order()));
        count += filters.back().output_count();
    }
    Matrix total = Matrix::Zero(left.size(), right.size()), outputs(0, count);
    for (Index from = 0; from < N; from += kPiece) {
        if (const Index rows = std::min(kPiece, N - from); rows != outputs.rows()) outputs.resize(rows, count);
        Index place = 0;
        for (std::size_t i = 0; i < signals.size(); ++i) {
            const Index own = filters[i].output_count();
            filters[i].advance(signals[i].signal, from, states[i], outputs.middleCols(place, own));
            place += own;
        }
        total += stored_products(outputs, left, right, sums);
    }
    return total;
}

}  // namespace dynlab::inline numerics
