#pragma once
#include <filesystem>
#include <string>

#include "documents/complaints.h"

namespace dynlab::inline documents {

/// The file with a document's literature, in BibTeX (.bib) or CSL-JSON (.json), named behind "bibliography:" in the
/// header of a report or a script and lying beside it.

/// Empty where `name` is that of a .bib or .json file without folder.
Message fault_of_bibliography_name(const std::string& name);

/// Why `file` cannot be a document's bibliography: it is missing, longer than a megabyte, or a link to a file outside
/// its folder. Empty where it can.
Message why_no_bibliography(const std::filesystem::path& file);

/// Copies `file` into the folder in which Pandoc works, and returns the name it has there. Where it cannot be the
/// bibliography, `complaints` get why, and nothing is copied.
std::string place_bibliography(const std::filesystem::path& file, const std::filesystem::path& work_folder,
                               Complaints& complaints);

}  // namespace dynlab::inline documents
