#include "course/store/refusals.h"

#include <fmt/format.h>

#include "platform/atomic_file.h"

namespace dynlab::inline course {

std::string kept_content(const Course& course, const std::filesystem::path& file, std::uintmax_t most_bytes) {
    const std::uintmax_t bytes = std::filesystem::file_size(file);
    if (bytes == 0 || bytes > most_bytes) return "";
    const std::string hash = course.keep(read_file(file));
    course.settle({hash});
    return hash;
}

void record_refused(Course& course, const Assignment& assignment, const RefusedFile& file) {
    const std::optional<std::string> hash = file.hash.empty() ? std::nullopt : std::optional(file.hash);
    const bool known = course.database()
                           .query(
                               "SELECT 1 FROM refusals WHERE assignment = ? AND ifnull(group_id, 0) = ? AND stage = "
                               "? AND name = ? AND ifnull(hash, '') = ? AND reason = ?",
                               assignment.id, file.group.value_or(0), file.stage, file.name, file.hash, file.reason)
                           .next();
    if (known) return;
    if (hash)
        course.record_file(*hash, static_cast<std::int64_t>(std::filesystem::file_size(course.file(*hash))), file.at);
    course.database().run(
        "INSERT INTO refusals (assignment, group_id, stage, name, hash, reason, received_at) VALUES (?, ?, ?, ?, ?, ?, "
        "?)",
        assignment.id, file.group, file.stage, file.name, hash, file.reason, file.at);
    course.note(fmt::format("{}: {} was not taken: {}", assignment.name, file.name, file.reason), file.at);
}

std::vector<RefusedFile> refused_files(Course& course, const Assignment& assignment, bool open_only) {
    std::vector<RefusedFile> files;
    for (Rows rows = course.database().query(
             "SELECT group_id, stage, name, ifnull(hash, ''), reason, received_at, EXISTS (SELECT 1 FROM standing s "
             "WHERE s.assignment = r.assignment AND (s.hash = r.hash OR s.group_id = r.group_id AND s.stage = r.stage "
             "AND s.received_at >= r.received_at)) FROM refusals r WHERE assignment = ? ORDER BY id",
             assignment.id);
         rows.next();)
        if (!open_only || rows.integer(6) == 0)
            files.push_back(
                {rows.optional_integer(0), rows.text(1), rows.text(2), rows.text(3), rows.text(4), rows.integer(5)});
    return files;
}

}  // namespace dynlab::inline course
