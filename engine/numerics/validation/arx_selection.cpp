#include "numerics/validation/arx_selection.h"

#include <algorithm>

#include "base/number_text.h"
#include "numerics/error.h"
#include "numerics/fit/equation_error.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/validation/fit_measures.h"

namespace dynlab::inline numerics {
namespace {

constexpr double kMostArxStructures = 2000;
constexpr double kHardlyLarger = 1.01;  // of a loss: not worth parameters

/// As a script writes it: a number, or {from, to}.
std::string range_text(std::pair<int, int> range) {
    const std::string first = std::to_string(range.first);
    return range.first == range.second ? first : "{" + first + ", " + std::to_string(range.second) + "}";
}

void check_range(const char* name, std::pair<int, int> range, int least) {
    if (range.first < least || range.second < range.first)
        throw InvalidArgument(std::string(name) + " must be a number or a range {from, to} from at least " +
                              std::to_string(least) + " upwards, but it is " + range_text(range));
}

void check_ranges(const ArxRanges& ranges) {
    check_range("na", ranges.na, 0);
    check_range("nb", ranges.nb, 1);
    check_range("nk", ranges.nk, 0);
    const auto length = [](std::pair<int, int> range) { return 1.0 + range.second - range.first; };
    if (length(ranges.na) * length(ranges.nb) * length(ranges.nk) > kMostArxStructures)
        throw InvalidArgument("there are more than " + number_text(kMostArxStructures) +
                              " structures to try: take smaller ranges");
}

/// The equations of the largest structure of one record: every other one's are columns of them.
struct LargestEquations {
    LargestEquations(const IdData& data, const ArxRanges& ranges) : na(ranges.na.second), nk(ranges.nk.first) {
        if (data.input_count() != 1)
            throw InvalidArgument("arxstruc: the data must have one input, but they have " +
                                  std::to_string(data.input_count()) + "; select one");
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

/// Points to a smaller structure that is hardly worse, where the loss alone has chosen.
std::string simpler_arx(const ArxSelection& selection, std::size_t chosen) {
    const ArxCandidate *taken = &selection.candidates[chosen], *simplest = taken;
    for (const ArxCandidate& one : selection.candidates)
        if (one.determined && one.parameters() < simplest->parameters() &&
            one.judged_loss() <= kHardlyLarger * taken->judged_loss())
            simplest = &one;
    if (simplest == taken) return "";
    return " With " + counted(simplest->parameters(), "parameter") + " instead of " +
           std::to_string(taken->parameters()) + ", " + orders_text(*simplest) + " comes within 1 % of it.";
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
    return candidate.judged_loss();
}

OrderChoice choose_arx(const ArxSelection& selection, ArxCriterion criterion) {
    const auto best = std::min_element(selection.candidates.begin(), selection.candidates.end(),
                                       [&](const ArxCandidate& one, const ArxCandidate& other) {
                                           if (one.determined != other.determined) return one.determined;
                                           return criterion_value(one, criterion) < criterion_value(other, criterion);
                                       });
    OrderChoice choice{static_cast<std::size_t>(best - selection.candidates.begin()),
                       "{na, nb, nk} = " + orders_text(*best) + " has the smallest "};
    if (criterion == ArxCriterion::kAic) choice.explanation += "AIC.";
    if (criterion == ArxCriterion::kBic) choice.explanation += "BIC.";
    if (criterion != ArxCriterion::kLoss) return choice;
    choice.explanation += selection.validated ? "loss on the second record." : "loss.";
    if (!selection.validated)
        choice.explanation +=
            " On the record of the estimation itself the loss falls with every parameter: give a "
            "second record, or choose by BIC.";
    choice.explanation += simpler_arx(selection, choice.place);
    return choice;
}

ArxCriterion usual_criterion(const ArxSelection& selection) {
    return selection.validated ? ArxCriterion::kLoss : ArxCriterion::kBic;
}

}  // namespace dynlab::inline numerics
