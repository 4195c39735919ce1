#pragma once
#include <filesystem>

#include "figures/gnuplot_renderer.h"
#include "platform/files/temporary_file.h"

namespace dynlab::inline figures {

/// Whether a file has the beginning and the end that its format requires; a full disk leaves none.
bool is_complete(const std::filesystem::path& file, FigureFormat format);

/// Gives the texts of an SVG file fonts to fall back on where the reader's machine lacks the document's own, and drops
/// empty groups: how many there are depends on what gnuplot drew before, and equal figures are to be equal files.
void finish_svg(const std::filesystem::path& svg);

/// Overwrites the date that cairo stamps on PDF files with blanks, so that equal figures are equal files.
void blank_creation_date(const std::filesystem::path& pdf);

/// An empty file beside `target`, to be filled and renamed while it is open. Throws EnvironmentError that says why none
/// can be made.
TemporaryFile make_temporary_next_to(const std::filesystem::path& target);

}  // namespace dynlab::inline figures
