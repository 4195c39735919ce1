#include "course/office/deadline_import.h"

#include <fmt/format.h>

#include "course/corrections/corrections.h"
#include "data_io/text_table.h"
#include "numerics/error.h"
#include "platform/error.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr char kForAll[] = "*";

/// Reads the cells of the table.
class DeadlineTable {
  public:
    explicit DeadlineTable(const fs::path& file) : file_(file), table_(read_text_table(file)) {
        for (const char* name : {"submission", "who", "group", "id", "student", "name"})
            if (!who_) who_ = table_.column(name);
        if (!who_ || !table_.column("deadline"))
            throw EnvironmentError(
                "{}: the columns \"who\" (or \"group\", \"id\" or \"submission\") and \"deadline\" are required; the "
                "columns are {}",
                file.string(), listed(table_.names));
    }
    const std::string& who(std::size_t row) const { return table_.rows[row][*who_]; }

    std::size_t rows() const { return table_.rows.size(); }
    std::string cell(std::size_t row, const char* column) const {
        const auto index = table_.column(column);
        return index ? table_.rows[row][*index] : "";
    }
    double number(std::size_t row, const char* column, double fallback) const {
        const std::string text = cell(row, column);
        if (text.empty()) return fallback;
        const std::optional<double> value = number_in_cell(text);
        if (!value || !(*value >= 0 && *value <= 100)) fail(row, column, Message("a number from 0 to 100"));
        return *value;
    }
    std::optional<Instant> time(std::size_t row, const char* column) const {
        const std::string text = cell(row, column);
        if (text.empty()) return {};
        const std::optional<ClockReading> value = plain_clock_reading(text);
        if (!value) fail(row, column, Message("a time such as 2026-03-01 18:00"));
        if (!value->exists) fail(row, column, Message("a time that exists in the time zone"));
        return value->instant;
    }
    std::optional<std::int64_t> duration(std::size_t row, const char* column) const {
        const std::string text = cell(row, column);
        if (text.empty()) return {};
        const std::optional<std::int64_t> value = duration_of(text);
        if (!value) fail(row, column, Message("a duration such as 15 min, 3 h or 2 d"));
        return value;
    }
    [[noreturn]] void fail(std::size_t row, const char* column, const Message& requested) const {
        throw EnvironmentError("{}, line {}: {} must be {}, but \"{}\" was given", file_.string(), table_.lines[row],
                               column, requested, cell(row, column));
    }
    [[noreturn]] void fail(std::size_t row, const Message& what) const {
        throw EnvironmentError("{}, line {}: {}", file_.string(), table_.lines[row], what);
    }

  private:
    fs::path file_;
    TextTable table_;
    std::optional<std::size_t> who_;
};

/// Brings what the table says of groups into the course.
class RowsOfGroups {
  public:
    RowsOfGroups(Course& course, const Assignment& a, const std::string& reason, Instant now)
        : course_(course), assignment_(a), reason_(reason), now_(now) {}

    void add(std::int64_t group, const DeadlineRow& row) {
        if (row.grace != assignment_.grace || row.percent_per_day != assignment_.costs.late_day ||
            row.max_percent != assignment_.costs.late_max)
            throw InvalidArgument(
                "in a course, the grace period and the penalty are the same for all students. To give a student more "
                "time, use the column \"extra\" or another deadline");
        const auto [known, fresh] = rows_.try_emplace(group, row);
        if (!fresh && known->second.deadline < row.deadline) known->second = row;
    }
    int extend_all() {
        int extended = 0;
        for (const Group& group : groups_of(course_)) {
            const auto row = rows_.find(group.id);
            if (row == rows_.end() || due_for(course_, assignment_, group.id, "first") == row->second.deadline)
                continue;
            extend(course_, assignment_, group.name, "first", row->second.deadline, reason_, now_);
            ++extended;
        }
        return extended;
    }
    /// `others`: when the work of all others was received.
    int correct_times(std::optional<Instant> others) {
        std::map<std::int64_t, Instant> requested;  // by version
        for (Rows rows = course_.database().query(
                 "SELECT id, group_id, received_at FROM standing WHERE assignment = ? AND stage = 'first'",
                 assignment_.id);
             rows.next();) {
            const auto row = rows_.find(rows.integer(1));
            const std::optional<Instant> received = row == rows_.end() ? others : row->second.received;
            if (received && *received != rows.integer(2)) requested[rows.integer(0)] = *received;
        }
        if (requested.empty()) return 0;
        Transaction transaction(course_.database());
        for (const auto& [version, received] : requested)
            log_arrival(course_, assignment_, version, received, reason_, now_);
        course_.note(fmt::format("{}: {} times of receipt {}", assignment_.name, requested.size(), reason_), now_);
        transaction.commit();
        return static_cast<int>(requested.size());
    }

