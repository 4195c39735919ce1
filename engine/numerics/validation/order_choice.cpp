#include <algorithm>
#include <cmath>

#include "numerics/error.h"
#include "numerics/validation/order_selection.h"

namespace dynlab::inline numerics {
namespace {

constexpr double kSlightEvidence = 2;  // difference of N BIC that is not worth a mention
constexpr double kSlightFit = 0.5;     // percentage points of validation fit
constexpr double kNoteworthyFit = 1;   // the same, when another candidate is pointed to

constexpr OrderMeasure kOrderMeasures[] = {
    {OrderCriterion::kRSquared, "RT2", true, [](const OrderCandidate& c) { return c.r_squared; }},
    {OrderCriterion::kYic, "YIC", false, [](const OrderCandidate& c) { return c.yic; }},
    {OrderCriterion::kAic, "AIC", false, [](const OrderCandidate& c) { return c.aic; }},
    {OrderCriterion::kBic, "BIC", false, [](const OrderCandidate& c) { return c.bic; }},
    {OrderCriterion::kFpe, "FPE", false, [](const OrderCandidate& c) { return c.fpe; }},
    {OrderCriterion::kFit, "fit", true, [](const OrderCandidate& c) { return c.fit_percent; }},
    {OrderCriterion::kValidationFit, "validation", true,
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

/// The candidate with fewest parameters among those slightly behind the best one; of candidates with equal numbers the
/// better one.
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

MessageList faults_of(const OrderCandidate& candidate) {
    MessageList faults{{}, Join::kAnd};
    if (candidate.cancellation)
        faults.items.push_back(candidate.integrator ? Message("a zero that cancels a pole or the integrator")
                                                    : Message("a zero that cancels a pole"));
    if (!candidate.undetermined.empty())
        faults.items.push_back(
            Message("a standard error larger than the value for {}", listed(candidate.undetermined)));
    if (!candidate.converged) faults.items.push_back(Message("an estimation that did not converge"));
    return faults;
}

Message measures_of(const OrderCandidate& candidate) {
    const Number r_squared = significant(candidate.r_squared, 4), yic = significant(candidate.yic, 4);
    if (!candidate.validation_fit) return Message("R_T^2 = {}, YIC = {}", r_squared, yic);
    return Message("R_T^2 = {}, YIC = {}, validation fit {} %", r_squared, yic,
                   significant(*candidate.validation_fit, 4));
}

/// Points to the candidate that fits better but was passed over, and says why; empty where there is none.
Message passed_over(const OrderSelection& selection, const Places& estimated, std::size_t chosen) {
    const OrderCandidate& taken = selection.candidates[chosen];
    const std::size_t closest = best_of(selection, estimated, OrderCriterion::kRecommended);
    const OrderCandidate& other = selection.candidates[closest];
    if (closest == chosen) return {};
    const Message structure = structure_text(other);
    if (!other.sound())
        return selection.validated
                   ? Message(
                         "With {} the validation fit would be better, but that model has {}, a sign of too many "
                         "parameters.",
                         structure, faults_of(other))
                   : Message("With {} the BIC would be better, but that model has {}, a sign of too many parameters.",
                             structure, faults_of(other));
    if (other.unstable && !taken.unstable)
        return selection.validated
                   ? Message("With {} the validation fit would be better, but that model is unstable.", structure)
                   : Message("With {} the BIC would be better, but that model is unstable.", structure);
    const int more = other.parameters() - taken.parameters();
    if (more <= 0) return {};
    const Message price = plural(more, "{} more parameter", "{} more parameters");
    return selection.validated
               ? Message("With {} the validation fit would be better, but not enough to justify {}.", structure, price)
               : Message("With {} the BIC would be better, but not enough to justify {}.", structure, price);
}

/// Empty where there is none.
Message validation_doubt(const OrderSelection& selection, const Places& sound, std::size_t chosen) {
    if (!selection.validated) return Message("Check this structure on validation data before you use it.");
    const OrderCandidate& taken = selection.candidates[chosen];
    if (*taken.validation_fit >= taken.fit_percent - 10 * kNoteworthyFit || sound.empty()) return {};
    return Message(
        "On the validation data the model fits clearly worse than on the estimation data: the data sets differ, or the "
        "model is wrong.");
}

Message sentences_that_are_there(std::vector<Message> all) {
    std::erase_if(all, [](const Message& one) { return one.empty(); });
    return sentences(std::move(all));
}

OrderChoice recommend(const OrderSelection& selection, const Places& estimated) {
    Places sound = places_where(selection, [](const OrderCandidate& one) { return one.sound() && !one.unstable; });
    if (sound.empty()) sound = places_where(selection, [](const OrderCandidate& one) { return one.sound(); });
    const std::size_t chosen = simplest_of(selection, sound.empty() ? estimated : sound);
    const OrderCandidate& taken = selection.candidates[chosen];
    std::vector<Message> explanation;
    if (sound.empty()) {
        explanation.push_back(
            Message("No structure yields a reliable model; the best one is {} ({}), with {}. Try fewer poles and "
                    "zeros, or data with more excitation.",
                    structure_text(taken), measures_of(taken), faults_of(taken)));
    } else {
        explanation.push_back(Message("Recommended: {} ({}).", structure_text(taken), measures_of(taken)));
        explanation.push_back(selection.validated
                                  ? Message("Among the models without canceling zeros or undetermined parameters, no "
                                            "simpler model fits the validation data nearly as well.")
                                  : Message("This structure balances a small error against few parameters (BIC). It "
                                            "has neither a zero that cancels a pole nor an undetermined parameter."));
        explanation.push_back(passed_over(selection, estimated, chosen));
    }
    explanation.push_back(validation_doubt(selection, sound, chosen));
    return {chosen, sentences_that_are_there(std::move(explanation))};
}

/// structure_text, with a capital letter.
Message structure_at_the_beginning(const OrderCandidate& candidate) {
    if (!candidate.integrator) return structure_text(candidate);
    OrderCandidate bare;
    bare.poles = candidate.poles;
    bare.zeros = candidate.zeros;
    bare.delay = candidate.delay;
    return Message("An integrator, {}", structure_text(bare));
}

/// That the structure is the best by the criterion, any but kRecommended.
Message best_by(OrderCriterion criterion, const OrderCandidate& taken) {
    const Message structure = structure_at_the_beginning(taken), measures = measures_of(taken);
    switch (criterion) {
        case OrderCriterion::kRSquared:
            return Message("{} have the largest R_T^2 ({}).", structure, measures);
        case OrderCriterion::kYic:
            return Message("{} have the smallest YIC ({}).", structure, measures);
        case OrderCriterion::kAic:
            return Message("{} have the smallest AIC ({}).", structure, measures);
        case OrderCriterion::kBic:
            return Message("{} have the smallest BIC ({}).", structure, measures);
        case OrderCriterion::kFpe:
            return Message("{} have the smallest FPE ({}).", structure, measures);
        case OrderCriterion::kFit:
            return Message("{} have the best fit ({}).", structure, measures);
        default:
            return Message("{} have the best validation fit ({}).", structure, measures);
    }
}

}  // namespace

std::span<const OrderMeasure> order_measures() {
    return kOrderMeasures;
}

const OrderMeasure& order_measure(OrderCriterion criterion) {
    return *std::ranges::find(kOrderMeasures, criterion, &OrderMeasure::criterion);
}

Message structure_text(const OrderCandidate& candidate) {
    const Message poles = plural(candidate.poles, "{} pole", "{} poles");
    const Message zeros = candidate.zeros == 0 ? Message("no zeros") : plural(candidate.zeros, "{} zero", "{} zeros");
    const Message structure = candidate.delay > 0 ? Message("{}, {} and a delay of {} s", poles, zeros, candidate.delay)
                                                  : Message("{} and {}", poles, zeros);
    return candidate.integrator ? Message("an integrator, {}", structure) : structure;
}

OrderChoice choose_order(const OrderSelection& selection, OrderCriterion criterion) {
    if (criterion == OrderCriterion::kValidationFit && !selection.validated)
        throw InvalidArgument(
            "no validation fit is available: specify validation data, as in srivcstruc(data, {poles = {1, 4}, validate "
            "= data2})");
    const Places estimated =
        places_where(selection, [](const OrderCandidate& candidate) { return candidate.failure.empty(); });
    if (estimated.empty()) throw InvalidArgument("none of the structures could be estimated, so none can be selected");
    if (criterion == OrderCriterion::kRecommended) return recommend(selection, estimated);
    const std::size_t chosen = best_of(selection, estimated, criterion);
    const OrderCandidate& taken = selection.candidates[chosen];
    std::vector<Message> explanation{best_by(criterion, taken)};
    if (!taken.sound()) explanation.push_back(Message("However, that model has {}.", faults_of(taken)));
    return {chosen, sentences_that_are_there(std::move(explanation))};
}

}  // namespace dynlab::inline numerics
