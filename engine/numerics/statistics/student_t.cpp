#include "numerics/statistics/student_t.h"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <string>

#include "numerics/error.h"

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
        throw InvalidArgument("A probability must lie between 0 and 1, but it is " + std::to_string(probability));
    return quantile(StudentT(degrees), probability);
}

}  // namespace dynlab::inline numerics
