#include "workflow/run_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "scripting/runtime.h"

namespace dynlab {
namespace {

/// A record's name as a file name: letters, digits and dashes only, with its place in front so that no two collide.
std::string figure_file_stem(const std::string& name, std::size_t place) {
    std::string stem = name;
    std::replace_if(
        stem.begin(), stem.end(), [](unsigned char c) { return !std::isalnum(c) || c > 127; }, '-');
    return fmt::format("{:02}-{}", place, stem.substr(0, 60));
}

std::string extension(FigureFormat format) {
    switch (format) {
        case FigureFormat::kSvg:
            return ".svg";
        case FigureFormat::kPng:
            return ".png";
        case FigureFormat::kPdf:
            break;
    }
    return ".pdf";
}

}  // namespace

RunRecord run_script(const RunRequest& request, GnuplotRenderer& renderer) {
    RunOptions options;
    options.seed = request.seed.value_or(request.script.header.seed);
    const std::filesystem::path folder = request.script.file.parent_path();
    options.script_folder = folder.empty() ? "." : folder;
    options.out_folder = request.out_folder;
    options.print = request.print;
    Runtime runtime(options, renderer);
    return runtime.run(request.script);
}

void draw_figures(RunRecord& record, GnuplotRenderer& renderer, const std::filesystem::path& folder,
                  FigureFormat format) {
    std::size_t place = 0;
    for (auto& [name, figure] : record.figures) {
        figure.file = folder / (figure_file_stem(name, ++place) + extension(format));
        renderer.draw(figure.figure, figure.file, format);
    }
}

}  // namespace dynlab
