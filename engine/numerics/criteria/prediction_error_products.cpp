#include "numerics/criteria/prediction_error_products.h"

#include <algorithm>
#include <array>
#include <utility>

namespace dynlab::inline numerics {

namespace {

constexpr Index kColumnsTogether = 8, kRowsInCache = 256, kFactors = 4;
using EightColumns = Eigen::Array<double, kColumnsTogether, 1>;

/// Eight columns over a block of rows and the rows before it that filters look back at: as they come, and filtered.
struct ColumnPack {
    Eigen::Array<double, kColumnsTogether, Eigen::Dynamic> raw, out;

    explicit ColumnPack(Index rows) : raw(decltype(raw)::Zero(kColumnsTogether, rows)), out(raw) {}

    /// out = raw D/C, row by row from `first` on; the first `silent` of them stay zero.
    void filter(const Vector& C, const Vector& D, Index first, Index rows, Index silent) {
        out.middleCols(first, std::min(silent, rows)).setZero();
        if (silent >= rows) return;
        const Index nc = C.size() - 1, nd = D.size() - 1;
        if (nc > kSizedOrder || nd > kSizedOrder)
            filter_any(C, D, first + silent, first + rows);
        else
            filter_by_order(C, D, first + silent, first + rows, std::make_index_sequence<kOrderPairs>());
    }

    void keep(Index past, Index rows) {
        raw.leftCols(past) = raw.middleCols(rows, past).eval();
        out.leftCols(past) = out.middleCols(rows, past).eval();
    }

  private:
    static constexpr int kSizedOrder = 3;
    static constexpr std::size_t kOrderPairs = (kSizedOrder + 1) * (kSizedOrder + 1);

    void filter_any(const Vector& C, const Vector& D, Index first, Index end) {
        for (Index k = first; k < end; ++k) {
            EightColumns z = raw.col(k);
            for (Index i = 1; i < D.size(); ++i) z += D[i] * raw.col(k - i);
            for (Index j = 1; j < C.size(); ++j) z -= C[j] * out.col(k - j);
            out.col(k) = z;
        }
    }

    /// The rows before stay in registers; what depends on the last one comes last.
    template <std::size_t nc, std::size_t nd>
    void filter_sized(const Vector& C, const Vector& D, Index first, Index end) {
        std::array<EightColumns, nc> past_out, c;
        std::array<EightColumns, nd> past_raw, d;
        for (std::size_t j = 0; j < nc; ++j) {
            const auto lag = static_cast<Index>(j) + 1;
            past_out[j] = out.col(first - lag);
            c[j] = EightColumns::Constant(C[lag]);
        }
        for (std::size_t i = 0; i < nd; ++i) {
            const auto lag = static_cast<Index>(i) + 1;
            past_raw[i] = raw.col(first - lag);
            d[i] = EightColumns::Constant(D[lag]);
        }
        for (Index k = first; k < end; ++k) {
            const EightColumns x = raw.col(k);
            EightColumns z = x;
            for (std::size_t i = 0; i < nd; ++i) z += d[i] * past_raw[i];
            for (std::size_t j = nc; j-- > 0;) z -= c[j] * past_out[j];
            for (std::size_t j = nc; j-- > 1;) past_out[j] = past_out[j - 1];
            for (std::size_t i = nd; i-- > 1;) past_raw[i] = past_raw[i - 1];
            if constexpr (nc > 0) past_out[0] = z;
            if constexpr (nd > 0) past_raw[0] = x;
            out.col(k) = z;
        }
    }

    template <std::size_t... pair>
    void filter_by_order(const Vector& C, const Vector& D, Index first, Index end, std::index_sequence<pair...>) {
        const auto requested = static_cast<std::size_t>((C.size() - 1) * (kSizedOrder + 1) + D.size() - 1);
        ((pair == requested ? filter_sized<pair / (kSizedOrder + 1), pair % (kSizedOrder + 1)>(C, D, first, end)
                            : void()),
         ...);
    }
};

/// Sums of products of `used` columns of one pack with all of another.
void add_products(const ColumnPack& a, Index used, const ColumnPack& b, Index first, Index rows,
                  Eigen::Ref<Matrix> sums) {
    for (Index i = 0; i < used; i += kFactors) {
        std::array<EightColumns, 2 * kFactors> parts;
        parts.fill(EightColumns::Zero());
        Index k = first;
        for (; k + 2 <= first + rows; k += 2) {
            const EightColumns even = b.out.col(k), odd = b.out.col(k + 1);
            for (Index j = 0; j < kFactors; ++j) {
                parts[static_cast<std::size_t>(j)] += a.out(i + j, k) * even;
                parts[static_cast<std::size_t>(j + kFactors)] += a.out(i + j, k + 1) * odd;
            }
        }
        for (; k < first + rows; ++k)
            for (Index j = 0; j < kFactors; ++j) parts[static_cast<std::size_t>(j)] += a.out(i + j, k) * b.out.col(k);
        for (Index j = 0; j < kFactors; ++j)
            sums.row(i + j) += (parts[static_cast<std::size_t>(j)] + parts[static_cast<std::size_t>(j + kFactors)])
                                   .matrix()
                                   .transpose();
    }
}

class FilteredColumns {
  public:
    FilteredColumns(const std::vector<LateColumn>& columns, const LateColumn& error, const Vector& C, const Vector& D)
        : columns_(columns), error_(error), C_(C), D_(D), past_(std::max<Index>({C.size() - 1, D.size() - 1, 3})) {
        const Index lanes = round_up(driven()) + round_up(noise());
        packs_.assign(static_cast<std::size_t>(lanes / kColumnsTogether), ColumnPack(past_ + block()));
        sums_ = Matrix::Zero(lanes, lanes);
    }

