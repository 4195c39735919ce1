#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "numerics/criteria/monomials.h"
#include "numerics/fit/fit.h"
#include "numerics/models/free_run.h"

namespace dynlab::inline numerics {

/// Which past values a polynomial NARX model reads: y(k-1) .. y(k-na), and of each input u(k-nk) .. u(k-nk-nb+1).
struct NarxLags {
    int na = 1;
    std::vector<int> nb, nk;  ///< an entry for each input

    /// Throws InvalidArgument for negative lags, none at all, or another number of inputs than the data have.
    void check(Index inputs) const;
    Index variables() const;  ///< past values
    Index first() const;      ///< the first sample (0-based) whose past is recorded
    /// Past values of the samples `first()` to N - 1 as rows, in the order above, input by input.
    Matrix past_values(const VectorView& y, const MatrixView& u) const;
    std::vector<std::string> names(const std::string& output, const std::vector<std::string>& inputs) const;
};

/// y(k) = sum_i theta_i p_i(past values), p_i monomials.
class NarxModel : public FreeRunModel {
  public:
    NarxModel(NarxLags lags, Monomials monomials, std::vector<Index> terms, Vector theta, double Ts, double largest);

    Index input_count() const override { return static_cast<Index>(lags_.nb.size()); }
    Index output_count() const override { return 1; }
    /// `x0`: the first outputs of the run, as many as the longest lag needs; by default the data provide them. A run is
    /// lost if its output exceeds 1e3 times the largest output of the estimation data.
    FreeRun free_run(const IdData& data, std::size_t experiment, const VectorView& x0) const override;

    const NarxLags& lags() const { return lags_; }
    const Monomials& monomials() const { return monomials_; }
    const std::vector<Index>& terms() const { return terms_; }  ///< the chosen monomials, in the order of theta
    const Vector& theta() const { return theta_; }

  private:
    NarxLags lags_;
    Monomials monomials_;
    std::vector<Index> terms_;
    Vector theta_;
    double Ts_, largest_;  // s; unit of the output
};

struct NarxOptions {
    int degree = 2;
    Index terms = 0;                    ///< how many; 0: as many as the smallest BIC has, at most 50
    std::function<bool()> cancel = {};  ///< called before every block of data and every term; narx throws when it
                                        ///< returns true

    /// Throws InvalidArgument naming the option.
    void validate() const;
};

/// One step of the choice of terms.
struct NarxStep {
    std::string term;
    double error_reduction = 0;  ///< share of the output's power that the term explains beyond those before it
    double bic = 0;              ///< of the model with the terms up to this one
};

/// theta and std belong to `fit.names`, the chosen terms in the order they were chosen in.
struct NarxFit {
    Fit fit;
    std::shared_ptr<const NarxModel> model;
    std::vector<NarxStep> steps;  ///< all that were looked at, those beyond the chosen ones at the end
    std::string equation;         ///< "y1(k) = 0.5*y1(k-1) + ..."
};

/// Polynomial NARX model y(k) = sum_i theta_i p_i(y(k-1).., u(k-nk)..) + e(k) by forward orthogonal selection. Of all
/// monomials of the past values up to a degree, each step selects the one that explains most of the output's remaining
/// power (error reduction ratio), until BIC rises or the requested number is reached. theta is the least-squares
/// solution. One orthogonal triangularization of all candidates comes first, so that the cost of the selection does not
/// depend on the length of the data. The estimate is consistent for white e in the equation; measurement noise biases
/// it, as for arx. `fit_percent` is that of the free run from the first recorded outputs (-infinity, with a warning, if
/// the run diverges), `prediction_fit_percent` that of the one-step prediction. Data: one output, any number of inputs
/// and experiments, regular sampling. Throws InvalidArgument for other data, lags or options, and no more equations
/// than candidates. References: Chen, Billings and Luo (1989), Int. J. Control 50, 1873-1896; Billings (2013),
/// Nonlinear System Identification, chapter 3.
NarxFit narx(const IdData& data, const NarxLags& lags, const NarxOptions& options = {});

}  // namespace dynlab::inline numerics
