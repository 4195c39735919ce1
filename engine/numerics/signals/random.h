#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// The course's reproducible source of random numbers: the Mersenne twister MT19937 (Matsumoto and Nishimura
/// 1998), uniforms from 53 bits, normals by Box-Muller in pairs. The same on every machine for equal seeds.
class RandomStream {
  public:
    explicit RandomStream(std::uint32_t seed = 1);

    double uniform();  ///< in [0, 1): ((g >> 5) 2^26 + (g >> 6)) / 2^53 of two draws g
    double normal();   ///< R cos(2 pi U2), then R sin(2 pi U2), with R = sqrt(-2 ln(1 - U1))

    Vector uniform(Index count);
    Vector normal(Index count);

  private:
    std::uint32_t next_word();
    void refill();
    void normals(double* values, Index count);

    std::array<std::uint32_t, 624> state_, words_;  ///< words_: those of state_, tempered
    std::size_t position_ = 0;
    std::optional<double> second_normal_;
};

}  // namespace dynlab::inline numerics
