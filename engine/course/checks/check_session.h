#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/message.h"
#include "course/intake/issue.h"
#include "course/sandbox_jobs/graded_run.h"

namespace dynlab::inline course {

/// What is said of a check before it is tried.
struct CheckDescription {
    std::string id, about, hint;
    double points = 1;
    std::string rerun;      ///< a data set's name, kOtherSeedRun, or empty
    bool document = false;  ///< it asks for findings of the document
    bool by_hand = false;   ///< the instructor marks it
    std::string rubric;     ///< what is marked by hand, for the instructor
    bool visible = true;    ///< students may read the file that declares the check
};

/// A check as its file declares it.
struct DeclaredCheck : CheckDescription {
    int test = 0;      ///< index of the function in Lua's registry, 0 where it is marked by hand
    int mistakes = 0;  ///< index of the list of common mistakes, 0 for none
};

/// What a check says of a submission.
struct CheckOutcome {
    double share = 0;             ///< of the points, 0 to 1
    Message message;              ///< one or two sentences for the student; may be empty
    Message for_instructor = {};  ///< the previous message, if it may quote a hidden data set
};

/// A simulated plant that a check file declares; its functions take {variant =, seed =} and are indices in Lua's
/// registry.
struct DeclaredPlant {
    int simulated_data = 0, truth = 0;  ///< truth: 0 if the file declares none
};

inline constexpr char kMainRun[] = "main";       ///< the submitted run
inline constexpr char kOtherSeedRun[] = "seed";  ///< the rerun with other random numbers, which changes no data set

/// Specimens of the apparatus by data set.
using PlantVariants = std::map<std::string, std::uint32_t>;
inline constexpr char kHiddenDataSets[] = "hidden";  ///< used as a run's name where plant variants are listed
inline constexpr char kRunOfAnswers[] = "run";       ///< field of a metatable: from which run the answers came

/// What the functions of checks.lua share while a submission is checked.
struct CheckSession {
    std::vector<DeclaredCheck> checks;
    std::map<std::string, DeclaredPlant> plants;  ///< by data set
    std::map<std::string, GradedRun> runs;        ///< kMainRun, and one for each rerun
    std::string source;                           ///< the student's script
    Issues findings;                              ///< of the document
    /// Plant variants of the data sets that each run read, by run; "hidden": those of hidden(). Data sets without an
    /// entry are the common ones, variant 0.
    std::map<std::string, PlantVariants> variants;
    std::filesystem::path hidden_folder;  ///< holds NAME.mat or NAME.csv
    bool visible_file = true;             ///< of the file that is being read
    const DeclaredCheck* current = nullptr;
    bool took_hidden = false;             ///< the current check used a hidden data set or its theoretical values
    Message answer_error;                 ///< why an answer that the current check requested is missing; quotes no data
    std::map<std::string, Message> said;  ///< message of each check result by its English text, which Lua holds
    std::optional<CheckOutcome> outcome;
    std::optional<std::pair<std::string, double>> change;       ///< an answer that is seen multiplied
    std::map<std::string, std::vector<double>> simulated_data;  ///< what `_record` made last
};

}  // namespace dynlab::inline course
