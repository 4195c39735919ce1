#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "bench/bench.h"
#include "numerics/linalg/types.h"
#include "platform/temporary_folder.h"

namespace dynlab::bench {

/// The programs of tests/bench/peers that do the same in another language. Each checks itself against the reference
/// data before it is timed.
enum class Peer { kNumpy, kOctave };

std::string name_of(Peer peer);
bool installed(Peer peer);  ///< with the libraries the peer needs

/// A data set as the peers read it: a file of N inputs and N outputs. The destructor removes the file.
class PeerData {
  public:
    PeerData(const VectorView& u, const VectorView& y);
    std::filesystem::path file() const { return folder_.path() / "record"; }

  private:
    TemporaryFolder folder_;
};

struct PeerRun {
    double seconds = 0;  ///< median, on one core
    Vector theta;        ///< what it estimated
};

/// Runs a job of numpy_peer.py or octave_peer.m. Throws std::runtime_error with its words when it fails.
PeerRun run_peer(Peer peer, const std::string& job, const PeerData& data_set, int repetitions);

struct Comparison {
    std::string what;
    Peer peer;
    std::string job;
    double bar = 0, goal = 0;  ///< of our seconds / the peer's
    int repetitions = 5, peer_repetitions = 5;
    double tolerance = 1e-5;  ///< largest relative difference of the two estimates
    int calls = 1;            ///< that `work` makes; the row is of one
};

/// Adds the row that compares `work` with the peer's job. `work` runs before the peer and again after it, and returns
/// its estimate. Without the peer, no row is added. Throws std::runtime_error if the two estimates differ.
void compare_with_peer(const Comparison& comparison, const PeerData& data_set, const std::function<Vector()>& work,
                       Report& report);

}  // namespace dynlab::bench
