#pragma once
#include <functional>
#include "numerics/fit/fit.h"
#include "numerics/models/state_space.h"

namespace dynlab::inline numerics {

struct DmdcOptions {
    int rank = 0;    ///< r, states of the model; 0: the number of singular values above rounding
    int delays = 1;  ///< d, samples of outputs and inputs that make up a snapshot; 1: the outputs alone
    std::function<bool()> cancel = {};  ///< asked before every decomposition; then it throws

    /// Throws InvalidArgument naming the option.
    void validate() const;
};

/// A fit with states and without theta. Of the Fit these are given: models (output by output), fit_percent,
/// condition_number and loss of the simulation from the first snapshot, start, warnings and message.
struct DmdcFit {
    Fit fit;
    StateSpace system;          ///< order r, discrete time, D = 0
    Vector singular_values;     ///< of all next snapshots, falling: a gap after the r-th speaks for rank r
    ComplexVector eigenvalues;  ///< of A
    int rank = 0, delays = 1;   ///< r and d as they were used
};

/// Dynamic mode decomposition with inputs. Snapshots z(k) hold the outputs y(k), .., y(k-d+1) and the inputs u(k-1),
/// .., u(k-d+1), each channel in units of its root mean square; z(k+1) = A z(k) + B u(k) is solved by least squares
/// over all neighboring snapshots with the singular value decomposition of [z; u], cut to r + nu directions, and
/// projected on the r left singular vectors of the next snapshots: x = U' z, y(k) the first rows of U x. With d = n a
/// noise-free linear system of order n is found exactly from one output. It minimizes errors one step ahead, so noise
/// on the outputs biases it, as it does arx. Means are not taken off: detrend the data first where they have an
/// operating point. Data: any number of outputs, inputs and experiments, regular sampling. Throws InvalidArgument for
/// other data, a rank above the size of a snapshot or the rank of the data, and fewer snapshots than unknowns in a row
/// of [A B]. Reference: Proctor, Brunton and Kutz (2016), SIAM J. Applied Dynamical Systems 15, 142-161.
DmdcFit dmdc(const IdData& data, const DmdcOptions& options = {});

}  // namespace dynlab::inline numerics
