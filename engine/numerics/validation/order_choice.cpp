#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "base/reader.h"
#include "numerics/error.h"
#include "numerics/fit/missed_options.h"
#include "numerics/validation/order_selection.h"

namespace dynlab::inline numerics {
namespace {

constexpr double kSlightEvidence = 2;  // difference of N BIC that is not worth a mention
constexpr double kSlightFit = 0.5;     // percentage points of validation fit
constexpr double kNoteworthyFit = 1;   // the same, when another candidate is pointed to

constexpr OrderMeasure kOrderMeasures[] = {
    {OrderCriterion::kRSquared, "RT2", "R_T^2", "", true, [](const OrderCandidate& c) { return c.r_squared; }},
    {OrderCriterion::kYic, "YIC", "YIC", "", false, [](const OrderCandidate& c) { return c.yic; }},
    {OrderCriterion::kAic, "AIC", "AIC", "", false, [](const OrderCandidate& c) { return c.aic; }},
    {OrderCriterion::kBic, "BIC", "BIC", "", false, [](const OrderCandidate& c) { return c.bic; }},
    {OrderCriterion::kFpe, "FPE", "FPE", "", false, [](const OrderCandidate& c) { return c.fpe; }},
    {OrderCriterion::kFit, "fit", "fit", " (%)", true, [](const OrderCandidate& c) { return c.fit_percent; }},
    {OrderCriterion::kValidationFit, "validation", "validation fit", " (%)", true,
     [](const OrderCandidate& c) { return c.validation_fit.value_or(std::nan("")); }}};

/// Smaller is better.
double badness(const OrderCandidate& candidate, OrderCriterion criterion) {
    if (criterion == OrderCriterion::kRecommended)
        return candidate.validation_fit ? -*candidate.validation_fit : candidate.evidence;
    const OrderMeasure& measure = order_measure(criterion);
    return measure.larger_is_better ? -measure.value(candidate) : measure.value(candidate);
}

using Places = std::vector<std::size_t>;

Places places_where(const OrderSelection& selection, bool (*accept)(const OrderCandidate&)) {
    Places places;
    for (std::size_t i = 0; i < selection.candidates.size(); ++i)
        if (accept(selection.candidates[i])) places.push_back(i);
    return places;
}

std::size_t best_of(const OrderSelection& selection, const Places& places, OrderCriterion criterion) {
    return *std::min_element(places.begin(), places.end(), [&](std::size_t i, std::size_t j) {
        return badness(selection.candidates[i], criterion) < badness(selection.candidates[j], criterion);
    });
}

/// The candidate with fewest parameters among those hardly behind the best one; of equally many the better one.
std::size_t simplest_of(const OrderSelection& selection, const Places& places) {
    constexpr OrderCriterion kOwn = OrderCriterion::kRecommended;
    const double slight = selection.validated ? kSlightFit : kSlightEvidence;
    std::size_t chosen = best_of(selection, places, kOwn);
    const double limit = badness(selection.candidates[chosen], kOwn) + slight;
    for (const std::size_t i : places) {
        const OrderCandidate &one = selection.candidates[i], &best = selection.candidates[chosen];
        if (badness(one, kOwn) <= limit && one.parameters() < best.parameters()) chosen = i;
    }
    for (const std::size_t i : places) {
        const OrderCandidate &one = selection.candidates[i], &best = selection.candidates[chosen];
        if (one.parameters() == best.parameters() && badness(one, kOwn) < badness(best, kOwn)) chosen = i;
    }
    return chosen;
}

std::string faults_of(const OrderCandidate& candidate) {
    std::vector<std::string> faults;
    if (candidate.cancellation)
        faults.push_back(candidate.integrator ? "a zero that cancels a pole or the integrator"
                                              : "a zero that cancels a pole");
    if (!candidate.undetermined.empty())
        faults.push_back("standard errors larger than the values of " + enumerated(candidate.undetermined));
    if (!candidate.converged) faults.push_back("an estimation that did not converge");
    return enumerated(faults, " and ");
}

std::string measures_of(const OrderCandidate& candidate) {
    std::string text = "R_T^2 = " + number_text(candidate.r_squared, 4) + ", YIC = " + number_text(candidate.yic, 4);
    if (candidate.validation_fit) text += ", validation fit " + number_text(*candidate.validation_fit, 4) + " %";
    return text;
}

/// Points to the candidate that fits better but was passed over, and says why.
std::string passed_over(const OrderSelection& selection, const Places& estimated, std::size_t chosen) {
    const OrderCandidate& taken = selection.candidates[chosen];
    const std::size_t closest = best_of(selection, estimated, OrderCriterion::kRecommended);
    const OrderCandidate& other = selection.candidates[closest];
    if (closest == chosen) return "";
    const std::string subject = " With " + structure_text(other) + " the " +
                                (selection.validated ? "validation fit" : "BIC") + " would be better still, but ";
    if (!other.sound()) return subject + "that model has " + faults_of(other) + ", a sign of too many parameters.";
    if (other.unstable && !taken.unstable) return subject + "that model is unstable.";
    if (other.parameters() > taken.parameters())
        return subject + "not by enough to pay for " +
               counted(other.parameters() - taken.parameters(), "more parameter") + ".";
    return "";
}

std::string validation_doubt(const OrderSelection& selection, const Places& sound, std::size_t chosen) {
    if (!selection.validated) return " Check it on a second record before you trust it.";
    const OrderCandidate& taken = selection.candidates[chosen];
    if (*taken.validation_fit >= taken.fit_percent - 10 * kNoteworthyFit || sound.empty()) return "";
    return " On the second record it fits clearly worse than on the first: the records differ, or the model is wrong.";
}

/// With the blank before it: which option its fit lacks.
std::string missed_by(const OrderCandidate& candidate) {
    const std::optional<MissedOption>& missed = candidate.estimate.doubts.missed_option;
    return missed ? " " + message_text(sentence_of(*missed)) + " Then compare the structures again." : "";
}

OrderChoice recommend(const OrderSelection& selection, const Places& estimated) {
    Places sound = places_where(selection, [](const OrderCandidate& one) { return one.sound() && !one.unstable; });
    if (sound.empty()) sound = places_where(selection, [](const OrderCandidate& one) { return one.sound(); });
    const std::size_t chosen = simplest_of(selection, sound.empty() ? estimated : sound);
    const OrderCandidate& taken = selection.candidates[chosen];
    OrderChoice choice{chosen, "Recommended: " + structure_text(taken) + " (" + measures_of(taken) + "). "};
    choice.explanation += selection.validated
                              ? "Among the models without cancelling zeros or undetermined parameters no simpler one "
                                "follows the second record nearly as well."
                              : "It balances a small error against few parameters (BIC) and has neither a zero that "
                                "cancels a pole nor an undetermined parameter.";
    if (sound.empty())
        choice.explanation = "No structure gives a sound model; least bad: " + structure_text(taken) + " (" +
                             measures_of(taken) + "), with " + faults_of(taken) +
                             ". Try fewer poles and zeros, or a record with more excitation.";
    else
        choice.explanation += passed_over(selection, estimated, chosen);
    choice.explanation += validation_doubt(selection, sound, chosen) + missed_by(taken);
    return choice;
}

}  // namespace

std::span<const OrderMeasure> order_measures() {
    return kOrderMeasures;
}

const OrderMeasure& order_measure(OrderCriterion criterion) {
    return *std::ranges::find(kOrderMeasures, criterion, &OrderMeasure::criterion);
}

std::string structure_text(const OrderCandidate& candidate) {
    const std::string zeros = candidate.zeros == 0 ? "no zero" : counted(candidate.zeros, "zero");
    const std::string delay = candidate.delay > 0 ? " and a delay of " + number_text(candidate.delay) + " s" : "";
    const std::string integrator = candidate.integrator ? "an integrator, " : "";
    return integrator + counted(candidate.poles, "pole") + (delay.empty() ? " and " : ", ") + zeros + delay;
}

OrderChoice choose_order(const OrderSelection& selection, OrderCriterion criterion) {
    if (criterion == OrderCriterion::kValidationFit && !selection.validated)
        throw InvalidArgument(
            "there is no validation fit: give srivcstruc a second record, as in srivcstruc(data, {poles = {1, 4}, "
            "validate = data2})");
    const Places estimated =
        places_where(selection, [](const OrderCandidate& candidate) { return candidate.failure.empty(); });
    if (estimated.empty()) throw InvalidArgument("none of the structures could be estimated, so none can be chosen");
    if (criterion == OrderCriterion::kRecommended) return recommend(selection, estimated);
    const OrderMeasure& measure = order_measure(criterion);
    const std::size_t chosen = best_of(selection, estimated, criterion);
    const OrderCandidate& taken = selection.candidates[chosen];
    OrderChoice choice{chosen, structure_text(taken) + " have the " +
                                   (measure.larger_is_better ? "largest " : "smallest ") + measure.name + " (" +
                                   measures_of(taken) + ")."};
    choice.explanation.front() = static_cast<char>(std::toupper(choice.explanation.front()));
    if (!taken.sound()) choice.explanation += " But that model has " + faults_of(taken) + ".";
    choice.explanation += missed_by(taken);
    return choice;
}

}  // namespace dynlab::inline numerics
