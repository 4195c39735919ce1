#include "course/grading/deadlines.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <set>

#include "course/intake/course_clock.h"
#include "course/intake/lateness.h"
#include "course/intake/owners.h"
#include "data_io/text_table.h"
#include "platform/error.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr char kForAll[] = "*";

std::string shown_instant(long instant) {
    const std::time_t seconds = instant;
    std::tm time{};
    ::localtime_r(&seconds, &time);
    char text[64];
    return {text,
            std::strftime(text, sizeof text, time.tm_sec == 0 ? "%Y-%m-%d %H:%M %Z" : "%Y-%m-%d %H:%M:%S %Z", &time)};
}

/// When an archive, or the newest file of a folder, was written.
long written(const fs::path& path) {
    const auto seconds = [](const fs::path& file) {
        const auto time = std::chrono::file_clock::to_sys(fs::last_write_time(file));
        return static_cast<long>(std::chrono::duration_cast<std::chrono::seconds>(time.time_since_epoch()).count());
    };
    if (!fs::is_directory(path)) return seconds(path);
    long newest = 0;
    for (auto entry = fs::recursive_directory_iterator(path); entry != fs::recursive_directory_iterator(); ++entry) {
        const bool hidden = entry->path().filename().string().starts_with('.');  // written by whoever looked at it
        const fs::file_type type = entry->symlink_status().type();
        if (hidden) entry.disable_recursion_pending();
        if (!hidden && type == fs::file_type::regular) newest = std::max(newest, seconds(entry->path()));
    }
    return newest;
}

/// Names in the table are compared as names of owners are.
std::string plain_key(const std::string& name) {
    return fmt::format("{}", fmt::join(words_of_name(name), " "));
}

/// Reads the cells of the table.
class DeadlineTable {
  public:
    explicit DeadlineTable(const fs::path& file) : file_(file), table_(read_text_table(file)) {
        if (!table_.column("submission") || !table_.column("deadline"))
            throw EnvironmentError("{}: the columns submission and deadline are needed; there are {}", file.string(),
                                   listed(table_.names));
    }

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
    std::optional<long> time(std::size_t row, const char* column) const {
        const std::string text = cell(row, column);
        if (text.empty()) return {};
        const std::optional<ClockReading> value = plain_clock_reading(text);
        if (!value) fail(row, column, Message("a time such as 2026-03-01 18:00"));
        if (!value->exists) fail(row, column, Message("a time that there is"));
        return static_cast<long>(value->instant);
    }
    std::optional<long> duration(std::size_t row, const char* column) const {
        const std::string text = cell(row, column);
        if (text.empty()) return {};
        const std::optional<std::int64_t> value = duration_of(text);
        if (!value) fail(row, column, Message("a time such as 15 min, 3 h or 2 d"));
        return static_cast<long>(*value);
    }
    [[noreturn]] void fail(std::size_t row, const char* column, const Message& wanted) const {
        throw EnvironmentError("{}, line {}: {} must be {}, but \"{}\" was given", file_.string(), table_.lines[row],
                               column, wanted, cell(row, column));
    }
    [[noreturn]] void fail(std::size_t row, const Message& what) const {
        throw EnvironmentError("{}, line {}: {}", file_.string(), table_.lines[row], what);
    }

  private:
    fs::path file_;
    TextTable table_;
};

/// "received 2026-03-01 18:20 CET, 20 min after the deadline of 2026-03-01 18:00 CET; each begun day costs 10 % of the
/// points"
Message reason_of(const LatePolicy& policy, std::int64_t received) {
    const std::string came = shown_instant(received), due = shown_instant(policy.deadline);
    const Message duration = duration_message(received - policy.deadline);
    if (policy.most_percent < 100)
        return Message(
            "received {}, {} after the deadline of {}; each begun day costs {} % of the points, at most {} %", came,
            duration, due, significant(policy.percent_per_day, 4), significant(policy.most_percent, 4));
    return Message("received {}, {} after the deadline of {}; each begun day costs {} % of the points", came, duration,
                   due, significant(policy.percent_per_day, 4));
}

}  // namespace

