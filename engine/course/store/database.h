#pragma once
#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>
#include <SQLiteCpp/Transaction.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

namespace dynlab::inline course {

// SQLiteCpp's classes; what SQLite refuses becomes an EnvironmentError that names the file and says what to do: no such
// file, not a database, locked by another, disk full, not writable.

class Database;

/// A statement with its values; walks over the rows of its answer: while (rows.next()) rows.text(0).
class Rows : public SQLite::Statement {
  public:
    Rows(Database& database, const std::string& sql);
    Rows(Rows&& other) noexcept;
    Rows& operator=(Rows&&) = delete;
    ~Rows();

    bool next();
    std::int64_t integer(int column) const { return getColumn(column).getInt64(); }
    std::optional<std::int64_t> optional_integer(int column) const;
    double number(int column) const { return getColumn(column).getDouble(); }
    std::string text(int column) const { return getColumn(column).getString(); }  ///< empty where the cell is null

    /// The value of parameter `parameter`, counted from 1. Without a value it is null, as one that was never given.
    template <class Value>
    void give(int parameter, const Value& value) {
        bind(parameter, value);
    }
    template <class Value>
    void give(int parameter, const std::optional<Value>& value) {
        if (value.has_value()) bind(parameter, *value);
    }

  private:
    Database* database_;
};

/// An SQLite database: write-ahead log, foreign keys enforced, every commit on disk, waits five seconds for another
/// writer. A file that cannot be written can be read.
class Database : public SQLite::Database {
  public:
    enum class Opening { kExisting, kNew };
    Database(const std::filesystem::path& file, Opening opening);

    /// Several statements without values, such as a schema.
    void execute(const std::string& statements);
    template <class... Values>
    Rows query(const std::string& sql, const Values&... values) {
        Rows rows(*this, sql);
        int parameter = 0;
        (rows.give(++parameter, values), ...);
        return rows;
    }
    template <class... Values>
    void run(const std::string& sql, const Values&... values) {
        Rows rows = query(sql, values...);
        while (rows.next()) continue;
    }

    /// What every transaction does as the last of its work.
    void before_commits(std::function<void(Database&)> work) { before_commits_ = std::move(work); }

  private:
    friend class Transaction;
    friend class Rows;
    std::function<void(Database&)> before_commits_;
    /// Statements of queries that are over, by their words: to read those takes longer than to do what they say.
    std::multimap<std::string, SQLite::Statement> idle_;
};

/// All or nothing: what is not committed when this object goes is undone. Holds the only right to write from its
/// beginning on, so that nothing read inside changes before it is written.
class Transaction {
  public:
    explicit Transaction(Database& database);
    void commit();

  private:
    Database& database_;
    std::optional<SQLite::Transaction> transaction_;
};

}  // namespace dynlab::inline course
