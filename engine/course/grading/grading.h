#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "course/grading/grading_rules.h"

namespace dynlab::inline course {

struct GradingRequest {
    GradingSetup setup;
    std::filesystem::path submissions, out;
    std::optional<std::filesystem::path> roster, deadlines, owners;
    std::vector<std::string> only;                    ///< submissions, by name, group, id or student; all when empty
    bool newest_counts = false;                       ///< of several hand-ins of one student; else the better one
    std::string timezone;                             ///< of deadlines: "Europe/Paris"; empty: this machine's
    std::optional<std::filesystem::path> times = {};  ///< the platform's times of receipt (intake/arrival_times.h)
    bool accept_late = false;  ///< penalties of half the points or more count (grading/late_penalties.h)
    bool again = false;        ///< all anew where `out` was made with other checks or options
    bool regrade = false;      ///< also those that have a result already
    bool pdf = true;           ///< feedback and summary as PDF, besides Markdown
    /// Who runs and judges: "processes:4", "parallel:HOSTS", "slurm:OPTIONS" (workflow/shares); this process when
    /// empty.
    std::string on = {};
    std::optional<std::filesystem::path> spool = {};  ///< folder through which they work; else in `out`
    int lease_seconds = 30;  ///< without a sign of life, after which a worker's job is given to another
};

struct GradingOutcome {
    int submissions = 0, made = 0, kept = 0, not_whole = 0;  ///< not_whole: a check is left ungraded
    int unowned = 0, unreadable = 0, unconfirmed = 0;        ///< unconfirmed: penalties that wait for the instructor
    std::vector<Message> complaints;                         ///< whole sentences for the instructor
    std::vector<Message> notes;  ///< of the time that is given, and of machines that did not work along
    std::vector<Message> late;   ///< a clause for each late submission, with what it costs
    std::vector<Message> eye;    ///< submissions that need the instructor's eye, a sentence each
};

/// Grades a class. In `out`: results/NAME/ with results.json and feedback.md and .pdf for each submission,
/// logs/NAME/log.txt, which may quote hidden records, gradebook.csv, summary.md or .pdf, manual.csv. Each submission is
/// graded alone, in boxes; a result whose inputs are unchanged is kept, so that a run that was ended goes on where it
/// was. Marks depend on neither the order nor `setup.jobs`. Throws EnvironmentError for what must be mended first,
/// Interrupted after Ctrl-C. `out` remembers what it was made with: where that differs, the run is refused unless
/// `again` is set. One run at a time may work in it.
GradingOutcome grade_class(const GradingRequest& request);

}  // namespace dynlab::inline course
