#pragma once
#include <filesystem>

#include "course/anonymity/identity_matcher.h"
#include "course/intake/issue.h"
#include "documents/pdf/pdf_layout.h"
#include "documents/pdf/pdf_objects.h"

namespace dynlab::inline course {

/// Names, numbers, mail addresses, groups and home folders that a reader of the PDF meets: name-in-text,
/// name-in-metadata, name-in-link, name-in-bookmark (rules, or hints where another person may be meant),
/// name-in-file-name (hint). At most forty, rules first; names-not-listed (rule) counts the others.
/// Further hints: name-ordinary-word lists names in the text that are ordinary words, too; author-named: the document
/// information names an unknown author; not-searchable: pages with pictures, or without text. not-searched (rule):
/// links and document information cannot be read. `layout` is that of the file; `source`, that of the document it was
/// printed from, is searched for names in letters beyond ASCII, whose meaning printing may lose. Throws PdfRefusal when
/// there is no such file.
Issues anonymity_findings(const std::filesystem::path& file, const PdfLayout& layout, const IdentityMatcher& matcher,
                          const PdfObjectLimits& limits = {}, const PdfLayout* source = nullptr);

}  // namespace dynlab::inline course
