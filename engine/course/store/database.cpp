#include "course/store/database.h"

#include <SQLiteCpp/Exception.h>
#include <sqlite3.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "platform/error.h"

namespace dynlab::inline course {
namespace {

constexpr int kMillisecondsToWait = 5000;
constexpr std::size_t kMaxIdle = 64;

/// An explanation of SQLite's code for the users of a course; SQLite's own message for other codes.
std::string reason_of(int code, const char* words) {
    switch (code & 0xFF) {
        case SQLITE_BUSY:
        case SQLITE_LOCKED:
            return "another dynlab is writing to this course; nothing was changed; try again later";
        case SQLITE_FULL:
            return "no space left on the disk; nothing was changed; free some space and repeat";
        case SQLITE_READONLY:
        case SQLITE_PERM:
            return "no write permission; nothing was changed; check the permissions of the file and its folder";
        case SQLITE_CANTOPEN:
            return "it cannot be opened; check that file and folder exist and are writable";
        case SQLITE_NOTADB:
            return "this is not a course: the file is not a database";
        case SQLITE_CORRUPT:
            return "the file is damaged; restore a backup, or import a JSON export with dynlab course import";
        case SQLITE_IOERR:
            return "the disk failed to read or write; nothing was changed; check the disk and repeat";
        default:
            return words;
    }
}

[[noreturn]] void fail(const std::string& file, int code, const char* words) {
    throw EnvironmentError("{}: {}", file, reason_of(code, words));
}

/// Does a piece of work with the open database.
template <class Work>
auto with_plain_errors(const SQLite::Database& database, const Work& work) {
    try {
        return work();
    } catch (const SQLite::Exception& error) {
        const int reason = sqlite3_system_errno(database.getHandle());
        const bool full =
            (error.getErrorCode() & 0xFF) == SQLITE_IOERR && (reason == ENOSPC || reason == EDQUOT);  // or a quota
        fail(database.getFilename(), full ? SQLITE_FULL : error.getErrorCode(), error.what());
    }
}

/// If no one can write, as in an archived course, SQLite cannot create its log next to the file and does not need one.
/// An existing log is left from an interrupted run and belongs to the data: then SQLite decides.
bool cannot_change(const std::filesystem::path& file) {
    if (::access(file.c_str(), F_OK) != 0 || ::access(file.c_str(), W_OK) == 0) return false;
    std::error_code no_log;
    return std::filesystem::file_size(file.string() + "-wal", no_log) == 0 || no_log;
}

/// The file as SQLite's URI for what never changes.
std::string unchanging(const std::filesystem::path& file) {
    std::string uri = "file:";
    for (const char c : file.string())
        uri += c == '%' ? "%25" : c == '?' ? "%3f" : c == '#' ? "%23" : std::string(1, c);
    return uri + "?immutable=1";
}

SQLite::Database opened(const std::filesystem::path& file, int flags) {
    try {
        if (cannot_change(file)) return {unchanging(file), SQLite::OPEN_READONLY | SQLite::OPEN_URI};
        return {file.string(), flags, kMillisecondsToWait};
    } catch (const SQLite::Exception& error) {
        fail(file.string(), error.getErrorCode(), error.what());
    }
}

}  // namespace

Rows::Rows(Database& database, const std::string& sql)
    : SQLite::Statement(with_plain_errors(database,
                                          [&] {
                                              auto idle = database.idle_.extract(sql);
                                              return idle ? std::move(idle.mapped()) : SQLite::Statement(database, sql);
                                          })),
      database_(&database) {}

Rows::Rows(Rows&& other) noexcept
    : SQLite::Statement(std::move(other)), database_(std::exchange(other.database_, nullptr)) {}

Rows::~Rows() {
    if (!database_ || database_->idle_.size() >= kMaxIdle) return;
    tryReset();
    clearBindings();
    database_->idle_.emplace(getQuery(), std::move(*this));
}

bool Rows::next() {
    return with_plain_errors(*database_, [this] { return executeStep(); });
}

std::optional<std::int64_t> Rows::optional_integer(int column) const {
    if (isColumnNull(column)) return {};
    return integer(column);
}

Database::Database(const std::filesystem::path& file, Opening opening)
    : SQLite::Database(opened(file, SQLite::OPEN_READWRITE | (opening == Opening::kNew ? SQLite::OPEN_CREATE : 0))) {
    execute("PRAGMA foreign_keys = ON; PRAGMA synchronous = FULL");
}

void Database::execute(const std::string& statements) {
    with_plain_errors(*this, [&] { return exec(statements); });
}

Transaction::Transaction(Database& database) : database_(database) {
    with_plain_errors(database, [&] { transaction_.emplace(database, SQLite::TransactionBehavior::IMMEDIATE); });
}

void Transaction::commit() {
    if (database_.before_commits_) database_.before_commits_(database_);
    with_plain_errors(database_, [this] { transaction_->commit(); });
}

}  // namespace dynlab::inline course
