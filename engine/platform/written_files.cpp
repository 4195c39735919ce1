#include "platform/written_files.h"

#include <fcntl.h>
#include <sys/file.h>

#include <atomic>
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

constexpr char kAboutToBe = '-', kNotOurs[] = "?";
constexpr std::uintmax_t kMaxLedgerBytes = 2u << 20;
constexpr std::size_t kLinesKept = 4000;

/// The newest lines of a ledger that has grown too long.
void shorten(const fs::path& ledger) {
    std::error_code none;
    if (const auto bytes = fs::file_size(ledger, none); none || bytes < kMaxLedgerBytes) return;
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

/// Those of this process, to be notified of files that are put in place.
struct Watchers {
    std::atomic<int> count = 0;  // most programs have none: they need no lock, and no copy of one inherits it locked
    std::recursive_mutex mutex;  // a ledger is such a file, too
    std::set<const WrittenFiles*> all;
};

Watchers& watchers() {
    static Watchers* const watchers = new Watchers;  // outlives every other object
    return *watchers;
}

}  // namespace

void note_replacement(const fs::path& target, const fs::path& finished) {
    if (watchers().count == 0) return;
    const std::lock_guard lock(watchers().mutex);
    for (const WrittenFiles* files : watchers().all) files->note_replacement(target, finished);
}

WrittenFiles::WrittenFiles(fs::path ledger, Others others) : ledger_(std::move(ledger)), others_(others) {
    const std::lock_guard lock(watchers().mutex);
    watchers().all.insert(this);
    ++watchers().count;
}

WrittenFiles::~WrittenFiles() {
    {
        const std::lock_guard lock(watchers().mutex);
        watchers().all.erase(this);
        --watchers().count;
    }
    settle();
}

void WrittenFiles::settle() {
    std::map<fs::path, Taken> taken_files;
    {
        const std::lock_guard lock(mutex_);
        taken_files.swap(taken_);
    }
    std::string lines;
    for (const auto& [file, taken] : taken_files) {
        std::string content = kNotOurs;
        try {
            if (fs::exists(file)) content = sha256_of_file(file);
        } catch (const std::exception&) {  // what cannot be read is not known to the next run
        }
        if (content == taken.others_content) content = kNotOurs;  // it was to be written, and was not
        lines += taken.path_hash + ' ' + content + '\n';
    }
    if (!lines.empty()) note(lines);
}

void WrittenFiles::take(const fs::path& file) {
    {
        const std::lock_guard lock(mutex_);
        if (taken_.contains(file)) return;
    }
    Taken taken{sha256_of(file.string()), {}};
    if (fs::exists(file)) {
        const std::set<std::string> known = known_contents(taken.path_hash);
        const std::string content = sha256_of_file(file);
        if (!known.contains(content)) {
            if (others_ == Others::kKept) refuse(file, !known.empty());
            taken.others_content = content;
        }
    }
    const std::lock_guard lock(mutex_);
    taken_[file] = std::move(taken);
}

void WrittenFiles::note_replacement(const fs::path& target, const fs::path& finished) const {
    if (ledger_.empty()) return;
    std::string path_hash;
    {
        const std::lock_guard lock(mutex_);
        if (taken_.empty()) return;
        std::error_code ignored;
        const fs::path absolute = fs::absolute(target, ignored);
        auto found = taken_.find(absolute);
        if (found == taken_.end()) found = taken_.find(fs::weakly_canonical(absolute, ignored));
        if (found == taken_.end()) return;
        path_hash = found->second.path_hash;
    }
    try {
        note(path_hash + ' ' + kAboutToBe + sha256_of_file(finished) + '\n');
    } catch (const std::exception&) {  // not noted: were this run killed now, the next one would ask for --force
    }
}

void WrittenFiles::refuse(const fs::path& file, bool was_ours) const {
    const std::string name = file.filename().string();
    if (ledger_.empty())
        throw EnvironmentError(
            "'{}' already exists, and its origin is unknown (neither HOME nor XDG_STATE_HOME is set). Save under "
            "another name, move the file elsewhere, or replace the file (dynlab run --force)",
            name);
    if (!was_ours)
        throw EnvironmentError(
            "'{}' already exists and was not written by dynlab. Save under another name, move the file elsewhere, or "
            "replace the file (dynlab run --force)",
            name);
    throw EnvironmentError(
        "'{}' already exists and was changed after dynlab wrote the file. Save under another name, move the file "
        "elsewhere, or replace the file (dynlab run --force)",
        name);
}

std::set<std::string> WrittenFiles::known_contents(const std::string& path_hash) const {
    std::set<std::string> known;
    std::ifstream stream(ledger_);
    for (std::string line; std::getline(stream, line);) {
        if (!line.starts_with(path_hash + ' ')) continue;
        const std::string content = line.substr(path_hash.size() + 1);
        if (content.starts_with(kAboutToBe)) {
            known.insert(content.substr(1));
        } else {
            known.clear();
            if (content != kNotOurs) known.insert(content);
        }
    }
    known.erase("");  // of versions that noted no content
    return known;
}

void WrittenFiles::note(const std::string& lines) const {
    if (ledger_.empty()) return;
    try {
        std::error_code ignored;
        fs::create_directories(ledger_.parent_path(), ignored);
        const FileDescriptor lock(::open((ledger_.string() + ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600));
        if (lock) retry_interrupted([&] { return ::flock(lock.get(), LOCK_EX); });
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
