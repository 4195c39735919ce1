#include "numerics/validation/fit_measures.h"

#include <cmath>
#include <limits>

#include "numerics/error.h"

namespace dynlab::inline numerics {

namespace {

void require_pair(const VectorView& y, const VectorView& y_sim) {
    if (y.size() != y_sim.size())
        throw InvalidArgument(
            "The simulated output must have the same length as the measured output, but has {} instead of {}",
            plural(y_sim.size(), "{} value", "{} values"), y.size());
    if (y.size() < 2)
        throw InvalidArgument(plural(y.size(), "A fit needs at least two samples, but {} was given",
                                     "A fit needs at least two samples, but {} were given"));
}

double square_about_mean(const VectorView& x) {
    return (x.array() - x.mean()).matrix().squaredNorm();
}

}  // namespace

double variation_about_mean(const VectorView& y) {
    require_pair(y, y);
    if ((y.array() == y[0]).all())
        throw InvalidArgument(
            "The measured output never changes, so a relative fit is undefined. Use data in which the output varies");
    return square_about_mean(y);
}

double r_squared_simulation(const VectorView& y, const VectorView& y_sim) {
    require_pair(y, y_sim);
    return 1 - square_about_mean(y - y_sim) / variation_about_mean(y);
}

YoungCriterion yic(const VectorView& y, const VectorView& y_sim, const VectorView& theta,
                   const MatrixView& covariance) {
    require_pair(y, y_sim);
    if (covariance.rows() != theta.size() || covariance.cols() != theta.size())
        throw InvalidArgument("YIC needs a {} x {} covariance matrix, but a {} x {} matrix was given", theta.size(),
                              theta.size(), covariance.rows(), covariance.cols());
    YoungCriterion criterion;
    double relative_variances = 0;
    for (Index i = 0; i < theta.size(); ++i) {
        if (theta[i] == 0)
            criterion.skipped.push_back(i);
        else
            relative_variances += covariance(i, i) / (theta[i] * theta[i]);
    }
    const double used = static_cast<double>(theta.size()) - static_cast<double>(criterion.skipped.size());
    if (used == 0) throw InvalidArgument("YIC needs at least one nonzero parameter");
    const double unexplained = square_about_mean(y - y_sim) / variation_about_mean(y);
    criterion.value = unexplained == 0 || relative_variances == 0
                          ? -std::numeric_limits<double>::infinity()
                          : std::log(unexplained) + std::log(relative_variances / used);
    return criterion;
}

InformationCriteria information_criteria(double mean_square, Index samples, Index parameters) {
    if (!(mean_square >= 0) || parameters < 0 || samples <= parameters + 1)
        throw InvalidArgument(
            "Information criteria need a nonnegative mean square and more samples than parameters plus one, but the "
            "mean square is {} with {} and {}",
            mean_square, plural(samples, "{} sample", "{} samples"),
            plural(parameters, "{} parameter", "{} parameters"));
    const double N = static_cast<double>(samples), d = static_cast<double>(parameters);
    InformationCriteria criteria;
    criteria.fpe = mean_square * (1 + d / N) / (1 - d / N);
    criteria.aic = std::log(mean_square) + 2 * d / N;
    criteria.aicc = criteria.aic + 2 * d * (d + 1) / (N * (N - d - 1));
    criteria.bic = std::log(mean_square) + d * std::log(N) / N;
    return criteria;
}

}  // namespace dynlab::inline numerics
