#include "scripting/objects/model_description.h"

namespace dynlab::inline scripting {

void check_value(const Estimate& estimate, const ValueLimits&) {
    const Index d = estimate.theta.size(), known = estimate.covariance().rows();
    const bool named = static_cast<Index>(estimate.names.size()) == d;
    const bool with_errors = estimate.std().size() == d || estimate.std().size() == 0;
    const bool with_covariance = known == estimate.covariance().cols() && (known == d || known == 0);
    if (!named || !with_errors || !with_covariance)
        throw InvalidArgument("the numbers of parameters, names, standard errors and covariances differ");
}

void check_value(const Model& model, const ValueLimits&) {
    if (model.outputs == 0 || model.channels.size() % model.outputs != 0)
        throw InvalidArgument("its channels do not form complete outputs");
}

}  // namespace dynlab::inline scripting
