#include "course/office/course_export.h"

#include <fmt/format.h>

#include <SQLiteCpp/Column.h>

#include <algorithm>
#include <map>
#include <set>
#include <variant>

#include "base/error.h"
#include "base/reader.h"
#include "course/office/course_totals.h"
#include "course/review/review_marks.h"
#include "course/review/score_sheet.h"
#include "course/store/course_schema.h"
#include "course/store/groups.h"
#include "course/store/marks.h"
#include "course/store/newest_versions.h"
#include "data_io/text_table.h"
#include "data_io/values/json_values.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/locks/complete_folder.h"
#include "platform/text/plain_words.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

std::string percent_text(const std::optional<double>& value) {
    return value ? fmt::format("{:.4g}", *value) : "";
}

std::string hours_text(std::int64_t seconds) {
    return fmt::format("{:.4g}", static_cast<double>(seconds) / 3600);
}

std::string time_cell(const Course& course, Instant at) {
    return course.clock().show_exactly(at).substr(0, std::string_view("2026-03-01 15:00").size());
}

/// When the newest version was received, as spreadsheets read it, and how many hours late it counts.
std::pair<std::string, std::string> arrival(Course& course, const SubmittedParts& parts, const char* part) {
    const auto found = parts.find(part);
    if (found == parts.end()) return {"missing", ""};
    const SubmittedFile& h = found->second;
    return {time_cell(course, h.received_at), hours_text(h.is_late() ? h.late : 0)};
}

std::map<std::int64_t, std::string> remarks_by_reviewer(Course& course, const Assignment& a, const Marks& marks) {
    std::map<std::int64_t, std::string> remarks;
    for (const ReviewPair& pair : review_pairs(course, a))
        for (const ReviewMark& mark : marks.reviews) {
            if (mark.pair != pair.id || !mark.outlier) continue;
            std::string& text = remarks[pair.reviewer];
            text += fmt::format("{}review of {} far below the others{}", text.empty() ? "" : "; ", pair.author_name,
                                mark.retaliation ? ", perhaps in return for a bad one" : "");
        }
    return remarks;
}

/// A row a student, with the mark of the group's work that counts, or the student's own.
std::string lab_csv(Course& course, const Assignment& a, Instant now) {
    TextTable table;
    table.names = {"id",   "name",   "mail",     "moodle",  "canvas",  "group", "submission",
                   "late", "points", "possible", "penalty", "percent", "reason"};
    auto versions = newest_versions(course, a);
    const auto authors = author_groups(course, a);
    auto marks = marks_of_students(course, a, now);
    std::map<std::int64_t, std::pair<std::string, std::string>> arrivals;  // by version
    for (Rows rows = course.database().query("SELECT id, received_at, late FROM standing WHERE assignment = ?", a.id);
         rows.next();)
        arrivals[rows.integer(0)] = {time_cell(course, rows.integer(1)), hours_text(rows.integer(2))};
    for (const Student& s : students_of(course)) {
        std::vector<std::string> row = {s.id, s.name, s.mail, s.moodle, s.canvas, s.group};
        if (const auto author = authors.find(s.id); author != authors.end()) {
            const auto& mark = marks[s.id].lab;
            const auto counts = mark ? arrivals.find(mark->version) : arrivals.end();
            const auto came = counts != arrivals.end()
                                  ? counts->second
                                  : arrival(course, versions[author->second]["first"], a.document());
            row.insert(row.end(), {came.first, came.second});
            if (mark)
                row.insert(row.end(), {percent_text(mark->earned), fmt::format("{:.4g}", mark->possible),
                                       fmt::format("{:.4g}", mark->penalty), percent_text(marks[s.id].percent),
                                       mark->reason.empty() ? mark->own_reasons : mark->reason});
        }
        row.resize(table.names.size());
        table.rows.push_back(std::move(row));
    }
    return csv_text(table);
}

/// A whole number, a number, a text or null.
struct StoredCell {
    std::variant<std::monostate, std::int64_t, double, std::string> value;
};

/// By the names of the columns.
using StoredRow = std::map<std::string, StoredCell>;

/// The file of an export.
struct CourseExport {
    int format = 1;
    std::optional<std::int64_t> tables_version;  ///< missing in the first exports
    std::map<std::string, std::vector<StoredRow>> tables;
};

void write_whole_value(ValueWriter& writer, const StoredCell& cell) {
    std::visit(
        [&writer](const auto& value) {
            if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, std::monostate>)
                writer.nothing();
            else
                write_value(writer, value);
        },
        cell.value);
}

void read_whole_value(ValueReader& reader, StoredCell& cell) {
    switch (reader.next()) {
        case ValueReader::Kind::kNothing:
            cell.value = std::monostate();
            return reader.nothing();
        case ValueReader::Kind::kWhole:
            cell.value = read_fresh<std::int64_t>(reader);
            return;
        case ValueReader::Kind::kNumber:
            cell.value = reader.number();
            return;
        default:
            cell.value = reader.text();
    }
}

