#pragma once
#include <filesystem>

#include "course/intake/finding.h"
#include "course/names/sought_names.h"
#include "documents/pdf/pdf_layout.h"
#include "documents/pdf/pdf_objects.h"

namespace dynlab::inline course {

struct NameSearchLimits {
    PdfLimits pdf;
    PdfObjectLimits objects;
};

/// Names, numbers, mail addresses and home folders in a PDF, wherever they stand: name-in-text, name-hidden,
/// name-in-metadata, name-in-attachment, name-in-annotation, name-in-form, name-in-link, name-in-bookmark,
/// name-in-layer, name-in-image, name-in-figure-file, name-in-remains, name-inside: rules, and hints where somebody
/// else may be meant. Of these, rules come before hints; of more than forty the rest is not listed, which is a rule of
/// its own: names-not-listed. author-named (hint): the metadata name an author who is not known. not-searched (rule):
/// the inside of the file, or a part of it, cannot be read, so that nothing can be said. Pictures of text are not read.
/// `layout` is the file's, as read_pdf_layout gives it. Throws PdfRefusal when there is no such file.
Findings name_findings(const std::filesystem::path& file, const PdfLayout& layout, const SoughtNames& sought,
                       const NameSearchLimits& limits);

}  // namespace dynlab::inline course
