#include "course/grading/manual_marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "course/checks/check_run.h"
#include "course/grading/feedback.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr double kMaxPoints = 1000;

/// The first of these columns that the table has.
std::optional<std::size_t> first_column(const TextTable& table, std::initializer_list<const char*> names) {
    for (const char* name : names)
        if (const auto column = table.column(name)) return column;
    return {};
}

/// Under a name that is not taken: nothing that an instructor wrote is lost.
void put_aside(const fs::path& file) {
    fs::path aside = file.string() + ".imported";
    for (int i = 2; fs::exists(aside); ++i) aside = fmt::format("{}.imported-{}", file.string(), i);
    std::error_code ignored;  // another part of the class may have done it
    fs::rename(file, aside, ignored);
}

std::string owner_of(const WorkItem& item) {
    if (!item.addressee.empty() && !item.students.empty()) return item.addressee;
    return item.submission.person.empty() ? item.submission.name
                                          : item.submission.person + " (" + item.submission.lms_id + ")";
}

}  // namespace

/// Whose work it was when it was submitted, not that of the group now.
std::optional<std::size_t> MarkedItems::student_called(const std::string& who) const {
    std::vector<std::size_t> named;
    for (std::size_t place = 0; place < work_.students.size(); ++place) {
        const Student& student = work_.students[place];
        if (student.id == who) return place;
        if (same_person(student.name, who) || (!who.empty() && in_small_letters(student.mail) == in_small_letters(who)))
            named.push_back(place);
    }
    return named.size() == 1 ? std::optional(named.front()) : std::nullopt;
}

MarkedItems::Found MarkedItems::find(const std::string& who) const {
    Found found;
    if (who.empty()) {
        found.error_reason = Message("the row has points but no name; fill in the column \"who\"");
        return found;
    }
    const auto take = [&](const auto& fits) {
        for (const WorkItem& item : work_.items)
            if (fits(item)) found.items.push_back(&item);
    };
    take([&](const WorkItem& item) { return item.submission.name == who; });
    if (found.items.empty()) take([&](const WorkItem& item) { return item.submission.path.filename() == who; });
    if (found.items.size() > 1) found.items.clear();  // files of one name in several folders
    found.by_name = !found.items.empty();
    if (found.by_name) return found;
    const Owners::Found owner = owners_.called(who);
    const std::optional<std::size_t> student = student_called(who);
    take([&](const WorkItem& item) {
        if (item.submission.lms_id == who || item.submission.person == who) return true;
        if (student) return std::ranges::find(item.students, *student) != item.students.end();
        return owner.anybody() &&
               (item.students == owner.students || (!owner.group.empty() && item.group == owner.group));
    });
    std::set<std::string> owners;  // a platform's number may be the id of another student
    for (const WorkItem* item : found.items) owners.insert(owner_of(*item));
    if (owners.size() > 1 || owner.doubtful) {
        const std::vector<std::string> names(owners.begin(), owners.end());
        found.error_reason = owner.doubtful ? Message("\"{}\" is ambiguous: {}", who, owner.error_reason)
                                            : Message("\"{}\" is ambiguous: {}", who, base::listed(names));
        found.items.clear();
    } else if (found.items.empty() && !owner.anybody()) {
        found.error_reason = Message("no submission, group or student is named \"{}\"", who);
    }
    return found;
}

MarksFile::MarksFile(const fs::path& results) : file_(results / kMarksFile) {
    if (!fs::exists(file_)) write_file_atomically(file_, csv_text({{"who", "check", "points", "reason"}, {}, {}}));
    read();
    take_in(results / "manual.csv");
    take_in(results / "by_hand.csv");
    read();  // with the lines that were added
}

