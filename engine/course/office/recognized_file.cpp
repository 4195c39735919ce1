#include "course/office/recognized_file.h"

#include <algorithm>
#include <fstream>
#include <set>

#include "course/intake/staging.h"
#include "course/issues/issues_report.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kStart = 1024;

/// As much as its kind can be recognized from: all of a script.
std::string start_of(const std::string& name, const fs::path& file) {
    if (name.ends_with(".lua")) return read_file(file);
    std::string start(kStart, '\0');
    std::ifstream in(file, std::ios::binary);
    in.read(start.data(), static_cast<std::streamsize>(kStart));
    if (in.bad() || !in.is_open()) throw EnvironmentError("the file cannot be read");
    start.resize(static_cast<std::size_t>(in.gcount()));
    return start;
}

std::string kind_of_file(const std::string& name, std::string_view content) {
    const auto begins = [&](std::string_view magic) { return content.substr(0, magic.size()) == magic; };
    const bool archive = begins("PK\x03\x04") || begins("\x1F\x8B") ||
                         begins(std::string_view("\xFD"
                                                 "7zXZ\0",
                                                 6)) ||
                         begins("BZh") || content.substr(0, 262).ends_with("ustar");
    if (archive && archive_stem(name)) return "pack";
    if (!archive && content.substr(0, 1024).find("%PDF-") != std::string_view::npos) return "pdf";
    const bool lua = name.ends_with(".lua") || script_name_meant_by(name).ends_with(".lua");
    if (lua && content.find('\0') == std::string_view::npos) return "script";
    static const std::set<std::string> written = {".docx", ".doc", ".odt", ".rtf", ".pages", ".pptx", ".ppt", ".odp"};
    return written.contains(ending_of(name)) ? "text" : "";
}

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

void explain_unreadable(const IncomingFile& file, const Assignment& assignment, RecognizedFile& found) {
    const std::string bytes = magic_bytes(file.file);
    if (bytes.empty()) {
        found.error_reason = "empty", found.reason = Message("The file is empty.");
    } else if (bytes.starts_with("PK\x05\x06")) {
        found.error_reason = "empty", found.reason = Message("The zip file is empty.");
    } else if (const std::string kind = closed_archive(bytes); !kind.empty()) {
        found.error_reason = "closed-archive";
        found.reason = Message("The file is a {} archive, which cannot be opened; submit a zip or tar archive.", kind);
    } else {
        found.error_reason = "other-kind";
        found.reason = assignment.is_lab() ? Message("The file is neither a script (.lua) nor a pack (.zip, .tar.gz).")
                       : assignment.is_report()
                           ? Message("The file is neither a PDF nor a pack (.zip, .tar.gz).")
                           : Message("The file is not a PDF, a script (.lua) or a pack (.zip, .tar.gz).");
    }
}

}  // namespace

std::string kind_of_file_at(const std::string& name, const fs::path& file) {
    return kind_of_file(name, start_of(name, file));
}

RecognizedFile recognize(const IncomingFile& file, const Assignment& assignment, const std::string& stage) {
    RecognizedFile found{kUnreadable, file.name, {}, {}, {}};
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
