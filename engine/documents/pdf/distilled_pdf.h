#pragma once
#include <chrono>
#include <filesystem>
#include <string>

#include "documents/pdf/pdf_objects.h"
#include "platform/sandbox.h"

namespace dynlab::inline documents {

struct DistillSetup {
    Isolation isolation = strongest_isolation();
    TimeLimits time{std::chrono::seconds(60)};  ///< of Ghostscript
    PdfObjectLimits objects;
};

/// The pages of a PDF as Ghostscript's pdfwrite prints them in a sandbox, in a new PDF: without document information,
/// XMP, attachments, scripts, layers, earlier revisions and annotations. Form fields are printed. Pictures are
/// encoded again; embedded fonts have numbers for names. Bookmarks stay, and links within the document or to the web
/// and to mail addresses. Equal input gives equal bytes on the same machine.
/// Throws MissingProgram without Ghostscript, and PdfRefusal where the file cannot be read or printed.
/// EnvironmentError as refuse_full_disk does.
std::string distilled_pdf(const std::filesystem::path& file, const DistillSetup& setup = {});

/// Throws EnvironmentError where the disk of a temporary folder, in which something could not be made, has less room
/// than this many bytes: then the disk is to blame.
void refuse_full_disk(const std::filesystem::path& folder, std::uintmax_t bytes);

}  // namespace dynlab::inline documents
