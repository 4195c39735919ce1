#include "documents/bibliography.h"

#include "documents/error.h"
#include "documents/work_file.h"
#include "platform/text_file.h"

namespace dynlab::inline documents {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostBytes = 1u << 20;

}  // namespace

void check_bibliography_name(const std::string& name, const std::string& where) {
    const std::string extension = fs::path(name).extension().string();
    const bool plain = name.find_first_of("/\\") == std::string::npos && !name.starts_with('.');
    if (plain && (extension == ".bib" || extension == ".json")) return;
    throw DocumentError(where +
                        "bibliography must be the name of a .bib (BibTeX) or .json (CSL) file beside this one, "
                        "such as references.bib, not \"" +
                        name + "\"");
}

std::string place_bibliography(const fs::path& file, const fs::path& work_folder, Complaints& complaints) {
    if (!fs::is_regular_file(file)) {
        complaints.add({file, 0}, "the bibliography is missing; put the file there or take \"bibliography:\" out");
        return "";
    }
    if (fs::file_size(file) > kMostBytes) {
        complaints.add({file, 0}, "the bibliography is longer than a megabyte; keep what the document cites");
        return "";
    }
    const std::string name = "references" + file.extension().string();
    write_work_file(work_folder / name, read_text(file));
    return name;
}

}  // namespace dynlab::inline documents
