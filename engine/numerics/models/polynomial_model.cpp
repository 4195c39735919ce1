#include "numerics/models/polynomial_model.h"

#include <algorithm>
#include <utility>

#include "numerics/error.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/signals/checks.h"

namespace dynlab::inline numerics {

namespace {

constexpr int kMaxOrder = 100, kMaxDelay = 1000000;

bool between(int value, int low, int high) {
    return value >= low && value <= high;
}

void check_orders(const PolynomialOrders& orders) {
    if (!between(orders.na, 0, kMaxOrder))
        throw InvalidArgument("na, the number of poles, must be between {} and {}, but is {}", 0, kMaxOrder, orders.na);
    if (!between(orders.nc, 0, kMaxOrder))
        throw InvalidArgument(
            "nc, the number of coefficients of C without the leading 1, must be between {} and {}, but is {}", 0,
            kMaxOrder, orders.nc);
    if (!between(orders.nd, 0, kMaxOrder))
        throw InvalidArgument(
            "nd, the number of coefficients of D without the leading 1, must be between {} and {}, but is {}", 0,
            kMaxOrder, orders.nd);
    for (std::size_t i = 0; i < orders.inputs(); ++i) {
        if (!between(orders.nb[i], 1, kMaxOrder))
            throw InvalidArgument("nb, the number of coefficients of B, must be between {} and {}, but is {}", 1,
                                  kMaxOrder, orders.nb[i]);
        if (!between(orders.nf[i], 0, kMaxOrder))
            throw InvalidArgument("nf, the number of poles of B/F, must be between {} and {}, but is {}", 0, kMaxOrder,
                                  orders.nf[i]);
        if (!between(orders.nk[i], 0, kMaxDelay))
            throw InvalidArgument(
                "nk, the delay in samples (1 for systems without direct feedthrough), must be between {} and {}, but "
                "is {}",
                0, kMaxDelay, orders.nk[i]);
    }
}

void check_list(const std::vector<int>& list, std::size_t inputs, const std::string& name) {
    if (list.size() == inputs) return;
    throw InvalidArgument("{} needs one value for each input: the length of nb is {}, but the length of {} is {}", name,
                          inputs, name, list.size());
}

void append_names(std::vector<std::string>& names, const char* letter, int first, int count,
                  const std::string& ending = "") {
    for (int i = 0; i < count; ++i) names.push_back(letter + std::to_string(first + i) + ending);
}

/// The ratio of two polynomials in q^-1 as one of polynomials in z.
TransferFunction in_powers_of_z(const VectorView& num, const VectorView& den, double Ts, double delay = 0) {
    const Index length = std::max(num.size(), den.size());
    Vector top = Vector::Zero(length), bottom = Vector::Zero(length);
    top.head(num.size()) = num;
    bottom.head(den.size()) = den;
    return TransferFunction(top, bottom, Ts, delay);
}

}  // namespace

PolynomialOrders PolynomialOrders::arx(int na, std::vector<int> nb, std::vector<int> nk) {
    PolynomialOrders orders;
    orders.na = na;
    orders.nf.assign(nb.size(), 0);
    orders.nb = std::move(nb);
    orders.nk = std::move(nk);
    return orders;
}

PolynomialOrders PolynomialOrders::output_error(std::vector<int> nb, std::vector<int> nf, std::vector<int> nk) {
    PolynomialOrders orders;
    orders.nb = std::move(nb);
    orders.nf = std::move(nf);
    orders.nk = std::move(nk);
    return orders;
}

Index PolynomialOrders::parameter_count() const {
    return d_start() + nd;
}

Index PolynomialOrders::f_start(std::size_t input) const {
    Index place = na;
    for (std::size_t i = 0; i < input; ++i) place += nf[i] + nb[i];
    return place;
}

Index PolynomialOrders::b_start(std::size_t input) const {
    return f_start(input) + nf[input];
}

Index PolynomialOrders::c_start() const {
    return f_start(inputs());
}

Index PolynomialOrders::d_start() const {
    return c_start() + nc;
}

Index PolynomialOrders::past() const {
    Index samples = na;
    for (std::size_t i = 0; i < inputs(); ++i) samples = std::max<Index>(samples, nk[i] + nb[i] - 1);
    return samples;
}

std::vector<std::string> PolynomialOrders::parameter_names() const {
    std::vector<std::string> names;
    append_names(names, "a", 1, na);
    for (std::size_t i = 0; i < inputs(); ++i) {
        const std::string ending = inputs() > 1 ? "_u" + std::to_string(i + 1) : "";
        append_names(names, "f", 1, nf[i], ending);
        append_names(names, "b", nk[i], nb[i], ending);
    }
    append_names(names, "c", 1, nc);
    append_names(names, "d", 1, nd);
    return names;
}

void PolynomialOrders::validate() const {
    if (nb.empty()) throw InvalidArgument("A polynomial model needs at least one input");
    check_list(nf, nb.size(), "nf");
    check_list(nk, nb.size(), "nk");
    check_orders(*this);
}

PolynomialModel::PolynomialModel(const PolynomialOrders& orders, const VectorView& theta, double sampling_time)
    : Ts(sampling_time) {
    orders.validate();
    if (!valid_sampling_time(Ts))
        throw InvalidArgument("polynomial model: the sampling time must be a positive number of seconds, but it is {}",
                              Ts);
    if (theta.size() != orders.parameter_count())
        throw InvalidArgument("The polynomial model has {}, but the number of specified values is {}",
                              plural(orders.parameter_count(), "{} parameter", "{} parameters"), theta.size());
    A = monic(theta.head(orders.na));
    C = monic(theta.segment(orders.c_start(), orders.nc));
    D = monic(theta.segment(orders.d_start(), orders.nd));
    for (std::size_t i = 0; i < orders.inputs(); ++i) {
        F.push_back(monic(theta.segment(orders.f_start(i), orders.nf[i])));
        B.push_back(Vector::Zero(orders.nk[i] + orders.nb[i]));
        B.back().tail(orders.nb[i]) = theta.segment(orders.b_start(i), orders.nb[i]);
    }
}

TransferFunction PolynomialModel::transfer_function(std::size_t input) const {
    const Vector &b = B.at(input), den = multiply(A, F.at(input));
    Index late = b.size() - strip_leading_zeros(b).size();
    late = std::max<Index>(0, late - 1);
    return in_powers_of_z(b.tail(b.size() - late), den, Ts, static_cast<double>(late) * Ts);
}

}  // namespace dynlab::inline numerics
