#pragma once
#include <filesystem>
#include <string>

#include "course/anonymity/identity_matcher.h"
#include "course/intake/issue.h"
#include "platform/sandbox.h"

namespace dynlab::inline course {

/// How copies for anonymous readers are made. The threat model is carelessness: authors who leave their name in a
/// document, not authors who want a reader to recognize them.
struct AnonymousCopySetup {
    IdentityMatcher names;  ///< of everyone in the course: a certain hit stops the copy
    Isolation isolation = strongest_isolation();
    std::filesystem::path program;                      ///< dynlab, which makes reports again
    TimeLimits report_time{std::chrono::seconds(120)};  ///< of a report made again
    bool rebuild = true;                                ///< from the source, where there is one
    bool accept = false;                                ///< make the copy although it has certain hits
};

struct AnonymousCopy {
    bool made = false;     ///< the copy was written
    bool rebuilt = false;  ///< from analysis.lua and report.md; else from the submitted PDF
    std::string hash;      ///< SHA-256 of the copy; empty when it was not made
    Issues findings;       ///< what stopped it (rules) and what the instructor may want to look at (hints)
    Message not_rebuilt;   ///< one sentence, when the source cannot be made again and the submitted PDF was taken
    Message error_reason;  ///< one sentence, when there was nothing to copy or making it failed
};

/// Makes `copy` (a PDF) from a submission: a PDF, a pack or other archive (.zip, .tar.gz), or a folder. Where it has
/// the source of a report, the report is made again in a sandbox; otherwise, or where that fails, the submitted PDF is
/// taken: report.pdf, or the only PDF. Either is printed into a new PDF (distilled_pdf), which is then searched for
/// names; nothing is written when one is found (a rule among the findings). Equal input gives equal bytes on the same
/// machine. Throws MissingProgram, and EnvironmentError where `copy` cannot be written.
AnonymousCopy anonymous_copy(const std::filesystem::path& submission, const std::filesystem::path& copy,
                             const AnonymousCopySetup& setup);

}  // namespace dynlab::inline course
