#include "course/store/sqlite.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <cerrno>

#include <nlohmann/json.hpp>

#include "platform/error.h"

namespace dynlab::inline course {
namespace {

constexpr int kMillisecondsToWait = 5000;

[[noreturn]] void fail(sqlite3* database, int code, const std::string& place) {
    const bool full = database && (code & 0xFF) == SQLITE_IOERR && sqlite3_system_errno(database) == ENOSPC;
    std::string reason;
    switch (full ? SQLITE_FULL : code & 0xFF) {
        case SQLITE_BUSY:
        case SQLITE_LOCKED:
            reason = "another dynlab is writing to this course; nothing was changed, try again when it is done";
            break;
        case SQLITE_FULL:
            reason = "no space left on the disk; nothing was changed, make room and repeat";
            break;
        case SQLITE_READONLY:
        case SQLITE_PERM:
            reason = "it may not be written to; nothing was changed, see to the rights of the file and its folder";
            break;
        case SQLITE_CANTOPEN:
            reason = "it cannot be opened; see whether file and folder are there and may be written to";
            break;
        case SQLITE_NOTADB:
            reason = "this is no course: the file is not a database";
            break;
        case SQLITE_CORRUPT:
            reason = "the file is damaged; take a backup, or a JSON export with dynlab course import";
            break;
        case SQLITE_IOERR:
            reason = "the disk refused to read or write; nothing was changed, see to it and repeat";
            break;
        default:
            reason = database ? sqlite3_errmsg(database) : sqlite3_errstr(code);
    }
    throw EnvironmentError(fmt::format("{}: {}", place, reason));
}

}  // namespace

void Rows::Finish::operator()(sqlite3_stmt* statement) const {
    sqlite3_finalize(statement);
}

Rows::Rows(sqlite3* database, std::string_view sql, const std::string& place) : database_(database), place_(place) {
    sqlite3_stmt* statement = nullptr;
    const int code = sqlite3_prepare_v2(database, sql.data(), static_cast<int>(sql.size()), &statement, nullptr);
    statement_.reset(statement);
    if (code != SQLITE_OK) fail(database, code, place);
}

void Rows::bind(int place, std::int64_t value) {
    sqlite3_bind_int64(statement_.get(), place, value);
}
void Rows::bind(int place, double value) {
    sqlite3_bind_double(statement_.get(), place, value);
}
void Rows::bind(int place, const std::string& value) {
    sqlite3_bind_text(statement_.get(), place, value.data(), static_cast<int>(value.size()), SQLITE_TRANSIENT);
}
void Rows::bind(int place, const std::optional<std::int64_t>& value) {
    if (value.has_value()) bind(place, *value);  // a value that was never bound is null
}
void Rows::bind(int place, const std::optional<std::string>& value) {
    if (value.has_value()) bind(place, *value);
}

bool Rows::next() {
    const int code = sqlite3_step(statement_.get());
    if (code == SQLITE_ROW) return true;
    if (code != SQLITE_DONE) fail(database_, code, place_);
    return false;
}

std::int64_t Rows::integer(int column) const {
    return sqlite3_column_int64(statement_.get(), column);
}
double Rows::number(int column) const {
    return sqlite3_column_double(statement_.get(), column);
}
std::string Rows::text(int column) const {
    const auto* const text = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
    if (text == nullptr) return {};
    return {text, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
}
bool Rows::null(int column) const {
    return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL;
}
std::optional<std::int64_t> Rows::optional_integer(int column) const {
    if (null(column)) return {};
    return integer(column);
}
int Rows::columns() const {
    return sqlite3_column_count(statement_.get());
}
std::string Rows::name(int column) const {
    return sqlite3_column_name(statement_.get(), column);
}

nlohmann::json Rows::value(int column) const {
    switch (sqlite3_column_type(statement_.get(), column)) {
        case SQLITE_INTEGER:
            return integer(column);
        case SQLITE_FLOAT:
            return number(column);
        case SQLITE_NULL:
            return nullptr;
        default:
            return text(column);
    }
}

void Database::Close::operator()(sqlite3* database) const {
    sqlite3_close_v2(database);
}

Database::Database(const std::filesystem::path& file, Opening opening) : place_(file.string()) {
    sqlite3* database = nullptr;
    const int flags = SQLITE_OPEN_READWRITE | (opening == Opening::kNew ? SQLITE_OPEN_CREATE : 0);
    const int code = sqlite3_open_v2(file.c_str(), &database, flags, nullptr);
    database_.reset(database);
    if (code != SQLITE_OK) fail(database, code, place_);
    sqlite3_extended_result_codes(database, 1);
    sqlite3_busy_timeout(database, kMillisecondsToWait);
    execute("PRAGMA foreign_keys = ON; PRAGMA synchronous = FULL");
}

void Database::execute(const std::string& statements) {
    const int code = sqlite3_exec(database_.get(), statements.c_str(), nullptr, nullptr, nullptr);
    if (code != SQLITE_OK) fail(database_.get(), code, place_);
}

void Database::insert(const std::string& table, const nlohmann::json& row) {
    std::string names, marks;
    for (const auto& [name, value] : row.items()) {
        names += (names.empty() ? "\"" : ", \"") + name + '"';
        marks += marks.empty() ? "?" : ", ?";
    }
    Rows statement = query(fmt::format("INSERT INTO {} ({}) VALUES ({})", table, names, marks));
    int place = 0;
    for (const auto& [name, value] : row.items()) {
        ++place;
        if (value.is_number_integer())
            statement.bind(place, value.get<std::int64_t>());
        else if (value.is_number())
            statement.bind(place, value.get<double>());
        else if (value.is_string())
            statement.bind(place, value.get<std::string>());
    }
    statement.next();
}

std::int64_t Database::last_id() const {
    return sqlite3_last_insert_rowid(database_.get());
}

Transaction::Transaction(Database& database) : database_(database) {
    database_.execute("BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
    if (!open_) return;
    try {
        database_.execute("ROLLBACK");
    } catch (const EnvironmentError&) {
        // SQLite has undone it already, or will when the file is opened next.
    }
}

void Transaction::commit() {
    database_.execute("COMMIT");
    open_ = false;
}

}  // namespace dynlab::inline course
