#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <semaphore>
#include <set>
#include <string>
#include <vector>

#include "course/checks/check_run.h"
#include "course/grading/grade.h"
#include "platform/sandbox.h"
#include "platform/temporary_folder.h"
#include "platform/time_limits.h"
#include "workflow/lesson_catalog.h"

namespace dynlab::inline course {

template <class Result>
struct SandboxResult;

struct GradingSetup {
    Lesson lesson;
    /// The instructor's own folder of *.lua files; its folders hidden and rerun may contain data sets, NAME.csv or
    /// NAME.mat.
    std::optional<std::filesystem::path> more_checks;
    std::string secret;  ///< of the course: the source of the hidden data sets' random numbers
    Isolation isolation = Isolation::kFull;
    TimeLimits time{std::chrono::seconds(60)};  ///< of each run of a student's script
    std::filesystem::path program;              ///< dynlab
    int jobs = 1;                               ///< sandboxes that may run at once
    /// Cache::root() of a lasting cache, from which runs recall long calls and in which they keep them: for scripts of
    /// the course itself. What is graded computes everything.
    std::optional<std::filesystem::path> call_memory;
};

inline constexpr char kDocumentFails[] = "document-fails";  ///< id of the finding that a report cannot be made

/// The standard for all submissions of a lesson: the checks, the hidden data sets, and the test of the checks
/// themselves, which first run on the lesson's reference solution.
class GradingRules {
  public:
    /// Creates the data sets. Throws EnvironmentError for a lesson without checks.lua, check files that cannot be read,
    /// or a rerun of a data set that no simulated plant creates.
    explicit GradingRules(GradingSetup setup);

    /// The seed of a group with its own data sets (dynlab new --group-seed); nothing for the common data.
    using GroupSeed = std::optional<std::uint32_t>;

    /// What the checks are tried on: the runs of the script in `folder`, and findings of its document where a check
    /// asks for them. Errors of a script that was a notebook name its cells.
    CheckedSubmission work_in(const std::filesystem::path& folder, const GroupSeed& group_seed, std::string& log,
                              bool of_notebook = false) const;
    /// A submission to be checked.
    struct Work {
        std::string name;
        CheckedSubmission submission;
        GroupSeed group_seed;
        std::string log;
    };
    /// Runs the checks on all submissions. One sandbox serves all of them, because starting a sandbox takes longer than
    /// most checks; inside, each submission has its own process.
    std::vector<Grade> grade_all(std::vector<Work> works) const;
    /// Runs and checks the submission in `folder`.
    Grade grade(const std::string& name, const std::filesystem::path& folder, const GroupSeed& group_seed = {}) const;
    /// Grade of a submission that cannot be run: no check is graded.
    Grade unreadable(const std::string& name, const Message& error_reason) const;

    /// Runs the checks on the reference solution. Checks that it does not pass are broken and stay ungraded. The
    /// results of its runs are cached in the file `memory` (CachedRuns), so that other checks do not run the solution
    /// again unless `run_again` is true. An empty name disables the cache.
    /// Returns a sentence for each broken check.
    std::vector<Message> try_solution(const std::filesystem::path& memory = {}, bool run_again = false);

    /// What the checks say of each of these. Throws EnvironmentError where they come to no end.
    std::vector<std::vector<EvaluatedCheck>> evaluated(const std::vector<CheckedSubmission>& submissions) const;

    /// Fingerprint of everything that the marks of a submission depend on, and of everything that its runs depend on
    /// (independent of the checks).
    std::string fingerprint(const std::string& content_hash, const GroupSeed& group_seed) const;
    std::string run_fingerprint(const std::string& content_hash, const GroupSeed& group_seed) const;
    const GradingSetup& setup() const { return setup_; }
    const std::vector<CheckDescription>& checks() const { return checks_; }

    /// Sets the seconds of processor time of the reference solution's runs, by name, if the solution is not run here.
    void compare_with_solution(std::map<std::string, double> seconds) { solution_seconds_ = std::move(seconds); }
    /// A sentence if the reference solution leaves little time to slower solutions.
    std::optional<Message> note_on_time() const;

  private:
    void read_checks();
    void make_data_sets();
    void make_data_set(const std::string& data_set, const std::string& run, const std::filesystem::path& folder);
    void make_data_of_declared_plants();
    std::optional<std::filesystem::path> own_data_set(const std::string& folder, const std::string& data_set) const;
    void bring_lesson_data();
    std::filesystem::path official_data() const;
    GradedRun run(const std::string& name, const std::filesystem::path& folder, const GroupSeed& group_seed,
                  std::string& log) const;
    std::map<std::string, GradedRun> runs(const std::filesystem::path& folder, const GroupSeed& group_seed,
                                          std::string& log) const;
    Issues findings(const std::filesystem::path& folder, const GroupSeed& group_seed) const;
    /// The declared checks, and the requested data sets.
    SandboxResult<CheckResults> listed(std::vector<RequestedDataSet> data_sets = {}) const;
    SandboxResult<CheckResults> checked(const std::vector<Work>& works, std::chrono::milliseconds max_time,
                                        std::optional<std::size_t> only = {}) const;
    /// `result` is empty if a check has no result; the reason is given instead.
    struct CheckAttempt {
        std::optional<EvaluatedCheck> result;
        Message reason;
    };
    std::vector<std::vector<CheckAttempt>> check_attempts(std::vector<Work>& works) const;
    std::vector<CheckAttempt> separate_check_attempts(const Work& work) const;
    Grade grade_of(Work&& work, const std::vector<CheckAttempt>& found) const;
    std::map<std::string, PlantVariants> variants_of(const GroupSeed& group_seed) const;
    std::vector<std::string> simulated() const;
    Grade ungraded(const std::string& name) const;
    std::filesystem::path data_of(const GroupSeed& group_seed) const;
    std::filesystem::path add_home(Sandbox& sandbox, const std::string& run, const GroupSeed& group_seed) const;
    std::uint32_t drawn(const std::string& what) const;

    GradingSetup setup_;
    std::vector<CheckFile> files_;
    std::vector<ExpectedAnswer> answers_;
    std::vector<CheckDescription> checks_;
    std::string lesson_;  ///< as its header names it
    std::uint32_t seed_ = 1;
    std::string standard_;  ///< the template, or the file of one, whose rules a document must keep
    mutable std::optional<std::vector<std::string>> simulated_;  ///< once they were asked for
    std::map<std::string, PlantVariants> variants_;              ///< of hidden and rerun data sets (CheckSession)
    std::set<std::string> reruns_, broken_;
    std::map<std::string, double> solution_seconds_;
    std::vector<std::string> declared_plants_;
    std::string own_data_sets_;  ///< hashes of all data sets that scripts find, and of the instructor's data sets
    bool document_ = false;
    std::unique_ptr<std::counting_semaphore<>> free_cores_;  ///< for runs in sandboxes
    TemporaryFolder data_sets_;
    std::unique_ptr<std::mutex> making_ = std::make_unique<std::mutex>();  ///< guards groups' data sets and simulated_
};

}  // namespace dynlab::inline course
