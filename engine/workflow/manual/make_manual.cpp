#include "workflow/manual/make_manual.h"

#include <chrono>

#include "documents/error.h"
#include "documents/html/web_page.h"
#include "documents/text_lines.h"
#include "figures/gnuplot_renderer.h"
#include "platform/atomic_file.h"
#include "platform/cache.h"
#include "platform/program_lookup.h"
#include "platform/temporary_folder.h"
#include "scripting/interpreter/catalogue.h"
#include "scripting/runtime/help.h"
#include "workflow/demonstration.h"
#include "workflow/make_report.h"
#include "workflow/manual/course_text.h"
#include "workflow/manual/manual_folder.h"
#include "workflow/manual/manual_lists.h"
#include "workflow/manual/manual_text.h"
#include "workflow/manual/search_index.h"
#include "workflow/measures.h"
#include "workflow/run_script.h"

namespace dynlab::inline workflow {
namespace {

namespace fs = std::filesystem;

/// As many pages are set together: Pandoc takes a quarter of a second to begin.
constexpr std::size_t kTextsAtOnce = 30;

std::string file_of(const std::string& name) {
    return (name.starts_with("guide-") || name == "methods" ? name : "help-" + name) + ".html";
}

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
    const std::size_t from = text.find(begin), to = text.rfind(end);
    if (from == std::string::npos || to == std::string::npos)
        throw DocumentError(Message("a page of the manual has no {}", begin));
    return text.substr(from, to - from);
}

class ManualMaker {
  public:
    explicit ManualMaker(const ManualRequest& request) : request_(request) {}

    ManualResult make() {
        check_manual_folder(request_.folder);
        timed(Message("the examples of the help pages"), [&] { examples_ = run_help_examples(work_.path(), cache_); });
        timed(Message("lessons"), [&] { add_lessons(); });
        timed(Message("demonstrations"), [&] { add_demonstrations(); });
        timed(Message("figures"), [&] { draw(FigureFormat::kSvg); });
        timed(Message("guides and functions"), [&] { add_texts(); });
        timed(Message("manual.pdf"), [&] { add_pdf(); });
        timed(Message("lists and search"), [&] { add_lists(); });
        timed(Message("files"), [&] { write(); });
        return std::move(result_);
    }

