#include "workflow/manual/course_text.h"

#include <re2/re2.h>

#include <set>

#include "documents/error.h"
#include "documents/text_lines.h"
#include "figures/gnuplot_renderer.h"
#include "platform/atomic_file.h"
#include "platform/cache.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "workflow/make_report.h"
#include "workflow/run_cache.h"
#include "workflow/run_script.h"

namespace dynlab::inline workflow {
namespace {

namespace fs = std::filesystem;

RunRecord run_for_paper(const ReportRequest& request, const fs::path& folder, const Cache& cache) {
    const RunCache runs(request, FigureFormat::kPdf, cache);
    if (auto known = runs.recall()) return *std::move(known);
    fs::create_directories(folder);
    CallCache calls(cache);
    GnuplotRenderer renderer(&cache);
    RunRequest run;
    run.script = request.script;
    run.seed = request.seed;
    run.out_folder = folder;
    run.call_cache = &calls;
    RunRecord record = run_script(run, renderer);
    if (record.error) throw DocumentError(Message::verbatim(record.error->text()));
    draw_figures(record, renderer, folder, FigureFormat::kPdf, request.script.header.language);
    renderer.finish();
    runs.remember(record);
    return record;
}

std::string with_own_names_in_line(std::string line, const std::string& prefix) {
    static const RE2 name(R"([#@](?:fig|tbl|eq|sec):|\]\(figure:|\{\.(?:table|text) name=)", RE2::Latin1),
        value(R"(`([^`]+)`\{\.value\})", RE2::Latin1);
    RE2::GlobalReplace(&line, name, R"(\0)" + prefix);
    RE2::GlobalReplace(&line, value, "`" + prefix + R"(\1`{.value})");
    return line;
}

/// Markdown that can stand beside that of others: labels of figures, tables, equations and sections, references to them
/// and names of slots begin with `prefix`; headings are one level lower; the place of the literature is left out.
MarkdownText with_own_names(const MarkdownText& markdown, const std::string& prefix) {
    MarkdownText own;
    own.origin = markdown.origin;
    FencedCode code;
    bool literature = false;
    for (const std::string& line : lines_of(markdown.text)) {
        const bool in_code = code.holds(line);
        if (!in_code && trimmed(line) == "::: references") literature = true;
        const bool heading = !in_code && line.starts_with('#') && line.find_first_not_of('#') < line.size() &&
                             line[line.find_first_not_of('#')] == ' ';
        if (!literature) own.text += (heading ? "#" : "") + (in_code ? line : with_own_names_in_line(line, prefix));
        own.text += '\n';
        if (literature && trimmed(line) == ":::") literature = false;
    }
    return own;
}

std::string text_with_own_names(const std::string& text, const std::string& prefix) {
    MarkdownText markdown;
    markdown.append(text, "", 1);
    return with_own_names(markdown, prefix).text;
}

template <typename Entries>
void take_entries(Entries& from, const std::string& prefix, Entries& all) {
    for (auto& [name, entry] : from) all.emplace(prefix + name, std::move(entry));
}

void take_record(RunRecord record, const std::string& prefix, RunRecord& all) {
    for (auto& [name, text] : record.texts) text.markdown = text_with_own_names(text.markdown, prefix);
    for (auto& [name, figure] : record.figures) figure.caption = trimmed(text_with_own_names(figure.caption, prefix));
    take_entries(record.values, prefix, all.values);
    take_entries(record.tables, prefix, all.tables);
    take_entries(record.texts, prefix, all.texts);
    take_entries(record.figures, prefix, all.figures);
}

/// The entries of a BibTeX file whose keys are not known yet.
std::string new_entries(const std::string& bibtex, std::set<std::string>& keys) {
    std::string entries;
    for (std::size_t at = bibtex.find('@'); at != std::string::npos;) {
        const std::size_t next = bibtex.find("\n@", at);
        const std::size_t open = bibtex.find('{', at), comma = bibtex.find(',', at);
        if (keys.insert(bibtex.substr(open + 1, comma - open - 1)).second)
            entries += bibtex.substr(at, next - at) + "\n";
        at = next == std::string::npos ? next : next + 1;
    }
    return entries;
}

}  // namespace

CourseText course_text(const fs::path& folder, const Cache& cache) {
    CourseText course;
    std::set<std::string> keys;
    for (const Lesson& lesson : lessons()) {
        ReportRequest request = sheet_of(lesson.slug, folder / (lesson.slug + ".pdf"));
        const RunRecord record = run_for_paper(request, folder / lesson.slug, cache);
        const DocumentSource source = document_source(request, record);
        const std::string prefix = "l" + replaced(lesson.slug, "_", "-") + "-";
        course.markdown.append("\n# " + request.metadata["title"] + "\n\n" + request.metadata["subtitle"] + "\n\n",
                               lesson.script(), 1);
        const MarkdownText text = with_own_names(source.cells, prefix);
        course.markdown.text += text.text + "\n";
        course.markdown.origin.insert(course.markdown.origin.end(), text.origin.begin(), text.origin.end());
        course.markdown.origin.push_back({lesson.script(), 1});
        take_record(record, prefix, course.record);
        if (!source.bibliography.empty()) course.bibliography += new_entries(read_text(source.bibliography), keys);
    }
    return course;
}

}  // namespace dynlab::inline workflow
