#include "numerics/signals/random.h"

#include <cmath>
#include <numbers>

namespace dynlab {

namespace {

constexpr std::size_t kWords = 624, kShift = 397;

/// Mixes the upper bit of one word with the lower bits of the next (the "twist" of Matsumoto and Nishimura 1998).
std::uint32_t twist(std::uint32_t upper, std::uint32_t lower) {
    constexpr std::uint32_t kUpperBit = 0x80000000u, kLowerBits = 0x7fffffffu, kMatrix = 0x9908b0dfu;
    const std::uint32_t mixed = (upper & kUpperBit) | (lower & kLowerBits);
    return (mixed >> 1) ^ ((0u - (mixed & 1u)) & kMatrix);  // a branch would be mispredicted every other time
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
    position_ = 0;
}

std::uint32_t RandomStream::next_word() {
    if (position_ == kWords) refill();
    std::uint32_t word = state_[position_++];
    word ^= word >> 11;
    word ^= (word << 7) & 0x9d2c5680u;
    word ^= (word << 15) & 0xefc60000u;
    return word ^ (word >> 18);
}

double RandomStream::uniform() {
    const double high = next_word() >> 5, low = next_word() >> 6;
    return (high * 67108864.0 + low) / 9007199254740992.0;
}

double RandomStream::normal() {
    if (second_normal_) {
        const double value = *second_normal_;
        second_normal_.reset();
        return value;
    }
    const double first = uniform(), second = uniform();
    const double radius = std::sqrt(-2.0 * std::log(1.0 - first));
    const double angle = 2.0 * std::numbers::pi * second;
    second_normal_ = radius * std::sin(angle);
    return radius * std::cos(angle);
}

Vector RandomStream::uniform(Index count) {
    Vector values(count);
    for (double& value : values) value = uniform();
    return values;
}

Vector RandomStream::normal(Index count) {
    Vector values(count);
    for (double& value : values) value = normal();
    return values;
}

}  // namespace dynlab
