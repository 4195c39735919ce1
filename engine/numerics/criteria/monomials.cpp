#include "numerics/criteria/monomials.h"

#include <algorithm>

#include "numerics/error.h"

namespace dynlab::inline numerics {

namespace {

constexpr int kMaxDegree = 9;
constexpr std::size_t kMaxMonomials = 2000;

}  // namespace

Monomials::Monomials(const std::string& caller, Index variables, int degree) : factors_{{}}, rest_{0} {
    if (degree < 0 || degree > kMaxDegree)
        throw InvalidArgument("{}: {} must be between 0 and {}, but is {}", caller, OptionName{"degree"}, kMaxDegree,
                              degree);
    std::size_t lower = 0;  // where those of the degree before begin
    for (int d = 1; d <= degree; ++d) {
        const std::size_t end = factors_.size();
        for (Index first = 0; first < variables; ++first) {
            for (std::size_t i = lower; i < end; ++i) {
                if (!factors_[i].empty() && factors_[i].front() < first) continue;
                std::vector<Index> factors{first};
                factors.insert(factors.end(), factors_[i].begin(), factors_[i].end());
                factors_.push_back(std::move(factors));
                rest_.push_back(static_cast<Index>(i));
                if (factors_.size() > kMaxMonomials)
                    throw InvalidArgument(
                        "{}: {} variables have more than {} monomials up to degree {}; use fewer lags or a lower "
                        "degree",
                        caller, variables, kMaxMonomials, degree);
            }
        }
        lower = end;
    }
}

double Monomials::value(Index monomial, const VectorView& z) const {
    double product = 1;
    for (const Index variable : factors_[static_cast<std::size_t>(monomial)]) product *= z[variable];
    return product;
}

Matrix Monomials::values(const MatrixView& Z) const {
    Matrix all(Z.rows(), count());
    all.col(0).setOnes();
    for (Index i = 1; i < count(); ++i) {
        const auto place = static_cast<std::size_t>(i);
        all.col(i) = Z.col(factors_[place].front()).cwiseProduct(all.col(rest_[place]));
    }
    return all;
}

std::string Monomials::text(Index monomial, const std::vector<std::string>& names) const {
    const std::vector<Index>& factors = factors_[static_cast<std::size_t>(monomial)];
    std::string text;
    for (auto factor = factors.begin(); factor != factors.end();) {
        const auto end = std::upper_bound(factor, factors.end(), *factor);
        text += (text.empty() ? "" : "*") + names[static_cast<std::size_t>(*factor)];
        if (end - factor > 1) text += "^" + std::to_string(end - factor);
        factor = end;
    }
    return text.empty() ? "1" : text;
}

}  // namespace dynlab::inline numerics
