// What files are, whatever their names say. Oracles: the magic numbers of the formats.
#include "course/office/recognized_file.h"

#include <gmock/gmock.h>

#include "course/course_bench.h"
#include "course/office/receive.h"
#include "course/store/newest_versions.h"

namespace dynlab::test {
namespace test_recognized_file {
using ::testing::HasSubstr;

class recognized_file : public testing::Test {
  protected:
    RecognizedFile seen(const std::string& name, const std::string& content, const std::string& stage = "first") const {
        write_file_atomically(folder_.path() / name, content);
        IncomingFile file;
        file.file = folder_.path() / name, file.name = name;
        return recognize(file, Assignment{}, stage);
    }
    TemporaryFolder folder_;
};

TEST_F(recognized_file, content_says_what_it_is) {
    EXPECT_EQ(seen("a.pdf", small_pdf("a")).part, "report");
    const RecognizedFile named = seen("review-report-78.docx", small_pdf("a"), "review");
    EXPECT_EQ(named.part, "review");
    EXPECT_EQ(named.name, "review-report-78.docx.pdf");
    EXPECT_EQ(message_text(named.remark), "a PDF, although its name ends in \".docx\"");
    EXPECT_TRUE(seen("b.docx", "PK\x03\x04 words").text);
    EXPECT_EQ(seen("c.zip", "PK\x03\x04 files").part, "pack");
}

TEST_F(recognized_file, what_no_one_can_read_has_its_reason) {
    const std::string empty_zip("PK\x05\x06\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 22);
    for (const auto& [name, content, error_reason, reason] :
         {std::tuple("a.zip", empty_zip, "empty", "The zip file is empty"),
          std::tuple("b.pdf", std::string(), "empty", "The file is empty"),
          std::tuple("c.zip", std::string("Rar!\x1A\x07"), "closed-archive", "a RAR archive"),
          std::tuple("d.7z", std::string("7z\xBC\xAF\x27\x1C"), "closed-archive", "a 7z archive"),
          std::tuple("e.xlsx", std::string("PK\x03\x04 table"), "other-kind", "neither a PDF nor a pack"),
          std::tuple("f.lua", std::string("print(1)"), "other-kind", "neither a PDF nor a pack")}) {
        const RecognizedFile found = seen(name, content);
        EXPECT_EQ(found.part, kUnreadable) << name;
        EXPECT_EQ(found.error_reason, error_reason) << name;
        EXPECT_THAT(message_text(found.reason), HasSubstr(reason)) << name;
        EXPECT_EQ(inspection_from(unreadable_inspection(found.error_reason, found.reason).json).error_reason,
                  error_reason)
            << name;
    }
}

/// Files that come in, in this process.
class every_incoming_file : public testing::Test {
  protected:
    ReceiveOutcome take(const std::vector<std::string>& files, Instant at) {
        ReceiveRequest request;
        for (const std::string& file : files) request.files.push_back(bench_.bench().path(file));
        request.assignment = "crane", request.at = at, request.checks = false;
        request.level = obstacle_to(Isolation::kFull) ? Isolation::kProcess : Isolation::kFull;
        request.program = DYNLAB_PROGRAM;
        return receive(course_, request);
    }
    std::map<std::string, SubmittedParts> parts_of_first_group() {
        std::map<std::string, SubmittedParts> found;
        for (const auto& [group, stages] : newest_versions(course_, assignment_named(course_, "crane")))
            for (const Group& one : groups_of(course_))
                if (one.id == group && stages.contains("first")) found[one.name] = stages.at("first");
        return found;
    }
    CourseBench bench_{3, 1};
    Course course_{bench_.bench().path("k")};
    Instant noon_ = course_.clock().parse("2026-03-01 10:00", "time");
};

TEST_F(every_incoming_file, leaves_a_trace_with_a_receipt_and_replaces_nothing) {
    bench_.bench().write("group-01.pdf", small_pdf("one"));
    take({"group-01.pdf"}, noon_);
    bench_.bench().write("group-01.zip", "Rar!\x1A\x07 by mistake");
    const ReceiveOutcome taken = take({"group-01.zip"}, noon_ + 60);
    ASSERT_EQ(taken.received.size(), 1u);
    EXPECT_EQ(taken.received[0].part, kUnreadable);
    EXPECT_EQ(taken.received[0].error_reason, "closed-archive");
    EXPECT_TRUE(taken.refused.empty());
    const SubmittedParts parts = parts_of_first_group()["group-01"];
    EXPECT_EQ(parts.at("report").version, 1);
    EXPECT_EQ(parts.at("report").error_reason, "");
    EXPECT_EQ(parts.at(kUnreadable).error_reason, "closed-archive");
    EXPECT_THAT(bench_.bench().shell("ls k/receipts/crane").output, HasSubstr("group-01-first-unreadable"));
    EXPECT_TRUE(take({"group-01.zip"}, noon_ + 120).received[0].known);
}

// oracle: either of the two could be meant; the one that is received alone later is the first version
TEST_F(every_incoming_file, several_pdfs_are_kept_until_one_of_them_comes_alone) {
    bench_.bench().write("in/group-02/a.pdf", small_pdf("a"));
    bench_.bench().write("in/group-02/b.pdf", small_pdf("b"));
    for (int i = 0; i < 2; ++i) {
        const ReceiveOutcome taken = take({"in"}, noon_ + 60 * i);
        ASSERT_EQ(taken.received.size(), 2u);
        EXPECT_EQ(taken.refused.size(), 2u);
        for (const Received& one : taken.received) {
            EXPECT_EQ(one.error_reason, "several");
            EXPECT_EQ(one.known, i == 1);
        }
        EXPECT_FALSE(parts_of_first_group()["group-02"].contains("report"));
    }
    bench_.bench().write("group-02.pdf", small_pdf("b"));
    const ReceiveOutcome alone = take({"group-02.pdf"}, noon_ + 300);
    EXPECT_EQ(alone.received.at(0).part, "report");
    EXPECT_FALSE(alone.received.at(0).known);
}

}  // namespace test_recognized_file
}  // namespace dynlab::test
