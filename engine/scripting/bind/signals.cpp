
#include "numerics/signals/excitation.h"
#include "numerics/signals/prbs.h"
#include "numerics/signals/random_phase_multisine.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/boxed.h"
#include "scripting/conversions/numeric.h"
#include "scripting/conversions/table_fields.h"

namespace dynlab::inline scripting {
namespace {

/// {low, high} of a signal with two levels.
std::pair<double, double> levels(const Call& call, int index, double low, double high) {
    if (!call.given(index)) return {low, high};
    const VectorMap values = call.vector(index, "{low, high}");
    if (values.size() != 2)
        throw InvalidArgument("the levels are written {low, high}, not {}",
                              plural(values.size(), "{} number", "{} numbers"));
    return {values[0], values[1]};
}

int make_prbs(Call& call) {
    call.at_most(3);
    const auto [low, high] = levels(call, 3, -1, 1);
    const Index hold = call.given(2) ? call.size(2, "p") : 1;
    return call.give_vector(prbs(static_cast<int>(call.size(1, "n")), static_cast<int>(hold), low, high));
}

int make_rbs(Call& call) {
    call.at_most(3);
    const auto [low, high] = levels(call, 3, -1, 1);
    const Index hold = call.given(2) ? call.size(2, "p") : 1;
    need_room_for_signal(call.state(), static_cast<double>(call.size(1, "N")));
    return call.give_vector(rbs(call.size(1, "N"), static_cast<int>(hold), call.context().random, low, high));
}

int make_step(Call& call) {
    call.at_most(3);
    const auto [low, high] = levels(call, 3, 0, 1);
    need_room_for_signal(call.state(), static_cast<double>(call.size(1, "N")));
    return call.give_vector(step_signal(call.size(1, "N"), call.given(2) ? call.size(2, "first") : 1, low, high));
}

int make_sine(Call& call) {
    call.at_most(4);
    const Options options(call, 4, {"amplitude", "phase"});
    need_room_for_signal(call.state(), call.number(2, "T") / call.number(3, "Ts"));
    return call.give_vector(sine(call.number(1, "frequency"), call.number(2, "T"), call.number(3, "Ts"),
                                 options.number("amplitude", 1), options.number("phase", 0)));
}

int make_chirp(Call& call) {
    call.at_most(5);
    const Options options(call, 5, {"shape"});
    const ChirpShape shape =
        options.choice("shape", {"sine", "square"}, 0) == 0 ? ChirpShape::kSine : ChirpShape::kSquare;
    need_room_for_signal(call.state(), call.number(3, "T") / call.number(4, "Ts"));
    return call.give_vector(
        chirp(call.number(1, "f0"), call.number(2, "f1"), call.number(3, "T"), call.number(4, "Ts"), shape));
}

/// One period of random phases, repeated: multisine(N, {options})
int make_random_phases(Call& call) {
    call.at_most(2);
    const Options options(call, 2, {"lines", "odd", "detection", "amplitude", "low_crest", "periods", "seed"});
    RandomPhaseOptions wanted;
    if (options.has("lines")) wanted.lines = options.vector("lines");
    wanted.odd = options.flag("odd", false);
    wanted.detection = options.size("detection", 0);
    wanted.amplitude = options.number("amplitude", 1);
    wanted.low_crest = options.flag("low_crest", false);
    const Index period = call.size(1, "N"), periods = options.size("periods", 1);
    if (periods < 1) refuse_option("periods", Message("at least 1"), Message("{}", periods));
    need_room_for_signal(call.state(), static_cast<double>(period) * static_cast<double>(periods));
    RandomStream own(static_cast<std::uint32_t>(options.size("seed", 1)));
    const RandomPhaseMultisine signal =
        random_phase_multisine(period, wanted, options.has("seed") ? own : call.context().random);
    call.give_vector(signal.u.replicate(periods, 1));
    give_table(call, "lines", signal.lines, "detection", signal.detection, "crest", signal.crest);
    return 2;
}

/// multisine({f1, f2, ...}, T, Ts), or of random phases
int make_multisine(Call& call) {
    if (call.type(1) == LUA_TNUMBER && !(call.type(2) == LUA_TNUMBER)) return make_random_phases(call);
    call.at_most(3);
    need_room_for_signal(call.state(), call.number(2, "T") / call.number(3, "Ts"));
    return call.give_vector(multisine(call.vector(1, "frequencies"), call.number(2, "T"), call.number(3, "Ts")));
}

constexpr FunctionEntry kSignalsFunctions[] = {
    {"prbs", "signals", "prbs(n, p, {low, high}) -> u",
     "pseudo-random binary sequence of n stages, each bit held for p samples", guarded<make_prbs>},
    {"rbs", "signals", "rbs(N, p, {low, high}) -> u",
     "N samples of a random binary signal, each value held for p samples", guarded<make_rbs>},
    {"step_signal", "signals", "step_signal(N, first, {low, high}) -> u",
     "N samples that change from low to high at sample `first`", guarded<make_step>},
    {"sine", "signals", "sine(f, T, Ts, {amplitude =, phase =}) -> u", "a sine of f hertz for T seconds",
     guarded<make_sine>},
    {"chirp", "signals", "chirp(f0, f1, T, Ts, {shape = \"sine\" | \"square\"}) -> u",
     "a sine or square wave whose frequency (hertz) runs from f0 to f1", guarded<make_chirp>},
    {"multisine", "signals",
     "multisine({f1, f2, ...}, T, Ts) -> u; multisine(N, {lines =, odd =, detection =, ...}) -> u, grid",
     "a sum of sines: with low peaks, or one period of random phases", guarded<make_multisine>},
};

}  // namespace

FunctionEntries signal_functions() {
    return kSignalsFunctions;
}

}  // namespace dynlab::inline scripting
