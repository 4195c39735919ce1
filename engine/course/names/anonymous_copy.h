#pragma once
#include <filesystem>
#include <string>

#include "course/intake/finding.h"
#include "course/names/sought_names.h"
#include "documents/pdf/pdf_objects.h"
#include "platform/box.h"

namespace dynlab::inline course {

/// How copies for anonymous readers are made.
struct AnonymousCopySetup {
    SoughtNames names;  ///< of everybody in the course: a hit stops the copy
    Isolation isolation = strongest_isolation();
    std::filesystem::path program;                      ///< dynlab, which makes reports again
    TimeLimits report_time{std::chrono::seconds(120)};  ///< of a report made again
    PdfObjectLimits objects;
    bool rebuild = true;  ///< from the source, where there is one
};

/// What became of one copy.
struct AnonymousCopy {
    bool made = false;     ///< the copy was written
    bool rebuilt = false;  ///< from analysis.lua and report.md; else from the PDF that was handed in
    std::string hash;      ///< SHA-256 of the copy; empty when it was not made
    Findings findings;     ///< what stopped it (rules) and what the instructor may want to look at (hints)
    Message trouble;       ///< one sentence, when there was nothing to copy or making it failed
};

/// Makes `copy` (a PDF) from what a group handed in: a PDF, a pack or other archive (.zip, .tar.gz), or a folder.
/// Source is preferred: the report is made anew in a box, as grading does. Where that fails or there is no source, the
/// PDF that was handed in is taken: report.pdf, or the only PDF. Either is cleaned (clean_pdf) and then searched for
/// all names; when one is found (a rule among the findings) nothing is written. Equal input gives equal bytes on the
/// same machine. Throws MissingProgram, and EnvironmentError where `copy` cannot be written.
AnonymousCopy anonymous_copy(const std::filesystem::path& handed_in, const std::filesystem::path& copy,
                             const AnonymousCopySetup& setup);

/// The PDF without document information, XMP, embedded files, comments, forms, dates, identities, private data of
/// programs, metadata of pictures, earlier versions and objects that nothing refers to. Links, bookmarks and layers
/// stay, as they belong to the text; of actions only those that turn to a place in the document (GoTo, and Named for
/// the next, previous, first and last page) or open an address of the web or of mail when they are clicked (URI), one
/// at a time. Nothing is fetched from other files. Throws PdfRefusal.
std::string clean_pdf(const std::filesystem::path& file, const PdfObjectLimits& limits = {});

}  // namespace dynlab::inline course
