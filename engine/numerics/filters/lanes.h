#pragma once
#if defined(__AVX__)
#include <immintrin.h>
#endif
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

/// Eight numbers that are worked on together, in as many machine vectors as the processor's width asks for. (One
/// vector of eight is no good: where the processor has narrower ones, GCC 12 takes it apart number by number.)
class Lanes {
  public:
    static constexpr int kCount = 8;
#if defined(__AVX512F__)
    static constexpr int kWidth = 8;
#elif defined(__AVX__)
    static constexpr int kWidth = 4;
#else
    static constexpr int kWidth = 2;
#endif
    typedef double Part __attribute__((vector_size(kWidth * sizeof(double))));
    static constexpr int kParts = kCount / kWidth;

    Lanes() : part_{} {}
    // Written out because GCC 12 copies a class through memory, and the filters would wait for it at every step.
    Lanes(const Lanes& x) {
        *this = x;
    }
    Lanes& operator=(const Lanes& x) {
        for (int i = 0; i < kParts; ++i) part_[i] = x.part_[i];
        return *this;
    }

    /// The numbers at p[0], p[stride], ..., as many as a part holds; stride >= 1.
    [[gnu::always_inline]] static Part gather_part(const double* p, long stride) {
#if defined(__AVX__) && !defined(__AVX512F__)
        // By number, the moves would keep a unit busy that multiplies. So two neighbours are loaded at a time, of which
        // one is wanted, and always between p[0] and p[3 stride].
        const auto pairs = [](const double* a, const double* b) {
            return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(a)), _mm_loadu_pd(b), 1);
        };
        return _mm256_blend_pd(pairs(p, p + 2 * stride), pairs(p + stride - 1, p + 3 * stride - 1), 0b1010);
#else
        Part part;
        for (int lane = 0; lane < kWidth; ++lane) part[lane] = p[lane * stride];
        return part;
#endif
    }
    /// tile[j] = gather_part(p + j, stride) for j = 0 .. kWidth - 1: whole vectors are loaded and transposed.
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
                pairs[i] = neighbours<column>(rows[2 * i], rows[2 * i + 1], Places());
            });
            spread<kWidth / 2, 2>(pairs, tile + column);
        });
    }
    /// The numbers at p[0], p[stride], ..., p[7 stride]; stride >= 1.
    static Lanes gather(const double* p, long stride) {
        Lanes lanes;
        for (int i = 0; i < kParts; ++i) lanes.part_[i] = gather_part(p + i * kWidth * stride, stride);
        return lanes;
    }

    Part part(int i) const {
        return part_[i];
    }
    Part& part(int i) {
        return part_[i];
    }
    double operator[](int lane) const {
        return part_[lane / kWidth][lane % kWidth];
    }
    void set(int lane, double value) {
        part_[lane / kWidth][lane % kWidth] = value;
    }

    Lanes times(double weight) const {
        Lanes product;
        for (int i = 0; i < kParts; ++i) product.part_[i] = weight * part_[i];
        return product;
    }
    /// this += weight x
    void add(double weight, const Lanes& x) {
        for (int i = 0; i < kParts; ++i) part_[i] += weight * x.part_[i];
    }
    Lanes& operator+=(const Lanes& x) {
        for (int i = 0; i < kParts; ++i) part_[i] += x.part_[i];
        return *this;
    }
    double sum() const {
        double total = 0;
        for (int lane = 0; lane < kCount; ++lane) total += (*this)[lane];
        return total;
    }

  private:
    using Places = std::make_integer_sequence<int, kWidth>;

    /// Of two rows, the numbers in the even (first = 0) or odd columns, those of one column side by side.
    template <int first, int... lane>
    [[gnu::always_inline]] static Part neighbours(const Part& a, const Part& b, std::integer_sequence<int, lane...>) {
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

    Part part_[kParts];
};

}  // namespace dynlab::inline numerics
