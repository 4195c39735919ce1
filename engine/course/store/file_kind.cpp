#include "course/store/file_kind.h"

#include <fstream>
#include <set>

#include "course/intake/submission.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kStart = 1024;

/// As much as its kind can be recognised from: all of a script.
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
    if (content.substr(0, 1024).find("%PDF-") != std::string_view::npos) return "pdf";
    const bool archive = begins("PK\x03\x04") || begins("\x1F\x8B") ||
                         begins(std::string_view("\xFD"
                                                 "7zXZ\0",
                                                 6)) ||
                         begins("BZh") || content.substr(0, 262).ends_with("ustar");
    if (archive && archive_stem(name)) return "pack";
    if (name.ends_with(".lua") && content.find('\0') == std::string_view::npos) return "script";
    static const std::set<std::string> written = {".docx", ".doc", ".odt", ".rtf", ".pages", ".pptx", ".ppt", ".odp"};
    return written.contains(ending_of(name)) ? "text" : "";
}

}  // namespace

std::string kind_of_file_at(const std::string& name, const fs::path& file) {
    return kind_of_file(name, start_of(name, file));
}

}  // namespace dynlab::inline course
