#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "course/checks/check_run.h"
#include "figures/gnuplot_renderer.h"
#include "scripting/interpreter/runtime.h"

namespace dynlab::inline course {

/// The checks that the files of a job declare, in a Lua state of this process, for one submission. On a shared machine
/// the caller must use a separate process (check_run.h); in a browser each page already has one.
class ReadChecks {
  public:
    ReadChecks(const ChecksJob& job, const SubmissionToGrade* submission);

    /// A sentence, when a file cannot be read.
    const std::optional<Message>& error() const { return error_; }

    /// Check results of the submission, or the result of the check with this number.
    std::vector<EvaluatedCheck> evaluated(std::optional<std::size_t> only = {});

    /// Lists the declared checks and simulated plants, and creates the requested data sets of these plants.
    CheckResults listed(const std::vector<RequestedDataSet>& data_sets);

  private:
    void hand_over(const SubmissionToGrade& submission);

    CheckSession session_;
    GnuplotRenderer renderer_;
    Runtime runtime_;
    std::optional<Message> error_;
};

/// The number from which a hidden data set, a rerun's data set or other random numbers are generated. It depends on the
/// course's secret, the lesson and the purpose.
std::uint32_t drawn_number(const std::string& secret, const std::string& lesson, const std::string& what);
/// The purpose string for the noise of a data set in this run (see drawn_number).
std::string noise_of(const std::string& data_set, const std::string& run);

}  // namespace dynlab::inline course
