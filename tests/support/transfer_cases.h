#pragma once
#include "numerics/models/transfer_structure.h"
#include "numerics/signals/iddata.h"
#include "numerics/signals/prbs.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"
#include "support/reference_data.h"

namespace dynlab::test {

/// A data set of tests/reference/data with columns t, u, y.
inline IdData reference_data(const std::string& name, double Ts) {
    const auto columns = reference_columns(name + ".csv");
    const auto &y = columns.at("y"), &u = columns.at("u");
    const Index N = static_cast<Index>(y.size());
    return IdData(Matrix(Vector::Map(y.data(), N)), Matrix(Vector::Map(u.data(), N)), Ts);
}

inline Vector values(std::initializer_list<double> list) {
    return Vector::Map(list.begin(), static_cast<Index>(list.size()));
}

/// The course's system 2/(s^2 + 4s + 3), prbs(4, 100), Ts = 0.01 s, N = 1500, with white noise.
inline IdData course_system_data(double sigma, std::uint32_t seed) {
    const Vector u = prbs(4, 100, -1, 1);
    Vector y = lsim(TransferFunction(values({2}), values({1, 4, 3})), u, 0.01);
    if (sigma > 0) y += sigma * RandomStream(seed).normal(u.size());
    return IdData(Matrix(y), Matrix(u), 0.01);
}

/// 3 exp(-0.62 s)/(s^2 + 1.5s + 3), prbs(7, 5), Ts = 0.1 s, with some white noise.
inline IdData delayed_data() {
    const Vector u = prbs(7, 5);
    const Vector y = lsim(TransferFunction(values({3}), values({1, 1.5, 3}), 0, 0.62), u, 0.1) +
                     0.1 * RandomStream(4).normal(u.size());
    return IdData(Matrix(y), Matrix(u), 0.1);
}

/// Largest relative difference of two vectors.
inline double relative_difference(const Vector& a, const Vector& b) {
    return ((a - b).array() / b.array()).abs().maxCoeff();
}

}  // namespace dynlab::test
