#include "course/store/packed_document.h"

#include <algorithm>
#include <vector>

#include "course/grading/submission.h"
#include "course/store/file_kind.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

/// All PDFs below, without what systems hide or add.
std::vector<fs::path> pdfs_in(const fs::path& folder) {
    std::vector<fs::path> pdfs;
    for (auto entry = fs::recursive_directory_iterator(folder); entry != fs::recursive_directory_iterator(); ++entry) {
        const std::string name = entry->path().filename();
        if (name.starts_with('.') || name == "__MACOSX") {
            entry.disable_recursion_pending();
        } else if (entry->is_regular_file() && kind_of_file_at(name, entry->path()) == "pdf") {
            pdfs.push_back(entry->path());
        }
    }
    return pdfs;
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

}  // namespace

std::optional<PackedDocument> document_in_pack(const fs::path& pack, const std::string& part, const fs::path& to,
                                               Isolation level, const fs::path& program) {
    unpack_submission(pack, to, level, program);
    const std::vector<fs::path> pdfs = pdfs_in(to);
    std::vector<fs::path> named;
    for (const fs::path& pdf : pdfs)
        if (pdf.filename() == part + ".pdf") named.push_back(pdf);
    const std::vector<fs::path> meant = named.empty() ? pdfs : highest(named);
    if (meant.size() != 1) return {};
    return PackedDocument{meant.front(), meant.front().lexically_relative(to).generic_string()};
}

}  // namespace dynlab::inline course