  private:
    Course& course_;
    const Assignment& assignment_;
    const std::string& reason_;
    Instant now_;
    std::map<std::int64_t, DeadlineRow> rows_;  ///< by group
};

}  // namespace

std::map<std::string, DeadlineRow> read_deadlines(const fs::path& file, const DeadlineRow& defaults) {
    const DeadlineTable table(file);
    std::vector<std::size_t> order;  // the row for all first: others go by it
    for (const bool for_all : {true, false})
        for (std::size_t row = 0; row < table.rows(); ++row)
            if ((table.who(row) == kForAll) == for_all) order.push_back(row);
    std::map<std::string, DeadlineRow> rows;
    for (const std::size_t row : order) {
        const std::string who = table.who(row);
        const auto all = rows.find(kForAll);
        DeadlineRow read = all != rows.end() ? all->second : who == kForAll ? DeadlineRow{} : defaults;
        const std::optional<Instant> deadline = table.time(row, "deadline");
        if (!deadline && all == rows.end()) table.fail(row, "deadline", Message("a time such as 2026-03-01 18:00"));
        read.deadline = deadline.value_or(read.deadline) + table.duration(row, "extra").value_or(0);
        read.received = table.time(row, "received");
        read.grace = table.duration(row, "grace").value_or(read.grace);
        read.percent_per_day = table.number(row, "percent_per_day", read.percent_per_day);
        read.max_percent = table.number(row, "most_percent", read.max_percent);
        if (!rows.emplace(who, read).second)
            table.fail(row,
                       Message("\"{}\" already has a deadline in an earlier row; delete one of the two rows", who));
    }
    return rows;
}

DeadlineImport import_deadlines(Course& course, const Assignment& assignment, const fs::path& file, Instant now,
                                const std::map<std::string, std::int64_t>& submissions) {
    DeadlineRow defaults;
    defaults.grace = assignment.grace;
    defaults.percent_per_day = assignment.costs.late_day, defaults.max_percent = assignment.costs.late_max;
    const std::map<std::string, DeadlineRow> table = read_deadlines(file, defaults);
    const std::string reason = "imported from " + file.filename().string();
    const auto all = table.find(kForAll);
    Assignment a = assignment;
    if (all != table.end()) {
        a.first_due = all->second.deadline, a.grace = all->second.grace;
        a.costs.late_day = all->second.percent_per_day, a.costs.late_max = all->second.max_percent;
        set_assignment(course, a, reason);
    }
    DeadlineImport done;
    RowsOfGroups rows(course, a, reason, now);
    for (const auto& [who, row] : table) {
        if (who == kForAll) continue;
        try {
            const auto submission = submissions.find(who);
            rows.add(submission == submissions.end() ? group_named(course, who).id : submission->second, row);
        } catch (const InvalidArgument& error) {
            done.complaints.push_back(Message("the row of \"{}\": {}", who, message_of(error)));
        }
    }
    done.extended = rows.extend_all();
    done.corrected = rows.correct_times(all == table.end() ? std::nullopt : all->second.received);
    return done;
}

}  // namespace dynlab::inline course
