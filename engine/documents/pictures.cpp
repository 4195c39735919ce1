#include "documents/pictures.h"

#include <algorithm>

#include "documents/html/web_page.h"
#include "documents/pandoc.h"
#include "platform/files/inside_folder.h"
#include "platform/text/small_letters.h"

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

bool is_web_picture(const std::string& extension) {
    return !media_type(extension).empty();
}

bool format_holds(DocumentFormat format, const std::string& extension) {
    if (format == DocumentFormat::kMarkdown) return is_web_picture(extension) || extension == ".pdf";
    if (format == DocumentFormat::kHtml) return is_web_picture(extension);
    return extension == ".pdf" || (is_web_picture(extension) && extension != ".svg");
}

}  // namespace

std::vector<PlacedPicture> find_picture_files(const std::vector<UsedPicture>& pictures, const MarkdownText& markdown,
                                              const fs::path& template_file, DocumentFormat format,
                                              const std::string& prefix, Complaints& complaints) {
    std::vector<PlacedPicture> found;
    for (const UsedPicture& picture : pictures) {
        if (picture.is_figure) continue;
        const fs::path path = without_percent_signs(picture.name);
        Place where = find_in(markdown, picture.name, template_file);
        if (where.line == 0) where = find_in(markdown, path.string(), template_file);
        const fs::path folder = folder_around(where.file), file = folder / path;
        const std::string shown = path.string();
        if (picture.name.find("://") != std::string::npos || picture.name.starts_with("data:"))
            complaints.add(where, Message("the picture \"{}\" must be a file beside this one, not an address", shown));
        else if (path.is_absolute() || !is_inside(file, folder))
            complaints.add(
                where,
                Message("the picture \"{}\" lies outside the folder of this file; copy it into the folder", shown));
        else if (!fs::is_regular_file(file))
            complaints.add(where, Message("the picture \"{}\" does not exist in {}", shown,
                                          fs::absolute(folder).lexically_normal().string()));
        else if (!format_holds(format, ending_of(path)))
            complaints.add(
                where, Message("the picture \"{}\" is of a kind this output cannot hold; use {}, .png or .jpg", shown,
                               format == DocumentFormat::kPdf ? ".pdf" : ".svg"));
        else
            found.push_back({file, prefix + std::to_string(picture.number) + ending_of(path), {}});
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
                           file.empty() ? Message("the figure \"{}\" was not drawn", picture.name)
                                        : Message("the figure \"{}\" was not drawn: {} does not exist", picture.name,
                                                  file.filename().string()));
        else if (file.extension() != "." + figure_extension(format))
            complaints.add(find_in(markdown, "figure:" + picture.name, template_file),
                           Message("the figure \"{}\" was drawn as {}, but this document wants {}", picture.name,
                                   file.extension().string(), "." + figure_extension(format)));
        else
            found.push_back({file, prefix + std::to_string(picture.number) + "." + figure_extension(format),
                             record.figures.at(picture.name).plot});
    }
    return found;
}

}  // namespace dynlab::inline documents
