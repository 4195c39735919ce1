#include "course/store/course_store.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <exception>
#include <limits>
#include <map>
#include <set>
#include <thread>
#include <utility>

#include "course/store/course_key.h"
#include "course/store/course_schema.h"
#include "course/store/side_by_side.h"
#include "course/store/store_seal.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/files/plain_file.h"
#include "platform/files/temporary_file.h"
#include "platform/hash.h"
#include "platform/keys/secure_random.h"
#include "platform/locks/abandoned_folders.h"
#include "platform/system_call.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr char kDatabase[] = "course.db", kKey[] = "course.key";

/// 32 random bytes in hexadecimal digits, readable by their owner only.
void make_key(const fs::path& file) {
    if (!fs::exists(file)) write_plain_file(file, secure_hex(32));
}

void sync_folder(const fs::path& folder) {
    const FileDescriptor fd(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (!fd || ::fsync(fd.get()) != 0)
        throw EnvironmentError("cannot write to {}: {}", folder.string(), system_reason(errno));
}

/// A new one is its owner's alone: names, addresses and who reviews whom are below.
void make_folder(const fs::path& folder) {
    std::error_code error;
    const bool made = fs::create_directories(folder, error);
    if (made && !error) fs::permissions(folder, fs::perms::owner_all, error);
    if (error) throw EnvironmentError("cannot create the folder {}: {}", folder.string(), system_reason(error.value()));
}

/// The folder itself or the nearest above it that holds a course.
fs::path course_folder(const fs::path& start) {
    std::error_code ignored;
    const fs::path from = fs::weakly_canonical(start, ignored);
    for (fs::path folder = from; !folder.empty(); folder = folder.parent_path()) {
        if (fs::exists(folder / kDatabase, ignored)) return folder;
        if (folder == folder.root_path()) break;
    }
    throw EnvironmentError(
        "no course was found in {} or its parent folders. Change to the folder of the course, specify the folder with "
        "--course DIR, or create a course with dynlab course init DIR",
        from.string());
}

std::string read_key(const fs::path& file) {
    if (!fs::exists(file))
        throw EnvironmentError(
            "{} is missing, so receipts can neither be signed nor verified; restore it from a backup", file.string());
    std::string key = read_file(file);
    while (!key.empty() && (key.back() == '\n' || key.back() == ' ')) key.pop_back();
    if (key.size() < 32) throw EnvironmentError("{} is damaged; restore it from a backup", file.string());
    return key;
}

/// Older versions used the same secret for codes, so signing uses a separate derived key.
SigningKey signing_key_of(const std::string& secret) {
    return SigningKey::derived(secret, "dynlab receipts");
}

fs::path write_public_key(const fs::path& folder, const std::string& name, const SigningKey& key) {
    const fs::path file = folder / kPublicKeyFile;
    const std::string text = public_key_text(name, key.public_key());
    if (!fs::exists(file) || read_file(file) != text) write_file_atomically(file, text);
    return file;
}

/// Temporary files of killed processes: of all that write() stores, of the files in the course's own folder, and
/// temporary folders.
std::vector<fs::path> remove_leftovers_of(const fs::path& course) {
    std::vector<fs::path> removed = remove_leftover_files(course);
    for (fs::path& file : remove_leftover_files(course / "files")) removed.push_back(std::move(file));
    for (fs::path& folder : remove_abandoned_folders()) removed.push_back(std::move(folder));
    return removed;
}

/// Brings it to the newest tables; the database as it was is kept beside it. Returns whether it was of earlier ones.
bool converted(Database& database, const fs::path& file) {
    keep_before_migration(database, file);
    return migrate_course(database, Database::Opening::kExisting, file.string());
}

void seal_commits(Database& database, const SigningKey& key) {
    database.before_commits([key](Database& changed) { seal_store(changed, key, CourseClock::now()); });
}

}  // namespace

void Course::create(const fs::path& folder, const std::string& name, const std::string& zone) {
    const CourseClock clock(zone);
    make_folder(folder);
    for (const char* own : {"files", "outbox", "receipts"}) make_folder(folder / own);
    Database database(folder / kDatabase, Database::Opening::kNew);
    fs::permissions(folder / kDatabase, fs::perms::owner_read | fs::perms::owner_write);
    migrate_course(database, Database::Opening::kNew, (folder / kDatabase).string());
    Transaction transaction(database);
    if (database.query("SELECT 1 FROM course").next())
        throw EnvironmentError("{} already contains a course; nothing was changed", fs::absolute(folder).string());
    make_key(folder / kKey);
    const SigningKey signing_key = signing_key_of(read_key(folder / kKey));
    write_public_key(folder, name, signing_key);
    seal_commits(database, signing_key);
    const auto set = [&](const char* key, const std::string& value) {
        database.run("INSERT INTO course VALUES (?, ?)", key, value);
    };
    set("name", name);
    set("zone", zone);
    database.run("INSERT INTO journal (at, what) VALUES (?, ?)", CourseClock::now(),
                 fmt::format("course \"{}\" made, times in {}", name, zone));
    transaction.commit();
}

