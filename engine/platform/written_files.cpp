#include "platform/written_files.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <cstdlib>
#include <deque>
#include <fstream>

#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/hash.h"
#include "platform/system_call.h"

namespace dynlab::inline platform {
namespace {

namespace fs = std::filesystem;

constexpr char kAtWork[] = "-";
constexpr std::uintmax_t kMostLedgerBytes = 2u << 20;
constexpr std::size_t kLinesKept = 4000;

/// The newest lines of a ledger that has grown too long.
void shorten(const fs::path& ledger) {
    std::error_code none;
    if (const auto bytes = fs::file_size(ledger, none); none || bytes < kMostLedgerBytes) return;
    std::deque<std::string> lines;
    std::ifstream stream(ledger);
    for (std::string line; std::getline(stream, line);) {
        lines.push_back(line + '\n');
        if (lines.size() > kLinesKept) lines.pop_front();
    }
    std::string text;
    for (const std::string& line : lines) text += line;
    write_file_atomically(ledger, text);
}

}  // namespace

WrittenFiles::WrittenFiles(fs::path ledger, Others others) : ledger_(std::move(ledger)), others_(others) {}

WrittenFiles::~WrittenFiles() {
    std::string lines;
    for (const auto& [file, path_hash] : taken_) {
        try {
            if (fs::exists(file)) lines += path_hash + ' ' + sha256_of_file(file) + '\n';
        } catch (const std::exception&) {  // what cannot be read is not known to the next run
        }
    }
    if (!lines.empty()) note(lines);
}

void WrittenFiles::take(const fs::path& file) {
    const std::string path_hash = sha256_of(file.string());
    if (taken_.contains(file)) return;
    if (others_ == Others::kKept && fs::exists(file)) {
        const std::string known = known_content(path_hash);
        if (known != kAtWork && (known.empty() || known != sha256_of_file(file)))
            throw EnvironmentError(
                fmt::format("'{}' is there already and {}; save under another name, move it away, or let it be "
                            "replaced (dynlab run --force)",
                            file.filename().string(),
                            known.empty() ? "no run of dynlab wrote it" : "was changed since dynlab wrote it"));
    }
    taken_[file] = path_hash;
    note(path_hash + ' ' + kAtWork + '\n');
}

std::string WrittenFiles::known_content(const std::string& path_hash) const {
    std::string known;
    std::ifstream stream(ledger_);
    for (std::string line; std::getline(stream, line);)
        if (line.starts_with(path_hash + ' ')) known = line.substr(path_hash.size() + 1);
    return known;
}

void WrittenFiles::note(const std::string& lines) const {
    if (ledger_.empty()) return;
    try {
        std::error_code ignored;
        fs::create_directories(ledger_.parent_path(), ignored);
        shorten(ledger_);
        const FileDescriptor stream(::open(ledger_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600));
        if (stream) write_all(stream.get(), lines.data(), lines.size());
    } catch (const std::exception&) {  // without a ledger the next run asks for --force
    }
}

fs::path state_file(const char* name) {
    const auto folder = [](const char* variable) -> fs::path {
        const char* value = std::getenv(variable);
        return value != nullptr && *value == '/' ? fs::path(value) : fs::path();
    };
    if (const fs::path state = folder("XDG_STATE_HOME"); !state.empty()) return state / "dynlab" / name;
    if (const fs::path home = folder("HOME"); !home.empty()) return home / ".local/state/dynlab" / name;
    return {};
}

}  // namespace dynlab::inline platform
