#include "numerics/criteria/reparametrized.h"

#include <algorithm>
#include <utility>

namespace dynlab::inline numerics {

Reparametrized::Reparametrized(const OutputErrorModel& inner, Map map, Vector lower, Vector upper)
    : inner_(inner), map_(std::move(map)) {
    lower_ = std::move(lower), upper_ = std::move(upper);
}

void Reparametrized::simulate(const Vector& theta, Vector& output, Matrix* sensitivities) const {
    const Point point = map_(theta);
    if (sensitivities == nullptr) {
        inner_.simulate(point.inner, output, nullptr);
        return;
    }
    constexpr Index kRowsTogether = 1024;  // they stay in the processor's cache
    Matrix of_inner;
    inner_.simulate(point.inner, output, &of_inner);
    sensitivities->resize(output.size(), theta.size());
    for (Index row = 0; row < output.size(); row += kRowsTogether) {
        const Index rows = std::min(kRowsTogether, output.size() - row);
        sensitivities->middleRows(row, rows).noalias() = of_inner.middleRows(row, rows) * point.derivatives;
    }
}

OutputErrorProducts Reparametrized::products(const Vector& theta, const VectorView& y) const {
    const Point point = map_(theta);
    const Matrix& T = point.derivatives;
    const OutputErrorProducts inner = inner_.products(point.inner, y);
    return {inner.squares, T.transpose() * inner.gram * T, T.transpose() * inner.descent};
}

}  // namespace dynlab::inline numerics
