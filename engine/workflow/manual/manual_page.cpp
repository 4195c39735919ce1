#include "workflow/manual/manual_page.h"

#include <fmt/format.h>
#include <sodium.h>

#include <set>

#include "documents/text_lines.h"
#include "platform/hash.h"

namespace dynlab::inline workflow {
namespace {

struct Room {
    const char *file, *name, *kind;
};
constexpr Room kRooms[] = {{"index.html", "Contents", ""},
                           {"functions.html", "Functions", "function"},
                           {"methods.html", "Methods", ""},
                           {"gallery.html", "Gallery", ""}};

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
bool stands_in_a_line(const std::string& html, std::size_t open) {
    static const std::set<std::string> kInLines = {"span", "em", "strong", "code", "a",    "sub",  "sup",  "mi",
                                                   "mo",   "mn", "mrow",   "msub", "msup", "math", "mtext"};
    const std::size_t name = open + (html[open + 1] == '/' ? 2 : 1);
    return kInLines.count(html.substr(name, html.find_first_of(" />", name) - name)) > 0;
}

std::string bar_of(const ManualPage& page) {
    std::string bar = "<a class=\"skip\" href=\"#text\">To the text</a>\n<nav class=\"site\" aria-label=\"Manual\">\n";
    for (const Room& room : kRooms) {
        const bool here = page.file == room.file;
        const bool above = !here && *room.kind && page.kind == room.kind;
        bar += fmt::format("<a href=\"{}\"{}>{}</a>\n", room.file, here || above ? " class=\"here\"" : "", room.name);
    }
    return bar +
           "<form role=\"search\"><input id=\"search\" type=\"search\" placeholder=\"Search ( / )\" "
           "aria-label=\"Search the manual\" autocomplete=\"off\"><ol id=\"found\" hidden></ol></form>\n</nav>\n";
}

}  // namespace

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
        if (!stands_in_a_line(html, open)) text += ' ';
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

std::string with_pictures_apart(const std::string& html, ManualFiles& files) {
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
        result += "src=\"" + file;
    }
    return result.append(html, at);
}

std::string with_links_to_pages(const std::string& html, const std::map<std::string, std::string>& pages,
                                const std::string& own) {
    const std::size_t choices = html.find("class=\"choice");
    const std::string open = "<code>", close = "</code>";
    std::string result;
    std::size_t at = 0;
    for (std::size_t next; (next = html.find(open, at)) < choices;) {
        const std::size_t begin = next + open.size(), end = html.find(close, begin);
        const auto page = pages.find(subject_of_code(html.substr(begin, end - begin)));
        const std::string before = html.substr(next < 64 ? 0 : next - 64, std::min<std::size_t>(next, 64));
        const bool within = before.ends_with("<pre>") || before.ends_with("class=\"output\">") ||
                            before.ends_with("class=\"error\">") || before.rfind("<a ") != std::string::npos;
        const bool leads = page != pages.end() && page->second != own && !within;
        const std::size_t after = end + close.size();
        result.append(html, at, next - at);
        if (leads) result += "<a href=\"" + page->second + "\">";
        result.append(html, next, after - next);
        if (leads) result += "</a>";
        at = after;
    }
    return result.append(html, at);
}

std::string framed_page(const ManualPage& page, const std::string& style) {
    std::string body = page.body;
    const std::size_t main = body.find("<main>");
    if (main != std::string::npos) body.replace(main, 6, "<main id=\"text\">");
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'self' file:; img-src "
        "'self' file: data:; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<meta name=\"generator\" content=\"dynlab\">\n<title>{} – dynlab</title>\n<style>\n{}</style>\n</head>\n"
        "<body class=\"manual\">\n{}{}\n<script src=\"document.js\"></script>\n<script "
        "src=\"manual.js\"></script>\n</body>\n</html>\n",
        html_text(page.title), style, bar_of(page), body);
}

}  // namespace dynlab::inline workflow
