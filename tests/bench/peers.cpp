#include "bench/peers.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "platform/child_process.h"
#include "platform/program_lookup.h"

namespace dynlab::bench {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(DYNLAB_SOURCE_DIR) / "tests/bench/peers";

ChildResult run_on_one_core(std::vector<std::string> command, const std::string& package) {
    ChildOptions options;
    options.command = std::move(command);
    options.environment = {{"OPENBLAS_NUM_THREADS", "1"}, {"OMP_NUM_THREADS", "1"}, {"PYTHONDONTWRITEBYTECODE", "1"}};
    return run_child(options, package);
}

/// The Python that has numpy and scipy. Debian installs them for its own Python, which may come after another one in
/// PATH.
std::optional<std::string> find_python() {
    for (const char* python : {"/usr/bin/python3", "python3"}) {
        if (!find_program(python)) continue;
        const auto tried = run_on_one_core({python, "-c", "import numpy, scipy.signal"}, "python3-scipy");
        if (tried.exit_code == 0) return python;
    }
    return std::nullopt;
}

const std::optional<std::string>& python() {
    static const std::optional<std::string> found = find_python();
    return found;
}

std::vector<std::string> command_of(Peer peer) {
    if (peer == Peer::kNumpy) return {python().value(), kFolder / "numpy_peer.py"};
    return {"octave-cli", "--norc", kFolder / "octave_peer.m"};
}

PeerRun parse_peer_run(const std::string& output) {
    PeerRun run;
    std::istringstream lines(output);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string name;
        words >> name;
        std::vector<double> values;
        for (double value; words >> value;) values.push_back(value);
        if (name == "theta") run.theta = Eigen::Map<const Vector>(values.data(), static_cast<Index>(values.size()));
        if (name == "seconds" && values.size() == 1) run.seconds = values.front();
    }
    if (run.seconds <= 0) throw std::runtime_error("A peer did not tell its time, but: " + output);
    return run;
}

void must_agree(const Comparison& comparison, const Vector& ours, const Vector& theirs) {
    const bool agree = ours.size() == theirs.size() &&
                       ((ours - theirs).array().abs() <= comparison.tolerance * theirs.array().abs()).all();
    if (agree) return;
    std::ostringstream values;
    values << "dynlab " << ours.transpose() << ", " << name_of(comparison.peer) << " " << theirs.transpose();
    throw std::runtime_error(comparison.what + ": the estimates differ: " + values.str());
}

}  // namespace

std::string name_of(Peer peer) {
    return peer == Peer::kNumpy ? "numpy" : "Octave";
}

bool installed(Peer peer) {
    return peer == Peer::kNumpy ? python().has_value() : find_program("octave-cli").has_value();
}

PeerData::PeerData(const VectorView& u, const VectorView& y) {
    std::ofstream stream(file(), std::ios::binary);
    for (const VectorView* signal : {&u, &y}) {
        stream.write(reinterpret_cast<const char*>(signal->data()),
                     static_cast<std::streamsize>(signal->size() * static_cast<Index>(sizeof(double))));
    }
    stream.close();
    if (!stream) throw std::runtime_error("cannot write " + file().string());
}

PeerRun run_peer(Peer peer, const std::string& job, const PeerData& data_set, int repetitions) {
    std::vector<std::string> command = command_of(peer);
    for (const std::string& argument : {job, data_set.file().string(), std::to_string(repetitions)})
        command.push_back(argument);
    const ChildResult result = run_on_one_core(command, peer == Peer::kNumpy ? "python3-scipy" : "octave");
    if (result.exit_code != 0) throw std::runtime_error(result.output + result.error_output);
    return parse_peer_run(result.output);
}

void compare_with_peer(const Comparison& comparison, const PeerData& data_set, const std::function<Vector()>& work,
                       Report& report) {
    const std::string against = fmt::format("{} ({}, s)", name_of(comparison.peer), comparison.job);
    if (!installed(comparison.peer)) {
        report.left_out.push_back(comparison.what + " against " + against);
        return;
    }
    Vector ours = work();
    const auto repeat = [&] { ours = work(); };
    std::vector<double> times = repeated_seconds(comparison.repetitions, repeat);
    const PeerRun theirs = run_peer(comparison.peer, comparison.job, data_set, comparison.peer_repetitions);
    for (const double time : repeated_seconds(comparison.repetitions, repeat)) times.push_back(time);
    must_agree(comparison, ours, theirs.theta);
    report.results.push_back(
        {comparison.what, against, median(times) / comparison.calls, theirs.seconds, comparison.bar, comparison.goal});
}

}  // namespace dynlab::bench
