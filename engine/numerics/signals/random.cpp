#include "numerics/signals/random.h"

#include <algorithm>

#include "numerics/signals/box_muller.h"

namespace dynlab::inline numerics {

namespace {

constexpr std::size_t kWords = 624, kShift = 397;

/// Mixes the upper bit of one word with the lower bits of the next (the "twist" of Matsumoto and Nishimura 1998).
std::uint32_t twist(std::uint32_t upper, std::uint32_t lower) {
    constexpr std::uint32_t kUpperBit = 0x80000000u, kLowerBits = 0x7fffffffu, kMatrix = 0x9908b0dfu;
    const std::uint32_t mixed = (upper & kUpperBit) | (lower & kLowerBits);
    return (mixed >> 1) ^ ((0u - (mixed & 1u)) & kMatrix);  // a branch would be mispredicted every other time
}

std::uint32_t tempered(std::uint32_t word) {
    word ^= word >> 11;
    word ^= (word << 7) & 0x9d2c5680u;
    word ^= (word << 15) & 0xefc60000u;
    return word ^ (word >> 18);
}

}  // namespace

RandomStream::RandomStream(std::uint32_t seed) : position_(kWords) {
    constexpr std::uint32_t kMultiplier = 1812433253u;
    state_[0] = seed;
    for (std::size_t i = 1; i < kWords; ++i)
        state_[i] = kMultiplier * (state_[i - 1] ^ (state_[i - 1] >> 30)) + static_cast<std::uint32_t>(i);
}

void RandomStream::refill() {
    constexpr std::size_t kBefore = kWords - kShift;  // words whose partner is not new yet
    for (std::size_t i = 0; i < kBefore; ++i) state_[i] = state_[i + kShift] ^ twist(state_[i], state_[i + 1]);
    for (std::size_t i = kBefore; i + 1 < kWords; ++i)
        state_[i] = state_[i - kBefore] ^ twist(state_[i], state_[i + 1]);
    state_[kWords - 1] = state_[kShift - 1] ^ twist(state_[kWords - 1], state_[0]);
    std::transform(state_.begin(), state_.end(), words_.begin(), tempered);
    position_ = 0;
}

std::uint32_t RandomStream::next_word() {
    if (position_ == kWords) refill();
    return words_[position_++];
}

double RandomStream::uniform() {
    const double high = next_word() >> 5, low = next_word() >> 6;
    return (high * 67108864.0 + low) / 9007199254740992.0;
}

double RandomStream::normal() {
    double value;
    normals(&value, 1);
    return value;
}

void RandomStream::normals(double* values, Index count) {
    Index k = 0;
    if (second_normal_ && count > 0) {
        values[k++] = *second_normal_;
        second_normal_.reset();
    }
    NormalPairs u1{}, u2{}, cosines, sines;
    while (k < count) {
        const int pairs = static_cast<int>(std::min<Index>(kNormalPairs, (count - k + 1) / 2));
        for (int i = 0; i < pairs; ++i) {
            u1[i] = uniform();
            u2[i] = uniform();
        }
        box_muller(u1, u2, cosines, sines);
        for (int i = 0; i < pairs; ++i) {
            values[k++] = cosines[i];
            if (k < count)
                values[k++] = sines[i];
            else
                second_normal_ = sines[i];
        }
    }
}

Vector RandomStream::uniform(Index count) {
    Vector values(count);
    for (double& value : values) value = uniform();
    return values;
}

Vector RandomStream::normal(Index count) {
    Vector values(count);
    normals(values.data(), count);
    return values;
}

}  // namespace dynlab::inline numerics
