#pragma once
#include <functional>

#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

// The start condition of a fit whose options leave it open (initial_state or offset kAuto).
//
// A start from rest without offset is tried first: its fit is quick and mostly right. The LOOK AHEAD from it evaluates
// the sensitivities J of the output once, on the first 3000 samples at most (what these do not show is too small to
// matter), extended by a constant and by the free motions of 1/A, and asks what one Gauss-Newton step gains with each
// of them (d'g with (J'J) d = g = J'e). Where one of them lowers BIC by more than 2 (positive evidence, Kass and
// Raftery 1995), or where the fit explains nothing from which to look ahead, all start conditions are fitted and the
// smallest BIC wins. BIC counts as many samples as white errors of the same power at low frequencies would have, N (1 -
// r)/(1 + r), r the correlation of the errors after the step from one sample to the next: errors that follow each other
// imitate a constant.

/// Whether the options allow a start from rest without offset, and others.
bool start_is_open(const FitOptions& options);

/// Whether the look ahead from a fit from rest promises more of another start that the options allow. Outputs that
/// share a denominator are looked at one after the other.
bool other_start_promises(const IdData& data, const Fit& from_rest, const FitOptions& options);

/// How one method fits.
struct StartTrials {
    std::function<Fit(const FitOptions& from_rest)> first;
    /// What `first` left out, where no other start is promised; it may return the fit as it is.
    std::function<Fit(Fit, const FitOptions& from_rest)> finish;
    std::function<Fit(const FitOptions& options)> among_all;
};

/// The fit under the start condition selected as described above; that of `among_all` if the options specify the start,
/// or if a fit from rest throws InvalidArgument.
Fit with_chosen_start(const IdData& data, const FitOptions& options, const StartTrials& trials);

/// Noise that drifts imitates constants and movements of the simulation, by whose error the start was chosen. With such
/// a noise model, where the options are open, the fit of smallest prediction error among this one, one from rest and
/// one from an estimated state with an offset.
Fit best_predicting_start(Fit fit, const FitOptions& options, const std::function<Fit(const FitOptions&)>& fit_with);

/// The look ahead from a fit of a difference equation to its simulation, from rest.
bool other_discrete_start_promises(const IdData& data, const Fit& from_rest, const FitOptions& options);

}  // namespace dynlab::inline numerics
