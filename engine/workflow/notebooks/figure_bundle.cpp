#include "workflow/notebooks/figure_bundle.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "figures/figure.h"
#include "platform/atomic_file.h"
#include "platform/temporary_folder.h"
#include "platform/text/base64.h"

namespace dynlab::inline workflow {

std::string figure_bundle(const Figure& figure, GnuplotRenderer& renderer, const Reader& reader) {
    const TemporaryFolder folder;
    const auto svg = folder.path() / "figure.svg", png = folder.path() / "figure.png",
               pdf = folder.path() / "figure.pdf";
    for (const auto& file : {svg, png, pdf}) renderer.draw(figure, file, figure_format(file), reader);
    renderer.finish();
    // Without the declaration of XML, which programs that put the picture into a page do not take.
    const std::string drawn = read_file(svg), element = drawn.substr(std::min(drawn.find("<svg"), drawn.size()));
    const nlohmann::json bundle = {
        {"image/svg+xml", element},
        {"image/png", base64(read_file(png))},
        {"application/pdf", base64(read_file(pdf))},
        {"text/plain", message_text(figure.title.empty() ? Message("figure") : figure.title, reader)}};
    return bundle.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace dynlab::inline workflow
