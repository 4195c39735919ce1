#include "workflow/site/lesson_page.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

#include "base/languages.h"
#include "base/reader.h"
#include "data_io/dataset_index.h"
#include "documents/error.h"
#include "documents/html/web_page.h"
#include "documents/text_lines.h"
#include "figures/gnuplot_renderer.h"
#include "platform/atomic_file.h"
#include "platform/cache.h"
#include "platform/temporary_folder.h"
#include "platform/text/base64.h"
#include "platform/utf8.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "workflow/make_report.h"
#include "workflow/run_cache.h"
#include "workflow/run_script.h"
#include "workflow/student_copy.h"

namespace dynlab::inline workflow {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kScript = "analysis.lua";

/// The run of a lesson's student copy, its figures drawn for pages.
RunRecord run_for_page(const ReportRequest& request, const fs::path& folder, const Cache& cache) {
    const RunCache runs(request, FigureFormat::kSvg, cache);
    if (auto known = runs.load_entry()) return *std::move(known);
    fs::create_directories(folder);
    CallCache calls(cache);
    GnuplotRenderer renderer(&cache);
    RunRequest run;
    run.script = request.script;
    run.seed = request.seed;
    run.out_folder = folder;
    run.call_cache = &calls;
    RunRecord record = run_script(run, renderer);
    draw_figures(record, renderer, folder, FigureFormat::kSvg, request.script.header.language);
    renderer.finish();
    runs.save_entry(record);
    return record;
}

/// The script whose code is not shown: its cells give their results alone.
PercentScript without_code(PercentScript script) {
    for (Cell& cell : script.cells)
        if (cell.kind == Cell::Kind::kCode) cell.options["echo"] = "false";
    return script;
}

std::string html_of(const SetChunk& chunk, const RunRecord& record) {
    std::vector<PlacedPicture> pictures;
    for (const SetPicture& picture : chunk.pictures) {
        const auto figure = record.figures.find(picture.name);
        if (!picture.is_figure)
            pictures.push_back({picture.file, picture.written_name, {}});
        else if (figure != record.figures.end())
            pictures.push_back({figure->second.file, picture.written_name, figure->second.plot});
    }
    return with_inlined_pictures(chunk.html, pictures) + "\n";
}

std::string lines_between(const PercentScript& script, int first, int last) {
    const std::vector<std::string> lines = lines_of(script.source);
    std::string text;
    for (int line = first; line <= std::min(last, static_cast<int>(lines.size())); ++line)
        text += (line == first ? "" : "\n") + lines[static_cast<std::size_t>(line) - 1];
    return text;
}

bool is_printed(const Cell& cell) {
    const auto echo = cell.options.find("echo");
    return echo == cell.options.end() || echo->second != "false";
}

std::string cell_element(const PercentScript& script, const Cell& cell, const std::string& html) {
    const std::string place = fmt::format("data-first=\"{}\" data-last=\"{}\"", cell.first_line, cell.last_line());
    if (cell.kind == Cell::Kind::kText) return fmt::format("<div class=\"text\" {}>\n{}</div>\n", place, html);
    return fmt::format(
        "<section class=\"cell\" data-cell=\"{}\" {}>\n<pre class=\"code\"{}>{}</pre>\n<div "
        "class=\"results\">\n{}</div>\n"
        "</section>\n",
        html_text(cell.id), place, is_printed(cell) ? "" : " hidden",
        html_text(lines_between(script, cell.first_line, cell.last_line())), html);
}

/// The document cell by cell; text that belongs to no cell, such as questions to check oneself by, comes last.
std::string cells_of_page(const PercentScript& script, const SetDocument& document, const RunRecord& record) {
    std::map<const Cell*, std::string> html;
    std::string rest;
    for (const SetChunk& chunk : document.chunks) {
        const bool of_script = chunk.chunk.origin.file == script.file;
        const Cell* const cell = of_script ? script.cell_at_line(std::max(chunk.chunk.origin.line, 1)) : nullptr;
        (cell ? html[cell] : rest) += html_of(chunk, record);
    }
    std::string cells;
    for (const Cell& cell : script.cells) cells += cell_element(script, cell, html[&cell]);
    return cells + rest + document.notes;
}

std::string notice(const Message& message, const std::string& language) {
    return "<p class=\"notice\">" + html_text(message_text(message, {catalog_of(language)})) + "</p>\n";
}

/// Data sets that the lesson's scripts name or its run has read.
std::vector<std::string> data_sets_of(const Lesson& lesson, const RunRecord& record) {
    std::set<std::string> read;
    for (const fs::path& file : record.files_read) read.insert(file.parent_path().filename().string());
    const std::string script = read_text(lesson.script());
    std::vector<std::string> names;
    for (const std::string& name : dataset_names())
        if (read.count(name) || script.find("load(\"" + name + "\")") != std::string::npos) names.push_back(name);
    return names;
}

/// The files of a student's copy, but for the course's data and hidden entries: texts as they are, others in base64.
json files_of_copy(const Lesson& lesson, const std::string& language) {
    const TemporaryFolder work;
    const fs::path copy = work.path() / "copy";
    make_student_copy(lesson, copy, {}, language);
    std::map<std::string, std::string> contents;
    for (const auto& entry : fs::recursive_directory_iterator(copy)) {
        const std::string name = entry.path().lexically_relative(copy).generic_string();
        if (!entry.is_symlink() && entry.is_regular_file() && !name.starts_with('.'))
            contents[name] = read_file(entry.path());
    }
    json list = json::array();
    for (const auto& [name, content] : contents)
        list.push_back(is_utf8(content) ? json{{"name", name}, {"text", content}}
                                        : json{{"name", name}, {"base64", base64(content)}});
    return list;
}

/// The checks and hints that students may read, by the names of their files.
json checks_of(const Lesson& lesson, const std::string& language) {
    json files = json::object();
    for (const fs::path& file : {lesson.folder / "checks.lua", lesson.checks_in(language), lesson.hints(language)})
        if (fs::is_regular_file(file)) files[file.filename().string()] = read_text(file);
    return files;
}

}  // namespace

