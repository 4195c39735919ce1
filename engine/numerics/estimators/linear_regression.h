#pragma once
#include "base/message.h"
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

enum class RegressionMethod {
    kQr,      ///< "qr": orthogonal factorization of the column-scaled regressors; accurate, works at any rank
    kNormal,  ///< "normal": (Phi'Phi) theta = Phi'y by Cholesky, as on the blackboard; squares the condition number
};

/// y = Phi theta + e with white e, theta by least squares.
struct LinearRegression {
    Vector theta, std;            ///< d parameters and their standard errors
    Matrix covariance;            ///< d x d, sigma^2 (Phi'Phi)^-1
    Vector fitted, residuals;     ///< N each
    double sigma = 0;             ///< of the noise, sqrt(residuals^2/(N - d)); NaN when N = d, and std with it
    double rmse = 0;              ///< sqrt(residuals^2/N)
    double condition_number = 0;  ///< of Phi as given
    Index rank = 0;               ///< numerical rank of Phi; below d, theta is the solution of least norm
    Message message;              ///< one sentence
};

/// Phi is N x d with N >= d. Throws InvalidArgument for sizes that do not fit, values that are not finite, and for
/// kNormal when the columns depend on each other. Reference: Ljung (1999), section 7.3 and appendix II.
LinearRegression lsq(const MatrixView& Phi, const VectorView& y, RegressionMethod method = RegressionMethod::kQr);

struct PolyfitOptions {
    bool centered = true;  ///< powers of x - mean(x): far better conditioned when x are years
    RegressionMethod method = RegressionMethod::kQr;
};

/// y = c_1 (x - center)^n + ... + c_n (x - center) + c_(n+1) + e.
struct PolynomialFit {
    int degree = 0;
    double center = 0;            ///< 0 when not centered
    LinearRegression regression;  ///< theta = [c_1 ... c_(n+1)], highest power first
    Vector coefficients;          ///< of the same polynomial in powers of x itself, highest first
};

/// Throws InvalidArgument for a negative degree, lengths that differ, or no more distinct x than the degree.
PolynomialFit fit_polynomial(const VectorView& x, const VectorView& y, int degree, const PolyfitOptions& options = {});

/// What a model says of one new measurement.
struct Forecast {
    double value;      ///< phi' theta
    double mean_std;   ///< standard error of the value, sqrt(phi' P phi)
    double std;        ///< of the forecast error, sqrt(sigma^2 + phi' P phi)
    double low, high;  ///< prediction interval: value -+ t std, t Student's quantile with N - d degrees of freedom
    double level;      ///< its probability
};

/// Forecast for the regressors phi (d values). Throws InvalidArgument for a wrong length, a level outside (0, 1), or a
/// regression without degrees of freedom (N = d). Reference: Seber and Lee (2003), section 5.3.
Forecast forecast(const LinearRegression& regression, const VectorView& phi, double level = 0.95);
Forecast forecast(const PolynomialFit& fit, double x, double level = 0.95);

}  // namespace dynlab::inline numerics
