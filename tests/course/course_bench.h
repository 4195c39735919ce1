#pragma once
#include <gmock/gmock.h>

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "course/store/assignments.h"
#include "course/store/groups.h"
#include "platform/atomic_file.h"
#include "platform/sandbox.h"
#include "platform/temporary_folder.h"
#include "support/program.h"

namespace dynlab::test {

/// A PDF of one page with this text, small but sound: offsets and lengths are right.
inline std::string small_pdf(const std::string& text) {
    const std::string content = "BT /F1 11 Tf 72 700 Td (" + text + ") Tj ET\n";
    const std::vector<std::string> objects = {
        "<< /Type /Catalog /Pages 2 0 R >>", "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
        "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 595 842] /Contents 4 0 R /Resources << /Font << /F1 5 0 R >> >> "
        ">>",
        "<< /Length " + std::to_string(content.size()) + " >>\nstream\n" + content + "endstream",
        "<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica >>"};
    std::string pdf = "%PDF-1.4\n", table = "xref\n0 6\n0000000000 65535 f \n";
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const std::string offset = std::to_string(pdf.size());
        table += std::string(10 - offset.size(), '0') + offset + " 00000 n \n";
        pdf += std::to_string(i + 1) + " 0 obj\n" + objects[i] + "\nendobj\n";
    }
    return pdf + table + "trailer << /Size 6 /Root 1 0 R >>\nstartxref\n" + std::to_string(pdf.size()) + "\n%%EOF\n";
}

/// A course of groups group-01, group-02, ... with a student each, and a report "crane" with deadlines at noon on
/// 1, 8 and 15 March 2026, UTC, with ten minutes of grace. The course is made once in this process and copied: courses
/// of equal size have the same key.
class CourseBench {
  public:
    explicit CourseBench(int groups, int reviews = 2) { copy_from(new_course(groups, reviews)); }
    /// A copy of another bench's folder: the work that several tests start from is done once.
    CourseBench(const CourseBench& other) { copy_from(other.bench_.path()); }
    static std::string group(int i) { return (i < 10 ? "group-0" : "group-") + std::to_string(i); }
    /// Tables of earlier versions of the store, which `marks` replaced.
    static constexpr char kTablesOfScores[] =
        "CREATE TABLE scores (pair, criterion, given_at, points); CREATE TABLE oral_scores (assignment, group_id, "
        "criterion, given_at, points); CREATE TABLE overrides (id INTEGER PRIMARY KEY, assignment, group_id, what, "
        "percent, reason, made_at); ";
    static constexpr char kTablesOfOralMarks[] =
        "CREATE TABLE instructor_scores (assignment, group_id, stage, criterion, given_at, points); CREATE TABLE "
        "student_scores (assignment, student, criterion, given_at, points); CREATE TABLE oral_comments (id INTEGER "
        "PRIMARY KEY, assignment, group_id, student, comment, made_at); ";
    static void expect_done(const ChildResult& result) { EXPECT_EQ(result.exit_code, 0) << result.error_output; }

    Workbench& bench() { return bench_; }
    ChildResult course(std::vector<std::string> words) const {
        words.insert(words.begin(), {"course", "--course", "k"});
        return bench_.dynlab(words);
    }
    ChildResult submit_file(const std::string& file, const std::string& content, const std::string& at,
                            std::vector<std::string> more = {}) const {
        bench_.write(file, content);
        std::vector<std::string> words = {"submit", file, "--at", at, "--isolation", level()};
        words.insert(words.end(), more.begin(), more.end());
        return course(words);
    }
    /// All of the store, for comparison before and after.
    std::string dump() const { return bench_.shell("sqlite3 k/course.db .dump").output; }
    /// Full where this machine can have it.
    static std::string level() { return obstacle_to(Isolation::kFull) ? "process" : "full"; }

  private:
    static std::filesystem::path new_course(int groups, int reviews) {
        static std::map<std::pair<int, int>, TemporaryFolder> folders;
        const auto [place, is_new] = folders.try_emplace({groups, reviews});
        const std::filesystem::path folder = place->second.path();
        if (!is_new) return folder;
        std::string roster = "id,name,group\n";
        for (int i = 1; i <= groups; ++i)
            roster += "s" + std::to_string(i) + ",Student " + std::to_string(i) + "," + group(i) + "\n";
        write_file_atomically(folder / "roster.csv", roster);
        Course::create(folder / "k", "k", "UTC");
        Course course(folder / "k");
        import_roster(course, folder / "roster.csv");
        const auto noon = [&course](const std::string& day) { return course.clock().parse(day + " 12:00", "day"); };
        Assignment crane;
        crane.name = "crane";
        crane.first_due = noon("2026-03-01"), crane.review_due = noon("2026-03-08"),
        crane.final_due = noon("2026-03-15");
        crane.grace = 600, crane.reviews = reviews;
        crane.criteria = usual_criteria(crane.kind);
        set_assignment(course, crane);
        return folder;
    }
    void copy_from(const std::filesystem::path& folder) const {
        std::filesystem::copy(folder, bench_.path(), std::filesystem::copy_options::recursive);
    }

    Workbench bench_;
};

}  // namespace dynlab::test
