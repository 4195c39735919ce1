#include "documents/pandoc.h"

#include <fmt/format.h>

#include <set>
#include <string_view>
#include <utility>

#include "documents/error.h"
#include "documents/latex_remains.h"
#include "documents/lua_text.h"
#include "documents/text_lines.h"
#include "documents/words/costly_text.h"
#include "documents/work_file.h"
#include "platform/child_process.h"

namespace dynlab::inline documents {
namespace {

using namespace std::chrono_literals;

/// What authors write: no raw TeX or HTML output, no metadata or macros in the text. raw_html stays on so that
/// comments are read as such; the filter drops these and refuses all other HTML.
const char* const kReader =
    "markdown-raw_tex-raw_attribute-yaml_metadata_block-pandoc_title_block-latex_macros-native_divs-native_spans"
    // These extensions make Pandoc read each "[" in several ways: its time doubles with each unclosed one. The filter
    // finds citations in the text; each note has a separate line ([^1]: ...).
    "-markdown_in_html_blocks-citations-inline_notes-bracketed_spans";
constexpr std::chrono::seconds kMaxTime = 60s;  // of the processor; the manual, the longest document, takes some 10 s
const char* const kMarkdownWriter =
    "markdown-raw_html-raw_tex-raw_attribute-native_divs-native_spans-fenced_divs-bracketed_spans-header_attributes-"
    "link_attributes-fenced_code_attributes-inline_code_attributes-citations-simple_tables-multiline_tables-grid_"
    "tables-implicit_figures-smart";

std::string lua_list(const std::vector<std::string>& cells) {
    std::string result = "{";
    for (const std::string& cell : cells) result += lua_text(cell) + ",";
    return result + "}";
}

/// "{["name"]=...,}" of a map, each entry written by `write`.
template <typename Entry, typename Write>
std::string lua_map(const std::map<std::string, Entry>& entries, Write write) {
    std::string result = "{";
    for (const auto& [name, entry] : entries) result += "[" + lua_text(name) + "]=" + write(entry) + ",\n";
    return result + "}";
}

std::string lua_set(const std::set<std::string>& words) {
    std::string result = "{";
    for (const std::string& word : words) result += "[" + lua_text(word) + "]=true,";
    return result + "}";
}

std::string one_line(const std::string& text) {
    return replaced(text, "\n", " ");
}

std::string lua_table_entry(const RecordedTable& table) {
    std::string rows = "{";
    for (const auto& row : table.rows) {
        std::vector<std::string> cells = row;
        cells.resize(table.header.size());
        for (std::string& cell : cells) cell = trimmed(one_line(cell));
        rows += lua_list(cells) + ",";
    }
    return "{header=" + lua_list(table.header) + ",rows=" + rows + "}}";
}

bool is_switch(const std::string& key) {
    return key == "toc" || key == "numbersections";
}

/// The titles of sections, in any language, with that of the document's.
std::map<std::string, std::string> section_titles(const PandocJob& job) {
    std::map<std::string, std::string> titles;
    for (const SectionRule& section : job.rules.sections)
        titles[section.english] = titles[section.french] = section.title(job.language);
    return titles;
}

std::string format_name(DocumentFormat format) {
    if (format == DocumentFormat::kPdf) return "latex";
    return format == DocumentFormat::kHtml ? "html" : "markdown";
}

/// What authors escaped to see it as it is: commands of LaTeX, and "@key".
std::set<std::string> escaped_words(const PandocJob& job) {
    std::set<std::string> words = escaped_commands(job.markdown);
    words.merge(escaped_citations(job.markdown.text));
    for (const auto& [name, text] : job.record->texts) words.merge(escaped_citations(text.markdown));
    return words;
}

bool sets_slides(const PandocJob& job) {
    return job.rules.slides && job.format == DocumentFormat::kPdf;
}

std::string lua_counts(const Counts& counts) {
    return fmt::format("{{{}}}", fmt::join(counts, ","));
}

std::string chunks_entry(const ChunkSurroundings& chunks) {
    std::map<std::string, Counts> counts;
    for (const auto& [number, count] : chunks.counts) counts[std::to_string(number)] = count;
    return "{counts=" + lua_map(counts, lua_counts) + ",labels=" + lua_map(chunks.labels, lua_text) + "}";
}

std::string slots_file(const PandocJob& job) {
    std::map<std::string, std::string> shown, switches;
    for (const auto& [key, value] : job.metadata)
        if (key != "lang" && key != "bibliography" && key != "logo" && !is_document_rule(key) && !value.empty())
            (is_switch(key) ? switches : shown)[key] = value;
    const auto as_string = [](const std::string& text) { return lua_text(text); };
    const bool numbered = switches.count("numbersections") && switches.at("numbersections") == "true";
    std::string variables =
        "{lang=" + lua_text(job.language) + ",pagetitle=" + lua_text(job.template_file.stem().string());
    if (switches.count("toc") && switches.at("toc") == "true") variables += ",toc=true";
    if (!job.logo.empty()) variables += ",logo=" + lua_text(job.logo);
    const RunRecord& record = *job.record;
    return "return {\nformat=" + lua_text(format_name(job.format)) + ",language=" + lua_text(job.language) +
           ",reader=" + lua_text(kReader) + ",numbersections=" + (numbered ? "true" : "false") +
           ",stopped=" + (record.error || job.unfinished ? "true" : "false") +
           ",draft=" + (job.draft ? "true" : "false") + ",names_values=" + (job.names_values ? "true" : "false") +
           ",\npicture_prefix=" + lua_text(job.picture_prefix) +
           ",figure_extension=" + lua_text(figure_extension(job.format)) +
           ",bibliography=" + lua_text(job.bibliography) + ",escaped=" + lua_set(escaped_words(job)) +
           ",slides=" + (sets_slides(job) ? "true" : "false") + ",\nvariables=" + variables +
           "},\nmetadata=" + lua_map(shown, as_string) + ",\nmeasures=" + lua_map(job.measures, as_string) +
           ",\nsection_titles=" + lua_map(section_titles(job), as_string) +
           ",\nvalue=" + lua_map(record.values, [](const RecordedValue& v) { return lua_text(one_line(v.text)); }) +
           ",\ntable=" + lua_map(record.tables, lua_table_entry) + ",\nfigure=" +
           lua_map(record.figures, [](const RecordedFigure& f) { return "{caption=" + lua_text(f.caption) + "}"; }) +
           ",\ntext=" + lua_map(record.texts, [](const RecordedText& t) { return lua_text(t.markdown); }) +
           (job.chunks ? ",\nchunks=" + chunks_entry(*job.chunks) : "") + "}\n";
}

std::vector<std::string> command_line(const PandocJob& job) {
    const std::filesystem::path& shared = job.shared_templates;
    // -A32m: one large nursery, so that documents of usual size are made without garbage collection
    std::vector<std::string> command = {"pandoc", "+RTS", "-A32m", "-M1g", "-RTS", "-f", kReader, "-t"};
    if (job.format == DocumentFormat::kMarkdown)
        command.insert(command.end(), {kMarkdownWriter, "--wrap=preserve"});
    else if (job.format == DocumentFormat::kHtml)
        command.insert(command.end(), {"html5", "--mathml", "--wrap=preserve"});
    else if (job.rules.slides)
        command.insert(command.end(), {"beamer", "--slide-level=1", "--wrap=preserve"});
    else
        command.insert(command.end(), {"latex", "--wrap=preserve"});
    const char* const layout = sets_slides(job)                      ? "latex/slides.latex"
                               : job.format == DocumentFormat::kPdf  ? "latex/document.latex"
                               : job.format == DocumentFormat::kHtml ? "html/document.html"
                                                                     : "markdown/document.md";
    command.insert(command.end(), {"--template", (shared / layout).string(), "--lua-filter",
                                   (shared / "filters/document.lua").string(), "--data-dir", job.work_folder.string()});
    if (!job.bibliography.empty())
        command.insert(command.end(), {"--citeproc", "--lua-filter", (shared / "filters/references.lua").string()});
    return command;
}

ChildOptions pandoc_child(const PandocJob& job) {
    ChildOptions child;
    child.command = command_line(job);
    child.folder = job.work_folder;
    child.environment = {{"LC_ALL", "C.UTF-8"}};
    child.processor_time = kMaxTime;
    child.timeout = 10 * kMaxTime;  // of a machine that others keep busy
    return child;
}

/// The job's Pandoc at its end, whether it was started before or is now.
ChildResult finished_pandoc(const PandocJob& job) {
    if (job.started != nullptr) {
        job.started->give_input(job.markdown.text);
        return job.started->wait();
    }
    ChildOptions child = pandoc_child(job);
    child.input = job.markdown.text;
    return run_child(child, "pandoc");
}

/// The first place where the job's texts hold what Pandoc would not be done with. What was counted up to there does not
/// speak against the texts behind it.
Complaints costly_text_of(const PandocJob& job) {
    Complaints found;
    CostlyText costly;
    if (const auto line = costly.line_of(job.markdown.text)) {
        found.add(job.markdown.origin_of(*line), CostlyText::complaint());
        return found;
    }
    std::vector<std::pair<std::string, std::string_view>> texts;
    for (const auto& [name, text] : job.record->texts) texts.emplace_back(name, text.markdown);
    for (const auto& [name, figure] : job.record->figures) texts.emplace_back(name, figure.caption);
    for (const auto& [key, text] : job.metadata) texts.emplace_back(key, text);
    for (const auto& [name, text] : texts)
        if (costly.line_of(text)) {
            found.add({job.template_file}, Message("{}: {}", name, CostlyText::complaint()));
            break;
        }
    return found;
}

}  // namespace

std::string figure_extension(DocumentFormat format) {
    return format == DocumentFormat::kPdf ? "pdf" : "svg";
}

ChildProcess start_pandoc(const PandocJob& job) {
    ChildOptions child = pandoc_child(job);
    child.input_later = true;
    return ChildProcess(child, "pandoc");
}

PandocResult run_pandoc(const PandocJob& job, Complaints& complaints) {
    if (const Complaints costly = costly_text_of(job); !costly.empty()) {
        complaints.add_all(costly);
        return {};
    }
    write_work_file(job.work_folder / "slots.lua", slots_file(job));
    ChildResult run = finished_pandoc(job);
    if (run.timed_out)
        throw DocumentError(Place{job.template_file},
                            Message("Pandoc did not finish this document within {} s of processor time, or ten times "
                                    "this limit in elapsed time; shorten the document",
                                    kMaxTime.count()));
    if (run.output_exceeded)
        throw DocumentError(Place{job.template_file},
                            Message("the output of Pandoc exceeds the size limit; shorten the document"));
    Complaints found;
    PandocResult result;
    FilterMessages messages =
        read_filter_messages(run.error_output, job.markdown, job.template_file, *job.record, found);
    result.pictures = std::move(messages.pictures);
    result.chunks = std::move(messages.chunks);
    result.gaps = std::move(messages.gaps);
    if (run.exit_code != 0 && found.empty())
        found.add({job.template_file}, Message("Pandoc stopped with exit code {}", run.exit_code));
    if (found.empty() || (job.chunks && run.exit_code == 0)) result.text = std::move(run.output);
    complaints.add_all(found);
    return result;
}

}  // namespace dynlab::inline documents