  private:
    template <typename Work>
    void timed(const Message& step, Work work) {
        if (request_.step) request_.step(step);
        const auto begin = std::chrono::steady_clock::now();
        work();
        result_.timings.emplace_back(step,
                                     std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }

    /// The page that a report makes, without its style and scripts.
    std::string body_of(ReportRequest request) {
        request.output = work_.path() / "page.html";
        const ReportResult made = make_report(request);
        if (made.error) throw DocumentError(*made.error);
        return between(read_file(request.output), "<header>", "<script>");
    }

    void add_lessons() {
        for (const Lesson& lesson : lessons()) {
            ReportRequest request = sheet_of(lesson.slug);
            ManualPage page;
            page.file = "lesson-" + lesson.slug + ".html";
            page.title = request.metadata["title"];
            page.about = request.metadata["subtitle"];
            page.kind = "lesson";
            page.body = body_of(std::move(request));
            pages_.push_back(std::move(page));
        }
    }

    void add_demonstrations() {
        for (const Demonstration& demonstration : demonstrations()) {
            ManualPage page;
            page.file = "demo-" + demonstration.name + ".html";
            page.title = demonstration.title;
            page.about = "dynlab demo " + demonstration.name;
            page.kind = "demonstration";
            page.script = "demo-" + demonstration.name + ".lua";
            files_[page.script] = read_file(demonstration.script);
            page.body = body_of(report_of_script(read_percent_script(demonstration.script), {}));
            pages_.push_back(std::move(page));
        }
    }

    void draw(FigureFormat format) {
        GnuplotRenderer renderer(&cache_);
        draw_figures(examples_.record, renderer, work_.path(), format, "en");
        renderer.finish();
    }

    DocumentSource document_of(const MarkdownText& text) const {
        DocumentSource source;
        source.template_file = shared_folder() / "report_templates/manual.md";
        source.record = &examples_.record;
        source.cells = text;
        return source;
    }

    std::vector<ManualText> texts() const {
        std::vector<ManualText> all = help_texts(examples_);
        all.push_back(methods_text());
        return all;
    }

    void add_texts() {
        const std::vector<ManualText> all = texts();
        for (std::size_t begin = 0; begin < all.size(); begin += kTextsAtOnce) {
            const std::size_t end = std::min(begin + kTextsAtOnce, all.size());
            const std::vector<ManualText> some(all.begin() + static_cast<std::ptrdiff_t>(begin),
                                               all.begin() + static_cast<std::ptrdiff_t>(end));
            const fs::path output = work_.path() / "texts.html";
            DocumentMaker({}).make(document_of(joined_pages(some)), output, DocumentFormat::kHtml, nullptr);
            const std::string main = between(read_file(output), "<main>", "</main>");
            std::size_t at = main.find("<h1");
            for (const ManualText& text : some) {
                const std::size_t next = main.find("<h1", at + 1);
                add_text(text.name, main.substr(at, next - at));
                at = next;
            }
        }
    }

    void add_text(const std::string& name, const std::string& html) {
        ManualPage page;
        page.file = file_of(name);
        page.title = name;
        page.kind = "guide";
        page.body = "<main>\n" + html + "</main>\n";
        for (const FunctionEntry& entry : catalogue_of_functions())
            if (entry.name == name) page.kind = "function", page.area = entry.area, page.about = entry.summary;
        if (page.kind == "guide") {
            if (const auto help = find_help_page(name)) {
                page.title = replaced(title_of_guide(*help), "`", "");
                page.about = "dynlab help " + name;
            }
        }
        if (name == "methods") page.kind = "overview", page.title = "Methods";
        pages_.push_back(std::move(page));
    }

    void add_pdf() {
        draw(FigureFormat::kPdf);
        CourseText course = course_text(work_.path() / "course", cache_);
        write_file_atomically(work_.path() / "literature.bib", course.bibliography);
        RunRecord record = examples_.record;
        record.values = course.record.values;
        record.tables = course.record.tables;
        record.texts = course.record.texts;
        record.figures.merge(course.record.figures);
        const MarkdownText chapters = joined_chapters(texts());
        MarkdownText& text = course.markdown;
        text.text += chapters.text;
        text.origin.insert(text.origin.end(), chapters.origin.begin(), chapters.origin.end());
        DocumentSource source = document_of(text);
        source.record = &record;
        source.measures = measures_for_documents("en");
        source.bibliography = work_.path() / "literature.bib";
        source.metadata = {{"title", "The manual of dynlab"}, {"toc", "true"}};
        const fs::path output = work_.path() / "manual.pdf";
        DocumentMaker({}).make(source, output, DocumentFormat::kPdf, nullptr);
        files_["manual.pdf"] = read_file(output);
    }

    void add_lists() {
        std::map<std::string, std::string> by_name;
        for (const HelpPage& page : help_pages()) by_name[std::string(page.name)] = file_of(std::string(page.name));
        for (ManualPage& page : pages_)
            page.body = with_links_to_pages(with_pictures_apart(page.body, files_), by_name, page.file);
        const std::vector<ManualPage> listed = {gallery_page(pages_), functions_page(pages_), contents_page(pages_)};
        pages_.insert(pages_.end(), listed.begin(), listed.end());
        const fs::path shared = shared_folder() / "report_templates";
        const std::string style = read_file(shared / "html/document.css") + read_file(shared / "html/manual.css");
        for (const ManualPage& page : pages_) files_[page.file] = framed_page(page, style);
        files_["search.js"] = search_index(pages_);
        files_["document.js"] = scripts_of_pages(shared, "en");
        files_["manual.js"] = read_file(shared / "html/manual.js");
        result_.pages = pages_.size();
    }

    void write() { write_manual_folder(request_.folder, files_); }

    const ManualRequest& request_;
    Cache cache_;
    TemporaryFolder work_;
    HelpExamples examples_;
    std::vector<ManualPage> pages_;
    ManualFiles files_;
    ManualResult result_;
};

}  // namespace

ManualResult make_manual(const ManualRequest& request) {
    return ManualMaker(request).make();
}

}  // namespace dynlab::inline workflow
