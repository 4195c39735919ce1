#include "documents/pictures.h"

#include <sodium.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "documents/pandoc.h"
#include "platform/atomic_file.h"

namespace dynlab::inline documents {
namespace {

namespace fs = std::filesystem;

/// Pandoc writes spaces and the like in a picture's path as %20.
std::string without_percent_signs(const std::string& path) {
    std::string result;
    for (std::size_t i = 0; i < path.size(); ++i) {
        const bool encoded = path[i] == '%' && i + 2 < path.size() &&
                             std::isxdigit(static_cast<unsigned char>(path[i + 1])) &&
                             std::isxdigit(static_cast<unsigned char>(path[i + 2]));
        result += encoded ? static_cast<char>(std::stoi(path.substr(i + 1, 2), nullptr, 16)) : path[i];
        if (encoded) i += 2;
    }
    return result;
}

const std::map<std::string, std::string>& media_types() {
    static const std::map<std::string, std::string> types = {
        {".svg", "image/svg+xml"}, {".png", "image/png"}, {".jpg", "image/jpeg"}, {".jpeg", "image/jpeg"}};
    return types;
}

/// In small letters: telephones write .JPG.
std::string kind_of(const fs::path& picture) {
    std::string extension = picture.extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

bool format_holds(DocumentFormat format, const std::string& extension) {
    if (format == DocumentFormat::kMarkdown) return media_types().count(extension) || extension == ".pdf";
    if (format == DocumentFormat::kHtml) return media_types().count(extension);
    return extension == ".pdf" || (media_types().count(extension) && extension != ".svg");
}

bool is_inside(const fs::path& file, const fs::path& folder) {
    const fs::path inner = fs::weakly_canonical(file), outer = fs::weakly_canonical(folder);
    return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

fs::path folder_of(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

std::string base64(const std::string& bytes) {
    std::string text(sodium_base64_ENCODED_LEN(bytes.size(), sodium_base64_VARIANT_ORIGINAL), '\0');
    sodium_bin2base64(text.data(), text.size(), reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(),
                      sodium_base64_VARIANT_ORIGINAL);
    text.pop_back();  // the zero behind it
    return text;
}

}  // namespace

std::vector<PlacedPicture> find_picture_files(const std::vector<UsedPicture>& pictures, const MarkdownText& markdown,
                                              const fs::path& template_file, DocumentFormat format,
                                              const std::string& prefix, Complaints& complaints) {
    std::vector<PlacedPicture> found;
    for (const UsedPicture& picture : pictures) {
        if (picture.is_figure) continue;
        const fs::path path = without_percent_signs(picture.name);
        SourceLine where = find_in(markdown, picture.name, template_file);
        if (where.line == 0) where = find_in(markdown, path.string(), template_file);
        const fs::path folder = folder_of(where.file), file = folder / path;
        const std::string shown = "the picture \"" + path.string() + "\" ";
        if (picture.name.find("://") != std::string::npos || picture.name.starts_with("data:"))
            complaints.add(where, shown + "must be a file beside this one, not an address");
        else if (path.is_absolute() || !is_inside(file, folder))
            complaints.add(where, shown + "lies outside the folder of this file; copy it into the folder");
        else if (!fs::is_regular_file(file))
            complaints.add(where, shown + "does not exist in " + fs::absolute(folder).lexically_normal().string());
        else if (!format_holds(format, kind_of(path)))
            complaints.add(where,
                           shown + "is of a kind this output cannot hold; " +
                               (format == DocumentFormat::kPdf ? "use .pdf, .png or .jpg" : "use .svg, .png or .jpg"));
        else
            found.push_back({file, prefix + std::to_string(picture.number) + kind_of(path)});
    }
    return found;
}

std::vector<PlacedPicture> find_figures(const std::vector<UsedPicture>& pictures, const MarkdownText& markdown,
                                        const fs::path& template_file, const RunRecord& record, DocumentFormat format,
                                        const std::string& prefix, Complaints& complaints) {
    std::vector<PlacedPicture> found;
    for (const UsedPicture& picture : pictures) {
        if (!picture.is_figure) continue;
        const fs::path& file = record.figures.at(picture.name).file;
        if (file.empty() || !fs::is_regular_file(file))
            complaints.add(find_in(markdown, "figure:" + picture.name, template_file),
                           "the figure \"" + picture.name + "\" was not drawn" +
                               (file.empty() ? "" : ": " + file.filename().string() + " does not exist"));
        else if (file.extension() != "." + figure_extension(format))
            complaints.add(find_in(markdown, "figure:" + picture.name, template_file),
                           "the figure \"" + picture.name + "\" was drawn as " + file.extension().string() +
                               ", but this document wants ." + figure_extension(format));
        else
            found.push_back({file, prefix + std::to_string(picture.number) + "." + figure_extension(format)});
    }
    return found;
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
        if (picture == by_name.end()) {
            result.append(html, start, end - start);
        } else {
            const fs::path& file = picture->second->file;
            result += "data:" + media_types().at(kind_of(file)) + ";base64," + base64(read_file(file));
        }
        at = end;
    }
    return result.append(html, at);
}

}  // namespace dynlab::inline documents