    Matrix run(Index first, Index rows) {
        for (Index row = 0; row < rows; row += block()) {
            const Index count = std::min(block(), rows - row), silent = std::clamp<Index>(nd() - row, 0, count);
            fill_driven(first + row, count);
            for (Index p = 0; p < driven_packs(); ++p) pack(p).filter(C_, D_, past_, count, silent);
            fill_noise(count, silent);
            for (Index p = driven_packs(); p < pack_count(); ++p)
                pack(p).filter(C_, Vector::Ones(1), past_, count, silent);
            add(past_ + silent, count - silent);
            for (ColumnPack& one : packs_) one.keep(past_, count);
        }
        return in_order();
    }

  private:
    static Index round_up(Index columns) {
        return (columns + kColumnsTogether - 1) / kColumnsTogether * kColumnsTogether;
    }
    Index block() const { return std::max(kRowsInCache, past_); }
    Index nc() const { return C_.size() - 1; }
    Index nd() const { return D_.size() - 1; }
    Index driven() const { return static_cast<Index>(columns_.size()) + 1; }
    Index noise() const { return nc() + nd(); }
    Index driven_packs() const { return round_up(driven()) / kColumnsTogether; }
    Index pack_count() const { return static_cast<Index>(packs_.size()); }
    ColumnPack& pack(Index p) { return packs_[static_cast<std::size_t>(p)]; }

    void fill_driven(Index sample, Index count) {
        for (Index c = 0; c < driven(); ++c) {
            const LateColumn& column = c + 1 < driven() ? columns_[static_cast<std::size_t>(c)] : error_;
            auto lane = pack(c / kColumnsTogether).raw.row(c % kColumnsTogether);
            const Index unknown = std::clamp<Index>(column.late - sample, 0, count);
            lane.segment(past_, unknown).setConstant(column.constant);
            const double* signal = column.signal.data() + (sample + unknown - column.late);
            for (Index k = 0; k < count - unknown; ++k)
                lane[past_ + unknown + k] = column.weight * signal[k] + column.constant;
        }
    }

    void fill_noise(Index count, Index silent) {
        const Index e = driven() - 1;
        const ColumnPack& source = pack(e / kColumnsTogether);
        for (Index c = 0; c < noise(); ++c) {
            ColumnPack& target = pack(driven_packs() + c / kColumnsTogether);
            const Index lag = c < nc() ? c + 1 : c - nc() + 1;
            for (Index k = past_ + silent; k < past_ + count; ++k)
                target.raw(c % kColumnsTogether, k) =
                    c < nc() ? source.out(e % kColumnsTogether, k - lag) : -source.raw(e % kColumnsTogether, k - lag);
        }
    }

    Index used(Index p) const {
        const Index all =
            p < driven_packs() ? driven() - p * kColumnsTogether : noise() - (p - driven_packs()) * kColumnsTogether;
        return std::min(all, kColumnsTogether);
    }

    void add(Index first, Index rows) {
        if (rows <= 0) return;
        for (Index p = 0; p < pack_count(); ++p)
            for (Index q = p; q < pack_count(); ++q)
                add_products(
                    pack(p), used(p), pack(q), first, rows,
                    sums_.block(p * kColumnsTogether, q * kColumnsTogether, kColumnsTogether, kColumnsTogether));
    }

    /// Without the empty lanes, both triangles.
    Matrix in_order() const {
        std::vector<Index> lanes;
        for (Index c = 0; c < driven(); ++c) lanes.push_back(c);
        for (Index c = 0; c < noise(); ++c) lanes.push_back(driven_packs() * kColumnsTogether + c);
        const Matrix upper = sums_(lanes, lanes);
        return upper.selfadjointView<Eigen::Upper>();
    }

    const std::vector<LateColumn>& columns_;
    const LateColumn& error_;
    const Vector &C_, &D_;
    Index past_;  // rows before a block that are kept
    std::vector<ColumnPack> packs_;
    Matrix sums_;
};

}  // namespace

Matrix prediction_error_products(const std::vector<LateColumn>& columns, const LateColumn& error, Index first,
                                 Index rows, const Vector& C, const Vector& D) {
    return FilteredColumns(columns, error, C, D).run(first, rows);
}

Matrix prediction_error_products(const std::vector<LateColumn>& columns, const LateColumn& error, Index first,
                                 Index rows) {
    const Vector one = Vector::Ones(1);
    return prediction_error_products(columns, error, first, rows, one, one);
}

void add_to(OutputErrorProducts& sums, const Matrix& products, const std::vector<Index>& places) {
    const auto count = static_cast<Index>(places.size());
    for (Index i = 0; i < count; ++i)
        for (Index j = 0; j < count; ++j) {
            const Index row = places[static_cast<std::size_t>(i)], column = places[static_cast<std::size_t>(j)];
            if (row < 0 && column < 0)
                sums.squares += products(i, j);
            else if (column < 0)
                sums.descent[row] += products(i, j);
            else if (row >= 0)
                sums.gram(row, column) += products(i, j);
        }
}

}  // namespace dynlab::inline numerics
