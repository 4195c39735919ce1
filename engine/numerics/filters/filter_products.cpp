#include "numerics/filters/filter_products.h"

#include <algorithm>

#include "numerics/filters/lane_filter.h"
#include "numerics/filters/sampled_recursion.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kShortestSegment = 8;
constexpr int kTile = 4;
using Columns = std::vector<const Lanes*>;

/// The products of two sets of columns, tile by tile, so that the sums of a tile stay in registers over a block.
class ProductSums {
  public:
    ProductSums(std::size_t rows, std::size_t columns, bool symmetric)
        : rows_(rows), columns_(columns), symmetric_(symmetric), sums_(rows * columns) {}

    void add(const Columns& left, const Columns& right, Index steps) {
        for (std::size_t i = 0; i < rows_; i += kTile)
            for (std::size_t j = symmetric_ ? i : 0; j < columns_; j += kTile)
                add_tile_of(static_cast<int>(std::min<std::size_t>(kTile, rows_ - i)),
                            static_cast<int>(std::min<std::size_t>(kTile, columns_ - j)), left.data() + i,
                            right.data() + j, steps, i * columns_ + j, symmetric_ && i == j);
    }

    Matrix total() const {
        Matrix result(rows_, columns_);
        for (std::size_t i = 0; i < rows_; ++i)
            for (std::size_t j = 0; j < columns_; ++j)
                result(static_cast<Index>(i), static_cast<Index>(j)) =
                    (symmetric_ && j < i ? sums_[j * columns_ + i] : sums_[i * columns_ + j]).sum();
        return result;
    }

  private:
    /// The tile of so many rows and columns whose first sum stands at `place`.
    void add_tile_of(int rows, int columns, const Lanes* const* left, const Lanes* const* right, Index steps,
                     std::size_t place, bool diagonal) {
        const auto try_size = [&](auto r, auto c) {
            if (rows != r || columns != c) return;
            if constexpr (r == c)
                if (diagonal) return add_tile<r, c, true>(left, right, steps, place);
            add_tile<r, c, false>(left, right, steps, place);
        };
        const auto try_columns = [&](auto r) {
            try_size(r, std::integral_constant<int, 1>());
            try_size(r, std::integral_constant<int, 2>());
            try_size(r, std::integral_constant<int, 3>());
            try_size(r, std::integral_constant<int, 4>());
        };
        try_columns(std::integral_constant<int, 1>());
        try_columns(std::integral_constant<int, 2>());
        try_columns(std::integral_constant<int, 3>());
        try_columns(std::integral_constant<int, 4>());
    }

    template <int kRows, int kColumns, bool kDiagonal>
    void add_tile(const Lanes* const* left, const Lanes* const* right, Index steps, std::size_t place) {
        const Lanes *rows[kRows], *columns[kColumns];
        std::copy_n(left, kRows, rows);
        std::copy_n(right, kColumns, columns);
        for (int part = 0; part < Lanes::kParts; ++part) {
            Lanes::Part tile[kRows][kColumns] = {};
            for (Index k = 0; k < steps; ++k)
                repeat<kRows>([&](auto r) {
                    const Lanes::Part x = rows[r][k].part(part);
                    repeat<kColumns>([&](auto c) {
                        if constexpr (!kDiagonal || c >= r) tile[r][c] += x * columns[c][k].part(part);
                    });
                });
            repeat<kRows>([&](auto r) {
                repeat<kColumns>([&](auto c) { sums_[place + r * columns_ + c].part(part) += tile[r][c]; });
            });
        }
    }

    std::size_t rows_, columns_;
    bool symmetric_;
    std::vector<Lanes> sums_;
};

/// The block's columns of all outputs, in order, and of the sums, which it makes.
class BlockColumns {
  public:
    BlockColumns(const std::vector<LaneFilter>& filters, const std::vector<FilteredSignal>& signals,
                 const std::vector<OutputSum>& sums)
        : sums_(sums), storage_(sums.size() * LaneFilter::kBlock) {
        for (std::size_t i = 0; i < filters.size(); ++i)
            for (Index j = 0; j < signals[i].system.C.rows(); ++j) columns_.push_back(filters[i].column(j));
        for (std::size_t i = 0; i < sums.size(); ++i) columns_.push_back(storage_.data() + i * LaneFilter::kBlock);
    }
    Columns of(const std::vector<Index>& outputs) const {
        Columns chosen;
        for (const Index output : outputs) chosen.push_back(columns_[static_cast<std::size_t>(output)]);
        return chosen;
    }
    void make_sums(Index steps) {
        for (std::size_t i = 0; i < sums_.size(); ++i) {
            Lanes* const sum = storage_.data() + i * LaneFilter::kBlock;
            std::fill_n(sum, steps, Lanes());
            for (const OutputSum::Term& term : sums_[i].terms) {
                const Lanes* const x = columns_[static_cast<std::size_t>(term.output)];
                for (Index k = 0; k < steps; ++k) sum[k].add(term.weight, x[k]);
            }
        }
    }

  private:
    const std::vector<OutputSum>& sums_;
    std::vector<Lanes> storage_;
    Columns columns_;
};

Matrix lane_products(std::vector<LaneFilter>& filters, const std::vector<FilteredSignal>& signals,
                     const std::vector<Index>& left, const std::vector<Index>& right,
                     const std::vector<OutputSum>& sums, Index segment) {
    BlockColumns columns(filters, signals, sums);
    const Columns left_columns = columns.of(left), right_columns = columns.of(right);
    ProductSums products(left.size(), right.size(), left == right);
    for (Index done = 0; done < segment; done += LaneFilter::kBlock) {
        const Index steps = std::min(LaneFilter::kBlock, segment - done);
        for (LaneFilter& filter : filters) filter.advance(steps);
        columns.make_sums(steps);
        products.add(left_columns, right_columns, steps);
    }
    return products.total();
}

}  // namespace

Matrix filter_products(const std::vector<FilteredSignal>& signals, const std::vector<Index>& left,
                       const std::vector<Index>& right, const std::vector<OutputSum>& sums) {
    const Index N = signals.front().signal.size();
    Index latest = 0;
    for (const FilteredSignal& signal : signals) latest = std::max(latest, signal.system.delay);
    SampleProducts samples(signals, left, right, sums);
    // The last sample is left out of the lanes, which look one sample ahead.
    const Index segment = std::max<Index>(0, N - latest - 2) / Lanes::kCount;
    if (segment < kShortestSegment) {
        samples.run(0, N);
        return samples.total();
    }
    const Index first = N - 1 - Lanes::kCount * segment;
    samples.run(0, first);
    std::vector<LaneFilter> filters;
    filters.reserve(signals.size());
    for (std::size_t i = 0; i < signals.size(); ++i)
        filters.emplace_back(signals[i], first, segment, samples.recursion(i).state());
    const Matrix inside = lane_products(filters, signals, left, right, sums, segment);
    for (std::size_t i = 0; i < signals.size(); ++i) samples.recursion(i).set_state(filters[i].last_state());
    samples.run(N - 1, N);
    return samples.total() + inside;
}

}  // namespace dynlab::inline numerics
