#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace dynlab::inline course {

/// A prepared statement with its values; walks over the rows of its answer: while (rows.next()) rows.text(0).
class Rows {
  public:
    bool next();
    std::int64_t integer(int column) const;
    double number(int column) const;
    std::string text(int column) const;  ///< empty where the cell is null
    bool null(int column) const;
    std::optional<std::int64_t> optional_integer(int column) const;
    int columns() const;
    std::string name(int column) const;
    nlohmann::json value(int column) const;  ///< a whole number, a number, a text or null

  private:
    friend class Database;
    Rows(sqlite3* database, std::string_view sql, const std::string& place);
    void bind(int place, std::int64_t value);
    void bind(int place, int value) { bind(place, std::int64_t{value}); }
    void bind(int place, double value);
    void bind(int place, const std::string& value);
    void bind(int place, const char* value) { bind(place, std::string(value)); }
    void bind(int place, const std::optional<std::int64_t>& value);
    void bind(int place, const std::optional<std::string>& value);

    struct Finish {
        void operator()(sqlite3_stmt* statement) const;
    };
    std::unique_ptr<sqlite3_stmt, Finish> statement_;
    sqlite3* database_;
    std::string place_;
};

/// An SQLite database: write-ahead log, foreign keys enforced, every commit on disk, waits five seconds for another
/// writer. Throws EnvironmentError: no such file, not a database, locked by another, disk full, not writable.
class Database {
  public:
    enum class Opening { kExisting, kNew };
    Database(const std::filesystem::path& file, Opening opening);

    /// Several statements without values, such as a schema.
    void execute(const std::string& statements);
    template <class... Values>
    Rows query(std::string_view sql, const Values&... values) {
        Rows rows(database_.get(), sql, place_);
        int place = 0;
        (rows.bind(++place, values), ...);
        return rows;
    }
    template <class... Values>
    void run(std::string_view sql, const Values&... values) {
        Rows rows = query(sql, values...);
        while (rows.next()) continue;
    }
    /// Inserts a row of column names and values.
    void insert(const std::string& table, const nlohmann::json& row);
    std::int64_t last_id() const;  ///< of the row that was inserted last

  private:
    struct Close {
        void operator()(sqlite3* database) const;
    };
    std::unique_ptr<sqlite3, Close> database_;
    std::string place_;
};

/// All or nothing: what is not committed when this object goes is undone. Holds the only right to write from its
/// beginning on, so that nothing read inside changes before it is written.
class Transaction {
  public:
    explicit Transaction(Database& database);
    ~Transaction();
    Transaction(const Transaction&) = delete;
    Transaction& operator=(const Transaction&) = delete;
    void commit();

  private:
    Database& database_;
    bool open_ = true;
};

}  // namespace dynlab::inline course
