#pragma once
#include <string>
#include <vector>

#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// How a signal behaves between its samples: held (zoh) or on straight lines (foh).
enum class Hold { kZoh, kFoh };

/// One uninterrupted record. Rows are samples, columns are channels.
struct Experiment {
    Matrix y;               ///< N x ny outputs
    Matrix u;               ///< N x nu inputs (nu = 0 for a time series)
    Vector t;               ///< sampling instants in time_unit when sampled irregularly, else empty
    double start_time = 0;  ///< time of the first sample
    std::string name;
    Matrix r = Matrix();  ///< N x nr references of the loop under which the record was taken; empty without
};

/// Input-output data as the course's `iddata`: one or several experiments with the same channels and sampling
/// time.
struct IdData {
    std::vector<Experiment> experiments;
    double Ts = 1;  ///< sampling time in seconds; 0 when sampled irregularly
    Hold hold = Hold::kZoh;
    std::vector<std::string> input_names, output_names;  ///< u1.. and y1.. unless given
    std::vector<std::string> input_units, output_units;  ///< empty strings when unknown
    std::string time_unit = "s";

    /// One experiment, regular sampling. `y` and `u` are N x channels. Throws InvalidArgument for rows that
    /// differ, no samples, a NaN or infinite sample (naming channel and position), Ts <= 0.
    IdData(Matrix y, Matrix u, double Ts);
    /// Irregular sampling at strictly increasing instants `t` (N values).
    IdData(Matrix y, Matrix u, const VectorView& t);
    IdData() = default;

    Index sample_count() const;  ///< over all experiments
    Index sample_count(std::size_t experiment) const { return experiments[experiment].y.rows(); }
    Index output_count() const { return experiments.empty() ? 0 : experiments.front().y.cols(); }
    Index input_count() const { return experiments.empty() ? 0 : experiments.front().u.cols(); }
    Index reference_count() const { return experiments.empty() ? 0 : experiments.front().r.cols(); }
    bool regular() const { return Ts > 0; }
    Vector time(std::size_t experiment = 0) const;  ///< N sampling instants of one experiment
    double duration(std::size_t experiment) const;  ///< from its first sample to its last
    /// Ts, or the mean interval between neighbouring samples of all experiments; 1 where none has a second sample.
    double mean_step() const;

    IdData range(Index first,
                 Index last) const;  ///< samples first..last (1-based, inclusive), one experiment
    /// The same, one experiment, taken in a closed loop with the reference `r` (N x nr). Throws InvalidArgument for
    /// another number of samples, or one that is not finite.
    IdData with_reference(Matrix r) const;
    IdData select(const std::vector<Index>& outputs,
                  const std::vector<Index>& inputs) const;   ///< channels, 1-based; references stay
    std::pair<IdData, IdData> split(double fraction) const;  ///< the first part holds round(fraction N) samples
    IdData shifted(Index samples) const;  ///< input delayed by so many samples (the data's ends are cut)
    static IdData merge(const std::vector<IdData>& parts);  ///< several experiments in one object
};

}  // namespace dynlab::inline numerics
