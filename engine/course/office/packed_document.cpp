#include "course/office/packed_document.h"

#include <vector>

#include "course/intake/notebooks.h"
#include "course/intake/submission.h"
#include "course/office/recognised_file.h"
#include "course/review/version_reading.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

/// All files below, without what systems hide or add.
std::vector<fs::path> files_in(const fs::path& folder) {
    std::vector<fs::path> files;
    for (auto entry = fs::recursive_directory_iterator(folder); entry != fs::recursive_directory_iterator(); ++entry) {
        const std::string name = entry->path().filename();
        if (name.starts_with('.') || name == "__MACOSX") {
            entry.disable_recursion_pending();
        } else if (entry->is_regular_file() && !entry->is_symlink()) {
            files.push_back(entry->path());
        }
    }
    return files;
}

std::vector<fs::path> highest(const std::vector<fs::path>& paths) {
    std::vector<fs::path> best;
    const auto depth = [](const fs::path& path) { return std::distance(path.begin(), path.end()); };
    for (const fs::path& path : paths) {
        if (!best.empty() && depth(path) > depth(best.front())) continue;
        if (!best.empty() && depth(path) < depth(best.front())) best.clear();
        best.push_back(path);
    }
    return best;
}

/// The PDF of the pack's own analysis and text.
OpenedPack made_document(const std::vector<fs::path>& files, const std::string& part, const fs::path& to,
                         Isolation level, const fs::path& program) {
    std::vector<fs::path> scripts;
    for (const fs::path& file : files)
        if (file.filename() == "analysis.lua") scripts.push_back(file);
    scripts = highest(scripts);
    if (scripts.size() != 1) return {{}, Message("no PDF in the pack")};
    fs::create_directories(to);
    const Message reason = make_version_in_box(scripts.front().parent_path(), to, true, level, program);
    const fs::path pdf = to / "report.pdf";
    if (!reason.empty() || fs::symlink_status(pdf).type() != fs::file_type::regular)
        return {{},
                reason.empty() ? Message("no PDF in the pack, and none can be made of it")
                               : Message("no PDF in the pack, and none can be made of it ({})", reason)};
    return {PackedDocument{pdf, part + ".pdf", true}, {}};
}

}  // namespace

OpenedPack open_pack(const fs::path& pack, const std::string& part, const fs::path& to, Isolation level,
                     const fs::path& program) {
    const fs::path unpacked = to / "pack";
    unpack_submission(pack, unpacked, level, program);
    take_notebooks(unpacked);
    const std::vector<fs::path> files = files_in(unpacked);
    std::vector<fs::path> pdfs, named;
    for (const fs::path& file : files) {
        const std::string name = file.filename();
        if (kind_of_file_at(name, file) != "pdf") continue;
        pdfs.push_back(file);
        if (name == part + ".pdf") named.push_back(file);
    }
    if (pdfs.empty()) return made_document(files, part, to / "made", level, program);
    const std::vector<fs::path> meant = named.empty() ? pdfs : highest(named);
    if (meant.size() != 1)
        return {{}, Message("{} PDFs in the pack, of which none alone is {}.pdf", meant.size(), part)};
    return {PackedDocument{meant.front(), meant.front().lexically_relative(unpacked).generic_string()}, {}};
}

}  // namespace dynlab::inline course
