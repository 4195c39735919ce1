#include "numerics/validation/model_assessment.h"

#include "numerics/fit/diagnosis.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kMostlyExplained = 50;  // per cent of fit

/// What the errors still hold of the answer to the input.
Message missing_part(const ModelEvidence& model) {
    if (!model.doubts.remedy.empty()) return model.doubts.remedy;
    if (!model.start.empty()) return model.start;
    if (model.acts_at_once)
        return Message(
            "The output responds to the input immediately, but the model does not: try direct feedthrough, that is, as "
            "many zeros as poles.");
    if (model.acts_earlier)
        return Message("The output responds earlier than the model's delay allows: try a shorter delay.");
    return Message(
        "The model does not describe all dynamics: try another delay, one more pole or one more zero, and then check "
        "for a nonlinearity or a drift.");
}

/// Whether a parameter belongs to the output of this number alone: b0_y2 and b0_y2u1 to 2. One without an output's
/// number belongs to all.
bool belongs_to(const std::string& parameter, std::size_t number) {
    const std::size_t at = parameter.rfind("_y");
    if (at == std::string::npos) return true;
    const std::string own = "_y" + std::to_string(number), rest = parameter.substr(at);
    return rest == own || rest.starts_with(own + "u");
}

}  // namespace

ModelDoubts ModelDoubts::about(std::size_t i, const std::string& name) const {
    ModelDoubts own;
    for (const std::string& parameter : undetermined)
        if (belongs_to(parameter, i + 1)) own.undetermined.push_back(parameter);
    if (output.empty() || output == name) own.remedy = remedy;
    return own;
}

Message model_quality_message(const ModelEvidence& model) {
    const Number fit = significant(model.fit_percent, 3);
    if (model.unstable) {
        const Message message = Message("The model is unstable. Do not use it, even if the residual tests pass.");
        return model.doubts.remedy.empty() ? message : sentences({message, model.doubts.remedy});
    }
    if (model.tested && explains_little(model.fit_percent)) {
        const Message message =
            Message("The model explains little of the output (fit {} %), even if the residual tests pass.", fit);
        const bool missing = !model.independent || !model.doubts.remedy.empty();
        return sentences(
            {message,
             missing
                 ? missing_part(model)
                 : Message(
                       "The remainder of the output is caused by a disturbance, another input or a nonlinearity.")});
    }
    const bool cause_known = !model.doubts.remedy.empty() || !model.start.empty();
    if (!model.independent || (!model.white && cause_known)) return missing_part(model);
    if (!model.doubts.undetermined.empty())
        return Message(
            "The residuals are uncorrelated with the input, but the data do not reliably determine {}: a simpler "
            "structure may be sufficient.",
            listed(model.doubts.undetermined));
    if (model.white)
        return Message("The tests show no missing dynamics, and the standard errors of the model are valid.");
    if (!model.tested)
        return Message(
            "The cause is missing dynamics or a colored disturbance: these data, without a varying input, cannot "
            "distinguish them.");
    if (model.of_predictions)
        return Message(
            "The model describes the dynamics, but not the disturbance: try another order of its noise model. Until "
            "then, use robust standard errors.");
    if (model.fit_percent < kMostlyExplained)
        return Message(
            "The model explains everything that depends on the input (fit {} %). The standard deviation of the "
            "residuals is more than half the standard deviation of the output. Possible causes are another input, a "
            "nonlinearity, or a colored disturbance. For a colored disturbance, use robust standard errors or a method "
            "with a noise model.",
            fit);
    return Message(
        "The model describes the dynamics. The disturbance is colored: use robust standard errors or a method with a "
        "noise model.");
}

}  // namespace dynlab::inline numerics
