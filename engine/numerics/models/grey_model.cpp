#include "numerics/models/grey_model.h"

#include <cmath>

#include "base/number_text.h"
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
        const std::string name = "The parameter " + p.name;
        if (!std::isfinite(p.start)) throw InvalidArgument(name + " starts from " + number_text(p.start));
        if (std::isnan(p.lower) || std::isnan(p.upper) || p.lower > p.upper)
            throw InvalidArgument(name + " has the bounds " + number_text(p.lower) + " and " + number_text(p.upper) +
                                  ", and the first must not be above the second");
        if (p.start < p.lower || p.start > p.upper)
            throw InvalidArgument(name + " starts from " + number_text(p.start) + ", outside its bounds " +
                                  number_text(p.lower) + " and " + number_text(p.upper));
    }
    if (state_names.empty()) throw InvalidArgument("The model needs at least one state");
}

}  // namespace dynlab::inline numerics
