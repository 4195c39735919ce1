#include "workflow/manual/manual_lists.h"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>

#include "documents/text_lines.h"

namespace dynlab::inline workflow {
namespace {

std::string link_to(const ManualPage& page) {
    return fmt::format("<a href=\"{}\">{}</a>", page.file, html_text(page.title));
}

std::string list_of_kind(const std::vector<ManualPage>& pages, const std::string& kind) {
    std::string list = "<ul class=\"pages\">\n";
    for (const ManualPage& page : pages) {
        if (page.kind != kind) continue;
        list += fmt::format("<li>{}<span>{}</span>", link_to(page), html_text(page.about));
        if (!page.script.empty()) list += fmt::format(" <a class=\"script\" href=\"{}\">script</a>", page.script);
        list += "</li>\n";
    }
    return list + "</ul>\n";
}

std::string headed(const std::string& title, const std::string& about) {
    return fmt::format("<header>\n<h1>{}</h1>\n<p>{}</p>\n</header>\n", html_text(title), html_text(about));
}

ManualPage overview(const std::string& file, const std::string& title, const std::string& about,
                    const std::string& main) {
    ManualPage page;
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

/// Links of a caption lead to places of its own page: their words stay.
std::string without_links(std::string html) {
    static const RE2 tag("</?a( [^>]*)?>", RE2::Latin1);
    RE2::GlobalReplace(&html, tag, "");
    return html;
}

/// The figures of a page, each with the block of code that stands before it.
std::vector<ShownFigure> figures_of(const ManualPage& page) {
    std::vector<ShownFigure> figures;
    const std::string& html = page.body;
    for (std::size_t at = 0; (at = html.find("<figure", at)) != std::string::npos; ++at) {
        const std::size_t end = html.find("</figure>", at), image = html.find("<img ", at);
        const std::size_t code = html.rfind("<div class=\"sourceCode\"", at);
        if (image > end || code == std::string::npos) continue;
        ShownFigure figure;
        figure.image = html.substr(image, html.find('>', image) + 1 - image);
        if (figure.image.find(".svg\"") == std::string::npos) continue;  // a photograph or a picture of a screen
        const std::size_t id = html.find(" id=\"", at);
        if (id < html.find('>', at)) figure.anchor = "#" + html.substr(id + 5, html.find('"', id + 5) - id - 5);
        const std::size_t caption = html.find("<figcaption", at);
        if (caption < end) {
            const std::size_t begin = html.find('>', caption) + 1;
            figure.caption = without_links(html.substr(begin, html.find("</figcaption>", begin) - begin));
        }
        const std::size_t pre = html.find("<pre", code);
        const std::string block = html.substr(pre, html.find("</pre>", pre) - pre);
        figure.code = "<pre><code>" + html_text(text_in_html(block)) + "</code></pre>";
        figures.push_back(std::move(figure));
    }
    return figures;
}

}  // namespace

ManualPage contents_page(const std::vector<ManualPage>& pages) {
    const auto part = [&](const std::string& id, const std::string& title, const std::string& kind) {
        return fmt::format("<h2 id=\"{}\">{}</h2>\n{}", id, title, list_of_kind(pages, kind));
    };
    const std::string rest =
        "<h2 id=\"reference\">Reference</h2>\n<ul class=\"pages\">\n"
        "<li><a href=\"functions.html\">Functions</a><span>every function of the scripts, with a run "
        "example</span></li>\n"
        "<li><a href=\"methods.html\">Methods</a><span>model, assumptions and literature of every "
        "method</span></li>\n"
        "<li><a href=\"gallery.html\">Gallery</a><span>figures, each with the script that made it</span></li>\n"
        "<li><a href=\"manual.pdf\">PDF</a><span>lessons, guides, functions and methods in one document to "
        "print</span></li>\n"
        "</ul>\n";
    return overview("index.html", "The manual of dynlab",
                    "Continuous-time system identification: a course, its program and its methods",
                    part("course", "The course", "lesson") + part("demonstrations", "Demonstrations", "demonstration") +
                        part("guides", "Guides", "guide") + rest);
}

ManualPage functions_page(const std::vector<ManualPage>& pages) {
    std::vector<std::string> areas;
    for (const ManualPage& page : pages)
        if (page.kind == "function" && std::ranges::find(areas, page.area) == areas.end()) areas.push_back(page.area);
    std::string main;
    for (const std::string& area : areas) {
        std::vector<ManualPage> of_area;
        std::copy_if(pages.begin(), pages.end(), std::back_inserter(of_area),
                     [&](const ManualPage& page) { return page.kind == "function" && page.area == area; });
        main += fmt::format("<h2 id=\"{}\">{}</h2>\n{}", replaced(area, " ", "-"), html_text(area),
                            list_of_kind(of_area, "function"));
    }
    return overview("functions.html", "Functions", "What scripts can call, by area", main);
}

ManualPage gallery_page(const std::vector<ManualPage>& pages) {
    std::string main;
    for (const ManualPage& page : pages) {
        const std::vector<ShownFigure> figures = figures_of(page);
        if (figures.empty()) continue;
        main += fmt::format("<h2>{}</h2>\n<div class=\"gallery\">\n", link_to(page));
        for (const ShownFigure& figure : figures)
            main += fmt::format(
                "<div class=\"shown\"><a href=\"{}{}\">{}</a>\n{}<details><summary>Script</summary>\n{}\n"
                "</details></div>\n",
                page.file, figure.anchor, figure.image, figure.caption.empty() ? "" : "<p>" + figure.caption + "</p>\n",
                figure.code);
        main += "</div>\n";
    }
    return overview("gallery.html", "Gallery", "Figures of the course and of the examples, with their sources", main);
}

}  // namespace dynlab::inline workflow
