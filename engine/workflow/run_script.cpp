#include "workflow/run_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "scripting/report_language.h"
#include "scripting/runtime.h"

namespace dynlab {
namespace {

/// A record's name as a file name: letters, digits and dashes only, with its number in front so that no two collide.
std::string figure_file_stem(const std::string& name, std::size_t number) {
    std::string stem = name;
    std::replace_if(
        stem.begin(), stem.end(), [](unsigned char c) { return !std::isalnum(c) || c > 127; }, '-');
    return fmt::format("{:02}-{}", number, stem.substr(0, 60));
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
    ReportLanguage language{request.script.header.language};
    Runtime runtime(options, renderer);
    runtime.set_service(&language);
    return runtime.run(request.script);
}

std::vector<std::string> figures_in_order(const RunRecord& record) {
    std::vector<std::string> names;
    for (const auto& [name, figure] : record.figures) names.push_back(name);
    std::stable_sort(names.begin(), names.end(), [&](const std::string& a, const std::string& b) {
        return record.figures.at(a).place < record.figures.at(b).place;
    });
    return names;
}

void draw_figures(RunRecord& record, GnuplotRenderer& renderer, const std::filesystem::path& folder,
                  FigureFormat format) {
    std::size_t number = 0;
    for (const std::string& name : figures_in_order(record)) {
        RecordedFigure& figure = record.figures.at(name);
        figure.file = folder / (figure_file_stem(name, ++number) + extension(format));
        renderer.draw(figure.figure, figure.file, format);
    }
}

}  // namespace dynlab
