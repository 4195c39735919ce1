#include "figures/gnuplot_renderer.h"

// A page draws its figures itself, from their description: nothing becomes a file.
namespace dynlab::inline figures {

class GnuplotRenderer::Work {};

GnuplotRenderer::GnuplotRenderer(const Cache*) {}
GnuplotRenderer::~GnuplotRenderer() = default;
void GnuplotRenderer::draw(const Figure&, const std::filesystem::path& file, FigureFormat, const Reader&) {
    throw FigureError("{}: a page in a browser makes no files of figures; show the figure instead, or run the script with dynlab",
                      file.string());
}
void GnuplotRenderer::finish() {}
CacheUse GnuplotRenderer::use() const {
    return {};
}

}  // namespace dynlab::inline figures
