#include <fmt/format.h>

#include <algorithm>

#include "bench/bench.h"
#include "bench/lua_session.h"
#include "bench/peers.h"

namespace dynlab::bench {
namespace {

/// Data sets of N samples that the session simulates: two poles (d), three poles (d3), two poles with a delay that is
/// not a whole number of samples (dd), and two poles with colored noise (dc).
constexpr char kDataSets[] = R"(
N, Ts = 999000, 0.01
s = tf("s")
G = 2/(s^2 + 4*s + 3)
u = prbs(17, 100):range(1, N)
rng(1)
noise = 0.2*randn(N)
function record(y) return iddata(y, u, Ts) end
d = record(lsim(G, u, Ts) + noise)
short = d:range(1, 1500)
d3 = record(lsim(6/((s + 1)*(s + 2)*(s + 3)), u, Ts) + noise)
dd = record(lsim(tf({2}, {1, 4, 3}, {IODelay = 0.1375}), u, Ts) + noise)
dc = record(lsim(G, u, Ts) + lsim(tf({1, 0.5}, {1, -0.9}, {Ts = Ts}), noise, Ts))
)";

constexpr char kTwoPoles[] = "E = srivc(d, {1, 2, 0}, {lambda = 3})";
constexpr char kSimulation[] = "x = lsim(G, u, Ts)";

/// Of a first call, repeated until two seconds are over: one of many seconds is made once and a short one often.
double seconds_of(LuaSession& session, const std::string& line) {
    constexpr double kEnough = 2;
    constexpr std::size_t kMax = 15;
    std::vector<double> times;
    for (double sum = 0; times.size() < kMax && sum < kEnough; sum += times.back()) {
        session.clear_results();
        times.push_back(median_seconds(1, [&] { session.run(line); }));
    }
    return median(times);
}

/// Adds the row of a line against another one that is measured before and after it.
void compare_lines(LuaSession& session, const Result& row, const std::string& line, const std::string& reference,
                   Report& report, double reference_times = 1) {
    const double before = seconds_of(session, reference), measured = seconds_of(session, line);
    const double after = seconds_of(session, reference);
    Result result = row;
    result.measured = measured;
    result.reference = reference_times * (before + after) / 2;
    report.results.push_back(result);
}

/// Lines that set E, against numpy; a short one is repeated within one measurement.
struct NumpyCall {
    const char *what, *data_set, *line, *job;
    double bar, goal;
    int calls = 1;
};
constexpr NumpyCall kNumpyCalls[] = {
    {"Lua lssvf(d, {2, 1, 0}, 3), N = 1500 (s)", "short", "lssvf(short, {2, 1, 0}, 3)", "lssvf", 1.0 / 20, 1.0 / 60,
     2000},
    {"Lua srivc(d, {1, 2, 0}), N = 1500 (s)", "short", "srivc(short, {1, 2, 0}, {lambda = 3})", "srivc", 1.0 / 40,
     1.0 / 60, 500},
    {"Lua lssvf(d, {2, 1, 0}, 3), N = 999000 (s)", "d", "lssvf(d, {2, 1, 0}, 3)", "lssvf", 1.0 / 100, 1.0 / 150},
    {"Lua srivc(d, {1, 2, 0}), N = 999000 (s)", "d", "srivc(d, {1, 2, 0}, {lambda = 3})", "srivc", 1.0 / 80,
     1.0 / 100}};

void measure_against_numpy(LuaSession& session, Report& report) {
    for (const NumpyCall& call : kNumpyCalls) {
        const std::string data_set = call.data_set;
        const Vector u = session.numbers(data_set + ".u"), y = session.numbers(data_set + ".y");
        const std::string line = fmt::format("for _ = 1, {} do E = {} end", call.calls, call.line);
        const auto work = [&] {
            session.clear_results();
            session.run(line);
            return session.numbers("E.param");
        };
        Comparison comparison{call.what, Peer::kNumpy, call.job, call.bar, call.goal, 11, 21};
        comparison.calls = call.calls;
        compare_with_peer(comparison, {u, y}, work, report);
    }
}

void measure_srivc_calls(LuaSession& session, Report& report) {
    compare_lines(session, {"Lua tfsrivc, 2 poles, IODelay = 0.1375 (s)", "without a delay (s)", 0, 0, 2, 1.3},
                  "tfsrivc(dd, 2, 0, {IODelay = 0.1375, lambda = 3})", kTwoPoles, report);
    constexpr double kPairs = 1.5;
    compare_lines(session, {"Lua srivc, 3 poles (s)", "1.5 times that of 2 poles (s)", 0, 0, 2, 1.3},
                  "srivc(d3, {1, 3, 0}, {lambda = 3})", kTwoPoles, report, kPairs);
}

void measure_validation_calls(LuaSession& session, Report& report) {
    for (const char* line : {"fit(d, G)", "compare(d, G)", "resid(d, G)"})
        compare_lines(session, {std::string("Lua ") + line + ", N = 999000 (s)", "one lsim (s)", 0, 0, 8, 4}, line,
                      kSimulation, report);
}

/// Calls that were slow when these rows were written, and how many times the time of one lsim they took then: a fifth
/// of that is the bar, a tenth the goal.
struct SlowCall {
    const char* line;
    double lsims_before;
};
constexpr SlowCall kSlowCalls[] = {{"procsrivc(d, 'P2')", 9300},
                                   {"rivc(dc, {1, 1, 1, 2, 0})", 1900},
                                   {"armax(dc, {2, 2, 2, 1})", 5800},
                                   {"bj(dc, {2, 1, 1, 2, 1})", 2400},
                                   {"advice(d)", 1450}};

void measure_slow_calls(LuaSession& session, Report& report) {
    for (const auto& [line, lsims_before] : kSlowCalls)
        compare_lines(session,
                      {std::string("Lua ") + line + " (s)", "one lsim (s)", 0, 0, lsims_before / 5, lsims_before / 10},
                      line, kSimulation, report);
}

void measure_saving(LuaSession& session, Report& report) {
    session.run("numbers = randn(2000000) save_mat('numbers.mat', {numbers = numbers})");
    compare_lines(session, {"Lua save_mat, 2e6 numbers (s)", "load of them (s)", 0, 0, 3, 1.5},
                  "save_mat('numbers.mat', {numbers = numbers})", "loaded = load('numbers.mat')", report);
}

}  // namespace

void measure_lua(Report& report) {
    LuaSession session;
    session.run(kDataSets);
    measure_against_numpy(session, report);
    measure_srivc_calls(session, report);
    measure_validation_calls(session, report);
    measure_slow_calls(session, report);
    measure_saving(session, report);
}

}  // namespace dynlab::bench
