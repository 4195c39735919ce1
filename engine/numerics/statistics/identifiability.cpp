#include "numerics/statistics/identifiability.h"

#include <cmath>

#include "numerics/linalg/decompositions.h"

namespace dynlab::inline numerics {
namespace {

constexpr double kNoEffect = 1e-10;    // of what the outputs vary
constexpr double kAmbiguous = 1.5e-8;  // of the largest singular value
constexpr double kTakesPart = 1e-3;    // in a singular vector

/// "m +1 %, k -2 %": joint changes of the parameters. The most changed parameter changes by one per cent (or by one, at
/// zero).
MessageList changes_text(const std::vector<std::string>& names, const Vector& changes, const Vector& theta) {
    MessageList list;
    const double unit = 1 / changes.cwiseAbs().maxCoeff();
    for (Index i = 0; i < changes.size(); ++i) {
        const double change = changes[i] * unit * (changes[0] < 0 ? -1 : 1);
        const std::string name = names[static_cast<std::size_t>(i)] + (change > 0 ? " +" : " -");
        const Number size = significant(std::abs(change), 3);
        list.items.push_back(theta[i] == 0 ? Message("{}{}", name, size) : Message("{}{} %", name, size));
    }
    return list;
}

}  // namespace

Ambiguity find_ambiguity(const MatrixView& J, const std::vector<std::string>& names, const VectorView& theta,
                         double spread) {
    Ambiguity found;
    found.parameters.assign(names.size(), false);
    if (!J.allFinite() || J.cols() == 0) return found;
    std::vector<std::string> idle;
    std::vector<Index> active;
    for (Index i = 0; i < J.cols(); ++i) {
        const double length = J.col(i).norm(), effect = theta[i] == 0 ? length : length * std::abs(theta[i]);
        const bool none = length == 0 || (theta[i] != 0 && effect <= kNoEffect * spread);
        if (none) {
            idle.push_back(names[static_cast<std::size_t>(i)]);
            found.parameters[static_cast<std::size_t>(i)] = true;
        } else {
            active.push_back(i);
        }
    }
    if (!idle.empty())
        found.sentences.push_back(
            Message("The outputs of these data do not depend on {}. Fix every such parameter, or excite the system so "
                    "that the parameter has an effect.",
                    listed(idle)));
    if (active.size() < 2) return found;
    Matrix scaled = J(Eigen::all, active);
    const Vector lengths = scaled.colwise().norm();
    scaled *= lengths.cwiseInverse().asDiagonal();
    const SingularValues parts = jacobi_svd(triangular_part(scaled));
    for (Index k = parts.s.size() - 1; k >= 0 && parts.s[k] <= kAmbiguous * parts.s[0]; --k) {
        const Vector v = parts.V.col(k);
        std::vector<std::string> involved;
        std::vector<double> changes, values;
        for (Index j = 0; j < v.size(); ++j) {
            const Index i = active[static_cast<std::size_t>(j)];
            if (std::abs(v[j]) < kTakesPart * v.cwiseAbs().maxCoeff()) continue;
            found.parameters[static_cast<std::size_t>(i)] = true;
            involved.push_back(names[static_cast<std::size_t>(i)]);
            changes.push_back(v[j] / (lengths[j] * (theta[i] == 0 ? 1 : std::abs(theta[i]))));
            values.push_back(theta[i]);
        }
        const auto size = static_cast<Index>(changes.size());
        found.sentences.push_back(Message(
            "The data cannot separate {}: the outputs do not change when these parameters change together ({}). Fix "
            "one of them.",
            listed(involved),
            changes_text(involved, Eigen::Map<Vector>(changes.data(), size), Eigen::Map<Vector>(values.data(), size))));
    }
    return found;
}

}  // namespace dynlab::inline numerics
