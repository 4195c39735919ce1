#include "course/grading/deadlines.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <ctime>

#include "data_io/text_table.h"
#include "platform/error.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

/// Seconds since 1970 of "2026-03-01 18:00[:00]" in local time.
std::optional<long> instant(const std::string& text) {
    for (const char* format : {"%Y-%m-%d %H:%M:%S", "%Y-%m-%d %H:%M", "%Y-%m-%dT%H:%M:%S", "%Y-%m-%dT%H:%M"}) {
        std::tm time{};
        const char* const end = ::strptime(text.c_str(), format, &time);
        if (end == nullptr || *end != '\0') continue;
        time.tm_isdst = -1;
        return static_cast<long>(std::mktime(&time));
    }
    return {};
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

}  // namespace

Deadlines::Deadlines(const fs::path& file) {
    const TextTable table = read_text_table(file);
    const auto who = table.column("submission"), deadline = table.column("deadline");
    if (!who || !deadline)
        throw EnvironmentError(fmt::format("{}: the columns submission and deadline are needed; there are {}",
                                           file.string(), fmt::join(table.names, ", ")));
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const auto& row = table.rows[i];
        const auto fail = [&](const char* column, const char* wanted) {
            throw EnvironmentError(fmt::format("{}, line {}: {} must be {}, but \"{}\" was given", file.string(),
                                               table.lines[i], column, wanted, row[*table.column(column)]));
        };
        const auto number = [&](const char* column, double fallback) {
            const auto index = table.column(column);
            if (!index || row[*index].empty()) return fallback;
            double value = 0;
            const std::string& text = row[*index];
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
            if (error != std::errc() || end != text.data() + text.size() || !(value >= 0 && value <= 100))
                fail(column, "a number from 0 to 100");
            return value;
        };
        Rule rule;
        const auto time = instant(row[*deadline]);
        if (!time) fail("deadline", "a time such as 2026-03-01 18:00");
        rule.deadline = *time;
        if (const auto received = table.column("received"); received && !row[*received].empty()) {
            rule.received = instant(row[*received]);
            if (!rule.received) fail("received", "a time such as 2026-03-01 18:00");
        }
        rule.percent_per_day = number("percent_per_day", 10);
        rule.most_percent = number("most_percent", 100);
        if (!rules_.emplace(row[*who], rule).second)
            throw EnvironmentError(
                fmt::format("{}, line {}: \"{}\" has a deadline already", file.string(), table.lines[i], row[*who]));
    }
}

Deadlines::Lateness Deadlines::of(const Submission& submission) const {
    for (const std::string& key : {submission.name, submission.lms_id, std::string("*")}) {
        const auto found = rules_.find(key);
        if (key.empty() || found == rules_.end()) continue;
        const Rule& rule = found->second;
        const long late = rule.received.value_or(written(submission.path)) - rule.deadline;
        if (late <= 0) return {};
        const double days = std::ceil(static_cast<double>(late) / 86400);
        return {static_cast<double>(late) / 3600, std::min(rule.most_percent, days * rule.percent_per_day)};
    }
    return {};
}

std::vector<std::string> Deadlines::strays(const std::vector<Submission>& submissions) const {
    std::vector<std::string> names;
    for (const auto& [name, rule] : rules_) {
        const bool known = name == "*" || std::any_of(submissions.begin(), submissions.end(), [&](const Submission& s) {
                               return s.name == name || s.lms_id == name;
                           });
        if (!known) names.push_back(name);
    }
    return names;
}

}  // namespace dynlab::inline course
