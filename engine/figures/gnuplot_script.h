#pragma once
#include <string>

#include "figures/gnuplot_renderer.h"

namespace dynlab::inline figures {

/// The gnuplot commands, data included, that draw a valid figure into the file that gnuplot's variable `output_file`
/// names; equal commands give equal files. Everything is placed in cm; gnuplot chooses nothing. Data are sent as
/// numbers in text, so that even a command gnuplot refuses leaves nothing behind that could be read as another command.
/// Texts and numbers are the reader's.
std::string gnuplot_script(const Figure& figure, FigureFormat format, const Reader& reader = {});

/// The same as the text of a file that `gnuplot FILE` can draw without further input, into `output`, a name in its
/// folder.
std::string gnuplot_file(const Figure& figure, FigureFormat format, const std::string& output,
                         const Reader& reader = {});

}  // namespace dynlab::inline figures
