#pragma once
#include <string>
#include <vector>

#include "numerics/models/transfer_function.h"

namespace dynlab::inline numerics {

/// The number of estimated coefficients of each polynomial of a PolynomialModel, and their order in a parameter vector:
/// a_1..a_na, then for each input f_1..f_nf and b_nk..b_(nk+nb-1), then c_1..c_nc and d_1..d_nd. The index of b is the
/// delay of the input in samples: b_1 is the weight of u(k-1).
struct PolynomialOrders {
    int na = 0;                   ///< poles common to all inputs and the noise
    std::vector<int> nb, nf, nk;  ///< per input: coefficients of B, separate poles, samples of delay
    int nc = 0, nd = 0;           ///< of the noise model

    static PolynomialOrders arx(int na, std::vector<int> nb, std::vector<int> nk);
    static PolynomialOrders output_error(std::vector<int> nb, std::vector<int> nf, std::vector<int> nk);

    std::size_t inputs() const { return nb.size(); }
    Index parameter_count() const;
    std::vector<std::string> parameter_names() const;  ///< a1, f1, b1, ...; with several inputs f1_u1, b1_u2, ...
    Index f_start(std::size_t input) const;            ///< of f_1 in the parameter vector
    Index b_start(std::size_t input) const;            ///< of b_nk
    Index c_start() const;
    Index d_start() const;
    /// Samples before the present one that bear on it: max(na, nk + nb - 1 of each input).
    Index past() const;

    /// Throws InvalidArgument that says what the entry means, unless there is at least one input, each with nb >= 1,
    /// nf >= 0 and nk >= 0, no list is shorter than another, and no order is negative or above 100.
    void validate() const;
};

/// A(q) y(k) = sum_i B_i(q)/F_i(q) u_i(k) + C(q)/D(q) e(k), every Ts seconds, with white e and one output. The vectors
/// hold the weights of the present sample, the one before it, ...: A = [1 a_1 .. a_na] is 1 + a_1 q^-1 + ..., which in
/// powers of q is highest power first. A delay of nk samples is represented in B by nk leading zeros: with nk = 1, no
/// direct term, B = [0 b_1 b_2 ...]. A, C, D and F begin with 1.
struct PolynomialModel {
    Vector A, C, D;
    std::vector<Vector> B, F;  ///< one for each input
    double Ts = 1;

    /// Throws InvalidArgument unless `theta` has one value for each parameter and Ts > 0.
    PolynomialModel(const PolynomialOrders& orders, const VectorView& theta, double Ts);

    /// B_i/(A F_i). All delay beyond one sample becomes the delay of the transfer function, so that d2c, which knows
    /// that a held input is seen one sample late, gives a continuous-time model without needless delay.
    TransferFunction transfer_function(std::size_t input = 0) const;
};

}  // namespace dynlab::inline numerics
