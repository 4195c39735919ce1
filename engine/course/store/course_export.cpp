#include "course/store/course_export.h"

#include <fmt/format.h>

#include <SQLiteCpp/Column.h>

#include <map>
#include <nlohmann/json.hpp>

#include "course/review/review_marks.h"
#include "course/store/course_schema.h"
#include "course/store/groups.h"
#include "course/store/newest_versions.h"
#include "data_io/text_table.h"
#include "platform/atomic_file.h"
#include "platform/error.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string percent_text(const std::optional<double>& value) {
    return value ? fmt::format("{:.4g}", *value) : "";
}

/// When the newest version came, and how late, or which earlier one was in time.
std::pair<std::string, std::string> arrival(Course& course, const HandedInParts& parts, const char* part) {
    const auto found = parts.find(part);
    if (found == parts.end()) return {"missing", ""};
    const HandedIn& h = found->second;
    return {course.clock().show_exactly(h.received_at), h.is_late()  ? duration_text(h.late)
                                                        : h.late > 0 ? fmt::format("v{} in time", h.in_time)
                                                                     : ""};
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

/// A whole number, a number, a text or null.
json cell_value(const SQLite::Column& cell) {
    if (cell.isInteger()) return cell.getInt64();
    if (cell.isFloat()) return cell.getDouble();
    return cell.isNull() ? json() : json(cell.getString());
}

/// Inserts a row of column names and values.
void insert_row(Database& db, const std::string& table, const json& row) {
    std::vector<std::string> names;
    for (const auto& [name, value] : row.items()) names.push_back('"' + name + '"');
    const std::vector<std::string> marks(names.size(), "?");
    Rows statement =
        db.query(fmt::format("INSERT INTO {} ({}) VALUES ({})", table, fmt::join(names, ", "), fmt::join(marks, ", ")));
    int place = 0;
    for (const auto& [name, value] : row.items()) {
        ++place;
        if (value.is_number_integer())
            statement.give(place, value.get<std::int64_t>());
        else if (value.is_number())
            statement.give(place, value.get<double>());
        else if (value.is_string())
            statement.give(place, value.get<std::string>());
    }
    statement.next();
}

}  // namespace

std::string marks_csv(Course& course, const Assignment& a) {
    TextTable table;
    table.names = {"id",
                   "name",
                   "mail",
                   "moodle",
                   "canvas",
                   "group",
                   "first version",
                   "late",
                   "final",
                   "final late",
                   "work percent",
                   "work reason",
                   "reviews written",
                   "reviews_late",
                   "reviews percent",
                   "reviews reason",
                   "remarks"};
    const Marks marks = course_marks(course, a);
    const auto remarks = remarks_by_reviewer(course, a, marks);
    const std::vector<ReviewPair> pairs = review_pairs(course, a);
    auto versions = newest_versions(course, a);
    std::map<std::string, Group> by_name;
    for (const Group& group : groups_of(course)) by_name[group.name] = group;
    for (const Student& s : students_of(course)) {
        std::vector<std::string> row = {s.id, s.name, s.mail, s.moodle, s.canvas, s.group};
        const auto group = by_name.find(s.group);
        if (group != by_name.end()) {
            const std::int64_t id = group->second.id;
            const char* const part = a.is_report() ? "report" : "slides";
            const auto first = arrival(course, versions[id]["first"], part),
                       last = arrival(course, versions[id]["final"], part);
            row.insert(row.end(), {first.first, first.second, a.is_report() ? last.first : "", last.second});
            int written = 0, late = 0, all = 0;
            for (const ReviewPair& pair : pairs)
                if (pair.reviewer == id && !pair.ended) ++all, written += pair.written, late += pair.late;
            for (const GroupMark& mark : marks.groups)
                if (mark.group == id)
                    row.insert(row.end(), {percent_text(mark.work_mark()), mark.work_reason,
                                           all > 0 ? fmt::format("{} of {}", written, all) : "",
                                           all > 0 ? fmt::format("{}", late) : "", percent_text(mark.reviews_mark()),
                                           mark.reviews_reason});
            std::string remark = group->second.dropped_out ? "dropped out" : "";
            if (const auto own = remarks.find(id); own != remarks.end())
                remark += (remark.empty() ? "" : "; ") + own->second;
            row.push_back(remark);
        }
        row.resize(table.names.size());
        table.rows.push_back(std::move(row));
    }
    return csv_text(table);
}

std::string course_json(Course& course) {
    Database& db = course.database();
    json all = {{"dynlab course", 1}};
    Rows version = db.query("PRAGMA user_version");
    version.next();
    all["tables version"] = version.integer(0);
    for (const std::string& table : course_tables()) {
        json& rows = all["tables"][table] = json::array();
        for (Rows row = db.query("SELECT * FROM " + table + " ORDER BY 1, 2"); row.next();) {
            json fields = json::object();
            for (int c = 0; c < row.getColumnCount(); ++c) fields[row.getColumnName(c)] = cell_value(row.getColumn(c));
            rows.push_back(std::move(fields));
        }
    }
    return all.dump(1, ' ', false, json::error_handler_t::replace) + '\n';
}

void import_course(const fs::path& file, const fs::path& from, const fs::path& folder) {
    const json all = json::parse(read_file(file), nullptr, false);
    if (all.is_discarded() || !all.is_object() || !all.contains("dynlab course") || !all.contains("tables"))
        throw EnvironmentError(fmt::format("{}: this is no export of dynlab course", file.string()));
    const auto setting = [&](const std::string& key) {
        for (const json& row : all["tables"].at("course"))
            if (row.at("key") == key) return row.at("value").get<std::string>();
        throw EnvironmentError(fmt::format("{}: the course's {} is missing", file.string(), key));
    };
    for (const json& row : all["tables"].at("files")) {
        const std::string hash = row.at("hash");
        if (!fs::exists(from / "files" / hash.substr(0, 2) / hash))
            throw EnvironmentError(fmt::format("{} has no file {}; nothing was made", from.string(), hash));
    }
    fs::create_directories(folder);
    if (!fs::exists(folder / "course.key") && fs::exists(from / "course.key"))
        fs::copy_file(from / "course.key", folder / "course.key");
    Course::create(folder, setting("name"), setting("zone"));
    Course course(folder);
    std::vector<std::string> hashes;
    for (const json& row : all["tables"].at("files")) {
        const std::string hash = row.at("hash");
        hashes.push_back(course.keep(read_file(from / "files" / hash.substr(0, 2) / hash)));
    }
    course.settle(hashes);
    Database& db = course.database();
    Transaction transaction(db);
    db.execute("DELETE FROM course; DELETE FROM journal");  // what create wrote
    const bool older = all.value("tables version", std::int64_t{0}) < static_cast<std::int64_t>(course_steps().size());
    for (const std::string& table : course_tables()) {
        if (older && !all["tables"].contains(table)) continue;  // one that a later version brought
        for (const json& row : all["tables"].at(table)) insert_row(db, table, row);
    }
    transaction.commit();
}

}  // namespace dynlab::inline course
