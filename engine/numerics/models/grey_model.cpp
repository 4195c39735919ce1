#include "numerics/models/grey_model.h"

#include <cmath>

#include "numerics/error.h"

namespace dynlab::inline numerics {

Vector GreyModel::start() const {
    Vector values(static_cast<Index>(parameters.size()));
    for (Index i = 0; i < values.size(); ++i) values[i] = parameters[static_cast<std::size_t>(i)].start;
    return values;
}

std::vector<Index> GreyModel::free_parameters() const {
    std::vector<Index> free;
    for (std::size_t i = 0; i < parameters.size(); ++i)
        if (!parameters[i].fixed) free.push_back(static_cast<Index>(i));
    return free;
}

void GreyModel::validate() const {
    for (const GreyParameter& p : parameters) {
        if (!std::isfinite(p.start))
            throw InvalidArgument("The initial value of the parameter {} must be finite, but is {}", p.name, p.start);
        if (std::isnan(p.lower) || std::isnan(p.upper) || p.lower > p.upper)
            throw InvalidArgument(
                "The parameter {} has the bounds {} and {}, but the lower bound must not exceed the upper bound",
                p.name, p.lower, p.upper);
        if (p.start < p.lower || p.start > p.upper)
            throw InvalidArgument("The initial value of the parameter {} is {}, which is outside the bounds {} and {}",
                                  p.name, p.start, p.lower, p.upper);
    }
    if (state_names.empty()) throw InvalidArgument("The model needs at least one state");
}

}  // namespace dynlab::inline numerics
