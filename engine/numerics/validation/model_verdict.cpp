#include "numerics/validation/model_verdict.h"

#include "base/number_text.h"
#include "numerics/fit/diagnosis.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kMostlyExplained = 50;  // per cent of fit

/// What the errors still hold of the answer to the input.
std::string missing_part(const ModelStanding& model) {
    if (!model.doubts.remedy.empty()) return model.doubts.remedy;
    if (!model.start.empty()) return model.start;
    if (model.acts_at_once)
        return "The input acts at once, which the model leaves out: try a direct feedthrough, as many zeros as poles.";
    if (model.acts_earlier) return "The input acts earlier than the model's delay lets it: try a shorter delay.";
    return "Dynamics are missing: try another delay, one more pole or one more zero, and then look for a nonlinearity "
           "or a drift.";
}

}  // namespace

std::string model_verdict(const ModelStanding& model) {
    if (model.unstable) {
        const std::string text = "The model is unstable and not to be used, whatever the tests of its errors say.";
        return model.doubts.remedy.empty() ? text : text + " " + model.doubts.remedy;
    }
    if (model.tested && explains_little(model.fit_percent)) {
        const std::string text = "The model explains little of the output (fit " + number_text(model.fit_percent, 3) +
                                 " %), whatever the tests of its errors say.";
        if (!model.independent || !model.doubts.remedy.empty()) return text + " " + missing_part(model);
        return text + " A disturbance, another input or a nonlinearity makes up the rest.";
    }
    const bool cause_known = !model.doubts.remedy.empty() || !model.start.empty();
    if (!model.independent || (!model.white && cause_known)) return missing_part(model);
    if (!model.doubts.undetermined.empty())
        return "Nothing more of the output is explained by the input, but the data hardly determine " +
               model.doubts.undetermined + ": a simpler structure may do as well.";
    if (model.white) return "The model explains all that the data show, and its standard errors hold.";
    if (!model.tested)
        return "Missing dynamics or a coloured disturbance: without an input that changes the record cannot tell "
               "which.";
    if (model.of_predictions)
        return "The dynamics are described, but not the disturbance: try another order of its noise model, and until "
               "then robust standard errors.";
    if (model.fit_percent < kMostlyExplained)
        return "The input explains no more than the model says (fit " + number_text(model.fit_percent, 3) +
               " %). What is left has more than half of the output's standard deviation: a coloured disturbance, for "
               "which robust standard errors or a method with a noise model are in place, another input, or a "
               "nonlinearity.";
    return "The dynamics are described; the disturbance is coloured, so that robust standard errors or a method with a "
           "noise model are in place.";
}

}  // namespace dynlab::inline numerics
