#pragma once
#include <filesystem>
#include <string>

#include "figures/figure.h"
#include "figures/gnuplot_renderer.h"

namespace dynlab {

/// The gnuplot commands, data included, that draw a valid figure into `file` (an absolute path). Everything is placed
/// in cm; gnuplot chooses nothing. Data are sent as numbers in text, so that even a command gnuplot refuses
/// leaves nothing behind that could be read as another command.
std::string gnuplot_script(const Figure& figure, const std::filesystem::path& file, FigureFormat format);

}  // namespace dynlab
