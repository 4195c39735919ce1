#include "course/office/recognised_file.h"

#include <algorithm>
#include <fstream>

#include "course/findings/findings_report.h"
#include "course/intake/submission.h"
#include "course/store/file_kind.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

std::string magic_bytes(const fs::path& file) {
    std::string bytes(8, '\0');
    std::ifstream in(file, std::ios::binary);
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(in.gcount()));
    return bytes;
}

/// The archive that cannot be opened here, by its first bytes; empty for anything else.
std::string closed_archive(const std::string& bytes) {
    if (bytes.starts_with("Rar!")) return "RAR";
    if (bytes.starts_with("7z\xBC\xAF\x27\x1C")) return "7z";
    return "";
}

void explain_unreadable(const IncomingFile& file, const Assignment& assignment, RecognisedFile& found) {
    const std::string bytes = magic_bytes(file.file);
    if (bytes.empty()) {
        found.trouble = "empty", found.reason = Message("The file is empty.");
    } else if (bytes.starts_with("PK\x05\x06")) {
        found.trouble = "empty", found.reason = Message("The zip is empty: there is no file in it.");
    } else if (const std::string kind = closed_archive(bytes); !kind.empty()) {
        found.trouble = "closed-archive";
        found.reason = Message("It is a {} archive, which cannot be opened here; zip and tar can.", kind);
    } else {
        found.trouble = "other-kind";
        found.reason = assignment.is_lab() ? Message("It is neither a script (.lua) nor a pack (.zip, .tar.gz).")
                       : assignment.is_report()
                           ? Message("It is neither a PDF nor a pack (.zip, .tar.gz).")
                           : Message("It is not a PDF, no script (.lua) and no pack (.zip, .tar.gz).");
    }
}

}  // namespace

RecognisedFile recognise(const IncomingFile& file, const Assignment& assignment, const std::string& stage) {
    RecognisedFile found{kUnreadable, file.name, {}, {}, {}};
    const std::string kind = kind_of_file_at(file.name, file.file);
    const std::vector<std::string> parts = parts_of(assignment, stage);
    const bool document = kind == "pdf" || kind == "text";
    const std::string part = !document ? kind : assignment.is_lab() ? "" : parts.front();
    if (fs::file_size(file.file) == 0 || std::ranges::find(parts, part) == parts.end()) {
        explain_unreadable(file, assignment, found);
        return found;
    }
    found.part = part, found.text = kind == "text";
    if (kind == "pdf" && ending_of(file.name) != ".pdf") {
        found.name += ".pdf";
        found.remark = Message("a PDF, although its name ends in \"{}\"", ending_of(file.name));
    }
    return found;
}

}  // namespace dynlab::inline course
