#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "course/grading/cached_stages.h"
#include "course/grading/grading_rules.h"
#include "course/grading/work_item.h"
#include "course/sandbox_jobs/sandboxed_document.h"

namespace dynlab::inline course {

struct GradingOptions {
    GradingSetup setup;
    std::filesystem::path out;   ///< folder of results
    bool regrade = false;        ///< also what has a result already
    bool pdf = true;             ///< feedback and summary as PDF, in addition to Markdown
    bool above_maximum = false;  ///< marks of the instructor may exceed the points of their checks
};

/// What happens to one submission, a stage after the other:
///
///   submission -> staged -> runs -> check results -> grade -> feedback
///
/// Each stage depends on what the one before it gave and on the rules; what it gave is kept under a key of all that,
/// so that equal inputs are not computed again. Threads may share a pipeline.
class GradingPipeline {
  public:
    GradingPipeline(const GradingRules& rules, const GradingOptions& options, const ClassWork& work);

    /// Of what a grade depends on: what was submitted, and the rules.
    std::string key_of(const WorkItem& item) const { return rules_.fingerprint(item.content, item.seed); }

    /// The grade that an earlier run made under this key; nothing where there is none, or to be made again.
    std::optional<Grade> cached_grade(const WorkItem& item, const std::string& key) const;
    /// Staged and run. Throws SubmissionError where there is nothing to run.
    struct Run {
        CachedRuns runs;
        std::string log;
    };
    Run run(const WorkItem& item) const;
    /// A submission to check. check() checks several submissions in one shared sandbox and returns their grades in
    /// order.
    struct ToCheck {
        const WorkItem* item = nullptr;
        std::string key;
        Run run;
    };
    std::vector<Grade> check(std::vector<ToCheck> submissions) const;
    Grade unreadable(const WorkItem& item, const std::string& key, const Message& why) const;

    /// Marked, with the penalty and what the instructor marked, and its files written where they say anything else, or
    /// `again`; `error_reason`: why there is no PDF.
    struct Finished {
        Grade marked;
        Message error_reason;
    };
    Finished finish(const WorkItem& item, Grade grade, bool again) const;
    /// The same once it is known which submission of the same student counts; empty where it is this one. Nothing where
    /// the files say so already.
    std::optional<Finished> finish_as_counted(const WorkItem& item, const Grade& now, const std::string& instead) const;

    std::filesystem::path results_of(const WorkItem& item) const {
        return options_.out / "results" / item.submission.name;
    }
    const GradingRules& rules() const { return rules_; }
    const SandboxedDocuments& documents() const { return documents_; }

  private:
    std::filesystem::path kept_in(const WorkItem& item) const { return options_.out / "runs" / item.submission.name; }
    Message write_files(const WorkItem& item, const Grade& grade, const Grade& marked, bool again) const;

    const GradingRules& rules_;
    const GradingOptions& options_;
    bool newest_counts_;
    SandboxedDocuments documents_;
};

}  // namespace dynlab::inline course
