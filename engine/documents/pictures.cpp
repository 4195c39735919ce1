#include "documents/pictures.h"

#include <algorithm>

#include "documents/html/web_page.h"
#include "documents/pandoc.h"
#include "platform/files/inside_folder.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline documents {
namespace {

namespace fs = std::filesystem;

bool is_web_picture(const std::string& extension) {
    return !media_type(extension).empty();
}

bool format_holds(DocumentFormat format, const std::string& extension) {
    if (format == DocumentFormat::kMarkdown) return is_web_picture(extension) || extension == ".pdf";
    if (format == DocumentFormat::kHtml) return is_web_picture(extension);
    return extension == ".pdf" || (is_web_picture(extension) && extension != ".svg");
}

/// Where the text shows it: as Pandoc writes the name, as it is, or with backslashes before its signs.
Place place_of_picture(const std::string& name, const MarkdownText& markdown, const fs::path& template_file) {
    std::string escaped;
    for (const char c : path_of_picture(name).string()) {
        if (c == ' ' || c == '_' || c == '*') escaped += '\\';
        escaped += c;
    }
    for (const std::string& form : {name, path_of_picture(name).string(), escaped})
        if (const Place found = find_in(markdown, form, template_file); found.line > 0) return found;
    return {template_file, 0};
}

}  // namespace

fs::path path_of_picture(const std::string& name) {
    std::string result;
    for (std::size_t i = 0; i < name.size(); ++i) {
        const bool encoded = name[i] == '%' && i + 2 < name.size() &&
                             std::isxdigit(static_cast<unsigned char>(name[i + 1])) &&
                             std::isxdigit(static_cast<unsigned char>(name[i + 2]));
        result += encoded ? static_cast<char>(std::stoi(name.substr(i + 1, 2), nullptr, 16)) : name[i];
        if (encoded) i += 2;
    }
    return result;
}

std::vector<PlacedPicture> find_picture_files(const std::vector<UsedPicture>& pictures, const MarkdownText& markdown,
                                              const fs::path& template_file, DocumentFormat format,
                                              const std::string& prefix, Complaints& complaints) {
    std::vector<PlacedPicture> found;
    for (const UsedPicture& picture : pictures) {
        if (picture.is_figure) continue;
        const fs::path path = path_of_picture(picture.name);
        const Place where = place_of_picture(picture.name, markdown, template_file);
        const fs::path folder = folder_around(where.file), file = folder / path;
        const std::string shown = path.string();
        if (picture.name.find("://") != std::string::npos || picture.name.starts_with("data:"))
            complaints.add(where,
                           Message("the picture \"{}\" must be a file in the same folder, not an address", shown));
        else if (path.is_absolute() || !is_inside(file, folder))
            complaints.add(
                where,
                Message("the picture \"{}\" is outside the folder of this file; copy the picture into that folder",
                        shown));
        else if (!fs::is_regular_file(file))
            complaints.add(where, Message("the picture \"{}\" is not in the folder of this file; add the file, or "
                                          "correct the name in the text",
                                          shown));
        else if (!format_holds(format, ending_of(path)))
            complaints.add(
                where,
                Message("the picture \"{}\" has a file type that this output does not support; use {}, .png or .jpg",
                        shown, format == DocumentFormat::kPdf ? ".pdf" : ".svg"));
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
                           Message("the figure \"{}\" was saved as {}, but this document needs {}", picture.name,
                                   file.extension().string(), "." + figure_extension(format)));
        else
            found.push_back({file, prefix + std::to_string(picture.number) + "." + figure_extension(format),
                             record.figures.at(picture.name).plot});
    }
    return found;
}

}  // namespace dynlab::inline documents
