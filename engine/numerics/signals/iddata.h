#pragma once
#include <string>
#include <vector>

#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// How a signal behaves between its samples: held (zoh) or linearly interpolated (foh).
enum class Hold { kZoh, kFoh };

/// Data of one uninterrupted experiment. Rows are samples, columns are channels.
struct Experiment {
    Matrix y;               ///< N x ny outputs
    Matrix u;               ///< N x nu inputs (nu = 0 for a time series)
    Vector t;               ///< sampling instants in time_unit when sampled irregularly, else empty
    double start_time = 0;  ///< time of the first sample, in time_unit
    std::string name;
    Matrix r = Matrix();  ///< N x nr references of the control loop in which the data were recorded; empty without a
                          ///< loop
};

/// Input-output data as the course's `iddata`: one or several experiments with the same channels and sampling
/// time.
struct IdData {
    std::vector<Experiment> experiments;
    double Ts = 1;  ///< sampling time in time_unit; 0 when sampled irregularly
    Hold hold = Hold::kZoh;
    std::vector<std::string> input_names, output_names;  ///< default: u1.. and y1..
    std::vector<std::string> input_units, output_units;  ///< empty strings when unknown
    std::string time_unit = "s";                         ///< of all times here; models found from the data count in it

    /// One experiment, regular sampling. `y` and `u` are N x channels. Throws InvalidArgument for rows that
    /// differ, no samples, a NaN or infinite sample (naming channel and position), Ts <= 0.
    IdData(Matrix y, Matrix u, double Ts);
    /// Irregular sampling at strictly increasing instants `t` (N values).
    IdData(Matrix y, Matrix u, const VectorView& t);

    // Compiled once (iddata.cpp): most sources copy or destroy data.
    IdData();
    IdData(const IdData&);
    IdData(IdData&&) noexcept;
    IdData& operator=(const IdData&);
    IdData& operator=(IdData&&) noexcept;
    ~IdData();

    Index sample_count() const;  ///< over all experiments
    Index sample_count(std::size_t experiment) const { return experiments[experiment].y.rows(); }
    Index output_count() const { return experiments.empty() ? 0 : experiments.front().y.cols(); }
    Index input_count() const { return experiments.empty() ? 0 : experiments.front().u.cols(); }
    Index reference_count() const { return experiments.empty() ? 0 : experiments.front().r.cols(); }
    bool regular() const { return Ts > 0; }
    Vector time(std::size_t experiment = 0) const;  ///< N sampling instants of one experiment, in time_unit
    double duration(std::size_t experiment) const;  ///< from its first sample to its last, in time_unit
    /// Ts, or the mean interval between neighboring samples of all experiments; 1 where none has a second sample.
    double mean_step() const;

    /// Samples first..last (1-based, inclusive). Throws InvalidArgument for several experiments or samples outside.
    IdData range(Index first, Index last) const;
    /// The same, one experiment, taken in a closed loop with the reference `r` (N x nr). Throws InvalidArgument for
    /// another number of samples, or one that is not finite.
    IdData with_reference(Matrix r) const;
    /// Channels, 1-based; references stay. Throws InvalidArgument for no output and for channels that are not there.
    IdData select(const std::vector<Index>& outputs, const std::vector<Index>& inputs) const;
    /// One experiment in two; the first part holds round(fraction N) samples. Throws InvalidArgument for an empty part.
    std::pair<IdData, IdData> split(double fraction) const;
    /// Input delayed by so many samples (the data's ends are cut). Throws InvalidArgument for irregular sampling.
    IdData shifted(Index samples) const;
    /// Several experiments in one object. Throws InvalidArgument for other channels, sampling, hold, or units of time
    /// or (where both are known) of a channel.
    static IdData merge(const std::vector<IdData>& parts);
};

}  // namespace dynlab::inline numerics
