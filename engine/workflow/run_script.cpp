#include "workflow/run_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "base/languages.h"
#include "documents/error.h"
#include "documents/html/plot_data.h"
#include "documents/text_lines.h"
#include "documents/weave.h"
#include "platform/written_files.h"
#include "workflow/script_environment.h"

namespace dynlab::inline workflow {
namespace {

/// A figure's name as a file name: letters, digits and dashes only, with its number first so that no two collide.
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

/// The heading of the text above a cell; empty when there is none.
std::string last_heading(const std::string& markdown, const std::string& before) {
    std::string heading = before;
    for (const std::string& line : lines_of(markdown))
        if (const std::size_t text = line.find_first_not_of('#'); text > 0 && text != std::string::npos)
            heading = trimmed(line.substr(text));
    return heading;
}

/// What to call each code cell while it runs, by its id.
std::map<std::string, Message> cell_titles(const PercentScript& script) {
    const auto is_code = [](const Cell& cell) { return cell.kind == Cell::Kind::kCode; };
    const auto total = std::count_if(script.cells.begin(), script.cells.end(), is_code);
    std::map<std::string, Message> titles;
    std::string heading;
    for (const Cell& cell : script.cells) {
        if (!is_code(cell)) {
            heading = last_heading(cell.content, heading);
            continue;
        }
        const std::string name = cell.id.starts_with("cell-") ? heading : cell.id;
        const std::size_t number = titles.size() + 1;
        titles[cell.id] = total == 1     ? Message("running the script")
                          : name.empty() ? Message("cell {} of {}", number, total)
                                         : Message("cell {} of {}, {}", number, total, name);
    }
    return titles;
}

void check_sliders(const RunRequest& request, const RunRecord& record) {
    for (const auto& [name, value] : request.slider_values) {
        if (record.sliders.contains(name)) continue;
        std::vector<std::string> known;
        for (const auto& [other, slider] : record.sliders) known.push_back(other);
        const std::string script = request.script.file.string();
        throw DocumentError(known.empty()
                                ? Message("{} has no slider \"{}\", because the script has no sliders", script, name)
                                : Message("{} has no slider \"{}\"; the sliders are {}", script, name, listed(known)));
    }
}

RunOptions run_options(const RunRequest& request) {
    RunOptions options;
    options.seed = request.seed.value_or(request.script.header.seed);
    const std::filesystem::path folder = request.script.file.parent_path();
    options.script_folder = folder.empty() ? "." : folder;
    options.out_folder = request.out_folder;
    options.stay_in_folder = request.stay_in_folder;
    options.print = request.print;
    options.call_cache = request.call_cache;
    if (request.enter_cell) {
        options.enter_cell = [titles = cell_titles(request.script),
                              notify = request.enter_cell](const std::string& id) {
            if (const auto title = titles.find(id); title != titles.end()) notify(title->second);
        };
    }
    return options;
}

}  // namespace

ScriptEnvironment::ScriptEnvironment(const RunRequest& request, GnuplotRenderer& renderer)
    : language{request.script.header.language},
      sliders{request.slider_values},
      runtime(run_options(request), renderer) {
    runtime.services() = {
        .language = &language, .sliders = &sliders, .written = request.written, .parts = request.parts};
}

RunRecord run_script(const RunRequest& request, GnuplotRenderer& renderer) {
    ScriptEnvironment world(request, renderer);
    RunRecord record = world.runtime.run(request.script);
    if (!record.error) check_sliders(request, record);
    return record;
}

std::string missing_answers(const PercentScript& script, const RunRecord& record) {
    std::string missing;
    for (const ExpectedAnswer& answer : script.header.answers)
        if (!record.answers.contains(answer.name))
            missing += fmt::format("{}{} ({})", missing.empty() ? "" : ", ", answer.name, answer.kind);
    return missing;
}

std::vector<std::string> figures_in_order(const RunRecord& record) {
    std::vector<std::string> names;
    for (const auto& [name, figure] : record.figures) names.push_back(name);
    std::stable_sort(names.begin(), names.end(), [&](const std::string& a, const std::string& b) {
        return record.figures.at(a).order < record.figures.at(b).order;
    });
    return names;
}

void draw_figures(RunRecord& record, GnuplotRenderer& renderer, const std::filesystem::path& folder,
                  FigureFormat format, const std::string& language) {
    const Reader reader{catalog_of(language)};
    std::size_t number = 0;
    for (const std::string& name : figures_in_order(record)) {
        RecordedFigure& figure = record.figures.at(name);
        figure.file = folder / (figure_file_stem(name, ++number) + extension(format));
        renderer.draw(*figure.figure, figure.file, format, reader);
        if (format == FigureFormat::kSvg) figure.plot = plot_data(*figure.figure, reader);
        figure.axes = words_of_axes(*figure.figure, reader);
    }
}

}  // namespace dynlab::inline workflow
