#include "numerics/fit/search_starts.h"

#include <algorithm>
#include <cmath>

#include "numerics/fit/delay_scan.h"
#include "numerics/linalg/polynomial.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kWorse = 1e-9;             // relative; smaller differences are rounding
constexpr double kGained = 1e-4;            // relative; less is no reason for a richer structure
constexpr double kAddedRoots[] = {5, 100};  // over the mean sampling time
constexpr double kApart = 1.5;              // of one added root to the next

bool fewer_poles(TransferStructure& structure) {
    bool any = false;
    for (std::size_t d = 0; d < structure.poles.size(); ++d) {
        if (structure.poles[d] < 2) continue;
        bool fits = true;
        for (const TransferChannel& channel : structure.channels)
            if (channel.denominator == static_cast<Index>(d) && channel.zeros >= structure.poles[d] - 1) fits = false;
        if (!fits) continue;
        --structure.poles[d];
        any = true;
    }
    return any;
}

bool fewer_zeros(TransferStructure& structure) {
    bool any = false;
    for (TransferChannel& channel : structure.channels) {
        if (channel.zeros == 0) continue;
        --channel.zeros;
        any = true;
    }
    return any;
}

/// p times (s + root).
Vector with_root(const Vector& p, double root) {
    return multiply(p, Vector{{1, root}});
}

}  // namespace

std::vector<TransferStructure> poorer_structures(const TransferStructure& structure) {
    std::vector<TransferStructure> all;
    TransferStructure poles = structure, zeros = structure;
    if (fewer_poles(poles)) all.push_back(poles);
    if (fewer_zeros(zeros)) {
        all.push_back(zeros);
        if (fewer_poles(zeros)) all.push_back(zeros);
    }
    return all;
}

Vector enriched(const TransferStructure& poorer, const Vector& poorer_theta, const TransferStructure& structure,
                double fast, double middle) {
    Vector theta = Vector::Zero(structure.parameter_count());
    for (std::size_t d = 0; d < structure.poles.size(); ++d) {
        const int added_poles = structure.poles[d] - poorer.poles[d];
        int shared = added_poles;  // poles that meet a zero in every channel
        for (std::size_t c = 0; c < structure.channels.size(); ++c)
            if (structure.channels[c].denominator == static_cast<Index>(d))
                shared = std::min(shared, structure.channels[c].zeros - poorer.channels[c].zeros);
        for (Index output = 0; output < structure.outputs; ++output)
            for (Index input = 0; input < structure.inputs; ++input) {
                const TransferChannel& channel = structure.channel(output, input);
                if (channel.denominator != static_cast<Index>(d)) continue;
                Vector A = poorer.denominator(poorer_theta, output, input);
                Vector B = poorer.numerator(poorer_theta, output, input);
                const int added_zeros = channel.zeros - poorer.channel(output, input).zeros;
                const auto added_root = [&](int i) {
                    return i < shared ? middle * std::pow(kApart, i) : fast * std::pow(kApart, i - shared);
                };
                for (int i = 0; i < added_poles; ++i) A = with_root(A, added_root(i));
                for (int i = 0; i < added_zeros; ++i) B = with_root(B, added_root(i));
                for (int i = shared; i < added_poles; ++i) B *= added_root(i);
                for (int i = shared; i < added_zeros; ++i) B /= added_root(i);
                theta.segment(structure.denominator_start(channel.denominator), A.size() - 1) = A.tail(A.size() - 1);
                theta.segment(structure.numerator_start(output, input), B.size()) = B;
            }
    }
    return theta;
}

AddedRoots::AddedRoots(const IdData& data) {
    constexpr double kSlow = 4;
    double longest = 0;
    for (std::size_t e = 0; e < data.experiments.size(); ++e) longest = std::max(longest, data.duration(e));
    rate_ = 1 / data.mean_step();
    slowest_ = kSlow / (longest + data.mean_step());
}

std::vector<Vector> AddedRoots::starts(const TransferStructure& poorer, const Vector& theta,
                                       const TransferStructure& structure) const {
    std::vector<Vector> starts;
    for (const double speed : kAddedRoots) {
        const double fast = speed * rate_;
        starts.push_back(enriched(poorer, theta, structure, fast, std::sqrt(fast * slowest_)));
    }
    return starts;
}

std::vector<Vector> starts_from_poorer(const IdData& data, const std::vector<const Fit*>& poorer,
                                       const TransferStructure& structure, double loss) {
    const AddedRoots added(data);
    std::vector<Vector> all;
    for (const Fit* fit : poorer) {
        if (!(fit->loss < (1 - kWorse) * loss)) continue;
        TransferStructure at = with_fixed_delays(structure);
        const TransferStructure theirs = with_delays_of(fit->structure, fit->theta);
        for (std::size_t c = 0; c < at.channels.size(); ++c) at.channels[c].delay = theirs.channels[c].delay;
        for (const Vector& start : added.starts(fit->structure, fit->theta, at))
            all.push_back(structure.free_delays ? with_delays(structure, at, start) : start);
    }
    return all;
}

NestedSearch::NestedSearch(const IdData& data, Solve solve) : solve_(std::move(solve)), added_(data) {}

std::vector<Vector> NestedSearch::better_starts(const TransferStructure& structure, double loss) {
    std::vector<Vector> starts;
    for (const TransferStructure& poorer : poorer_structures(structure)) {
        const NestedSolution& solution = best(poorer);
        if (!(solution.loss < (1 - kWorse) * loss)) continue;
        for (Vector& start : added_.starts(solution.structure, solution.theta, structure))
            starts.push_back(std::move(start));
    }
    return starts;
}

const NestedSolution& NestedSearch::best(const TransferStructure& structure) {
    std::vector<int> key = structure.poles;
    for (const TransferChannel& channel : structure.channels) key.push_back(channel.zeros);
    const auto known = found_.find(key);
    if (known != found_.end()) return known->second;
    NestedSolution solution = solve_(structure, {});
    solution.structure = structure;
    const std::vector<Vector> starts = better_starts(structure, solution.loss);
    if (!starts.empty()) {
        NestedSolution other = solve_(structure, starts);
        if (other.loss < solution.loss) solution = {std::move(other.theta), other.loss, structure};
    }
    for (const TransferStructure& poorer : poorer_structures(structure))
        if (const NestedSolution& less = best(poorer); (1 - kGained) * less.loss <= solution.loss) solution = less;
    return found_.emplace(std::move(key), std::move(solution)).first->second;
}

}  // namespace dynlab::inline numerics
