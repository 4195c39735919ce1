#include "course/store/graded_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <set>

#include "course/intake/submission.h"
#include "course/store/groups.h"
#include "data_io/text_table.h"
#include "numerics/error.h"
#include "platform/error.h"
#include "platform/files/whole_folder.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

/// A version that can be graded.
struct GradableVersion {
    std::string part, hash, name;
    Instant received_at = 0;
};

std::map<std::int64_t, GradableVersion> gradable_versions(Course& course, const Assignment& assignment,
                                                          const std::string& stage) {
    std::map<std::int64_t, GradableVersion> newest;  // by group
    for (Rows rows = course.database().query(
             "SELECT group_id, part, hash, name, received_at FROM standing WHERE assignment = ? AND stage = ? AND part "
             "IN ('script', 'pack') ORDER BY received_at, id",
             assignment.id, stage);
         rows.next();)
        newest[rows.integer(0)] = {rows.text(1), rows.text(2), rows.text(3), rows.integer(4)};
    return newest;
}

void set_time(const fs::path& file, Instant at) {
    const std::chrono::sys_seconds time{std::chrono::seconds(at)};
    fs::last_write_time(file, fs::file_time_type::clock::from_sys(time));
}

/// The ending of an archive's name.
std::string archive_ending(const std::string& name) {
    const std::optional<std::string> stem = archive_stem(name);
    return stem ? name.substr(stem->size()) : ".zip";
}

std::size_t column_of(const TextTable& table, const fs::path& file, const char* name) {
    const std::optional<std::size_t> column = table.column(name);
    if (!column)
        throw EnvironmentError("{}: there is no column \"{}\"; give the gradebook.csv of dynlab grade", file.string(),
                               name);
    return *column;
}

const Criterion& criterion_named(const Assignment& assignment, const std::string& name) {
    std::vector<std::string> names;
    for (const Criterion& criterion : assignment.criteria) {
        if (criterion.name == name) return criterion;
        names.push_back(criterion.name);
    }
    throw InvalidArgument("{} has no criterion \"{}\"; its criteria are {}", assignment.name, name, listed(names));
}

}  // namespace

LaidOutWork lay_out_work(Course& course, const Assignment& assignment, const std::string& stage,
                         const fs::path& folder) {
    if (fs::exists(folder)) throw InvalidArgument("{} exists already; name a new folder", folder.string());
    const std::map<std::int64_t, GradableVersion> newest = gradable_versions(course, assignment, stage);
    LaidOutWork work;
    make_whole_folder(folder, [&](const fs::path& growing) {
        for (const Group& group : groups_of(course)) {
            const auto found = newest.find(group.id);
            if (found == newest.end()) {
                if (!group.dropped_out) work.without.push_back(group.name);
                continue;
            }
            const GradableVersion& version = found->second;
            const fs::path file = version.part == "script" ? growing / group.name / "analysis.lua"
                                                           : growing / (group.name + archive_ending(version.name));
            fs::create_directories(file.parent_path());
            fs::copy_file(course.file(version.hash), file);
            set_time(file, version.received_at);
            work.groups.push_back(group.name);
        }
    });
    return work;
}

GradedScores scores_of_gradebook(const Assignment& assignment, const std::string& stage, const fs::path& gradebook,
                                 const std::string& criterion) {
    const Criterion& wanted = criterion_named(assignment, criterion);
    const TextTable table = read_text_table(gradebook);
    const std::size_t submission = column_of(table, gradebook, "submission"),
                      state = column_of(table, gradebook, "state"), points = column_of(table, gradebook, "points"),
                      possible = column_of(table, gradebook, "possible");
    const bool of_reviews = assignment.is_report() && stage == "first";
    TextTable scores;
    scores.names = {"group", criterion};
    if (of_reviews) scores.names = {"reviewer", "report", criterion};
    GradedScores given;
    std::set<std::string> seen;  // of a group each member has a row
    for (const std::vector<std::string>& row : table.rows) {
        const std::string& name = row[submission];
        if (name.empty() || !seen.insert(name).second) continue;
        const std::optional<double> earned = number_in_cell(row[points]), most = number_in_cell(row[possible]);
        if (row[state] != "graded" || !earned || !most || *most <= 0) {
            given.left_out.push_back(name);
            continue;
        }
        const double score = std::round(100 * wanted.most * *earned / *most) / 100;
        std::vector<std::string> cells = {name, fmt::format("{}", score)};
        if (of_reviews) cells.insert(cells.begin(), "instructor");
        scores.rows.push_back(std::move(cells));
    }
    given.csv = csv_text(scores);
    return given;
}

}  // namespace dynlab::inline course
