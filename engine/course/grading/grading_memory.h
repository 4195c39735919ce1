#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "course/checks/check_run.h"

namespace dynlab::inline course {

/// An input that marks depend on: as it was named, and a hash of what stood there; both empty where it was not given.
struct RememberedInput {
    std::string name, hash;
};

/// What a folder of results was made with: it stands in it as grading.json, so that no later run mixes marks of two
/// kinds.
struct GradingMemory {
    std::string lesson;
    RememberedInput lesson_checks, checks, secret, roster, owners, deadlines;
    std::string keep, timezone;
};

RememberedInput remembered_file(const std::optional<std::filesystem::path>& file);
/// Of the *.lua in a folder and the files below it.
RememberedInput remembered_folder(const std::optional<std::filesystem::path>& folder);
RememberedInput remembered_text(const std::string& name, const std::string& text);

/// Nothing where there is none, or where it cannot be read.
std::optional<GradingMemory> read_grading_memory(const std::filesystem::path& out);
void write_grading_memory(const std::filesystem::path& out, const GradingMemory& memory);

/// What differs so that marks of both kinds would stand side by side, a clause each: "the checks (own1 then, none
/// now)". A roster or a list of owners, which say whose work it is, may be given or mended when all of the class is
/// graded, as the gradebook is then made anew from all of it; one that is missing now counts. Deadlines take points:
/// other ones always count.
std::vector<std::string> differences_of(const GradingMemory& then, const GradingMemory& now, bool all_of_the_class);

/// What a script did when it was run, kept apart from what the checks say of it: with other checks it need not run
/// again.
struct KeptRuns {
    std::string fingerprint;  ///< of the submission and of all that its runs depend on
    CheckedSubmission work;
    std::string remark, language;  ///< see StagedWork
};

std::optional<KeptRuns> read_kept_runs(const std::filesystem::path& file, const std::string& fingerprint);
void write_kept_runs(const std::filesystem::path& file, KeptRuns runs);

}  // namespace dynlab::inline course
