#include "figures/gnuplot_renderer.h"

// A page draws its figures itself, from their description: nothing becomes a file.
namespace dynlab::inline figures {

class GnuplotRenderer::Work {};

GnuplotRenderer::GnuplotRenderer(const Cache*) {}
GnuplotRenderer::~GnuplotRenderer() = default;
void GnuplotRenderer::draw(const Figure&, const std::filesystem::path& file, FigureFormat, const Reader&) {
    throw FigureError(Message("{}: a page in a browser makes no files of figures; run the script with dynlab for them",
                              file.string()));
}
void GnuplotRenderer::finish() {}
CacheUse GnuplotRenderer::use() const {
    return {};
}

}  // namespace dynlab::inline figures