void MarksFile::read() {
    table_ = read_text_table(file_);
    const auto who = first_column(table_, {"who", "submission", "group", "id", "student", "name"}),
               check = table_.column("check"), points = table_.column("points");
    if (!who || !check || !points)
        throw EnvironmentError("{}: the columns \"who\", \"check\" and \"points\" are required; the columns are {}",
                               file_.string(), listed(table_.names));
    if (!first_column(table_, {"reason", "comment"})) {
        table_.names.emplace_back("reason");
        for (auto& row : table_.rows) row.emplace_back();
    }
    who_ = *who, check_ = *check, points_ = *points, reason_ = *first_column(table_, {"reason", "comment"});
    rows_.clear();
    for (std::size_t i = 0; i < table_.rows.size(); ++i) {
        const auto& cells = table_.rows[i];
        if (cells[who_].empty() && cells[points_].empty()) continue;
        Row row{table_.lines[i],
                as_written(cells[who_]),
                cells[check_].empty() ? kWholeItem : cells[check_],
                {},
                as_written(cells[reason_])};
        if (!cells[points_].empty()) {
            row.points = number_in_cell(cells[points_]);
            if (!row.points || !(*row.points >= 0 && *row.points <= kMaxPoints))
                throw EnvironmentError("{}, line {}: points must be a number from 0 to {}, but \"{}\" was given",
                                       file_.string(), row.line, kMaxPoints, cells[points_]);
        }
        rows_.push_back(std::move(row));
    }
}

/// Marks of a file that earlier versions read; a mark that is here already stays.
void MarksFile::take_in(const fs::path& former) {
    if (!fs::exists(former)) return;
    const TextTable table = read_text_table(former);
    const auto who = first_column(table, {"submission", "who"}), check = table.column("check"),
               points = table.column("points"), reason = first_column(table, {"reason", "comment"});
    if (!who || !check || !points)
        throw EnvironmentError(
            "{}: the columns \"submission\", \"check\" and \"points\" are required; the columns are {}",
            former.string(), listed(table.names));
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const auto& cells = table.rows[i];
        if (cells[*points].empty()) continue;
        const auto value = number_in_cell(cells[*points]);
        if (!value || !(*value >= 0 && *value <= kMaxPoints))
            throw EnvironmentError("{}, line {}: points must be a number from 0 to {}, but \"{}\" was given",
                                   former.string(), table.lines[i], kMaxPoints, cells[*points]);
        const auto known = std::ranges::find_if(
            rows_, [&](const Row& row) { return row.who == cells[*who] && row.check == cells[*check]; });
        const std::string why = reason ? cells[*reason] : "";
        if (known == rows_.end())
            add({{0, cells[*who], cells[*check], value, why}});
        else if (!known->points)
            fill(cells[*who], cells[*check], value, why);
    }
    put_aside(former);
}

void MarksFile::add(const std::vector<Row>& rows, const std::vector<std::vector<std::string>>& more) {
    bool added = false;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Row& row = rows[i];
        if (std::ranges::any_of(rows_, [&](const Row& r) { return r.who == row.who && r.check == row.check; }))
            continue;
        std::vector<std::string> cells(table_.names.size());
        cells[who_] = row.who, cells[check_] = row.check, cells[reason_] = row.reason;
        if (row.points) cells[points_] = points_text(*row.points);
        for (std::size_t c = 0; i < more.size() && c < more[i].size(); ++c) {
            static constexpr const char* kMore[] = {"of", "about", "rubric"};
            if (c >= std::size(kMore)) break;
            auto column = table_.column(kMore[c]);
            if (!column) {
                table_.names.emplace_back(kMore[c]);
                for (auto& other : table_.rows) other.emplace_back();
                cells.emplace_back();
                column = cells.size() - 1;
            }
            cells[*column] = more[i][c];
        }
        table_.rows.push_back(std::move(cells));
        rows_.push_back(row);
        added = true;
    }
    if (added) write();
}

void MarksFile::fill(const std::string& who, const std::string& check, std::optional<double> points,
                     const std::string& reason) {
    for (auto& cells : table_.rows) {
        if (cells[who_] != who || (cells[check_].empty() ? kWholeItem : cells[check_]) != check) continue;
        cells[points_] = points ? points_text(*points) : "";
        cells[reason_] = reason;
    }
    write();
    read();
}

void MarksFile::write() const {
    write_file_atomically(file_, csv_text(table_));
}

}  // namespace dynlab::inline course
