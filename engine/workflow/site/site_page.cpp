#include "workflow/site/site_page.h"

#include <fmt/format.h>
#include <sodium.h>

#include <set>

#include "base/languages.h"
#include "base/reader.h"
#include "documents/text_lines.h"
#include "platform/hash.h"

namespace dynlab::inline workflow {
namespace {

/// A link of the bar.
struct BarLink {
    std::string file;
    Message name;
    std::string kind;  ///< of the pages below it
};

std::vector<BarLink> links_of(const std::string& language, bool workbench) {
    const std::string own = language == "en" ? "" : language + "/";
    std::vector<BarLink> links = {{own + "index.html", Message("Course"), "lesson"}};
    if (workbench) links.push_back({"workbench/index.html", Message("Workbench"), ""});
    links.insert(links.end(), {{"functions/index.html", Message("Functions"), "function"},
                               {"guides/methods.html", Message("Methods"), ""},
                               {"gallery/index.html", Message("Gallery"), ""}});
    return links;
}

std::string bytes_of_base64(std::string_view text) {
    std::string bytes(text.size(), '\0');
    std::size_t size = 0;
    sodium_base642bin(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(), text.data(), text.size(), nullptr,
                      &size, nullptr, sodium_base64_VARIANT_ORIGINAL);
    bytes.resize(size);
    return bytes;
}

/// The function or guide that code in the text speaks of; empty for other code.
std::string subject_of_code(std::string code) {
    for (const std::string_view asking : {"dynlab help ", "help "})
        if (code.starts_with(asking)) return code.substr(asking.size());
    if (code.starts_with("help(&quot;")) return code.substr(11, code.find("&quot;", 11) - 11);
    const std::size_t end = std::min(code.find('('), code.size());
    return code.substr(0, end);
}

/// Whether the element at `open` only makes letters look otherwise: words on both sides of any other are two.
bool is_inline(const std::string& html, std::size_t open) {
    static const std::set<std::string> kInLines = {"span", "em", "strong", "code", "a",    "sub",  "sup",  "mi",
                                                   "mo",   "mn", "mrow",   "msub", "msup", "math", "mtext"};
    const std::size_t name = open + (html[open + 1] == '/' ? 2 : 1);
    return kInLines.count(html.substr(name, html.find_first_of(" />", name) - name)) > 0;
}

/// The name of a language, in that language.
std::string name_of_language(const std::string& code) {
    return code == "fr" ? "Français" : "English";
}

std::string bar_of(const SitePage& page, bool workbench) {
    const Reader reader{catalog_of(page.language)};
    const auto in_html = [&](const Message& message) { return html_text(message_text(message, reader)); };
    std::string bar = fmt::format("<a class=\"skip\" href=\"#{}\">{}</a>\n<nav class=\"site\" aria-label=\"{}\">\n",
                                  page.kind == "lesson" ? "lesson" : "text", in_html(Message("Skip to the text")),
                                  in_html(Message("Site")));
    for (const BarLink& link : links_of(page.language, workbench)) {
        const bool here = page.file == link.file;
        const bool above = !here && !link.kind.empty() && page.kind == link.kind;
        bar += fmt::format("<a href=\"{}{}\"{}>{}</a>\n", page.root(), link.file,
                           here || above ? " class=\"here\"" : "", in_html(link.name));
    }
    if (!page.translation.empty()) {
        const std::string other = page.language == "en" ? "fr" : "en";
        bar += fmt::format("<a href=\"{}{}\" lang=\"{}\" hreflang=\"{}\">{}</a>\n", page.root(), page.translation,
                           other, other, name_of_language(other));
    }
    return bar + fmt::format(
                     "<form role=\"search\"><input id=\"search\" type=\"search\" placeholder=\"{}\" "
                     "aria-label=\"{}\" autocomplete=\"off\"><ol id=\"found\" hidden></ol></form>\n</nav>\n",
                     in_html(Message("Search ( / )")), in_html(Message("Search the site")));
}

}  // namespace

std::string SitePage::root() const {
    std::string way;
    for (const char c : file)
        if (c == '/') way += "../";
    return way;
}

std::string html_text(std::string_view text) {
    std::string html;
    for (const char c : text) {
        switch (c) {
            case '&':
                html += "&amp;";
                break;
            case '<':
                html += "&lt;";
                break;
            case '>':
                html += "&gt;";
                break;
            case '"':
                html += "&quot;";
                break;
            default:
                html += c;
        }
    }
    return html;
}

std::string text_in_html(const std::string& html) {
    std::string text;
    for (std::size_t at = 0; at < html.size();) {
        const std::size_t open = html.find('<', at);
        text.append(html, at, open == std::string::npos ? open : open - at);
        if (open == std::string::npos) break;
        std::size_t close = html.find('>', open);
        for (const char* unseen : {"script", "annotation"})
            if (html.compare(open + 1, std::string_view(unseen).size(), unseen) == 0)
                close = html.find('>', html.find(fmt::format("</{}", unseen), open));
        if (close == std::string::npos) break;
        if (!is_inline(html, open)) text += ' ';
        at = close + 1;
    }
    for (const auto& [entity, letter] : {std::pair{"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&amp;", "&"}})
        text = replaced(std::move(text), entity, letter);
    return text;
}

std::vector<std::pair<std::string, std::string>> headings_in(const std::string& html) {
    std::vector<std::pair<std::string, std::string>> headings;
    for (std::size_t at = 0; (at = html.find("<h", at)) != std::string::npos; ++at) {
        const char level = at + 2 < html.size() ? html[at + 2] : ' ';
        if (level < '1' || level > '3' || html.compare(at + 3, 5, " id=\"") != 0) continue;
        const std::size_t id = at + 8, quote = html.find('"', id), begin = html.find('>', quote) + 1;
        const std::size_t end = html.find("</h", begin);
        headings.emplace_back(html.substr(id, quote - id), trimmed(text_in_html(html.substr(begin, end - begin))));
    }
    return headings;
}

std::string with_pictures_apart(const std::string& html, const std::string& root, SiteFiles& files) {
    static const std::map<std::string, std::string> endings = {
        {"image/svg+xml", ".svg"}, {"image/png", ".png"}, {"image/jpeg", ".jpg"}};
    const std::string sign = "src=\"data:";
    std::string result;
    std::size_t at = 0;
    for (std::size_t next; (next = html.find(sign, at)) != std::string::npos;) {
        const std::size_t type = next + sign.size(), end = html.find('"', type), comma = html.find(";base64,", type);
        const auto ending = comma < end ? endings.find(html.substr(type, comma - type)) : endings.end();
        result.append(html, at, next - at);
        at = end;
        if (ending == endings.end()) {
            result.append(html, next, end - next);
            continue;
        }
        const std::string bytes = bytes_of_base64(std::string_view(html).substr(comma + 8, end - comma - 8));
        const std::string file = "pictures/" + digest_of(bytes).hex() + ending->second;
        files.emplace(file, bytes);
        result += "loading=\"lazy\" src=\"" + root + file;
    }
    return result.append(html, at);
}

std::string with_links_to_pages(const SitePage& page, const std::map<std::string, std::string>& pages) {
    const std::string& html = page.body;
    const std::size_t choices = html.find("class=\"choice");
    const std::string open = "<code>", close = "</code>";
    std::string result;
    std::size_t at = 0;
    for (std::size_t next; (next = html.find(open, at)) < choices;) {
        const std::size_t begin = next + open.size(), end = html.find(close, begin);
        const auto other = pages.find(subject_of_code(html.substr(begin, end - begin)));
        const std::string before = html.substr(next < 64 ? 0 : next - 64, std::min<std::size_t>(next, 64));
        const bool within = before.ends_with("<pre>") || before.ends_with("class=\"output\">") ||
                            before.ends_with("class=\"error\">") || before.rfind("<a ") != std::string::npos;
        const bool leads = other != pages.end() && other->second != page.file && !within;
        const std::size_t after = end + close.size();
        result.append(html, at, next - at);
        if (leads) result += "<a href=\"" + page.root() + other->second + "\">";
        result.append(html, next, after - next);
        if (leads) result += "</a>";
        at = after;
    }
    return result.append(html, at);
}

const char* const kSitePolicy =
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'self' file: "
    "'wasm-unsafe-eval'; connect-src 'self'; worker-src 'self'; manifest-src 'self'; img-src 'self' file: data: blob:; "
    "style-src 'self' file: 'unsafe-inline'; base-uri 'self'; form-action 'none'\">\n";

std::string framed_page(const SitePage& page, const SiteFrame& frame) {
    std::string body = page.body, links, scripts;
    const std::size_t main = body.find("<main>");
    if (main != std::string::npos) body.replace(main, 6, "<main id=\"text\">");
    const std::string root = page.root();
    for (const std::string& style : page.styles)
        links += fmt::format("<link rel=\"stylesheet\" href=\"{}{}\">\n", root, style);
    if (frame.runs) links += fmt::format("<link rel=\"manifest\" href=\"{}manifest.webmanifest\">\n", root);
    for (const char* script : {"catalogs", "plot", "document", "site"})
        scripts += fmt::format("<script src=\"{}page/{}.js\" defer></script>\n", root, script);
    for (const std::string& module : page.first_modules)
        links += fmt::format("<script src=\"{}{}\" type=\"module\" async></script>\n", root, module);
    for (const std::string& module : page.modules)
        scripts += fmt::format("<script src=\"{}{}\" type=\"module\"></script>\n", root, module);
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"{}\" data-root=\"{}\"{}>\n<head>\n<meta charset=\"utf-8\">\n"
        "{}"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<meta name=\"generator\" content=\"dynlab\">\n<title>{} – dynlab</title>\n"
        "<link rel=\"icon\" href=\"{}icon.svg\">\n<style>\n{}</style>\n{}</head>\n"
        "<body class=\"site {}\">\n{}{}\n{}</body>\n</html>\n",
        page.language, root, frame.runs ? " data-offline" : "", kSitePolicy, html_text(page.title), root, frame.style,
        links, page.kind, bar_of(page, frame.runs), body, scripts);
}

}  // namespace dynlab::inline workflow
