#pragma once
#include "numerics/estimators/lssvf.h"
#include "numerics/fit/recursive/recursive_pass.h"
#include "support/transfer_cases.h"

namespace dynlab::test {

inline SvfOptions cutoff(double lambda) {
    SvfOptions options;
    options.lambda = lambda;
    return options;
}

inline RecursiveOptions recursive(double lambda) {
    RecursiveOptions options;
    options.lambda = lambda;
    return options;
}

struct RecursiveCase {
    const char* name;
    IdData data;
    TransferStructure structure;
    double lambda;
};

/// Regular and irregular sampling, held and straight inputs, whole delays, direct terms, one to four poles.
inline std::vector<RecursiveCase> recursive_cases() {
    const IdData course = course_system_data(0.1, 3);
    IdData straight = course;
    straight.hold = Hold::kFoh;
    Vector t = course.time();
    for (Index k = 0; k < t.size(); ++k) t[k] += 0.003 * static_cast<double>(k % 3);
    const IdData irregular(course.experiments[0].y, course.experiments[0].u, t);
    return {{"two poles", course, TransferStructure::single(2, 0), 3},
            {"a zero", course, TransferStructure::single(2, 1), 3},
            {"direct feedthrough", course, TransferStructure::single(2, 2), 3},
            {"a delay", course, TransferStructure::single(2, 0, 0.07), 3},
            {"a delay and direct feedthrough", straight, TransferStructure::single(2, 2, 0.07), 3},
            {"straight lines", straight, TransferStructure::single(2, 1), 3},
            {"irregular", irregular, TransferStructure::single(2, 0), 3},
            {"one pole", course, TransferStructure::single(1, 0), 2},
            {"four poles", delayed_data(), TransferStructure::single(4, 1, 0.6), 2}};
}

/// 2/(s + 1) whose numerator jumps to 4 in the middle, prbs(7, 20), Ts = 0.05 s, with a little noise.
inline IdData jumping_data() {
    const Vector u = prbs(7, 20);
    Vector gain = Vector::Constant(u.size(), 2);
    gain.tail(u.size() / 2).setConstant(4);
    const Vector y = lsim(TransferFunction(values({1}), values({1, 1})), gain.cwiseProduct(u), 0.05) +
                     0.01 * RandomStream(7).normal(u.size());
    return IdData(Matrix(y), Matrix(u), 0.05);
}

}  // namespace dynlab::test
