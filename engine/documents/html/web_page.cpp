#include "documents/html/web_page.h"

#include <sodium.h>

#include <map>

#include "documents/html/script_catalogs.h"
#include "platform/atomic_file.h"
#include "platform/text/base64.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline documents {
namespace {

namespace fs = std::filesystem;

/// A script's name in a Content Security Policy.
std::string policy_hash(const std::string& script) {
    std::string hash(crypto_hash_sha256_BYTES, '\0');
    crypto_hash_sha256(reinterpret_cast<unsigned char*>(hash.data()),
                       reinterpret_cast<const unsigned char*>(script.data()), script.size());
    return "'sha256-" + base64(hash) + "'";
}

/// Replaces the first `from` of the page: the template contains it before any content of a document, or it is an
/// element, which no document contains.
std::string with_first(std::string page, const std::string& from, const std::string& to) {
    const std::size_t at = page.find(from);
    return at == std::string::npos ? page : page.replace(at, from.size(), to);
}

/// As html/document.html has it.
std::string language_of_page(const std::string& html) {
    const std::string sign = "<html lang=\"";
    const std::size_t at = html.find(sign), begin = at + sign.size();
    return at == std::string::npos ? "en" : html.substr(begin, html.find('"', begin) - begin);
}

}  // namespace

std::string media_type(const std::string& extension) {
    static const std::map<std::string, std::string> types = {
        {".svg", "image/svg+xml"}, {".png", "image/png"}, {".jpg", "image/jpeg"}, {".jpeg", "image/jpeg"}};
    const auto found = types.find(extension);
    return found == types.end() ? "" : found->second;
}

std::string plot_element(const std::string& plot) {
    return plot.empty() ? "" : "<script type=\"application/json\" class=\"plot-data\">" + plot + "</script>";
}

std::string shown_scripts(const fs::path& shared_templates) {
    std::string scripts;
    for (const char* name :
         {"words.js", "plot_drawing.js", "motion.js", "plot_copies.js", "plot_table.js", "plot.js", "choices.js"})
        scripts += read_file(shared_templates / "html" / name);
    return scripts;
}

std::string scripts_of_pages(const fs::path& shared_templates, const std::string& language) {
    const std::string scripts = shown_scripts(shared_templates) + read_file(shared_templates / "html/sliders.js") +
                                read_file(shared_templates / "html/document.js");
    return script_catalogs(scripts, {language, language.substr(0, language.find('-'))}) + scripts;
}

std::string with_inlined_pictures(const std::string& html, const std::vector<PlacedPicture>& pictures) {
    std::map<std::string, const PlacedPicture*> by_name;
    for (const PlacedPicture& picture : pictures) by_name[picture.written_name] = &picture;
    const std::string sign = "<img src=\"";
    std::string result;
    std::size_t at = 0;
    for (std::size_t next; (next = html.find(sign, at)) != std::string::npos;) {
        const std::size_t start = next + sign.size(), end = html.find('"', start);
        const auto picture = by_name.find(html.substr(start, end - start));
        result.append(html, at, start - at);
        at = html.find('>', end) + 1;
        if (picture == by_name.end()) {
            result.append(html, start, at - start);
            continue;
        }
        const fs::path& file = picture->second->file;
        const std::string type = file.empty() ? "" : media_type(ending_of(file));
        result += file.empty() ? "data:," : "data:" + type + ";base64," + base64(read_file(file));
        result.append(html, end, at - end);
        result += plot_element(picture->second->plot);
    }
    return result.append(html, at);
}

std::string whole_web_page(const std::string& html, const fs::path& shared_templates,
                           const std::vector<PlacedPicture>& pictures) {
    // They go in here, not in the template: Pandoc takes 0.3 s to read them there.
    const std::string script = "\n" + scripts_of_pages(shared_templates, language_of_page(html));
    std::string page = with_first(html, "script-src 'none'", "script-src " + policy_hash(script));
    page = with_first(std::move(page), "<style></style>",
                      "<style>\n" + read_file(shared_templates / "html/document.css") + "</style>");
    page = with_first(std::move(page), "<script></script>", "<script>" + script + "</script>");
    return with_inlined_pictures(page, pictures);
}

}  // namespace dynlab::inline documents
