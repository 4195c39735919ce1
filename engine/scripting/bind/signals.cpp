#include <array>

#include "numerics/signals/excitation.h"
#include "numerics/signals/prbs.h"
#include "numerics/signals/random_phase_multisine.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/numeric.h"
#include "scripting/conversions/option_member.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/conversions/userdata.h"

namespace dynlab::inline scripting {
namespace {

constexpr std::array kChirpShapes = {"sine", "square"};
constexpr std::array kSineOptions = {
    OptionEntry{"amplitude", ValueKind::kNumber, about("amplitude of the sine"), {.initial = "1"}},
    OptionEntry{"phase", ValueKind::kNumber, about("phase of the sine at time 0"), {.initial = "0", .unit = "rad"}}};
constexpr std::array kChirpOptions = {OptionEntry{
    "shape", ValueKind::kChoice, about("shape of the wave"), {.initial = "\"sine\"", .choices = kChirpShapes}}};
constexpr std::array kMultisineOptions = {
    option<&RandomPhaseOptions::lines>(
        "lines", about("excited lines, in cycles per period, from 1 to less than N/2; line k is at k/(N Ts) hertz")),
    option<&RandomPhaseOptions::odd>(
        "odd", about("true excites only the odd lines; the even lines then show even distortion")),
    option<&RandomPhaseOptions::detection>("detection",
                                           about("number of lines per group. One line of each group, chosen at random, "
                                                 "is not excited and shows odd distortion; 0 for no groups")),
    option<&RandomPhaseOptions::amplitude>("amplitude", about("root mean square of the signal")),
    option<&RandomPhaseOptions::low_crest>("low_crest", about("true selects phases with a low crest factor")),
    OptionEntry{"periods", ValueKind::kCount, about("number of periods"), {.initial = "1", .minimum = 1}},
    OptionEntry{"seed", ValueKind::kCount, about("seed of the phases; by default, the random stream of `rng`")}};
constexpr OptionTable kSineTables[] = {kSineOptions}, kChirpTables[] = {kChirpOptions},
                      kMultisineTables[] = {kMultisineOptions};

constexpr ArgumentEntry kSignalLength = {"N", ValueKind::kCount, about("number of samples")},
                        kSignalHold = {"p", ValueKind::kCount,
                                       about("number of samples for which each value is held; by default 1")},
                        kSignalLevels = {"{low, high}", ValueKind::kVector,
                                         about("levels of the signal; by default {-1, 1}")},
                        kSignalDuration = {"T", ValueKind::kNumber, about("duration in seconds")},
                        kSignalPeriod = {"Ts", ValueKind::kNumber, about("sampling time in seconds")};
constexpr std::array kPrbsArguments = {
    ArgumentEntry{"n", ValueKind::kCount, about("number of stages, 3 to 18; the sequence has 2^n - 1 bits")},
    kSignalHold, kSignalLevels};
constexpr std::array kRbsArguments = {kSignalLength, kSignalHold, kSignalLevels};
constexpr std::array kStepSignalArguments = {
    kSignalLength, ArgumentEntry{"first", ValueKind::kCount, about("sample at which the signal changes; by default 1")},
    ArgumentEntry{"{low, high}", ValueKind::kVector, about("levels before and after the step; by default {0, 1}")}};
constexpr std::array kSineArguments = {ArgumentEntry{"f", ValueKind::kNumber, about("frequency in hertz")},
                                       kSignalDuration, kSignalPeriod};
constexpr std::array kChirpArguments = {ArgumentEntry{"f0", ValueKind::kNumber, about("first frequency in hertz")},
                                        ArgumentEntry{"f1", ValueKind::kNumber, about("last frequency in hertz")},
                                        kSignalDuration, kSignalPeriod};
constexpr std::array kMultisineArguments = {
    ArgumentEntry{"{f1, f2, ...}", ValueKind::kVector, about("distinct frequencies in hertz")},
    ArgumentEntry{"T", ValueKind::kNumber,
                  about("duration in seconds; with an integer number of periods of every sine, the signal can be "
                        "repeated without a jump")},
    kSignalPeriod, ArgumentEntry{"N", ValueKind::kCount, about("number of samples of a period")}};

/// {low, high} of a signal with two levels.
std::pair<double, double> levels(const Call& call, int index, double low, double high) {
    if (!call.given(index)) return {low, high};
    const VectorMap values = call.vector(index, "{low, high}");
    if (values.size() != 2)
        throw InvalidArgument("the levels must be {low, high}, not {}",
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
    require_memory_for_signal(call.state(), static_cast<double>(call.size(1, "N")));
    return call.give_vector(rbs(call.size(1, "N"), static_cast<int>(hold), call.context().random, low, high));
}

int make_step(Call& call) {
    call.at_most(3);
    const auto [low, high] = levels(call, 3, 0, 1);
    require_memory_for_signal(call.state(), static_cast<double>(call.size(1, "N")));
    return call.give_vector(step_signal(call.size(1, "N"), call.given(2) ? call.size(2, "first") : 1, low, high));
}

int make_sine(Call& call) {
    call.at_most(4);
    const Options options(call, 4, kSineTables);
    require_memory_for_signal(call.state(), call.number(2, "T") / call.number(3, "Ts"));
    return call.give_vector(sine(call.number(1, "frequency"), call.number(2, "T"), call.number(3, "Ts"),
                                 options.number("amplitude", 1), options.number("phase", 0)));
}

int make_chirp(Call& call) {
    call.at_most(5);
    const Options options(call, 5, kChirpTables);
    const auto shape =
        options.has("shape") ? static_cast<ChirpShape>(options.choice(kChirpOptions[0])) : ChirpShape::kSine;
    require_memory_for_signal(call.state(), call.number(3, "T") / call.number(4, "Ts"));
    return call.give_vector(
        chirp(call.number(1, "f0"), call.number(2, "f1"), call.number(3, "T"), call.number(4, "Ts"), shape));
}

/// One period of random phases, repeated: multisine(N, {options})
int make_random_phases(Call& call) {
    call.at_most(2);
    const Options options(call, 2, kMultisineTables);
    RandomPhaseOptions requested;
    options.read(requested);
    const Index period = call.size(1, "N"), periods = options.size("periods", 1);
    require_memory_for_signal(call.state(), static_cast<double>(period) * static_cast<double>(periods));
    RandomStream own(static_cast<std::uint32_t>(options.whole("seed", 1)));
    const RandomPhaseMultisine signal =
        random_phase_multisine(period, requested, options.has("seed") ? own : call.context().random);
    call.give_vector(signal.u.replicate(periods, 1));
    give_table(call, "lines", signal.lines, "detection", signal.detection, "crest", signal.crest);
    return 2;
}

/// multisine({f1, f2, ...}, T, Ts), or of random phases
int make_multisine(Call& call) {
    if (call.type(1) == LUA_TNUMBER && !(call.type(2) == LUA_TNUMBER)) return make_random_phases(call);
    call.at_most(3);
    require_memory_for_signal(call.state(), call.number(2, "T") / call.number(3, "Ts"));
    return call.give_vector(multisine(call.vector(1, "frequencies"), call.number(2, "T"), call.number(3, "Ts")));
}

constexpr FunctionEntry kSignalsFunctions[] = {
    {"prbs", "signals", "prbs(n, p, {low, high}) -> u", "Create a pseudo-random binary sequence of n stages",
     guarded<make_prbs>, kNoOptions, kPrbsArguments},
    {"rbs", "signals", "rbs(N, p, {low, high}) -> u", "Create a random binary signal of N samples", guarded<make_rbs>,
     kNoOptions, kRbsArguments},
    {"step_signal", "signals", "step_signal(N, first, {low, high}) -> u", "Create a step of N samples",
     guarded<make_step>, kNoOptions, kStepSignalArguments},
    {"sine", "signals", "sine(f, T, Ts, {options}) -> u", "Create a sine wave", guarded<make_sine>, kSineTables,
     kSineArguments},
    {"chirp", "signals", "chirp(f0, f1, T, Ts, {options}) -> u", "Create a sine or square wave with changing frequency",
     guarded<make_chirp>, kChirpTables, kChirpArguments},
    {"multisine", "signals", "multisine({f1, f2, ...}, T, Ts) -> u; multisine(N, {options}) -> u, grid",
     "Create a multisine with a low crest factor, or one period with random phases", guarded<make_multisine>,
     kMultisineTables, kMultisineArguments},
};

}  // namespace

FunctionEntries signal_functions() {
    return kSignalsFunctions;
}

}  // namespace dynlab::inline scripting
