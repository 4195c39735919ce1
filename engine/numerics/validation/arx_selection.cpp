#include "numerics/validation/arx_selection.h"

#include <algorithm>

#include "numerics/error.h"
#include "numerics/fit/equation_error.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/validation/fit_measures.h"

namespace dynlab::inline numerics {
namespace {

constexpr int kMaxArxStructures = 2000;
constexpr double kNegligibleIncrease = 1.01;  // of a loss: not worth parameters

/// As a script writes it: a number, or {from, to}.
std::string range_text(std::pair<int, int> range) {
    const std::string first = std::to_string(range.first);
    return range.first == range.second ? first : "{" + first + ", " + std::to_string(range.second) + "}";
}

void check_range(const char* name, std::pair<int, int> range, int least) {
    if (range.first < least || range.second < range.first)
        throw InvalidArgument(
            "{} must be a number or a range {from, to} with from <= to, starting at {} or higher, but it is {}", name,
            least, range_text(range));
}

void check_ranges(const ArxRanges& ranges) {
    check_range("na", ranges.na, 0);
    check_range("nb", ranges.nb, 1);
    check_range("nk", ranges.nk, 0);
    const auto length = [](std::pair<int, int> range) { return 1.0 + range.second - range.first; };
    if (length(ranges.na) * length(ranges.nb) * length(ranges.nk) > kMaxArxStructures)
        throw InvalidArgument("more than {} structures would be tried: use smaller ranges", kMaxArxStructures);
}

/// The equations of the largest structure for one data set: those of every other structure are columns of them.
struct LargestEquations {
    LargestEquations(const IdData& data, const ArxRanges& ranges) : na(ranges.na.second), nk(ranges.nk.first) {
        if (data.input_count() != 1)
            throw InvalidArgument("arxstruc: the data must have one input, but they have {}; select one",
                                  data.input_count());
        const int lags = ranges.nk.second + ranges.nb.second - nk;
        const auto orders = PolynomialOrders::arx(na, {lags}, {nk});
        check_equation_error("arxstruc", data, orders);
        const ArxEquations equations(data, orders);
        count = equations.count();
        R = equations.triangular_factor();
    }

    Matrix regressors(const ArxCandidate& structure) const {
        Matrix columns(R.rows(), structure.parameters());
        columns << R.leftCols(structure.na), R.middleCols(na + structure.nk - nk, structure.nb);
        return columns;
    }
    Vector output() const { return R.col(R.cols() - 1); }

    int na, nk;
    Index count = 0;
    Matrix R;
};

void estimate_arx_structure(ArxCandidate& candidate, const LargestEquations& equations,
                            const LargestEquations* validation) {
    const LeastSquares fit = solve_least_squares(equations.regressors(candidate), equations.output());
    candidate.determined = fit.rank == candidate.parameters();
    candidate.loss = fit.residuals.squaredNorm() / static_cast<double>(equations.count);
    const auto criteria = information_criteria(candidate.loss, equations.count, candidate.parameters());
    candidate.aic = criteria.aic;
    candidate.bic = criteria.bic;
    if (validation == nullptr) return;
    const Vector errors = validation->output() - validation->regressors(candidate) * fit.solution;
    candidate.validation_loss = errors.squaredNorm() / static_cast<double>(validation->count);
}

std::string orders_text(const ArxCandidate& candidate) {
    return "{" + std::to_string(candidate.na) + ", " + std::to_string(candidate.nb) + ", " +
           std::to_string(candidate.nk) + "}";
}

/// Suggests a smaller structure that is only slightly worse, if the loss alone was the criterion.
std::optional<Message> simpler_arx(const ArxSelection& selection, std::size_t chosen) {
    const ArxCandidate *taken = &selection.candidates[chosen], *simplest = taken;
    for (const ArxCandidate& one : selection.candidates)
        if (one.determined && one.parameters() < simplest->parameters() &&
            one.comparison_loss() <= kNegligibleIncrease * taken->comparison_loss())
            simplest = &one;
    if (simplest == taken) return std::nullopt;
    return plural(simplest->parameters(), "With {} parameter instead of {}, {} has a loss that is at most 1 % larger.",
                  "With {} parameters instead of {}, {} has a loss that is at most 1 % larger.", taken->parameters(),
                  orders_text(*simplest));
}

Message reason_of(const std::string& orders, ArxCriterion criterion, bool validated) {
    switch (criterion) {
        case ArxCriterion::kAic:
            return Message("{na, nb, nk} = {} has the smallest AIC.", orders);
        case ArxCriterion::kBic:
            return Message("{na, nb, nk} = {} has the smallest BIC.", orders);
        case ArxCriterion::kLoss:
            break;
    }
    return validated ? Message("{na, nb, nk} = {} has the smallest loss on the validation data.", orders)
                     : Message("{na, nb, nk} = {} has the smallest loss.", orders);
}

}  // namespace

ArxSelection select_arx(const IdData& data, const ArxRanges& ranges, const IdData* validation) {
    check_ranges(ranges);
    const LargestEquations equations(data, ranges);
    std::optional<LargestEquations> unseen;
    if (validation != nullptr) unseen.emplace(*validation, ranges);
    ArxSelection selection{{}, equations.count, validation != nullptr};
    for (int na = ranges.na.first; na <= ranges.na.second; ++na)
        for (int nb = ranges.nb.first; nb <= ranges.nb.second; ++nb)
            for (int nk = ranges.nk.first; nk <= ranges.nk.second; ++nk) {
                ArxCandidate candidate;
                candidate.na = na;
                candidate.nb = nb;
                candidate.nk = nk;
                estimate_arx_structure(candidate, equations, unseen ? &*unseen : nullptr);
                selection.candidates.push_back(candidate);
            }
    return selection;
}

double criterion_value(const ArxCandidate& candidate, ArxCriterion criterion) {
    switch (criterion) {
        case ArxCriterion::kAic:
            return candidate.aic;
        case ArxCriterion::kBic:
            return candidate.bic;
        case ArxCriterion::kLoss:
            break;
    }
    return candidate.comparison_loss();
}

OrderChoice choose_arx(const ArxSelection& selection, ArxCriterion criterion) {
    const auto best = std::min_element(selection.candidates.begin(), selection.candidates.end(),
                                       [&](const ArxCandidate& one, const ArxCandidate& other) {
                                           if (one.determined != other.determined) return one.determined;
                                           return criterion_value(one, criterion) < criterion_value(other, criterion);
                                       });
    const auto place = static_cast<std::size_t>(best - selection.candidates.begin());
    std::vector<Message> explanation{reason_of(orders_text(*best), criterion, selection.validated)};
    if (criterion != ArxCriterion::kLoss) return {place, sentences(explanation)};
    if (!selection.validated)
        explanation.push_back(
            Message("On the estimation data, the loss decreases with every additional parameter: specify validation "
                    "data, or select the orders by BIC."));
    if (const auto simpler = simpler_arx(selection, place)) explanation.push_back(*simpler);
    return {place, sentences(explanation)};
}

ArxCriterion usual_criterion(const ArxSelection& selection) {
    return selection.validated ? ArxCriterion::kLoss : ArxCriterion::kBic;
}

}  // namespace dynlab::inline numerics
