#pragma once
#include <string>
#include <vector>

#include "numerics/models/transfer_function.h"

namespace dynlab::inline numerics {

/// One input-output channel B(p)/A(p) exp(-delay p) of a model.
struct TransferChannel {
    Index denominator = 0;  ///< place in TransferStructure::poles; channels with the same number share their A
    int zeros = 0;          ///< degree m of B, which has m + 1 coefficients
    double delay = 0;       ///< s; with free delays where their search begins
};

/// Which channels of a model have a denominator in common.
enum class Denominators { kPerChannel, kPerOutput, kCommon };

/// The transfer functions of a continuous-time model with ny outputs and nu inputs, before they have values.
/// Parameters are ordered denominator by denominator: its a_1..a_n, then for each channel that uses it b_0..b_m and,
/// when delays are free, the delay (s). One input and one output: [a_1..a_n b_0..b_m (Td)].
struct TransferStructure {
    Index outputs = 1, inputs = 1;
    std::vector<int> poles;                 ///< degree n of each denominator
    std::vector<TransferChannel> channels;  ///< ny nu: all inputs of output 0, then of output 1, ...
    bool free_delays = false;

    /// One input, one output.
    static TransferStructure single(int poles, int zeros, double delay = 0);
    /// `poles`, `zeros` and `delays` (s) have one entry for all channels or one per channel; channels that share a
    /// denominator must ask for equal poles. Throws InvalidArgument for lists of another length and as validate().
    static TransferStructure grid(Index outputs, Index inputs, Denominators sharing, const std::vector<int>& poles,
                                  const std::vector<int>& zeros, const std::vector<double>& delays);

    const TransferChannel& channel(Index output, Index input) const;
    bool single_channel() const { return channels.size() == 1; }
    bool inputs_share_denominator(Index output) const;  ///< all inputs of this output have one A
    bool outputs_share_denominator() const;             ///< there are fewer denominators than outputs

    Index parameter_count() const;
    std::vector<std::string> parameter_names() const;  ///< a1, b0, Td; with _u1, _y1 or _y1u1 where there are several
    Index denominator_start(Index denominator) const;  ///< of a_1 in theta
    Index numerator_start(Index output, Index input) const;  ///< of b_0 in theta
    Index delay_index(Index output, Index input) const;      ///< -1 when delays are fixed

    Vector denominator(const VectorView& theta, Index output, Index input) const;  ///< monic, n + 1
    Vector numerator(const VectorView& theta, Index output, Index input) const;    ///< m + 1
    double delay(const VectorView& theta, Index output, Index input) const;        ///< s
    /// The channels' transfer functions in the order of `channels`.
    std::vector<TransferFunction> models(const VectorView& theta) const;

    /// With the poles and zeros of these models (output by output, `outputs` of them), whose denominators are shared
    /// where they are equal, and their delays, which are free where one of them has any; `theta` becomes their values.
    /// Throws InvalidArgument for a model in discrete time or with more zeros than poles.
    static TransferStructure of_models(const std::vector<TransferFunction>& models, Index outputs, Vector& theta);

    /// Throws InvalidArgument unless 1 <= n, 0 <= m <= n, delays are not negative, and places and counts fit.
    void validate() const;
};

}  // namespace dynlab::inline numerics
