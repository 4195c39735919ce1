#include "figures/gnuplot_renderer.h"

// A page draws its figures itself, from their description: nothing becomes a file.
namespace dynlab::inline figures {

class GnuplotRenderer::Work {};

GnuplotRenderer::GnuplotRenderer(const Cache*) {}
GnuplotRenderer::~GnuplotRenderer() = default;
void GnuplotRenderer::draw(const Figure&, const std::filesystem::path& file, FigureFormat, const Reader&) {
    throw FigureError(Message(
        "{}: in a browser, dynlab cannot write figure files; run the script with the installed dynlab", file.string()));
}
void GnuplotRenderer::finish() {}
CacheUse GnuplotRenderer::use() const {
    return {};
}

}  // namespace dynlab::inline figures
