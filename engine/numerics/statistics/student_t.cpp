#include "numerics/statistics/student_t.h"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <string>

#include "numerics/error.h"
#include "numerics/number_text.h"

namespace dynlab::inline numerics {

namespace {

using Policy = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
using StudentT = boost::math::students_t_distribution<double, Policy>;

}  // namespace

double student_t_quantile(double probability, double degrees) {
    if (!(degrees > 0) || !std::isfinite(degrees))
        throw InvalidArgument("Student's t needs a positive number of degrees of freedom, and got " +
                              std::to_string(degrees) + ": use more samples than parameters");
    if (!(probability > 0 && probability < 1))
        throw InvalidArgument("A probability must lie between 0 and 1, but it is " + number_text(probability));
    try {
        return quantile(StudentT(degrees), probability);
    } catch (const std::exception&) {  // beyond what a number can hold, or the series that Boost has
        throw InvalidArgument("The quantile of Student's t for the probability " + number_text(probability) + " and " +
                              number_text(degrees) + " degrees of freedom cannot be worked out");
    }
}

}  // namespace dynlab::inline numerics