Lateness lateness_of(const LatePolicy& policy, std::int64_t received) {
    const std::int64_t late = received - policy.deadline;
    if (late <= policy.grace) return {};
    return {static_cast<double>(late) / 3600, late_percent(policy.percent_per_day, policy.most_percent, late),
            reason_of(policy, received), late};
}

Deadlines::Deadlines(const fs::path& file) {
    const DeadlineTable table(file);
    std::vector<std::size_t> order;  // the row for all first: others go by it
    for (std::size_t row = 0; row < table.rows(); ++row)
        if (table.cell(row, "submission") == kForAll) order.push_back(row);
    for (std::size_t row = 0; row < table.rows(); ++row)
        if (table.cell(row, "submission") != kForAll) order.push_back(row);
    for (const std::size_t row : order) {
        const std::string who = table.cell(row, "submission");
        const auto all = rules_.find(kForAll);
        Rule rule = all != rules_.end() ? all->second : Rule{};
        if (who != kForAll) rule.received.reset();
        const std::optional<long> deadline = table.time(row, "deadline"), extra = table.duration(row, "extra");
        if (!deadline && all == rules_.end()) table.fail(row, "deadline", Message("a time such as 2026-03-01 18:00"));
        rule.deadline = deadline.value_or(rule.deadline) + extra.value_or(0);
        if (const auto received = table.time(row, "received")) rule.received = received;
        rule.grace = table.duration(row, "grace").value_or(rule.grace);
        rule.percent_per_day = table.number(row, "percent_per_day", rule.percent_per_day);
        rule.most_percent = table.number(row, "most_percent", rule.most_percent);
        if (!rules_.emplace(who, rule).second) table.fail(row, Message("\"{}\" has a deadline already", who));
    }
}

const Deadlines::Rule* Deadlines::rule_for(const Submission& submission, const std::vector<std::string>& also) const {
    for (const std::string& key : {submission.name, submission.lms_id})
        if (const auto found = rules_.find(key); !key.empty() && found != rules_.end()) return &found->second;
    std::set<std::string> names = {plain_key(submission.person)};
    for (const std::string& name : also) names.insert(plain_key(name));
    names.erase("");
    const Rule* latest = nullptr;
    for (const auto& [who, rule] : rules_)
        if (who != kForAll && names.contains(plain_key(who)) && (latest == nullptr || rule.deadline > latest->deadline))
            latest = &rule;
    if (latest != nullptr) return latest;
    const auto all = rules_.find(kForAll);
    return all == rules_.end() ? nullptr : &all->second;
}

long Deadlines::received(const Submission& submission, const std::vector<std::string>& also) const {
    const Rule* const rule = rule_for(submission, also);
    if (rule != nullptr && rule->received) return *rule->received;
    if (const auto time = times_.of(submission, also)) return static_cast<long>(*time);
    if (submission.loose.empty()) return written(submission.path);
    long newest = 0;
    for (const LooseFile& file : submission.loose) newest = std::max(newest, written(file.path));
    return newest;
}

Lateness Deadlines::of(const Submission& submission, const std::vector<std::string>& also) const {
    const Rule* const rule = rule_for(submission, also);
    if (rule == nullptr) return {};
    Lateness lateness = lateness_of(*rule, received(submission, also));
    lateness.typed = rule->received.has_value();
    return lateness;
}

std::vector<std::string> Deadlines::unmatched_names(const std::vector<Submission>& submissions,
                                                    const std::vector<std::string>& known) const {
    std::set<std::string> names;
    for (const std::string& name : known) names.insert(plain_key(name));
    for (const Submission& submission : submissions) names.insert(plain_key(submission.person));
    std::vector<std::string> unmatched_names;
    for (const auto& [who, rule] : rules_) {
        const bool named = std::ranges::any_of(
            submissions, [&, &name = who](const Submission& s) { return s.name == name || s.lms_id == name; });
        if (who != kForAll && !named && !names.contains(plain_key(who))) unmatched_names.push_back(who);
    }
    return unmatched_names;
}

}  // namespace dynlab::inline course