Course::Course(const fs::path& folder)
    : folder_(course_folder(folder)),
      leftovers_(remove_leftovers_of(folder_)),
      database_(folder_ / kDatabase, Database::Opening::kExisting),
      migrated_(converted(database_, folder_ / kDatabase)),
      name_(setting("name")),
      clock_(setting("zone")),
      key_(read_key(folder_ / kKey)),
      signing_key_(signing_key_of(key_)) {
    seal_commits(database_, signing_key_);
    if (migrated_) Transaction(database_).commit();  // what came before seals is taken as it is
}

fs::path Course::publish_key() const {
    return write_public_key(folder_, name_, signing_key_);
}

std::string Course::setting(const char* key) {
    Rows rows = database_.query("SELECT value FROM course WHERE key = ?", key);
    if (!rows.next())
        throw EnvironmentError("{}: the course is incomplete; repeat dynlab course init",
                               (folder_ / kDatabase).string());
    return rows.text(0);
}

fs::path Course::file(const std::string& hash) const {
    return folder_ / "files" / hash.substr(0, 2) / hash;
}

std::string Course::keep(std::string_view content) const {
    return keep(std::vector<std::string>{std::string(content)}).front();
}

std::vector<std::string> Course::keep(std::vector<std::string> contents) const {
    std::vector<std::string> hashes;
    std::map<fs::path, std::string> fresh;
    for (std::string& content : contents) {
        hashes.push_back(sha256_of(content));
        const fs::path kept = file(hashes.back());
        if (fresh.contains(kept) || (fs::exists(kept) && sha256_of_file(kept) == hashes.back())) continue;
        make_folder(kept.parent_path());
        fresh.emplace(kept, std::move(content));
    }
    std::vector<NewFile> files;
    for (auto& [kept, content] : fresh) files.push_back({kept, std::move(content)});
    write(files);
    return hashes;
}

void Course::write(const std::vector<NewFile>& files) const {
    make_folder(folder_ / "files");
    write_files_atomically(files, folder_ / "files");
}

void Course::settle(const std::vector<std::string>& hashes) const {
    std::set<fs::path> folders = {folder_ / "files"};
    for (const std::string& hash : hashes) folders.insert(file(hash).parent_path());
    for (const fs::path& folder : folders) sync_folder(folder);
}

void Course::keep_files(const std::vector<fs::path>& files,
                        const std::function<void(std::size_t, const StoredFile&)>& look,
                        const std::function<void(std::size_t, std::size_t)>& progress) const {
    constexpr std::size_t kGivenUp = std::numeric_limits<std::size_t>::max();
    std::vector<StoredFile> kept(files.size());
    std::atomic<std::size_t> done = 0;  // of them
    const auto notify = [&done](std::size_t now) {
        done = now;
        done.notify_all();
    };
    std::exception_ptr failure;
    {
        const std::jthread keeper([&](const std::stop_token& stop) {
            try {
                keep_in_batches(files, kept, notify, stop);
            } catch (...) {
                failure = std::current_exception();
                notify(kGivenUp);
            }
        });
        const auto work = [&](std::size_t i) {
            std::size_t now = done;
            for (; now <= i; now = done) done.wait(now);
            if (now != kGivenUp) look(i, kept[i]);
        };
        side_by_side(files.size(), work, progress);
    }
    if (failure) std::rethrow_exception(failure);
    std::vector<std::string> hashes;
    for (const StoredFile& file : kept) hashes.push_back(file.hash);
    settle(hashes);
}

/// So many at a time that they wait for the disk together, and so few that the first is soon there and that little
/// memory is copied with each process that looks at one.
void Course::keep_in_batches(const std::vector<fs::path>& files, std::vector<StoredFile>& kept,
                             const std::function<void(std::size_t)>& notify, const std::stop_token& stop) const {
    constexpr std::int64_t kMaxBatchBytes = 2 << 20;
    std::vector<std::string> contents;
    std::int64_t bytes = 0;
    for (std::size_t i = 0; i < files.size() && !stop.stop_requested(); ++i) {
        contents.push_back(read_file(files[i]));
        kept[i].bytes = static_cast<std::int64_t>(contents.back().size());
        bytes += kept[i].bytes;
        if (bytes < kMaxBatchBytes && i + 1 < files.size()) continue;
        std::size_t next = i + 1 - contents.size();
        for (std::string& hash : keep(std::exchange(contents, {}))) kept[next++].hash = std::move(hash);
        bytes = 0;
        notify(next);
    }
}

void Course::register_file(const std::string& hash, std::int64_t bytes, Instant at) {
    database_.run("INSERT OR IGNORE INTO files VALUES (?, ?, ?)", hash, bytes, at);
}

std::string Course::saved_entry(const std::string& key) {
    Rows rows = database_.query("SELECT value FROM course WHERE key = ?", key);
    return rows.next() ? rows.text(0) : "";
}

void Course::save_entry(const std::string& key, const std::string& value) {
    database_.run(
        "INSERT INTO course VALUES (?, ?) ON CONFLICT DO UPDATE SET value = excluded.value WHERE value <> "
        "excluded.value",
        key, value);
}

void Course::note(const std::string& what, Instant at) {
    database_.run("INSERT INTO journal (at, what) VALUES (?, ?)", at, terminal_line(what));
}

}  // namespace dynlab::inline course
