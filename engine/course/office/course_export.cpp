#include "course/office/course_export.h"

#include <fmt/format.h>

#include <SQLiteCpp/Column.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.h"
#include "base/reader.h"
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
#include "platform/locks/whole_folder.h"
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

/// When the newest version was received, as spreadsheets read it, and how many hours late it counts.
std::pair<std::string, std::string> arrival(Course& course, const HandedInParts& parts, const char* part) {
    const auto found = parts.find(part);
    if (found == parts.end()) return {"missing", ""};
    const HandedIn& h = found->second;
    return {course.clock().show_exactly(h.received_at).substr(0, std::string_view("2026-03-01 15:00").size()),
            hours_text(h.is_late() ? h.late : 0)};
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
std::string lab_csv(Course& course, const Assignment& a) {
    TextTable table;
    table.names = {"id",   "name",   "mail",     "moodle",  "canvas",  "group", "submission",
                   "late", "points", "possible", "penalty", "percent", "reason"};
    auto versions = newest_versions(course, a);
    const auto authors = author_groups(course, a);
    std::set<std::string> with_own;  // students with marks of their own
    for (const GivenMark& mark : marks_in_force(course, a)) with_own.insert(mark.student);
    const std::vector<LabMark> of_groups = lab_marks(course, a);
    for (const Student& s : students_of(course)) {
        std::vector<std::string> row = {s.id, s.name, s.mail, s.moodle, s.canvas, s.group};
        if (const auto author = authors.find(s.id); author != authors.end()) {
            const auto came = arrival(course, versions[author->second]["first"], a.document());
            row.insert(row.end(), {came.first, came.second});
            const std::vector<LabMark> marks = with_own.contains(s.id) ? lab_marks(course, a, s.id) : of_groups;
            if (const auto mark = std::ranges::find(marks, author->second, &LabMark::group); mark != marks.end())
                row.insert(row.end(),
                           {percent_text(mark->earned), fmt::format("{:.4g}", mark->possible),
                            fmt::format("{:.4g}", mark->penalty), percent_text(mark->percent()), mark->reason});
        }
        row.resize(table.names.size());
        table.rows.push_back(std::move(row));
    }
    return csv_text(table);
}

using nlohmann::json;

json json_of_cell(const SQLite::Column& cell) {
    if (cell.isInteger()) return cell.getInt64();
    if (cell.isFloat()) return cell.getDouble();
    return cell.isNull() ? json() : json(cell.getString());
}

void insert_row(Database& db, const std::string& table, const json& row) {
    std::vector<std::string> columns;
    for (const auto& [name, cell] : row.items()) {
        const bool plain = std::ranges::all_of(name, [](char c) { return c == '_' || (c >= 'a' && c <= 'z'); });
        if (!plain || name.empty()) throw EnvironmentError("there is no column \"{}\"", printable(name));
        columns.push_back(name);
    }
    const std::vector<std::string> marks(columns.size(), "?");
    Rows statement = db.query(
        fmt::format("INSERT INTO {} ({}) VALUES ({})", table, fmt::join(columns, ", "), fmt::join(marks, ", ")));
    int parameter = 0;
    for (const json& cell : row) {
        ++parameter;
        if (cell.is_number_integer())
            statement.give(parameter, cell.get<std::int64_t>());
        else if (cell.is_number())
            statement.give(parameter, cell.get<double>());
        else if (!cell.is_null())
            statement.give(parameter, cell.get<std::string>());
    }
    statement.next();
}

/// Makes the imported course in `folder`, a new one: with the tables that the exported one had, which opening it then
/// brings to today's.
void fill_imported(const fs::path& folder, const fs::path& from, std::map<std::string, std::string>& settings,
                   const std::vector<fs::path>& handed_in, const json& all) {
    fs::permissions(folder, fs::perms::owner_all);
    if (fs::exists(from / "course.key")) fs::copy_file(from / "course.key", folder / "course.key");
    Course::create(folder, settings["name"], settings["zone"]);
    {
        const fs::path file = folder / "course.db";
        fs::remove(file);
        Database db(file, Database::Opening::kNew);
        fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
        const std::vector<const char*>& steps = course_steps();
        const auto count = std::clamp<std::int64_t>(all.at("tables version").get<std::int64_t>() - kFirstTables + 1, 1,
                                                    std::ssize(steps));
        migrate_course(db, Database::Opening::kNew, file.string(), {steps.begin(), steps.begin() + count});
        db.execute("PRAGMA foreign_keys = OFF");  // tables come in any order
        Transaction transaction(db);
        for (const auto& [table, rows] : all.at("tables").items()) {
            if (!db.query("SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = ?", table).next())
                throw EnvironmentError("there is no table \"{}\"", printable(table));
            for (const json& row : rows) insert_row(db, table, row);
        }
        if (db.query("PRAGMA foreign_key_check").next())
            throw EnvironmentError("a row refers to one that is not there");
        transaction.commit();
    }
    Course course(folder);
    std::vector<std::string> hashes;
    for (const fs::path& kept : handed_in) hashes.push_back(course.keep(read_file(kept)));
    course.settle(hashes);
    Transaction(course.database()).commit();  // seals what the exported course had not sealed
}

}  // namespace

