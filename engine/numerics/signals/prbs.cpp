#include "numerics/signals/prbs.h"

#include <array>
#include <cstdint>

#include "numerics/error.h"

namespace dynlab::inline numerics {

namespace {

constexpr int kMinStages = 3, kMaxStages = 18;

/// The register as bits, stage 1 the lowest: the stages whose exclusive-or is fed back, for 3 to 18 stages.
constexpr std::uint32_t stage_mask(std::array<int, 4> stages) {
    std::uint32_t mask = 0;
    for (const int stage : stages)
        if (stage > 0) mask |= 1u << (stage - 1);
    return mask;
}

constexpr std::array<std::uint32_t, kMaxStages - kMinStages + 1> kFeedback = {
    stage_mask({3, 2}),   stage_mask({4, 3}),          stage_mask({5, 3}),        stage_mask({6, 5}),
    stage_mask({7, 6}),   stage_mask({8, 6, 5, 4}),    stage_mask({9, 5}),        stage_mask({10, 7}),
    stage_mask({11, 9}),  stage_mask({12, 6, 4, 1}),   stage_mask({13, 4, 3, 1}), stage_mask({14, 5, 3, 1}),
    stage_mask({15, 14}), stage_mask({16, 15, 13, 4}), stage_mask({17, 14}),      stage_mask({18, 11})};

std::uint32_t parity(std::uint32_t bits) {
    std::uint32_t odd = 0;
    for (; bits != 0; bits >>= 1) odd ^= bits & 1u;
    return odd;
}

}  // namespace

Vector prbs(int stages, int hold, double low, double high) {
    if (stages < kMinStages || stages > kMaxStages)
        throw InvalidArgument("prbs: the number of stages must be between 3 and 18, but it is {}", stages);
    if (hold < 1) throw InvalidArgument("prbs: each bit must be held for at least 1 sample, but p is {}", hold);
    const std::uint32_t feedback = kFeedback[static_cast<std::size_t>(stages - kMinStages)];
    const std::uint32_t all = (1u << stages) - 1;
    std::uint32_t bits = all;
    Vector signal(static_cast<Index>(all) * hold);
    for (Index bit = 0; bit < static_cast<Index>(all); ++bit) {
        const bool last_stage = ((bits >> (stages - 1)) & 1u) != 0;
        signal.segment(bit * hold, hold).setConstant(last_stage ? high : low);
        bits = ((bits << 1) | parity(bits & feedback)) & all;
    }
    return signal;
}

}  // namespace dynlab::inline numerics