template <Is<CourseExport> T, class V>
void describe(T& object, V& member) {
    auto& [format, tables_version, tables] = object;
    member("dynlab course", format), member("tables version", tables_version), member("tables", tables);
}

StoredCell stored_cell(const SQLite::Column& cell) {
    if (cell.isInteger()) return {cell.getInt64()};
    if (cell.isFloat()) return {cell.getDouble()};
    if (cell.isNull()) return {};
    return {cell.getString()};
}

const std::string& text_in(const StoredRow& row, const std::string& column) {
    const auto found = row.find(column);
    const auto* const text = found == row.end() ? nullptr : std::get_if<std::string>(&found->second.value);
    if (!text) throw ValueError("a row has no value for \"{}\"", column);
    return *text;
}

std::string column_list(const StoredRow& row) {
    std::string list;
    for (const auto& [name, cell] : row) {
        const bool plain = std::ranges::all_of(name, [](char c) { return c == '_' || (c >= 'a' && c <= 'z'); });
        if (!plain || name.empty()) throw ValueError("the column \"{}\" is missing", printable(name));
        list += (list.empty() ? "" : ", ") + name;
    }
    return list;
}

void insert_row(Database& db, const std::string& table, const StoredRow& row) {
    const std::vector<std::string> marks(row.size(), "?");
    Rows statement =
        db.query(fmt::format("INSERT INTO {} ({}) VALUES ({})", table, column_list(row), fmt::join(marks, ", ")));
    int parameter = 0;
    for (const auto& [name, cell] : row) {
        ++parameter;
        if (const auto* const whole = std::get_if<std::int64_t>(&cell.value))
            statement.give(parameter, *whole);
        else if (const auto* const number = std::get_if<double>(&cell.value))
            statement.give(parameter, *number);
        else if (const auto* const text = std::get_if<std::string>(&cell.value))
            statement.give(parameter, *text);
    }
    statement.next();
}

/// Checks or a secret that lie in the folder of the course. An export may come from others: nothing is copied from or
/// to another folder.
void copy_own(const fs::path& from, const fs::path& folder, const std::string& place) {
    const fs::path own = fs::path(place).lexically_normal();
    if (own.empty() || own.is_absolute() || own == "." || *own.begin() == ".." || !fs::exists(from / own)) return;
    fs::create_directories((folder / own).parent_path());
    fs::copy(from / own, folder / own, fs::copy_options::recursive | fs::copy_options::skip_existing);
}

/// Makes the imported course in `folder`, an empty one: with the tables that the exported one had, which opening it
/// then brings to today's.
void fill_imported(const fs::path& folder, const fs::path& from, std::map<std::string, std::string>& settings,
                   const std::vector<fs::path>& submitted_files, const CourseExport& all) {
    if (fs::exists(from / "course.key")) fs::copy_file(from / "course.key", folder / "course.key");
    Course::create(folder, settings["name"], settings["zone"]);
    {
        const std::vector<const char*>& steps = course_steps();
        const auto version = std::clamp<std::int64_t>(all.tables_version.value_or(2), 1, std::ssize(steps));
        const fs::path file = folder / "course.db";
        fs::remove(file);
        Database db(file, Database::Opening::kNew);
        fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
        migrate_course(db, Database::Opening::kNew, file.string(), {steps.begin(), steps.begin() + version});
        db.execute("PRAGMA foreign_keys = OFF");  // tables come in any order
        Transaction transaction(db);
        for (const auto& [table, rows] : all.tables) {
            if (!db.query("SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = ?", table).next())
                throw EnvironmentError("the table \"{}\" does not exist", printable(table));
            for (const StoredRow& row : rows) insert_row(db, table, row);
        }
        if (db.query("PRAGMA foreign_key_check").next()) throw EnvironmentError("a row refers to a missing row");
        transaction.commit();
    }
    Course course(folder);
    for (const Assignment& a : assignments_of(course))
        copy_own(from, folder, a.checks), copy_own(from, folder, a.secret);
    std::vector<std::string> hashes;
    for (const fs::path& kept : submitted_files) hashes.push_back(course.keep(read_file(kept)));
    course.settle(hashes);
    Transaction(course.database()).commit();  // seals what the exported course had not sealed
}

/// Throws ValueError for a file that is not an export.
CourseExport read_export(const fs::path& file) {
    auto read = from_json<CourseExport>(read_file(file));
    for (const char* needed : {"course", "files"})
        if (!read.tables.contains(needed)) throw ValueError("the table \"{}\" is missing", needed);
    return read;
}

}  // namespace