std::string marks_csv(Course& course, const Assignment& a, Instant now) {
    if (a.is_lab()) return lab_csv(course, a);
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
            if (a.is_report() && mark->scored == 1 && a.reviews > 1) remarks.emplace_back("rests on one review");
            for (const Message& cost : mark->costs) remarks.push_back(message_text(cost));
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
    Rows version = db.query("PRAGMA user_version");
    version.next();
    json all = {{"dynlab course", 1}, {"tables version", version.integer(0)}, {"tables", json::object()}};
    for (const std::string& table : course_tables()) {
        json& rows = all["tables"][table] = json::array();
        for (Rows row = db.query("SELECT * FROM " + table + " ORDER BY 1, 2"); row.next();) {
            json& stored = rows.emplace_back(json::object());
            for (int c = 0; c < row.getColumnCount(); ++c)
                stored[row.getColumnName(c)] = json_of_cell(row.getColumn(c));
        }
    }
    return all.dump(1, ' ', false, json::error_handler_t::replace) + '\n';
}

void import_course(const fs::path& file, const fs::path& from, const fs::path& folder) {
    try {
        const json all = parsed_json(read_file(file));
        std::map<std::string, std::string> settings;
        for (const json& row : all.at("tables").at("course"))
            settings[row.at("key").get<std::string>()] = row.at("value").get<std::string>();
        for (const char* needed : {"name", "zone"})
            if (!settings.contains(needed)) throw EnvironmentError("the course's {} is missing", needed);
        std::vector<fs::path> handed_in;
        for (const json& row : all.at("tables").at("files")) {
            const auto hash = row.at("hash").get<std::string>();
            handed_in.push_back(from / "files" / hash.substr(0, 2) / hash);
            if (!fs::exists(handed_in.back()))
                throw EnvironmentError(
                    "{} is not the folder of the exported course: the submitted file {} is not in it. Name that folder "
                    "with --from",
                    from.string(), hash);
        }
        make_whole_folder(folder,
                          [&](const fs::path& growing) { fill_imported(growing, from, settings, handed_in, all); });
    } catch (const ValueError& error) {
        throw EnvironmentError("{}: this is not an export of dynlab course ({})", file.string(), message_of(error));
    } catch (const EnvironmentError& error) {
        throw EnvironmentError("{}: {}; nothing was made", file.string(), message_of(error));
    } catch (const json::exception& error) {
        throw EnvironmentError("{}: this is not an export of dynlab course ({})", file.string(), error.what());
    }
}

}  // namespace dynlab::inline course
