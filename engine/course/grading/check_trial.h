#pragma once
#include <string>
#include <vector>

#include "course/grading/grading_rules.h"

namespace dynlab::inline course {

/// The check results of one script, or of one change of the reference solution's answers.
struct EvaluatedScript {
    std::string name;
    Message error_reason;                ///< why it did not run to its end
    std::vector<EvaluatedCheck> checks;  ///< in the order of CheckTrial::checks
};

/// Checks that are tried on scripts of which one knows what they are worth.
struct CheckTrial {
    std::vector<CheckDescription> checks;
    EvaluatedScript solution;
    std::vector<EvaluatedScript> scripts;  ///< the starter, wrong_*.lua, right_*.lua, and those of the folder's own
    std::vector<EvaluatedScript> mutants;  ///< the solution with one answer scaled, of the other sign, or left out
    std::vector<EvaluatedScript> typed;    ///< the starter with a number of checks.lua typed in as an answer: "K = 8.5"

    /// Of every check by its place: whether something tried here fails it, and whether the solution passes it.
    bool fails_sometimes(std::size_t check) const;
    bool solution_passes(std::size_t check) const;
    /// Whether the reference solution passes all checks and no check stops with its own error on it.
    bool sound() const;
};

/// Runs the checks of `setup` on the lesson's reference solution, its starter, its wrong_*.lua and right_*.lua, the
/// scripts in the folder `try` of the instructor's checks, and on mutants of the solution's answers: each number of an
/// answer multiplied by 1.5, with the other sign, the answer left out. Students can read checks.lua: numbers in it that
/// are within a tenth of an answer of the solution are tested as typed-in answers. Scripts are run, mutants and
/// typed-in answers are not. Throws EnvironmentError as GradingRules does.
enum class Mutants { kAll, kNone };
CheckTrial try_checks_of(const GradingSetup& setup, Mutants mutants = Mutants::kAll);

/// It in words, a line for each script and what no script shows.
std::string trial_in_words(const CheckTrial& trial);

}  // namespace dynlab::inline course
