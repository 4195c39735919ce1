#include "course/store/store_seal.h"

#include <SQLiteCpp/Column.h>
#include <fmt/format.h>

#include <map>
#include <sstream>

#include "course/store/course_schema.h"
#include "platform/hash.h"

namespace dynlab::inline course {
namespace {

/// By table: "ROWS SHA-256".
using TableStates = std::map<std::string, std::string>;

/// The rows in the order of their keys, every cell with its kind and length, so that no two contents give one text.
std::string state_of(Database& database, const std::string& query) {
    std::string text;
    std::int64_t count = 0;
    for (Rows rows = database.query(query); rows.next(); ++count)
        for (int c = 0; c < rows.getColumnCount(); ++c) {
            const SQLite::Column cell = rows.getColumn(c);
            if (cell.isNull()) {
                text += "n;";
                continue;
            }
            const std::string value = cell.getString();
            text += fmt::format("{}{}:{};", cell.isInteger() ? 'i' : cell.isFloat() ? 'f' : 't', value.size(), value);
        }
    return fmt::format("{} {}", count, sha256_of(text));
}

TableStates states_now(Database& database) {
    TableStates states;
    for (const std::string& table : course_tables()) {
        if (table == "seals") continue;
        std::string order;
        for (Rows keys = database.query("SELECT name FROM pragma_table_info(?) WHERE pk > 0 ORDER BY pk", table);
             keys.next();)
            order += (order.empty() ? "" : ", ") + keys.text(0);
        states[table] = state_of(database, fmt::format("SELECT * FROM {} ORDER BY {}", table, order));
    }
    states["(tables themselves)"] =
        state_of(database,
                 "SELECT type, name, sql FROM sqlite_master WHERE sql IS NOT NULL AND name NOT LIKE 'sqlite_%' "
                 "ORDER BY type, name");
    return states;
}

struct Seal {
    std::int64_t id = 0, at = 0;
    std::string contents, signature;
};

std::string sealed_text(const Seal& seal, const std::string& before) {
    return fmt::format("dynlab seal {}\n{}\n{}\n{}", seal.id, utc_text(seal.at), before, seal.contents);
}

std::vector<Seal> seals_of(Database& database) {
    std::vector<Seal> seals;
    for (Rows rows = database.query("SELECT id, at, contents, signature FROM seals ORDER BY id"); rows.next();)
        seals.push_back({rows.integer(0), rows.integer(1), rows.text(2), rows.text(3)});
    return seals;
}

void add_states(const std::string& contents, TableStates& states) {
    std::istringstream lines(contents);
    for (std::string line; std::getline(lines, line);)
        if (const auto colon = line.find(": "); colon != std::string::npos)
            states[line.substr(0, colon)] = line.substr(colon + 2);
}

/// The state of the tables according to all seals together.
TableStates states_sealed(const std::vector<Seal>& seals) {
    TableStates states;
    for (const Seal& seal : seals) add_states(seal.contents, states);
    return states;
}

std::string rows_of(const std::string& state) {
    return state.substr(0, state.find(' '));
}

}  // namespace

void seal_store(Database& database, const SigningKey& key, Instant at) {
    const std::vector<Seal> seals = seals_of(database);
    const TableStates before = states_sealed(seals);
    Seal seal;
    seal.id = seals.empty() ? 1 : seals.back().id + 1, seal.at = at;
    for (const auto& [table, state] : states_now(database)) {
        const auto known = before.find(table);
        if (known == before.end() || known->second != state) seal.contents += fmt::format("{}: {}\n", table, state);
    }
    if (seal.contents.empty()) return;
    seal.signature = key.sign(sealed_text(seal, seals.empty() ? "" : seals.back().signature));
    database.run("INSERT INTO seals VALUES (?, ?, ?, ?)", seal.id, seal.at, seal.contents, seal.signature);
}

std::vector<std::string> seal_errors(Database& database, std::string_view public_key) {
    const std::vector<Seal> seals = seals_of(database);
    if (seals.empty()) return {"the store has no seals: they were removed"};
    std::vector<std::string> error_list;
    std::string before;
    std::int64_t expected = 1;
    for (const Seal& seal : seals) {
        if (seal.id != expected || !is_signature(seal.signature, sealed_text(seal, before), public_key))
            error_list.push_back(
                fmt::format("seal {} ({}) was altered, or one before it is missing", seal.id, utc_text(seal.at)));
        before = seal.signature, expected = seal.id + 1;
    }
    const TableStates sealed = states_sealed(seals);
    for (const auto& [table, state] : states_now(database)) {
        const auto known = sealed.find(table);
        if (known != sealed.end() && known->second == state) continue;
        error_list.push_back(fmt::format(
            "the table {} was changed by another program: it has {} rows, but had {} when it was last sealed ({}); "
            "restore a backup",
            table, rows_of(state), known == sealed.end() ? "none" : rows_of(known->second), utc_text(seals.back().at)));
    }
    return error_list;
}

}  // namespace dynlab::inline course
