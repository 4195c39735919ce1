#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "course/checks/check_run.h"
#include "figures/gnuplot_renderer.h"
#include "scripting/interpreter/runtime.h"

namespace dynlab::inline course {

/// The checks that the files of a job declare, in a Lua state of this process, for one submission. On a machine of
/// others that wants a process of its own (check_run.h); in a browser the page has one.
class ReadChecks {
  public:
    ReadChecks(const ChecksJob& job, const SubmissionToJudge* submission);

    /// A sentence, when a file cannot be read.
    const std::optional<Message>& error() const { return error_; }

    /// What they say of the submission; of one alone, by its number.
    std::vector<TriedCheck> tried(std::optional<std::size_t> only = {});

    /// The checks as they are declared, the rigs, and the records that are wanted of these.
    CheckResults listed(const std::vector<WantedRecord>& records);

  private:
    void hand_over(const SubmissionToJudge& submission);

    CheckSession session_;
    GnuplotRenderer renderer_;
    Runtime runtime_;
    std::optional<Message> error_;
};

/// What a hidden record, a rerun's record or other random numbers are drawn from: the course's secret, the lesson and
/// what is drawn.
std::uint32_t drawn_number(const std::string& secret, const std::string& lesson, const std::string& what);
/// What is drawn for the noise of a data set's record in this run.
std::string noise_of(const std::string& data_set, const std::string& run);

}  // namespace dynlab::inline course