std::string marks_csv(Course& course, const Assignment& a, Instant now) {
    if (a.is_lab()) return lab_csv(course, a, now);
    TextTable table;
    table.names = {"id",
                   "name",
                   "mail",
                   "moodle",
                   "canvas",
                   "group",
                   "first version",
                   "first late (h)",
                   "reviews written",
                   "reviews late (h)",
                   "final version",
                   "final late (h)",
                   "work percent",
                   "work reason",
                   "reviews percent",
                   "reviews reason",
                   "remarks"};
    const Marks marks = course_marks(course, a, now);
    const auto of_reviewers = remarks_by_reviewer(course, a, marks);
    const std::vector<ReviewPair> pairs = review_pairs(course, a);
    const auto authors = author_groups(course, a);
    const char* const part = a.document();
    auto versions = newest_versions(course, a);
    OralComments said = oral_comments(course, a);
    std::map<std::int64_t, Group> groups;
    for (const Group& group : groups_of(course)) groups[group.id] = group;
    for (const Student& s : students_of(course)) {
        std::vector<std::string> row = {s.id, s.name, s.mail, s.moodle, s.canvas, s.group};
        const auto author = authors.find(s.id);
        const auto mark = author == authors.end() ? marks.groups.end()
                                                  : std::ranges::find(marks.groups, author->second, &GroupMark::group);
        if (mark != marks.groups.end()) {
            const std::int64_t id = author->second;
            const auto first = arrival(course, versions[id]["first"], part),
                       last = arrival(course, versions[id]["final"], part);
            int written = 0, all = 0;
            std::int64_t late = 0;
            for (const ReviewPair& pair : pairs)
                if (pair.reviewer == id && !pair.ended)
                    ++all, written += pair.written, late = std::max(late, pair.late);
            row.insert(row.end(), {first.first, first.second, all > 0 ? fmt::format("{} of {}", written, all) : "",
                                   all > 0 ? hours_text(late) : "", a.is_report() ? last.first : "", last.second});
            for (const FinalMark& own : {marks.work_of(*mark, s.id), marks.reviews_of(*mark, s.id)})
                row.insert(row.end(), {percent_text(own.percent), own.given != nullptr ? own.given->reason : ""});
            std::vector<std::string> remarks;
            const Group& group = groups.at(id);
            if (group.name != s.group) remarks.push_back("marks of " + group.name + ", the group at the submission");
            if (group.dropped_out) remarks.emplace_back("dropped out");
            if (const auto own = of_reviewers.find(id); own != of_reviewers.end()) remarks.push_back(own->second);
            if (a.is_report() && mark->scored == 0 && versions[id]["first"].contains(part))
                remarks.emplace_back("no scored review");
            if (a.is_report() && mark->scored == 1 && a.reviews > 1) remarks.emplace_back("is based on one review");
            for (const Message& cost : marks.costs_of(*mark, s.id)) remarks.push_back(message_text(cost));
            const StudentMark* const own = mark->own_points_of(s.id);
            for (const std::string& criterion : own ? own->zeros : mark->zeros)
                remarks.push_back("no points for " + criterion + ", counted as 0");
            remarks.push_back(said.groups[id]), remarks.push_back(said.students[s.id]);
            std::erase(remarks, "");
            row.push_back(fmt::format("{}", fmt::join(remarks, "; ")));
        }
        row.resize(table.names.size());
        table.rows.push_back(std::move(row));
    }
    return csv_text(table);
}

std::string course_json(Course& course) {
    Database& db = course.database();
    CourseExport all;
    Rows version = db.query("PRAGMA user_version");
    version.next();
    all.tables_version = version.integer(0);
    for (const std::string& table : course_tables()) {
        std::vector<StoredRow>& rows = all.tables[table];
        for (Rows row = db.query("SELECT * FROM " + table + " ORDER BY 1, 2"); row.next();) {
            StoredRow& stored = rows.emplace_back();
            for (int c = 0; c < row.getColumnCount(); ++c) stored[row.getColumnName(c)] = stored_cell(row.getColumn(c));
        }
    }
    return json_of(all, 1) + '\n';
}

void import_course(const fs::path& file, const fs::path& from, const fs::path& folder) {
    CourseExport all;
    std::map<std::string, std::string> settings;
    std::vector<fs::path> submitted_files;
    try {
        all = read_export(file);
        for (const StoredRow& row : all.tables["course"]) settings[text_in(row, "key")] = text_in(row, "value");
        for (const StoredRow& row : all.tables["files"]) {
            const std::string& hash = text_in(row, "hash");
            submitted_files.push_back(from / "files" / hash.substr(0, 2) / hash);
        }
    } catch (const ValueError& error) {
        throw EnvironmentError("{}: the file is not an export of dynlab course ({})", file.string(), message_of(error));
    }
    for (const char* needed : {"name", "zone"})
        if (!settings.contains(needed)) throw EnvironmentError("{}: the course's {} is missing", file.string(), needed);
    for (const fs::path& kept : submitted_files)
        if (!fs::exists(kept))
            throw EnvironmentError(
                "{} is not the folder of the exported course, because the submitted file {} is missing. Give the "
                "folder of the course with --from. Nothing was created",
                from.string(), kept.filename().string());
    make_complete_folder(folder, [&](const fs::path& growing) {
        fs::permissions(growing, fs::perms::owner_all);
        try {
            fill_imported(growing, from, settings, submitted_files, all);
        } catch (const EnvironmentError& error) {
            throw EnvironmentError("{}: {}; nothing was created", file.string(), message_of(error));
        }
    });
}

}  // namespace dynlab::inline course
