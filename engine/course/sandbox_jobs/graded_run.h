#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "documents/percent_script.h"
#include "documents/run_record.h"

namespace dynlab::inline course {

constexpr std::uint64_t kMaxGradedRunBytes = 4ull << 20;  ///< bytes of a GradedRun outside its sandbox

/// Results of a run that checks can read. A script that cannot be read has only an error.
struct GradedRun {
    std::map<std::string, RecordedAnswer> answers;
    std::vector<std::string> figures, values;  ///< their names
    std::string printed;                       ///< the end of what it printed
    std::optional<Message> error;              ///< with its place
    double seconds = 0;                        ///< of processor time that the script used
    std::string lesson = {};                   ///< as the script's header names it
    bool began = true;                         ///< false for a script that cannot be read
};

/// Returns the results that checks can read. Answers and names of figures and values that exceed kMaxGradedRunBytes are
/// omitted.
GradedRun graded_run(RunRecord&& record, const PercentScript& script);

/// One run of a student's script for grading.
struct RunJob {
    static constexpr char kWork[] = "run";
    using Result = GradedRun;

    std::filesystem::path script;
    std::uint32_t seed = 1;
    std::vector<ExpectedAnswer> answers;  ///< as the lesson declares them
    std::int64_t time_ms = 0;             ///< most milliseconds of processor time
    std::uint64_t memory_bytes = 0;       ///< most bytes of the script
    bool recalls = false;                 ///< long calls, from the cache of its environment: never of a submission
};

/// Runs the script in this process, which must be in a sandbox and is confined here. DYNLAB_HOME names the data.
GradedRun run_for_grading(const RunJob& job);

}  // namespace dynlab::inline course
