#pragma once
#include <utility>

namespace dynlab::inline numerics {

/// f(0), ..., f(n - 1) with the place as a constant: only then does the compiler keep what it indexes in registers.
/// For the same end, functions that work on lanes are marked always_inline: GCC leaves lambdas out of long ones.
template <int n, class Function>
[[gnu::always_inline]] inline void repeat(const Function& f) {
    [&]<int... i>(std::integer_sequence<int, i...>) __attribute__((always_inline)) {
        (f(std::integral_constant<int, i>()), ...);
    }
    (std::make_integer_sequence<int, n>());
}

/// Numbers that are worked on together: one machine vector, as wide as the processor has them.
class Lanes {
  public:
#if defined(__AVX512F__)
    static constexpr int kWidth = 8;
#elif defined(__AVX__)
    static constexpr int kWidth = 4;
#else
    static constexpr int kWidth = 2;
#endif
    typedef double Part __attribute__((vector_size(kWidth * sizeof(double))));

    /// tile[j]: the numbers at p[j], p[j + stride], p[j + 2 stride], ..., for j = 0 .. kWidth - 1; stride >= 1. Whole
    /// vectors are loaded and transposed.
    [[gnu::always_inline]] static void gather_tile(const double* p, long stride, Part* tile) {
        typedef double Unaligned
            __attribute__((vector_size(kWidth * sizeof(double)), aligned(sizeof(double)), may_alias));
        Part rows[kWidth];
        repeat<kWidth>([&](auto i) __attribute__((always_inline)) {
            rows[i] = *reinterpret_cast<const Unaligned*>(p + i * stride);
        });
        // In pairs, numbers stay in their half or quarter of a vector; pairs then move as a whole.
        repeat<2>([&](auto column) __attribute__((always_inline)) {
            Part pairs[kWidth / 2];
            repeat<kWidth / 2>([&](auto i) __attribute__((always_inline)) {
                pairs[i] = neighbors<column>(rows[2 * i], rows[2 * i + 1], Places());
            });
            spread<kWidth / 2, 2>(pairs, tile + column);
        });
    }

  private:
    using Places = std::make_integer_sequence<int, kWidth>;

    /// Of two rows, the numbers in the even (first = 0) or odd columns, those of one column side by side.
    template <int first, int... lane>
    [[gnu::always_inline]] static Part neighbors(const Part& a, const Part& b, std::integer_sequence<int, lane...>) {
        return __builtin_shufflevector(a, b, (lane % 2 ? kWidth + lane - 1 + first : lane + first)...);
    }
    /// Of two vectors of pairs, the pairs in even (first = 0) or odd places.
    template <int first, int... lane>
    [[gnu::always_inline]] static Part alternate(const Part& a, const Part& b, std::integer_sequence<int, lane...>) {
        return __builtin_shufflevector(a, b, (4 * (lane / 2) + 2 * first + lane % 2)...);
    }
    /// to[i step]: the i-th pairs of `count` vectors.
    template <int count, int step>
    [[gnu::always_inline]] static void spread(const Part* pairs, Part* to) {
        if constexpr (count == 1) {
            *to = *pairs;
        } else {
            repeat<2>([&](auto place) __attribute__((always_inline)) {
                Part half[count / 2];
                repeat<count / 2>([&](auto i) __attribute__((always_inline)) {
                    half[i] = alternate<place>(pairs[2 * i], pairs[2 * i + 1], Places());
                });
                spread<count / 2, 2 * step>(half, to + place * step);
            });
        }
    }
};

}  // namespace dynlab::inline numerics
