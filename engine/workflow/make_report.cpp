#include "workflow/make_report.h"

#include <fmt/format.h>
#include <toml++/toml.h>
#include <algorithm>

#include "documents/error.h"
#include "documents/solutions.h"
#include "documents/template_file.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/program_lookup.h"
#include "platform/stopwatch.h"
#include "platform/temporary_folder.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "workflow/error_text.h"
#include "workflow/given_script.h"
#include "workflow/measures.h"
#include "workflow/notebooks/notebook.h"
#include "workflow/report_cache.h"
#include "workflow/run_cache.h"
#include "workflow/run_script.h"
#include "workflow/slider_runs.h"
#include "workflow/student_copy.h"

namespace dynlab::inline workflow {
namespace {

namespace fs = std::filesystem;

fs::path template_named(const std::string& name) {
    return shared_folder() / "report_templates" / (name + ".md");
}

/// The seed a group's folder asks for; the script's own without group.toml.
std::uint32_t seed_of_group(const fs::path& folder, std::uint32_t otherwise) {
    const fs::path file = folder / "group.toml";
    if (!fs::exists(file)) return otherwise;
    try {
        const toml::table group = toml::parse_file(file.string());
        const std::int64_t seed = group["seed"].value_or<std::int64_t>(otherwise);
        if (seed < 0 || seed > std::int64_t{UINT32_MAX}) {
            throw DocumentError(Place{file},
                                Message("the seed must be a whole number from 0 to 4294967295, not {}", seed));
        }
        return static_cast<std::uint32_t>(seed);
    } catch (const toml::parse_error& error) {
        throw DocumentError(Place{file, static_cast<int>(error.source().begin.line)},
                            Message::verbatim(std::string(error.description())));
    }
}

ReportRequest report_of_folder(const fs::path& folder, const fs::path& output) {
    for (const char* needed : {"analysis.lua", "report.md"}) {
        if (!fs::is_regular_file(folder / needed)) {
            const Message near = nearly_called(folder, needed);
            throw EnvironmentError(near.empty() ? Message("{} has no {}; a report needs analysis.lua and report.md "
                                                          "(dynlab new LESSON DIR creates them)",
                                                          folder.string(), needed)
                                                : Message("{} has no {}, {}; a report needs analysis.lua and report.md "
                                                          "(dynlab new LESSON DIR creates them)",
                                                          folder.string(), needed, near));
        }
    }
    ReportRequest request;
    request.script = read_percent_script(folder / "analysis.lua");
    request.template_file = folder / "report.md";
    request.output = output.empty() ? folder / "report.pdf" : output;
    request.seed = seed_of_group(folder, request.script.header.seed);
    const auto metadata = read_template(request.template_file).metadata;
    if (const auto language = metadata.find("lang"); language != metadata.end() && !language->second.empty())
        request.script.header.language = language->second;
    return request;
}

/// The questions that the lesson's readers check themselves by, where there are some; without answers on task sheets,
/// whose own questions they would answer.
void add_self_check(const Lesson& lesson, ReportRequest& request, bool with_answers) {
    const fs::path file = lesson.self_check(request.script.header.language);
    if (!fs::is_regular_file(file)) return;
    const std::string text = read_text(file);
    request.last_section.append(with_answers ? text : replaced(text, "::: choice\n", "::: {.choice .unanswered}\n"),
                                file, 1);
}

/// The report next to a lesson's script, or the woven lesson itself.
ReportRequest report_of_lesson(const Lesson& lesson, const fs::path& output, const std::string& language) {
    PercentScript script = read_percent_script(lesson.script());
    if (!language.empty()) script.header.language = language;
    ReportRequest request = report_of_script(script, output.empty() ? fs::path(lesson.slug + ".pdf") : output);
    request.of_lesson = true;
    add_self_check(lesson, request, true);
    const fs::path report = lesson.report(script.header.language);
    if (fs::is_regular_file(report)) {
        request.template_file = report;
        request.metadata.clear();
    } else if (!language.empty()) {
        throw EnvironmentError("lesson {} has no report in the language \"{}\"; the file {} does not exist",
                               lesson.slug, language, report.filename().string());
    }
    return request;
}

/// All text of a document: the template's, and the cells' where it shows them.
std::string text_of_document(const fs::path& template_file, const MarkdownText& cells) {
    return read_text(template_file) + (shows_cells(read_template(template_file)) ? cells.text : "");
}

std::vector<std::pair<std::string, double>> cells_in_order(const PercentScript& script,
                                                           const std::map<std::string, double>& seconds) {
    std::vector<std::pair<std::string, double>> cells;
    for (const Cell& cell : script.cells)
        if (const auto found = seconds.find(cell.id); found != seconds.end()) cells.push_back(*found);
    return cells;
}

DocumentSource template_of(const ReportRequest& request) {
    DocumentSource source;
    source.template_file = request.template_file;
    source.metadata = request.metadata;
    return source;
}

FigureFormat figure_format_for(DocumentFormat format) {
    return format == DocumentFormat::kPdf ? FigureFormat::kPdf : FigureFormat::kSvg;
}

PercentScript text_of(PercentScript script) {
    std::erase_if(script.cells, [](const Cell& cell) { return cell.kind == Cell::Kind::kCode; });
    return script;
}

bool has_text(const PercentScript& script) {
    return std::ranges::any_of(script.cells, [](const Cell& cell) { return cell.kind == Cell::Kind::kText; });
}

}  // namespace

std::vector<UnplacedEntries> entries_without_place(const PercentScript& script, const RunRecord& record) {
    const fs::path report = script.file.parent_path() / "report.md";
    if (record.error || script.file.filename() == "lesson.lua") return {};
    const MarkdownText cells = weave_cells(script, record);
    if (script.file.filename() == "analysis.lua" && fs::is_regular_file(report))
        return unplaced_entries(record, text_of_document(report, cells));
    return has_text(script) ? unplaced_entries(record, cells.text) : std::vector<UnplacedEntries>();
}

ReportRequest report_of_script(const PercentScript& script, const fs::path& output) {
    ReportRequest request;
    request.script = script;
    const ScriptHeader& header = request.script.header;
    request.template_file = template_named(header.template_name);
    if (!fs::is_regular_file(request.template_file)) {
        throw DocumentError(Place{script.file},
                            Message("unknown template '{}'; dynlab searched {}", header.template_name,
                                    request.template_file.parent_path().string()));
    }
    // A template to be written in shows nothing of a script alone.
    if (!shows_cells(read_template(request.template_file))) request.template_file = template_named("lesson");
    request.metadata = {{"title", header.title.empty() ? script.file.stem().string() : header.title},
                        {"subtitle", header.subtitle},
                        {"lang", header.language}};
    request.output = output;
    request.seed = header.seed;
    return request;
}

ReportRequest report_of(const std::string& subject, const fs::path& output, const std::string& language) {
    const fs::path folder = subject;
    if (fs::is_regular_file(folder)) {
        if (!language.empty())
            throw EnvironmentError(
                "--lang applies only to a lesson. Set the language in the header of {} with \"language:\"", subject);
        return report_of_script(read_script_or_notebook(folder),
                                output.empty() ? fs::path(folder).replace_extension(".pdf") : output);
    }
    if (!fs::is_directory(folder) || (lesson_in(folder) && !fs::exists(folder / "analysis.lua")))
        return report_of_lesson(find_lesson(subject), output, language);
    if (!language.empty())
        throw EnvironmentError(
            "--lang applies only to a lesson. Set the language of {} in the header of report.md with \"lang:\"",
            subject);
    return report_of_folder(subject, output);
}

DocumentSource document_source(const ReportRequest& request, const RunRecord& record) {
    DocumentSource source = template_of(request);
    source.record = &record;
    source.bibliography = bibliography_of(request.script);
    source.measures = measures_for_documents(request.script.header.language);
    if (request.shows == ReportRequest::Shows::kCells) source.cells = weave_cells(request.script, record);
    if (request.shows == ReportRequest::Shows::kText) source.cells = weave_cells(text_of(request.script), record);
    source.cells.text += request.last_section.text;
    const std::vector<Place>& further = request.last_section.origin;
    source.cells.origin.insert(source.cells.origin.end(), further.begin(), further.end());
    return source;
}

ReportRequest sheet_of(const std::string& name, const fs::path& output, const std::string& language) {
    const Lesson lesson = find_lesson(name);
    const PercentScript master = lesson_script(lesson, language);
    if (!language.empty() && master.header.language != language)
        throw EnvironmentError("lesson {} has no tasks in the language \"{}\"; the file {} does not exist", lesson.slug,
                               language, lesson.tasks(language).filename().string());
    const PercentScript tasks = parse_percent_script(
        without_solutions(master.source, lesson.script(), master.header.language), lesson.script());
    ReportRequest request = report_of_script(tasks, output.empty() ? fs::path(lesson.slug + "_sheet.pdf") : output);
    request.of_lesson = true;
    add_self_check(lesson, request, false);
    return request;
}

ReportRequest model_answers_of(const Lesson& lesson, const fs::path& output, const std::string& language) {
    ReportRequest request = report_of_lesson(lesson, output, language);
    request.shows = ReportRequest::Shows::kText;
    request.last_section = {};
    return request;
}

ReportRequest talk_sheet_of(const std::string& name, bool with_answers, const fs::path& output) {
    const Lesson lesson = find_lesson(name);
    const fs::path file = lesson.talk_questions();
    if (!fs::is_regular_file(file))
        throw EnvironmentError("lesson {} has no questions for a talk; the file {} does not exist", lesson.slug,
                               file.string());
    const PercentScript master = read_percent_script(lesson.script());
    ReportRequest request = report_of_script(master, output.empty() ? fs::path(lesson.slug + "_talk.pdf") : output);
    request.metadata["title"] = "Questions after the talk";
    request.metadata["subtitle"] = master.header.title + (with_answers ? " – with model answers" : "");
    request.template_file = template_named("lesson");
    request.of_lesson = true;
    request.shows = ReportRequest::Shows::kNothing;
    int line_number = 0, question = 0;
    for (const std::string& line : lines_of(read_text(file))) {
        ++line_number;
        if (line.starts_with("# "))
            request.last_section.append(fmt::format("**{}. {}**\n\n", ++question, line.substr(2)), file, line_number);
        else if (with_answers)
            request.last_section.append(line + "\n", file, line_number);
    }
    return request;
}

ReportResult make_report(const ReportRequest& request) {
    const auto begin = [&](const Message& step) {
        if (request.step) request.step(step);
    };
    ReportResult result;
    Stopwatch watch(&result.timings);
    const DocumentFormat format = document_format(request.output);
    const Cache cache;
    const ReportCache reports(request, cache);
    const bool from_start = request.print || !request.record.empty();
    result.up_to_date = !from_start && reports.unchanged();
    watch.note("look for changes");
    if (result.up_to_date) return result;

    const RunCache runs(request, figure_format_for(format), cache);
    const TemporaryFolder workplace;
    CallCache calls(cache);
    GnuplotRenderer renderer(&cache);
    std::optional<CachedLatexFormat> latex_format;  // made by TeX while the script runs
    std::optional<RunRecord> known;
    if (!from_start) known = runs.load_entry();
    const bool from_cache = known.has_value();
    RunRecord record;
    if (from_cache) {
        record = *std::move(known);
        watch.note("recall the run");
    } else {
        begin(Message("running the script"));
        if (format == DocumentFormat::kPdf) latex_format.emplace(latex_layout(template_of(request)));
        RunRequest run{.script = request.script,
                       .seed = request.seed,
                       .slider_values = request.slider_values,
                       .out_folder = workplace.path(),
                       .print = request.print,
                       .enter_cell = request.enter_cell,
                       .stay_in_folder = request.stay_in_folder,
                       .call_cache = &calls};
        record = run_script(run, renderer);
        result.cells = cells_in_order(request.script, record.timings);
        result.long_calls = calls.use();
        if (record.error) result.error = error_message(*record.error, request.script);
        if (record.error && request.print) throw DocumentError(*result.error);
        draw_figures(record, renderer, workplace.path(), figure_format_for(format), request.script.header.language);
        if (!request.record.empty()) write_file_atomically(request.record, to_json(record));
        watch.note(kRunStep);
    }

    begin(Message("creating the document"));
    const DocumentSource source = document_source(request, record);
    if (!record.error && !request.of_lesson)
        result.unplaced = unplaced_entries(record, text_of_document(request.template_file, source.cells));
    try {
        DocumentMaker::Options options;
        options.timings = &result.timings;
        options.begun_format = latex_format ? &*latex_format : nullptr;
        Complaints gaps;
        options.gaps = &gaps;
        options.notes = &result.notes;
        std::vector<fs::path> pictures;
        options.pictures = &pictures;
        DocumentMaker(options).make(source, request.output, format, [&] {
            renderer.finish();
            if (from_cache) return;
            result.figures = renderer.use();
            runs.save_entry(record);
        });
        result.gaps = gaps.messages();
        record.files_read.insert(record.files_read.end(), pictures.begin(), pictures.end());
        if (format == DocumentFormat::kHtml) {
            const auto read = add_slider_places(request, record, calls, workplace.path());
            record.files_read.insert(record.files_read.end(), read.begin(), read.end());
        }
    } catch (const DocumentError& complaint) {
        if (!result.error) throw;
        throw DocumentError(
            Message("{}\nThe report up to this point cannot be created: {}", *result.error, complaint.message()));
    }
    if (!result.error && result.gaps.empty()) reports.save_entry(record);
    return result;
}

}  // namespace dynlab::inline workflow
