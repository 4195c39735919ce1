#include "course/office/packed_document.h"

#include <re2/re2.h>

#include <algorithm>
#include <vector>

#include "course/intake/folder_copy.h"
#include "course/intake/notebooks.h"
#include "course/intake/submission.h"
#include "course/office/recognized_file.h"
#include "course/review/version_reading.h"
#include "platform/atomic_file.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

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
    if (scripts.size() != 1) return {{}, Message("the pack contains no PDF")};
    fs::create_directories(to);
    const Message reason = make_version_in_sandbox(scripts.front().parent_path(), to, true, level, program);
    const fs::path pdf = to / "report.pdf";
    if (!reason.empty() || fs::symlink_status(pdf).type() != fs::file_type::regular)
        return {{},
                reason.empty() ? Message("the pack contains no PDF, and none can be created from it")
                               : Message("the pack contains no PDF, and none can be created from it ({})", reason)};
    return {PackedDocument{pdf, part + ".pdf", true}, {}};
}

constexpr std::uintmax_t kLargestScript = 1 << 20;
constexpr std::size_t kMaxTableBytes = 4000;

std::string without_comments(std::string_view text) {
    std::string kept;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string_view line = text.substr(at, end - at);
        kept += std::string(line.substr(0, line.find("--"))) + '\n';
        at = end + 1;
    }
    return kept;
}

/// Behind the brace of the first statement "scores = {" or "local scores = {" that begins a line.
std::size_t begin_of_scores(const std::string& text) {
    constexpr std::string_view kName = "scores", kLocal = "local", kBlank = " \t\r\n";
    constexpr std::size_t kMaxCharactersBefore = 200;  // blanks and "local"
    std::size_t line = 0;                              // begin of the line that holds the name
    for (std::size_t at = text.find(kName); at != std::string::npos; at = text.find(kName, at + 1)) {
        for (std::size_t end = text.find('\n', line); end < at; end = text.find('\n', line)) line = end + 1;
        if (at - line > kMaxCharactersBefore) continue;
        std::string_view before = std::string_view(text).substr(line, at - line);
        const auto word = before.find_first_not_of(kBlank);
        before.remove_prefix(std::min(word, before.size()));
        const bool alone = before.empty() || (before.starts_with(kLocal) && before.size() > kLocal.size() &&
                                              before.find_first_not_of(kBlank, kLocal.size()) == before.npos);
        const std::size_t sign = text.find_first_not_of(kBlank, at + kName.size());
        if (!alone || sign == std::string::npos || text[sign] != '=') continue;
        const std::size_t brace = text.find_first_not_of(kBlank, sign + 1);
        if (brace != std::string::npos && text[brace] == '{') return brace + 1;
    }
    return std::string::npos;
}

}  // namespace

OpenedPack open_pack(const fs::path& pack, const std::string& part, const fs::path& to, Isolation level,
                     const fs::path& program) {
    const fs::path unpacked = to / "pack";
    unpack_submission(pack, unpacked, level, program);
    take_notebooks(unpacked);
    const std::vector<fs::path> files = files_below(unpacked);
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
        return {{}, Message("the pack contains {} PDF files; exactly one must be named {}.pdf", meant.size(), part)};
    return {PackedDocument{meant.front(), meant.front().lexically_relative(unpacked).generic_string()}, {}};
}

std::map<std::string, double> scores_in_script(std::string_view script) {
    static const RE2 entry(R"((\w+)\s*=\s*(\d{1,4}(?:\.\d{1,4})?)\s*[,;\n}])", RE2::Latin1);
    const std::string text = without_comments(script);
    const std::size_t from = begin_of_scores(text);
    if (from == std::string::npos) return {};
    const std::size_t close = text.find('}', from);
    if (close == std::string::npos || close - from > kMaxTableBytes) return {};
    const std::string body = text.substr(from, close + 1 - from);
    std::map<std::string, double> scores;
    std::string name;
    double score = 0;
    for (re2::StringPiece rest = body; RE2::FindAndConsume(&rest, entry, &name, &score);) scores[name] = score;
    return scores;
}

std::map<std::string, double> scores_in_pack(const fs::path& folder) {
    std::vector<fs::path> scripts = files_below(folder);
    std::erase_if(scripts, [](const fs::path& file) {
        return file.filename() != "analysis.lua" || fs::file_size(file) > kLargestScript;
    });
    scripts = highest(scripts);
    return scripts.empty() ? std::map<std::string, double>() : scores_in_script(read_file(scripts.front()));
}

}  // namespace dynlab::inline course
