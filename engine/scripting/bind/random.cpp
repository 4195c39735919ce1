
#include "scripting/bind/bindings.h"
#include "scripting/conversions/userdata.h"

namespace dynlab::inline scripting {
namespace {

int rng(Call& call) {
    call.at_most(1);
    const std::int64_t seed = call.whole(1, "seed");
    if (seed < 0 || seed > 0xFFFFFFFF)
        throw InvalidArgument("{} must be {}, but {} was given", Message("the seed"),
                              Message("a whole number from 0 to 4294967295"), seed);
    call.context().random = RandomStream(static_cast<std::uint32_t>(seed));
    return 0;
}

/// Fills a vector of n or a matrix of n x m, or gives a single number.
template <double (RandomStream::*kDraw)()>
int draw(Call& call) {
    call.at_most(2);
    RandomStream& random = call.context().random;
    if (call.count() == 0) return call.give((random.*kDraw)());
    const Index rows = call.size(1, "n"), columns = call.given(2) ? call.size(2, "m") : 1;
    NumericBlock& block = columns == 1 ? push_vector(call.state(), rows) : push_matrix(call.state(), rows, columns);
    for (double& value : block.vector()) value = (random.*kDraw)();
    return 1;
}

constexpr FunctionEntry kRandomFunctions[] = {
    {"rng", "random", "rng(seed)", "Set the seed of the random numbers", guarded<rng>},
    {"randn", "random", "randn(n, m) -> v", "Normally distributed random numbers with mean 0 and variance 1",
     guarded<draw<&RandomStream::normal>>},
    {"rand", "random", "rand(n, m) -> v", "Uniformly distributed random numbers in [0, 1)",
     guarded<draw<&RandomStream::uniform>>},
};

}  // namespace

FunctionEntries random_functions() {
    return kRandomFunctions;
}

}  // namespace dynlab::inline scripting
