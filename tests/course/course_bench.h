#pragma once
#include <gmock/gmock.h>

#include <fstream>
#include <string>
#include <vector>

#include "platform/atomic_file.h"
#include "platform/box.h"
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
/// 1, 8 and 15 March 2026, UTC, with ten minutes of grace.
class CourseBench {
  public:
    explicit CourseBench(int groups, int reviews = 2) {
        std::string roster = "id,name,group\n";
        for (int i = 1; i <= groups; ++i)
            roster += "s" + std::to_string(i) + ",Student " + std::to_string(i) + "," + group(i) + "\n";
        bench_.write("roster.csv", roster);
        expect_done(bench_.dynlab({"course", "init", "k", "--timezone", "UTC"}));
        expect_done(course({"roster", "import", "roster.csv"}));
        expect_done(course({"assignment", "add", "crane", "--first", "2026-03-01 12:00", "--review", "2026-03-08 12:00",
                            "--final", "2026-03-15 12:00", "--grace", "10min", "--seed", "7", "--reviews",
                            std::to_string(reviews)}));
    }
    static std::string group(int i) { return (i < 10 ? "group-0" : "group-") + std::to_string(i); }
    static void expect_done(const ChildResult& result) { EXPECT_EQ(result.exit_code, 0) << result.error_output; }

    Workbench& bench() { return bench_; }
    ChildResult course(std::vector<std::string> words) const {
        words.insert(words.begin(), {"course", "--course", "k"});
        return bench_.dynlab(words);
    }
    ChildResult hand_in(const std::string& file, const std::string& content, const std::string& at,
                        std::vector<std::string> more = {}) const {
        bench_.write(file, content);
        std::vector<std::string> words = {"receive", file, "--at", at, "--isolation", level()};
        words.insert(words.end(), more.begin(), more.end());
        return course(words);
    }
    /// All of the store, for comparison before and after.
    std::string dump() const { return bench_.shell("sqlite3 k/course.db .dump").output; }
    /// Full where this machine can have it.
    static std::string level() { return obstacle_to(Isolation::kFull) ? "process" : "full"; }

  private:
    Workbench bench_;
};

}  // namespace dynlab::test
