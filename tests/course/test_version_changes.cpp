#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "course/course_bench.h"

namespace dynlab::test {
namespace test_version_changes {
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr char kAnalysis[] =
    "-- ---\n-- title: Trolley\n-- ---\n\n-- %%\nreport.value(\"fit\", 80, \"%.1f\")\nreport.value(\"kept\", 2, "
    "\"%d\")\n";
constexpr char kReport[] =
    "---\ntitle: Trolley\nlang: en\nnumbersections: true\n---\n\n# Design\n\nThe sampling time is 0.05 s. The record "
    "lasts "
    "one minute.\n\n# Validation\n\nThe fit is `fit`{.value} %. The model is good.\n\n# Old\n\nThis goes away at "
    "last.\n";
constexpr char kFinalReport[] =
    "---\ntitle: Trolley\nlang: en\nnumbersections: true\n---\n\n# Design\n\nThe sampling time is 0.05 s, twenty times "
    "less "
    "than the fastest time constant. The record lasts one minute.\n\n# Validation on a second record\n\nThe fit is "
    "`fit`{.value} %. The model is good.\n\n# Control\n\nA compensator moves it quickly.\n";
constexpr char kReview[] =
    "---\ntitle: Review\nlang: en\n---\n\n# Data and experiments\n\nThe choice of the sampling time is not justified "
    "by the "
    "time constants.\n\nThe friction of the belt was never measured.\n\n# Greatest strength\n\nThe experiments.\n";

/// What LaTeX, Markdown and terminals might take for more than text.
const std::string kHostile =
    "\\\\input{/etc/passwd} \\$x\\_1\\^2\\$ \\*\\*bold\\*\\* \\`code\\` 100% & \\#1 \\~\\~gone\\~\\~ \\<b\\> "
    "\\[a\\](b) "
    "\\| a \\| \u00e9\u00df\u03c9 " +
    std::string(180, 'w') + " ::: done.";

/// A course in which reports are made of Markdown by dynlab itself.
class version_changes : public ::testing::Test {
  protected:
    version_changes() : bench_(5, 1) {}

    /// NAME.pdf and NAME.zip.
    void make(const std::string& name, const std::string& report, const std::string& analysis = kAnalysis) {
        bench_.bench().write(name + "/analysis.lua", analysis);
        bench_.bench().write(name + "/report.md", report);
        CourseBench::expect_done(bench_.bench().dynlab({"report", name, "-o", name + ".pdf"}));
        CourseBench::expect_done(bench_.bench().dynlab({"pack", name, "-o", name + ".zip"}));
    }
    void take(const std::string& file, const std::string& group, bool final = false) {
        std::vector<std::string> words = {"submit",      file,          "--from",
                                          group,         "--at",        final ? "2026-03-14 10:00" : "2026-03-01 10:00",
                                          "--no-checks", "--isolation", CourseBench::level()};
        if (final) words.insert(words.end(), {"--stage", "final"});
        CourseBench::expect_done(bench_.course(words));
    }
    /// Every group that submitted a report gets and writes a review.
    void review(const std::string& text) {
        make("review", text);
        CourseBench::expect_done(bench_.course({"review", "assign", "--at", "2026-03-02 10:00"}));
        const ChildResult sent = bench_.bench().shell(
            "set -e; $DYNLAB course --course k review send --at '2026-03-02 11:00'\n"
            "for g in $($DYNLAB course --course k review pairs | awk '$NF == \"sent\" {print $1}'); do\n"
            "$DYNLAB course --course k review collect review.pdf --from $g --at '2026-03-05 10:00' --no-checks; done\n"
            "$DYNLAB course --course k review release --at '2026-03-09 10:00'");
        CourseBench::expect_done(sent);
    }
    ChildResult changes(std::vector<std::string> more = {}) {
        std::vector<std::string> words = {"changes", "--isolation", CourseBench::level()};
        words.insert(words.end(), more.begin(), more.end());
        return bench_.course(words);
    }
    std::string document(const std::string& group) { return bench_.bench().read("out/" + group + ".md"); }
    std::string printed(const std::string& group) {
        return bench_.bench().shell("pdftotext -layout out/" + group + ".pdf -").output;
    }

