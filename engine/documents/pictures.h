#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "documents/complaints.h"
#include "documents/document.h"
#include "documents/filter_messages.h"

namespace dynlab::inline documents {

/// A picture file of the document and the name that Pandoc writes for it.
struct PlacedPicture {
    std::filesystem::path file;
    std::string written_name;  ///< prefix + number + extension
    std::string plot;          ///< of a figure of the run (RecordedFigure)
};

/// The path of a picture: Pandoc writes spaces and letters beyond ASCII in it as %20.
std::filesystem::path path_of_picture(const std::string& name);

/// Finds the picture files (not figures) of a document. They must be files inside the folder of the template or
/// script that shows them, of a kind the format can hold; everything else is a complaint.
std::vector<PlacedPicture> find_picture_files(const std::vector<UsedPicture>& pictures, const MarkdownText& markdown,
                                              const std::filesystem::path& template_file, DocumentFormat format,
                                              const std::string& prefix, Complaints& complaints);

/// The same for the figures of the run, once they are drawn; a figure that was not drawn is a complaint.
std::vector<PlacedPicture> find_figures(const std::vector<UsedPicture>& pictures, const MarkdownText& markdown,
                                        const std::filesystem::path& template_file, const RunRecord& record,
                                        DocumentFormat format, const std::string& prefix, Complaints& complaints);

}  // namespace dynlab::inline documents
