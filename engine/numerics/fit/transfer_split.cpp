#include "numerics/fit/transfer_split.h"

#include <algorithm>
#include <numeric>

namespace dynlab::inline numerics {

namespace {

// The later of two in the order converged, no progress, iteration limit, diverged, cancelled.
Termination worse(Termination a, Termination b) {
    const auto rank = [](Termination termination) {
        switch (termination) {
            case Termination::kConverged:
                return 0;
            case Termination::kNoProgress:
                return 1;
            case Termination::kIterationLimit:
                return 2;
            case Termination::kDiverged:
                return 3;
            case Termination::kCancelled:
                return 4;
        }
        return 4;
    };
    return rank(a) < rank(b) ? b : a;
}

std::vector<FitIteration> joined_trace(Index parameters, const std::vector<OutputProblem>& problems,
                                       const std::vector<Fit>& estimates) {
    std::size_t length = 0;
    for (const Fit& estimate : estimates) length = std::max(length, estimate.trace.size());
    std::vector<FitIteration> trace(length);
    for (std::size_t k = 0; k < length; ++k) {
        trace[k].theta.resize(parameters);
        for (std::size_t i = 0; i < estimates.size(); ++i) {
            const auto& own = estimates[i].trace;
            const bool empty = own.empty();
            const std::size_t position = std::min(k, empty ? 0 : own.size() - 1);
            trace[k].theta(problems[i].places) = empty ? estimates[i].theta : own[position].theta;
            trace[k].loss += (empty ? estimates[i].loss : own[position].loss) / static_cast<double>(estimates.size());
            if (k < own.size()) trace[k].change = std::max(trace[k].change, own[k].change);
        }
    }
    return trace;
}

}  // namespace

bool outputs_are_separate(const TransferStructure& structure) {
    for (Index output = 1; output < structure.outputs; ++output)
        for (Index input = 0; input < structure.inputs; ++input)
            for (Index i = 0; i < output * structure.inputs; ++i)
                if (structure.channels[static_cast<std::size_t>(i)].denominator ==
                    structure.channel(output, input).denominator)
                    return false;
    return true;
}

OutputProblem output_problem(const IdData& data, const TransferStructure& structure, Index output) {
    std::vector<Index> inputs(static_cast<std::size_t>(structure.inputs));
    std::iota(inputs.begin(), inputs.end(), Index{1});
    OutputProblem problem{data.select({output + 1}, inputs), {}, {}};
    TransferStructure& own = problem.structure;
    own.inputs = structure.inputs;
    own.free_delays = structure.free_delays;
    std::vector<Index> denominators;  // of the whole structure, in the order of the own ones
    for (Index input = 0; input < structure.inputs; ++input) {
        TransferChannel channel = structure.channel(output, input);
        auto known = std::find(denominators.begin(), denominators.end(), channel.denominator);
        if (known == denominators.end()) {
            own.poles.push_back(structure.poles[static_cast<std::size_t>(channel.denominator)]);
            known = denominators.insert(known, channel.denominator);
        }
        channel.denominator = known - denominators.begin();
        own.channels.push_back(channel);
    }
    problem.places.resize(static_cast<std::size_t>(own.parameter_count()));
    const auto place = [&](Index here, Index there, Index count) {
        std::iota(problem.places.begin() + here, problem.places.begin() + here + count, there);
    };
    for (std::size_t d = 0; d < denominators.size(); ++d)
        place(own.a_place(static_cast<Index>(d)), structure.a_place(denominators[d]), own.poles[d]);
    for (Index input = 0; input < structure.inputs; ++input)
        place(own.b_place(0, input), structure.b_place(output, input),
              own.channel(0, input).zeros + 1 + (own.free_delays ? 1 : 0));
    return problem;
}

Fit join_outputs(const TransferStructure& structure, const std::vector<OutputProblem>& problems,
                 const std::vector<Fit>& estimates) {
    const Index count = structure.parameter_count(), outputs = structure.outputs;
    Fit all;
    all.structure = structure;
    all.names = structure.parameter_names();
    all.theta.resize(count);
    all.covariance = Matrix::Zero(count, count);
    all.noise_variance.resize(outputs);
    all.fit_percent.resize(outputs);
    all.start = estimates.front().start;
    all.initial_values.resize(estimates.front().initial_values.size());
    all.offsets.resize(estimates.front().offsets.rows(), outputs);
    all.termination = Termination::kConverged;
    for (std::size_t i = 0; i < estimates.size(); ++i) {
        const Fit& one = estimates[i];
        const auto& places = problems[i].places;
        const Index output = static_cast<Index>(i);
        all.theta(places) = one.theta;
        all.covariance(places, places) = one.covariance;
        all.noise_variance[output] = one.noise_variance[0];
        all.fit_percent[output] = one.fit_percent[0];
        all.offsets.col(output) = one.offsets.col(0);
        for (std::size_t e = 0; e < one.initial_values.size(); ++e) {
            Vector joined(all.initial_values[e].size() + one.initial_values[e].size());
            joined << all.initial_values[e], one.initial_values[e];
            all.initial_values[e] = joined;
        }
        all.loss += one.loss / static_cast<double>(outputs);
        all.condition_number = std::max(all.condition_number, one.condition_number);
        all.termination = worse(all.termination, one.termination);
    }
    all.models = structure.models(all.theta);
    all.trace = joined_trace(count, problems, estimates);
    return all;
}

}  // namespace dynlab::inline numerics
