#include "workflow/site/make_site.h"

#include <chrono>
#include <set>

#include "documents/error.h"
#include "documents/text_lines.h"
#include "figures/gnuplot_renderer.h"
#include "platform/atomic_file.h"
#include "platform/cache.h"
#include "platform/error.h"
#include "platform/program_lookup.h"
#include "platform/temporary_folder.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/runtime/help.h"
#include "workflow/demonstration.h"
#include "workflow/make_report.h"
#include "workflow/run_script.h"
#include "workflow/site/lesson_page.h"
#include "workflow/site/search_index.h"
#include "workflow/site/site_data.h"
#include "workflow/site/site_folder.h"
#include "workflow/site/site_lists.h"
#include "workflow/site/site_manifest.h"
#include "workflow/site/site_text.h"

namespace dynlab::inline workflow {
namespace {

namespace fs = std::filesystem;

/// As many pages are set together: Pandoc takes a quarter of a second to begin.
constexpr std::size_t kTextsAtOnce = 30;

std::string file_of(const std::string& name) {
    return (find_function(name) ? "functions/" : "guides/") + name + ".html";
}

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
    const std::size_t from = text.find(begin), to = text.rfind(end);
    if (from == std::string::npos || to == std::string::npos)
        throw DocumentError(Message("a page of the site has no {}", begin));
    return text.substr(from, to - from);
}

class SiteMaker {
  public:
    explicit SiteMaker(const SiteRequest& request) : request_(request) {
        const fs::path shared = shared_folder() / "report_templates/html";
        frame_.style = read_file(shared / "document.css") + read_file(shared / "site.css");
        frame_.runs = request_.engine.has_value();
    }

