#include "documents/bibliography.h"

#include "documents/work_file.h"
#include "platform/atomic_file.h"
#include "platform/files/inside_folder.h"

namespace dynlab::inline documents {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostBytes = 1u << 20;

}  // namespace

Message fault_of_bibliography_name(const std::string& name) {
    const std::string extension = fs::path(name).extension().string();
    const bool plain = name.find_first_of("/\\") == std::string::npos && !name.starts_with('.');
    if (plain && (extension == ".bib" || extension == ".json")) return {};
    return Message(
        "bibliography must be the name of a .bib (BibTeX) or .json (CSL) file beside this one, such as references.bib, "
        "not \"{}\"",
        name);
}

Message why_no_bibliography(const fs::path& file) {
    if (!is_inside(file, folder_around(file)))
        return Message("the bibliography lies outside the folder of this file; copy it into the folder");
    if (!fs::is_regular_file(file))
        return Message("the bibliography is missing; put the file there or take \"bibliography:\" out");
    if (fs::file_size(file) > kMostBytes)
        return Message("the bibliography is longer than a megabyte; keep what the document cites");
    return {};
}

std::string place_bibliography(const fs::path& file, const fs::path& work_folder, Complaints& complaints) {
    if (const Message fault = why_no_bibliography(file); !fault.empty()) {
        complaints.add({file, 0}, fault);
        return "";
    }
    const std::string name = "references" + file.extension().string();
    write_work_file(work_folder / name, read_text(file));
    return name;
}

}  // namespace dynlab::inline documents
