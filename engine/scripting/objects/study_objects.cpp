#include "scripting/objects/study_objects.h"

namespace dynlab::inline scripting {

std::size_t Userdata<ArxSelection>::outside_bytes(const ArxSelection& table) {
    return table.candidates.size() * sizeof(ArxCandidate);
}

std::size_t Userdata<MonteCarlo>::outside_bytes(const MonteCarlo& study) {
    std::size_t numbers = 0;
    for (const MonteCarloResult& result : study.results)
        numbers += static_cast<std::size_t>(result.theta.size() + result.std.size() + result.bound.size());
    return numbers * sizeof(double) + study.results.size() * sizeof(MonteCarloResult);
}

std::size_t Userdata<OrderTable>::outside_bytes(const OrderTable& table) {
    std::size_t bytes = 0;
    for (const OrderCandidate& candidate : table.selection.candidates) {
        const auto d = static_cast<std::size_t>(candidate.parameters());
        bytes += sizeof(OrderCandidate) + sizeof(double) * d * (d + candidate.estimate.trace.size());
    }
    return bytes;
}

}  // namespace dynlab::inline scripting