    SiteResult make() {
        check_site_folder(request_.folder);
        check_engine();
        timed(Message("the examples of the help pages"), [&] { add_examples(); });
        add_lessons();
        timed(Message("demonstrations"), [&] { add_demonstrations(); });
        timed(Message("guides and functions"), [&] { add_texts(); });
        timed(Message("data sets"), [&] { files_.merge(data_of_site()); });
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

    void check_engine() const {
        if (!request_.engine) return;
        for (const char* file : {"dynlab.js", "dynlab.wasm"})
            if (!fs::is_regular_file(*request_.engine / file))
                throw EnvironmentError("{} has no {}. To build the engine for browsers, run: scripts/build web",
                                       request_.engine->string(), file);
    }

    void add_examples() {
        examples_ = run_help_examples(work_.path(), cache_);
        GnuplotRenderer renderer(&cache_);
        draw_figures(examples_.record, renderer, work_.path(), FigureFormat::kSvg, "en");
        renderer.finish();
    }

    void add_lessons() {
        const std::vector<Lesson> all = lessons();
        const std::map<std::string, std::string> numbers = numbers_of(all);
        LessonPages made_pages(work_.path() / "lessons", cache_, runs());
        for (const Lesson& lesson : all)
            timed(Message("lesson {}", lesson.slug), [&] {
                std::vector<SitePage> versions;
                for (const std::string& language : languages_of(lesson)) {
                    LessonPage made = made_pages.make(lesson, language, numbers.at(lesson.slug));
                    files_[(fs::path(made.page.file).parent_path() / "lesson.json").string()] = made.description;
                    add_page_code(made.page, "lesson_page");
                    if (runs()) made.page.first_modules.push_back("page/engine_start.js");
                    versions.push_back(std::move(made.page));
                }
                if (versions.size() > 1) {
                    versions[0].translation = versions[1].file;
                    versions[1].translation = versions[0].file;
                }
                pages_.insert(pages_.end(), versions.begin(), versions.end());
            });
    }

    bool runs() const { return frame_.runs; }

    /// Style and script that let a page run code.
    void add_page_code(SitePage& page, const std::string& name) const {
        if (!runs()) return;
        const std::string style = "page/" + name + ".css", script = "page/" + name + ".js";
        if (request_.page_files.count(style)) page.styles.push_back(style);
        if (request_.page_files.count(script)) page.modules.push_back(script);
    }

    void add_demonstrations() {
        for (const Demonstration& demonstration : demonstrations()) {
            SitePage page;
            page.file = "demonstrations/" + demonstration.name + ".html";
            page.title = demonstration.title;
            page.about = "dynlab demo " + demonstration.name;
            page.kind = "demonstration";
            page.script = "demonstrations/" + demonstration.name + ".lua";
            files_[page.script] = read_file(demonstration.script);
            page.body = body_of(report_of_script(read_percent_script(demonstration.script), {}));
            pages_.push_back(std::move(page));
        }
    }

    DocumentSource document_of(const MarkdownText& text) const {
        DocumentSource source;
        source.template_file = shared_folder() / "report_templates/help.md";
        source.record = &examples_.record;
        source.cells = text;
        return source;
    }

    std::vector<SiteText> texts() const {
        std::vector<SiteText> all = help_texts(examples_);
        all.push_back(methods_text());
        return all;
    }

    void add_texts() {
        const std::vector<SiteText> all = texts();
        for (std::size_t begin = 0; begin < all.size(); begin += kTextsAtOnce) {
            const std::size_t end = std::min(begin + kTextsAtOnce, all.size());
            const std::vector<SiteText> some(all.begin() + static_cast<std::ptrdiff_t>(begin),
                                             all.begin() + static_cast<std::ptrdiff_t>(end));
            const fs::path output = work_.path() / "texts.html";
            DocumentMaker({}).make(document_of(joined_pages(some)), output, DocumentFormat::kHtml, nullptr);
            const std::string main = between(read_file(output), "<main>", "</main>");
            std::size_t at = main.find("<h1");
            for (const SiteText& text : some) {
                const std::size_t next = main.find("<h1", at + 1);
                add_text(text.name, main.substr(at, next - at));
                at = next;
            }
        }
    }

    void add_text(const std::string& name, const std::string& html) {
        SitePage page;
        page.file = file_of(name);
        page.title = name;
        page.kind = "guide";
        page.body = "<main>\n" + html + "</main>\n";
        if (const FunctionEntry* const entry = find_function(name)) {
            page.kind = "function", page.area = entry->area, page.about = entry->summary;
            if (runs()) page.body = with_run_example(page.body);
            add_page_code(page, "help_page");
        }
        if (page.kind == "guide") {
            if (const auto help = find_help_page(name)) {
                page.title = replaced(title_of_guide(*help), "`", "");
                page.about = "dynlab help " + name;
            }
        }
        if (name == "methods") page.kind = "overview", page.title = "Methods";
        pages_.push_back(std::move(page));
    }

    /// The code that was run for the page is what page/help_page.js makes an editor of.
    static std::string with_run_example(const std::string& html) {
        return replaced(html, "<pre class=\"sourceCode lua cell\">", "<pre class=\"example sourceCode lua\" data-run>");
    }

    void add_lists() {
        std::map<std::string, std::string> by_name;
        for (const HelpPage& page : help_pages()) by_name[std::string(page.name)] = file_of(std::string(page.name));
        for (SitePage& page : pages_) {
            page.body = with_pictures_apart(page.body, page.root(), files_);
            page.body = with_links_to_pages(page, by_name);
        }
        std::vector<SitePage> listed = {gallery_page(pages_), functions_page(pages_)};
        std::vector<SitePage> first;
        std::set<std::string> spoken = {"en"};
        for (const SitePage& page : pages_) spoken.insert(page.language);
        for (const std::string& language : spoken) first.push_back(course_page(pages_, language, frame_));
        if (first.size() == 2) {
            first[0].translation = first[1].file;
            first[1].translation = first[0].file;
        }
        pages_.insert(pages_.end(), listed.begin(), listed.end());
        pages_.insert(pages_.end(), first.begin(), first.end());
        result_.pages = pages_.size();
    }

    void write() {
        const fs::path shared = shared_folder() / "report_templates/html";
        for (const auto& [name, content] : request_.page_files)
            if (runs() || name.starts_with("page/")) files_[name] = content;
        for (const SitePage& page : pages_) files_[page.file] = framed_page(page, frame_);
        files_["page/search.js"] = search_index(pages_);
        files_["icon.svg"] = read_file(shared / "dynlab.svg");
        if (runs()) add_engine();
        files_["manifest.webmanifest"] = web_manifest();
        files_["files.json"] = list_of_files(files_);
        write_site_folder(request_.folder, files_);
    }

    /// Adds the engine with the texts that it fetches, all in one folder. The build's own files of CMake there are left
    /// out.
    void add_engine() {
        for (const auto& entry : fs::directory_iterator(*request_.engine)) {
            const std::string name = entry.path().filename();
            if (entry.is_regular_file() && !name.starts_with("CMake") && !name.starts_with("cmake"))
                files_["engine/" + name] = read_file(entry.path());
        }
    }

    const SiteRequest& request_;
    SiteFrame frame_;
    Cache cache_;
    TemporaryFolder work_;
    HelpExamples examples_;
    std::vector<SitePage> pages_;
    SiteFiles files_;
    SiteResult result_;
};

}  // namespace

SiteResult make_site(const SiteRequest& request) {
    return SiteMaker(request).make();
}

std::optional<fs::path> web_engine() {
    const fs::path shared = shared_folder_of(running_program());
    for (const fs::path& folder : {shared / "web", shared / "build/web/engine"})
        if (fs::is_regular_file(folder / "dynlab.wasm")) return folder;
    return std::nullopt;
}

}  // namespace dynlab::inline workflow