    CourseBench bench_;
};

// oracle: the differences of the reports above, by hand
TEST_F(version_changes, documents_show_changed_words_values_and_reviews) {
    make("first", kReport);
    make("last", kFinalReport,
         "-- ---\n-- title: Trolley\n-- ---\n\n-- %%\nreport.value(\"fit\", 90, \"%.1f\")\nreport.value(\"kept\", 2, "
         "\"%d\")\n");
    for (const char* group : {"group-01", "group-02", "group-03", "group-04"}) take("first.pdf", group);
    take("first.zip", "group-01");
    review(kReview);
    take("last.pdf", "group-01", true), take("last.zip", "group-01", true);
    take("last.pdf", "group-02", true);
    take("first.pdf", "group-03", true);
    bench_.bench().shell("head -c 3000 last.pdf >damaged.pdf");
    take("damaged.pdf", "group-04", true);
    take("last.pdf", "group-05", true);
    const std::string before = bench_.dump();
    const ChildResult result = changes({"--out", "out"});
    CourseBench::expect_done(result);
    EXPECT_EQ(bench_.dump(), before);
    EXPECT_THAT(result.output, ContainsRegex("group-01 +1 +[1-9][0-9]* % +[0-9]+ +[0-9]+ +1 of 2 +1"));
    EXPECT_THAT(result.output, ContainsRegex("group-02 +1 +[1-9][0-9]* % +[0-9]+ +[0-9]+ +- +1"));
    EXPECT_THAT(
        result.output,
        ContainsRegex("group-03 +1 +0 % +0 +0 +- +1 +the final version is identical to the first version, byte"));
    EXPECT_THAT(result.output, ContainsRegex("group-04 .*Final version: The PDF cannot be read"));
    EXPECT_THAT(result.output, ContainsRegex("group-05 .*no first version for comparison"));
    for (const std::string group : {"group-01", "group-02"}) {
        const std::string text = document(group);
        EXPECT_THAT(
            text,
            HasSubstr("The sampling time is 0.05 ~~s.~~ **s, twenty times less than the fastest time constant.**"));
        EXPECT_THAT(text, ContainsRegex("# reviewer-[0-9]+, released Mon 2026-03-09 10:00"));
        EXPECT_THAT(text, HasSubstr("The friction of the belt was never measured."));
        EXPECT_THAT(text, Not(ContainsRegex("group-0[345]")));  // the reviewers stay anonymous
        EXPECT_THAT(printed(group), HasSubstr("The friction of the belt was never measured."));
    }
    EXPECT_THAT(document("group-01"), ContainsRegex("fit +\\| +80.0 +\\| +90.0 "));
    EXPECT_THAT(document("group-02"), HasSubstr("Values can be compared if both versions have a pack"));
    EXPECT_THAT(document("group-03"), HasSubstr("The final version is identical to the first version, byte for byte."));
    EXPECT_THAT(document("group-04"), HasSubstr("The texts cannot be compared."));
    EXPECT_THAT(document("group-05"), HasSubstr("No review was released to this group."));
    const std::string pdf = bench_.bench().read("out/group-01.pdf");
    CourseBench::expect_done(changes({"group-01", "--out", "out"}));
    EXPECT_EQ(bench_.bench().read("out/group-01.pdf"), pdf);
    EXPECT_THAT(changes({"group-9"}).error_output, HasSubstr("group-9"));
    const std::string table = bench_.course({"changes", "--isolation", CourseBench::level()}).output;
    EXPECT_EQ(result.output, table + "5 documents as PDF and Markdown in out\n");
}

// oracle: the texts come out as they went in, and nothing is wider than the page
TEST_F(version_changes, bears_hostile_texts) {
    const std::string title = "Design $ # % & _ ~ ^ " + std::string(90, 'Q');
    make("first", "---\ntitle: T\nlang: en\n---\n\n# Design\n\nBefore it all. " + kHostile + "\n");
    make("last",
         "---\ntitle: T\nlang: en\n---\n\n# " + title + "\n\nBefore it all. Everything else is quite another text.\n",
         "-- ---\n-- title: T\n-- ---\n\n-- %%\nreport.value(\"" + std::string(80, 'v') +
             "\", \"\\\\input{x} $ 🙂 ☃ | \")\n");
    for (const char* group : {"group-01", "group-02"}) take("first.pdf", group), take("first.zip", group);
    review("---\ntitle: R\nlang: en\n---\n\n# Suggestions\n\n" + kHostile + "\n");
    take("last.pdf", "group-01", true), take("last.zip", "group-01", true);
    const ChildResult reported = changes({"--out", "out"});
    CourseBench::expect_done(reported);
    const std::string text = printed("group-01");
    EXPECT_THAT(text, HasSubstr("$x_1"));
    EXPECT_THAT(text, HasSubstr("input{/etc/passwd}"));
    EXPECT_THAT(text, Not(HasSubstr("root:")));
    EXPECT_THAT(text, HasSubstr("~~gone~~"));
    const ChildResult outside = bench_.bench().shell(
        "pdftotext -bbox out/group-01.pdf - | awk -F'\"' '/<word/ && ($2 < 60 || $6 > 535) {print}'");
    EXPECT_EQ(outside.output, "");
}

// oracle: the message
TEST_F(version_changes, say_when_nothing_can_be_compared) {
    EXPECT_THAT(changes().output, HasSubstr("0 of 0 groups have a final version"));
    make("first", kReport);
    take("first.zip", "group-01");
    take("first.zip", "group-01", true);
    EXPECT_THAT(changes().output, ContainsRegex("group-01 +1 +0 % +0 +0 +0 of 2"));
    make("bad", kReport);
    bench_.bench().write("bad/analysis.lua", "error('no')");
    CourseBench::expect_done(bench_.bench().dynlab({"pack", "bad", "-o", "bad.zip"}));
    take("bad.zip", "group-01", true);
    CourseBench::expect_done(changes({"--out", "out"}));
    EXPECT_THAT(document("group-01"), HasSubstr("Final version: The pack’s analysis cannot be run"));
    EXPECT_THAT(document("group-01"), HasSubstr("Values can be compared if both versions have a pack"));
    CourseBench::expect_done(bench_.course({"assignment", "talk", "--kind", "talk", "--first", "2026-04-01 12:00"}));
    EXPECT_THAT(changes({"--assignment", "talk"}).error_output, HasSubstr("talk is a talk and has no final version"));
}

}  // namespace test_version_changes
}  // namespace dynlab::test
