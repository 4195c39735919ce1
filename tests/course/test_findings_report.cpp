// Oracle: the definition in findings_report.h.
#include "course/issues/issues_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace dynlab {
namespace test_findings_report {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

CheckResult some_result() {
    CheckResult result{"report.pdf",
                       "lab_report",
                       "en",
                       "",
                       7,
                       {Message("{} pages (limit: {})", 7, 6), Message("placeholder text")},
                       {}};
    result.findings = {{"language-mixed", Severity::kHint, 2, "", Message("A hint."), Message("Look at it.")},
                       {"pages", Severity::kRule, 7, "", Message("It is long."), Message("Shorten it.")},
                       {"answer-open", Severity::kRule, 9, "", Message("Another."), Message("Write.")},
                       {"answer-open", Severity::kRule, 0, "analysis.lua:12",
                        Message("{} {}.", std::string(30, 'x'), std::string(80, 'y')), Message("Write.")}};
    sort_issues(result.findings);
    return result;
}

TEST(findings_report, rules_come_before_hints_with_place_and_remedy) {
    EXPECT_EQ(issues_as_text(some_result(), false),
              "report.pdf: still to do: 2 texts to complete and 1 problem to fix\n"
              "Checked as lab_report: 7 pages (limit: 6), placeholder text\n"
              "\nRules violated (3)\n"
              "\n  answer-open\n    analysis.lua:12: " +
                  std::string(30, 'x') + "\n    " + std::string(80, 'y') +
                  ".\n    page 9: Another.\n    -> Write.\n"
                  "\n  pages\n    page 7: It is long.\n    -> Shorten it.\n"
                  "\nHints (1)\n"
                  "\n  language-mixed\n    page 2: A hint.\n    -> Look at it.\n");
}

/// The page of a document uses the same counts (app/page/findings.js).
TEST(findings_report, answers_and_checks_of_the_lesson_are_counted_by_themselves) {
    CheckResult result = some_result();
    result.findings.push_back({"answer-missing", Severity::kRule, 0, "", Message("Missing."), Message("Give it.")});
    result.findings.push_back({"check-failed", Severity::kHint, 0, "", Message("Lost."), Message("Look.")});
    const std::string words = issues_as_text(result, false);
    EXPECT_THAT(words, StartsWith("report.pdf: still to do: 1 answer to submit, 2 texts to complete and 1 problem to "
                                  "fix\nChecked as lab_report: "));
    for (const char* const title :
         {"Missing answers (1)", "Rules violated (3)", "Hints (1)", "Checks of the lesson (1)"})
        EXPECT_THAT(words, HasSubstr(std::string("\n") + title + "\n"));
}

TEST(findings_report, hints_alone_say_that_no_rule_is_broken) {
    CheckResult result = some_result();
    result.findings.erase(result.findings.begin(), result.findings.begin() + 3);
    EXPECT_THAT(issues_as_text(result, false), StartsWith("report.pdf: checked as lab_report: "));
    EXPECT_THAT(issues_as_text(result, false), HasSubstr("\nNo rules are violated.\n"));
    EXPECT_THAT(issues_as_text(result, false), Not(HasSubstr("Rules violated")));
}

TEST(findings_report, a_pass_is_one_line_that_says_what_was_checked) {
    CheckResult result = some_result();
    result.findings.clear();
    EXPECT_EQ(issues_as_text(result, false),
              "report.pdf: nothing to fix; checked as lab_report: 7 pages (limit: 6), placeholder text.\n");
}

TEST(findings_report, color_only_when_asked_for) {
    EXPECT_THAT(issues_as_text(some_result(), false), Not(HasSubstr("\033")));
    EXPECT_THAT(issues_as_text(some_result(), true), HasSubstr("\033[31mRules violated (3)\033[0m"));
}

TEST(findings_report, json_holds_everything_and_null_where_nothing_is_known) {
    const auto json = nlohmann::json::parse(issues_as_json(some_result()));
    EXPECT_EQ(json.at("subject"), "report.pdf");
    EXPECT_EQ(json.at("template"), "lab_report");
    EXPECT_EQ(json.at("language"), "en");
    EXPECT_EQ(json.at("pages"), 7);
    EXPECT_EQ(json.at("passed"), false);
    EXPECT_EQ(json.at("checked").size(), 2u);
    ASSERT_EQ(json.at("findings").size(), 4u);
    EXPECT_EQ(json.at("findings").at(0).at("place"), "analysis.lua:12");
    EXPECT_TRUE(json.at("findings").at(0).at("page").is_null());
    EXPECT_EQ(json.at("findings").at(1).at("page"), 7);
    EXPECT_EQ(json.at("findings").at(1).at("what"), "It is long.");
    EXPECT_EQ(json.at("findings").at(1).at("severity"), "rule");
    EXPECT_EQ(json.at("findings").at(3).at("severity"), "hint");
    EXPECT_TRUE(nlohmann::json::parse(issues_as_json(CheckResult())).at("pages").is_null());
}

// Oracle: what was written; the form of files that earlier versions stored, with its members in another order.
TEST(findings_report, json_comes_back_and_other_texts_are_refused) {
    const CheckResult back = issues_from_json(issues_as_json(some_result()));
    EXPECT_EQ(issues_as_text(back, false), issues_as_text(some_result(), false));
    EXPECT_EQ(issues_as_json(back), issues_as_json(some_result()));
    EXPECT_EQ(back.checked, some_result().checked);
    EXPECT_EQ(back.findings.at(0).what, some_result().findings.at(0).what) << "the message, not its text alone";
    const CheckResult stored = issues_from_json(
        R"({"subject": "report.pdf", "template": null, "language": "en", "pages": null, "passed": false, "checked": [],
            "findings": [{"id": "damaged", "severity": "rule", "page": null, "place": null, "what": "w",
                          "remedy": "r"}]})");
    EXPECT_EQ(stored.template_name, "");
    EXPECT_EQ(stored.pages, 0);
    EXPECT_EQ(stored.findings.at(0).severity, Severity::kRule);
    EXPECT_EQ(stored.findings.at(0).place, "");
    EXPECT_EQ(stored.findings.at(0).what, Message::verbatim("w"));
    for (const char* text : {"", "[]", R"({"subject": "x"})"})
        EXPECT_THROW(issues_from_json(text), EnvironmentError) << text;
}

}  // namespace test_findings_report
}  // namespace dynlab
