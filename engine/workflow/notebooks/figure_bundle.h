#pragma once
#include <string>

#include "figures/gnuplot_renderer.h"

namespace dynlab::inline workflow {

/// What a notebook shows for a figure, as the JSON of its types: SVG for pages, PNG where no SVG is taken, PDF for
/// documents by LaTeX (the last two in base64). Throws FigureError, MissingProgram.
std::string figure_bundle(const Figure& figure, GnuplotRenderer& renderer, const Reader& reader);

}  // namespace dynlab::inline workflow
