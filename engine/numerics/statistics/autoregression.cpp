#include "numerics/statistics/autoregression.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "numerics/error.h"

namespace dynlab::inline numerics {

namespace {

void check_autoregression(Index count, const std::vector<Index>& lengths) {
    if (std::accumulate(lengths.begin(), lengths.end(), Index{0}) != count)
        throw InvalidArgument("The lengths of the experiments of an autoregressive model must add up to the {} samples",
                              count);
}

/// Errors of prediction forwards and backwards, which Burg's method makes smaller together, order by order.
class BurgLattice {
  public:
    BurgLattice(const VectorView& e, const std::vector<Index>& lengths)
        : lengths_(lengths), forward_(e), backward_(e) {}

    /// The reflection coefficient of the next order, |k| < 1; the errors are those of that order afterwards.
    double next() {
        ++order_;
        double products = 0, squares = 0;
        for_each_experiment([&](auto&& f, auto&& b) {
            products += f.dot(b);
            squares += f.squaredNorm() + b.squaredNorm();
        });
        const double reflection = squares > 0 ? -2 * products / squares : 0;
        for_each_experiment([&](auto&& f, auto&& b) {
            const Vector before = f;
            f += reflection * b;
            b += reflection * before;
        });
        return reflection;
    }

  private:
    /// f(k) and b(k-1) for k = order .. length-1 of each experiment. b(k-1) is stored at k - order, so that the errors
    /// of every order begin at the front.
    template <class Work>
    void for_each_experiment(const Work& work) {
        Index first = 0;
        for (const Index length : lengths_) {
            const Index rest = length - order_;
            if (rest > 0) work(forward_.segment(first + order_, rest), backward_.segment(first, rest));
            first += length;
        }
    }

    const std::vector<Index>& lengths_;
    Vector forward_, backward_;
    Index order_ = 0;
};

/// The predictor of the next order (Levinson's step).
Vector with_reflection(const Vector& a, double reflection) {
    const Index p = a.size();
    Vector next(p + 1);
    next.head(p) = a + reflection * a.reverse();
    next[p] = reflection;
    return next;
}

/// The predictor of the k-th value of an experiment: of a lower order while fewer values precede it.
const Vector& predictor_at(const Autoregression& model, Index k) {
    return model.predictors[static_cast<std::size_t>(std::min(k, model.order()))];
}

/// What the chosen order makes smallest.
double order_criterion(AutoregressiveOrder choice, double N, double order, double variance) {
    switch (choice) {
        case AutoregressiveOrder::kAicc:
            return N * std::log(variance) + 2 * order * N / (N - order - 2);
        case AutoregressiveOrder::kBic:
            return N * std::log(variance) + order * std::log(N);
        case AutoregressiveOrder::kMaxInteger:
            return -order;
    }
    return 0;
}

}  // namespace

Vector Autoregression::filter() const {
    Vector all = Vector::Ones(order() + 1);
    all.tail(order()) = predictors.back();
    return all;
}

Index highest_autoregressive_order(Index N) {
    return N < 2 ? 0 : static_cast<Index>(20 * std::log10(static_cast<double>(N)));
}

Autoregression fit_autoregression(const VectorView& e, const std::vector<Index>& lengths, Index max_order,
                                  AutoregressiveOrder choice) {
    check_autoregression(e.size(), lengths);
    if (!e.allFinite()) throw InvalidArgument("An autoregressive model needs a signal in which all samples are finite");
    const double N = static_cast<double>(e.size());
    Autoregression model{{Vector()}, e.size() > 0 ? e.squaredNorm() / N : 0};
    if (model.variance == 0) return model;
    const Index longest = *std::max_element(lengths.begin(), lengths.end());
    const Index highest =
        choice == AutoregressiveOrder::kMaxInteger ? max_order : std::min(max_order, (longest - 1) / 4);
    double least = order_criterion(choice, N, 0, model.variance), variance = model.variance;
    std::size_t chosen = 0;
    BurgLattice lattice(e, lengths);
    for (Index p = 1; p <= highest; ++p) {
        const double reflection = lattice.next();
        variance *= 1 - reflection * reflection;
        if (!(variance > std::numeric_limits<double>::min())) break;
        model.predictors.push_back(with_reflection(model.predictors.back(), reflection));
        const double criterion = order_criterion(choice, N, static_cast<double>(p), variance);
        if (criterion < least) {
            least = criterion;
            chosen = static_cast<std::size_t>(p);
            model.variance = variance;
        }
    }
    model.predictors.resize(chosen + 1);
    return model;
}

Vector filtered_past(const Autoregression& model, const VectorView& x) {
    const Index p = model.order(), count = x.size() - p;
    Vector w = x.tail(count);
    for (Index i = 0; i < p; ++i) w += model.predictors.back()[i] * x.segment(p - 1 - i, count);
    return w;
}

Vector whitened(const Autoregression& model, const VectorView& e, const std::vector<Index>& lengths) {
    check_autoregression(e.size(), lengths);
    Vector w = e;
    Index first = 0;
    for (const Index length : lengths) {
        const Index early = std::min(length, model.order());
        for (Index k = 1; k < early; ++k) w[first + k] += predictor_at(model, k).dot(e.segment(first, k).reverse());
        if (length > early) w.segment(first + early, length - early) = filtered_past(model, e.segment(first, length));
        first += length;
    }
    return w;
}

Matrix colored_backwards(const Autoregression& model, const MatrixView& Z, const std::vector<Index>& lengths) {
    check_autoregression(Z.rows(), lengths);
    if (model.order() == 0) return Z;
    // One row an instant, so that the columns are worked on side by side.
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> X = Z;
    Index first = 0;
    for (const Index length : lengths) {
        for (Index k = length - 1; k > 0; --k) {
            const Vector& a = predictor_at(model, k);
            for (Index i = 0; i < a.size(); ++i) X.row(first + k - 1 - i) -= a[i] * X.row(first + k);
        }
        first += length;
    }
    return X;
}

}  // namespace dynlab::inline numerics
