#include "numerics/rigs/seeded_prbs.h"

#include <cmath>

#include "numerics/signals/prbs.h"

namespace dynlab::inline numerics {

Vector seeded_prbs(int stages, int hold, double low, double high, RandomStream& random) {
    const Vector bits = prbs(stages, 1, 0, 1);
    const Index count = bits.size();
    const auto first = static_cast<Index>(std::floor(random.uniform() * static_cast<double>(count)));
    const Index direction = random.uniform() < 0.5 ? 1 : count - 1;
    const bool exchanged = random.uniform() < 0.5;
    Vector u(count * hold);
    for (Index k = 0; k < count; ++k) {
        const bool one = bits[(first + direction * k) % count] > 0.5;
        u.segment(k * hold, hold).setConstant(one != exchanged ? high : low);
    }
    return u;
}

}  // namespace dynlab::inline numerics
