#pragma once
#include <filesystem>
#include <string>

#include "base/message.h"
#include "course/intake/submission.h"

namespace dynlab::inline course {

struct StagedWork {
    std::filesystem::path folder;  ///< holds analysis.lua
    Message remark;                ///< for the instructor: which of several versions was taken; else empty
    std::string language{};        ///< of the work, see language_of_work
    bool of_notebook = false;      ///< its analysis.lua was an analysis.ipynb
};

/// Copies the files of a submission that is no archive into `to`, an empty folder: a folder's, or loose ones, of which
/// a platform's "..._analysis.lua" and "analysis-1.lua" get their own name again. Returns what was left out: links, and
/// what is no regular file. Throws SubmissionError for more than the limits allow.
std::vector<std::string> copy_submission(const Submission& submission, const std::filesystem::path& to,
                                         const SubmissionLimits& limits = {});

/// The same as a zip: of equal bytes for equal files.
void zip_submission(const Submission& submission, const std::filesystem::path& zip,
                    const SubmissionLimits& limits = {});

/// "analysis.lua" or "analysis.ipynb" for what browsers, systems and platforms make of these names: another case, .txt
/// at the end, "my%20analysis.lua", "analysis (1).lua", "analysis-1.lua", "ada_4711_analysis.lua"; else empty.
std::string script_name_meant_by(const std::string& name);

/// Copies a submission's files into `to`, an empty folder, and finds analysis.lua: at any depth, and inside nested
/// archives if there is none outside of them; a notebook analysis.ipynb is converted (notebooks.h). Of several scripts
/// the newest is taken: by the numbers in their names ("work.zip", "work_v2.zip"), else by the scripts' times. A script
/// whose name a platform extended ("..._analysis.lua", "analysis-1.lua") gets its original name. If there is no such
/// script, a script is taken whose name a browser or a system changed ("Analysis.lua", "analysis.lua.txt", "analysis
/// (1).lua"). A script in UTF-16 is converted to UTF-8. `program` unpacks archives in a sandbox. Throws SubmissionError
/// with a sentence for the student: no script, with a list of the existing files; several of one age; too large.
StagedWork stage_submission(const Submission& submission, const std::filesystem::path& to, Isolation level,
                            const std::filesystem::path& program, const SubmissionLimits& limits = {});

}  // namespace dynlab::inline course