std::vector<std::string> languages_of(const Lesson& lesson) {
    std::vector<std::string> all = {read_percent_script(lesson.script()).header.language};
    for (const std::string& language : languages())
        if (language != all.front() && fs::is_regular_file(lesson.tasks(language))) all.push_back(language);
    return all;
}

std::map<std::string, std::string> numbers_of(const std::vector<Lesson>& lessons) {
    const auto number = [](const Lesson& lesson) { return lesson.slug.substr(0, lesson.slug.find('_')); };
    std::map<std::string, int> counts;
    for (const Lesson& lesson : lessons) ++counts[number(lesson)];
    std::map<std::string, std::string> folders;
    for (const Lesson& lesson : lessons)
        folders[lesson.slug] = counts[number(lesson)] == 1 ? number(lesson) : lesson.slug;
    return folders;
}

LessonPage LessonPages::make(const Lesson& lesson, const std::string& language, const std::string& number) {
    ReportRequest request = sheet_of(lasting_name(lesson), {}, language);
    const RunRecord record = run_for_page(request, work_folder_ / language / lesson.slug, cache_);
    const PercentScript script = request.script;
    request.script = without_code(std::move(request.script));
    DocumentSource source = document_source(request, record);
    source.names_values = true;
    const SetDocument document = setter_.set(source, false);
    if (!document.complaints.empty()) throw DocumentError(document.complaints.front());

    LessonPage made;
    SitePage& page = made.page;
    const std::string folder = (language == "en" ? "" : language + "/") + "lessons/" + number;
    page.file = folder + "/index.html";
    page.title = request.metadata["title"];
    page.about = request.metadata["subtitle"];
    page.kind = "lesson";
    page.language = language;
    page.body = document.head;
    page.body += runs_ ? "<noscript>" + notice(Message("Allow JavaScript to run the cells of this page."), language) +
                             "</noscript>\n"
                       : notice(Message("This site was created without the engine for browsers: the page shows the "
                                        "results of a run, and its cells cannot be run here."),
                                language);
    page.body += fmt::format(
        "<main id=\"lesson\" data-root=\"{}\" data-lesson=\"{}\" data-file=\"{}\" data-language=\"{}\">\n{}</main>\n",
        page.root(), html_text(lesson.slug), kScript, language, cells_of_page(script, document, record));

    const bool own_language = language == languages_of(lesson).front();
    const json description = {{"lesson", lesson.slug},
                              {"file", kScript},
                              {"language", language},
                              {"title", page.title},
                              {"files", files_of_copy(lesson, own_language ? "" : language)},
                              {"data", data_sets_of(lesson, record)},
                              {"checks", checks_of(lesson, language)}};
    made.description = description.dump() + "\n";
    return made;
}

}  // namespace dynlab::inline workflow
