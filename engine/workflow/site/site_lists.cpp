#include "workflow/site/site_lists.h"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>

#include "base/languages.h"
#include "base/reader.h"
#include "documents/text_lines.h"

namespace dynlab::inline workflow {
namespace {

std::string link_to(const SitePage& page, const std::string& root) {
    return fmt::format("<a href=\"{}{}\">{}</a>", root, page.file, html_text(page.title));
}

std::string item_of(const SitePage& page, const std::string& root, const std::string& remark = {}) {
    std::string item =
        fmt::format("<li>{}<span>{}{}</span>", link_to(page, root), html_text(page.about), html_text(remark));
    if (!page.script.empty()) item += fmt::format(" <a class=\"script\" href=\"{}{}\">script</a>", root, page.script);
    return item + "</li>\n";
}

std::string list_of_kind(const std::vector<SitePage>& pages, const std::string& kind, const std::string& root) {
    std::string list = "<ul class=\"pages\">\n";
    for (const SitePage& page : pages)
        if (page.kind == kind && page.language == "en") list += item_of(page, root);
    return list + "</ul>\n";
}

/// Each lesson once: in the language where it has a page in it.
std::string list_of_lessons(const std::vector<SitePage>& pages, const std::string& language, const std::string& root) {
    std::string list = "<ol class=\"pages\">\n";
    for (const SitePage& page : pages) {
        if (page.kind != "lesson" || (page.language != language && !page.translation.empty())) continue;
        const Message remark = page.language == language ? Message()
                               : page.language == "fr"   ? Message(" (in French)")
                                                         : Message(" (in English)");
        list += item_of(page, root, message_text(remark, {catalog_of(language)}));
    }
    return list + "</ol>\n";
}

std::string headed(const std::string& title, const std::string& about) {
    return fmt::format("<header>\n<h1>{}</h1>\n<p>{}</p>\n</header>\n", html_text(title), html_text(about));
}

SitePage overview(const std::string& file, const std::string& title, const std::string& about,
                  const std::string& main) {
    SitePage page;
    page.file = file;
    page.title = title;
    page.kind = "overview";
    page.about = about;
    page.body = headed(title, about) + "<main>\n" + main + "</main>\n";
    return page;
}

struct ShownFigure {
    std::string image, anchor, caption, code;
};

/// Links of a caption lead to places of the caption's page: only their words stay.
std::string without_links(std::string html) {
    static const RE2 tag("</?a( [^>]*)?>", RE2::Latin1);
    RE2::GlobalReplace(&html, tag, "");
    return html;
}

/// The place where the script of a figure begins: the last cell before the figure, or on a help page the last example,
/// which is marked if it can be run.
std::size_t code_before(const std::string& html, std::size_t figure) {
    for (const char* begin : {"<pre class=\"code\"", "<pre class=\"example", "<pre class=\"sourceCode"})
        if (const std::size_t at = html.rfind(begin, figure); at != std::string::npos) return at;
    return std::string::npos;
}

std::vector<ShownFigure> figures_of(const SitePage& page) {
    std::vector<ShownFigure> figures;
    const std::string& html = page.body;
    for (std::size_t at = 0; (at = html.find("<figure", at)) != std::string::npos; ++at) {
        const std::size_t end = html.find("</figure>", at), image = html.find("<img ", at);
        const std::size_t pre = code_before(html, at);
        if (image > end || pre == std::string::npos) continue;
        ShownFigure figure;
        figure.image =
            replaced(html.substr(image, html.find('>', image) + 1 - image), page.root() + "pictures/", "../pictures/");
        if (figure.image.find(".svg\"") == std::string::npos) continue;  // a photograph or a picture of a screen
        const std::size_t id = html.find(" id=\"", at);
        if (id < html.find('>', at)) figure.anchor = "#" + html.substr(id + 5, html.find('"', id + 5) - id - 5);
        const std::size_t caption = html.find("<figcaption", at);
        if (caption < end) {
            const std::size_t begin = html.find('>', caption) + 1;
            figure.caption = without_links(html.substr(begin, html.find("</figcaption>", begin) - begin));
        }
        const std::string block = html.substr(pre, html.find("</pre>", pre) - pre);
        figure.code = "<pre><code>" + html_text(text_in_html(block)) + "</code></pre>";
        figures.push_back(std::move(figure));
    }
    return figures;
}

}  // namespace

SitePage course_page(const std::vector<SitePage>& pages, const std::string& language, const SiteFrame& site) {
    const Reader reader{catalog_of(language)};
    const auto words = [&](const Message& message) { return html_text(message_text(message, reader)); };
    SitePage frame;
    frame.file = language == "en" ? "index.html" : language + "/index.html";
    const std::string root = frame.root();
    const auto part = [&](const std::string& id, const Message& title, const std::string& list) {
        return fmt::format("<h2 id=\"{}\">{}</h2>\n{}", id, words(title), list);
    };
    const auto entry = [&](const std::string& file, const Message& title, const Message& about) {
        return fmt::format("<li><a href=\"{}{}\">{}</a><span>{}</span></li>\n", root, file, words(title), words(about));
    };
    std::string main = fmt::format(
        "<p>{}</p>\n",
        words(site.runs
                  ? Message("Open a lesson and run its cells. Everything runs in your browser: there is nothing to "
                            "install, and your work stays on this device.")
                  : Message("This site was created without the engine for browsers: lessons show the results of a run, "
                            "and their cells cannot be run here.")));
    main += part("course", Message("Lessons"), list_of_lessons(pages, language, root));
    if (site.runs)
        main += part("workbench", Message("Workbench"),
                     "<ul class=\"pages\">\n" +
                         entry("workbench/index.html", Message("Workbench"),
                               Message("estimate a model from your data; the file stays on this device")) +
                         "</ul>\n");
    main += part("demonstrations", Message("Demonstrations"), list_of_kind(pages, "demonstration", root));
    main += part("guides", Message("Guides"), list_of_kind(pages, "guide", root));
    main +=
        part("reference", Message("Reference"),
             "<ul class=\"pages\">\n" +
                 entry("functions/index.html", Message("Functions"), Message("every function, with examples")) +
                 entry("guides/methods.html", Message("Methods"),
                       Message("model, assumptions and literature of every method")) +
                 entry("gallery/index.html", Message("Gallery"), Message("figures, each with its script")) + "</ul>\n");
    SitePage page = overview(
        frame.file, message_text(Message("System identification with dynlab"), reader),
        message_text(Message("A laboratory course on continuous-time models of dynamic systems"), reader), main);
    page.language = language;
    return page;
}

SitePage functions_page(const std::vector<SitePage>& pages) {
    std::vector<std::string> areas;
    for (const SitePage& page : pages)
        if (page.kind == "function" && std::ranges::find(areas, page.area) == areas.end()) areas.push_back(page.area);
    std::string main;
    for (const std::string& area : areas) {
        std::vector<SitePage> of_area;
        std::copy_if(pages.begin(), pages.end(), std::back_inserter(of_area),
                     [&](const SitePage& page) { return page.kind == "function" && page.area == area; });
        main += fmt::format("<h2 id=\"{}\">{}</h2>\n{}", replaced(area, " ", "-"), html_text(area),
                            list_of_kind(of_area, "function", "../"));
    }
    return overview("functions/index.html", "Functions", "What scripts can call, by area", main);
}

SitePage gallery_page(const std::vector<SitePage>& pages) {
    std::string main;
    for (const SitePage& page : pages) {
        const std::vector<ShownFigure> figures = figures_of(page);
        if (figures.empty() || page.language != "en") continue;
        main += fmt::format("<h2>{}</h2>\n<div class=\"gallery\">\n", link_to(page, "../"));
        for (const ShownFigure& figure : figures)
            main += fmt::format(
                "<div class=\"shown\"><a href=\"../{}{}\">{}</a>\n{}<details><summary>Script</summary>\n{}\n"
                "</details></div>\n",
                page.file, figure.anchor, figure.image, figure.caption.empty() ? "" : "<p>" + figure.caption + "</p>\n",
                figure.code);
        main += "</div>\n";
    }
    return overview("gallery/index.html", "Gallery", "Figures of the course and of the examples, with their sources",
                    main);
}

}  // namespace dynlab::inline workflow
