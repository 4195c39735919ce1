// Reviews from the form to the authors, and the reports about stored versions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "course/course_bench.h"
#include "course/issues/issues_report.h"

namespace dynlab::test {
namespace test_reviews {
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kAnswer =
    "The amplitude of the input is given and so is the sampling time, but figure 2 does not say which record it shows, "
    "so that the experiment could not be repeated with nothing but this report in the hand. A table with the records "
    "and what was done to each of them would mend this, and it would take the place of the second paragraph. "
    "The conclusion holds for small movements, and it ought to say so; for large ones the friction that page 4 speaks "
    "of could be tried with a second model. The fit is given without the record that it was computed on. ";

/// The form of `dynlab new review` with `answer` below each question, as a PDF.
void make_review(const Workbench& bench, const std::string& name, const std::string& answer) {
    CourseBench::expect_done(bench.dynlab({"new", "review", name}));
    std::string form = bench.read(name + "/report.md");
    for (const char* question :
         {"{#sec:data}", "{#sec:steps}", "{#sec:conclusions}", "{#sec:strength}", "{#sec:suggestions}"}) {
        const std::size_t at = form.find(question);
        ASSERT_NE(at, std::string::npos) << question;
        form.insert(at + std::string(question).size(), "\n\n" + answer + "\n");
    }
    bench.write(name + "/report.md", form);
    CourseBench::expect_done(bench.dynlab({"report", name, "-o", name + ".pdf"}));
}

std::vector<std::string> ids(const ChildResult& checked) {
    std::vector<std::string> found;
    const nlohmann::json report = nlohmann::json::parse(checked.output, nullptr, false);
    if (report.is_discarded()) return {checked.output + checked.error_output};
    for (const auto& issue : report.at("findings"))
        if (found.empty() || found.back() != issue.at("id")) found.push_back(issue.at("id"));
    return found;
}

// oracle: the form's own rules: five sections, one to two pages, guidance that is never printed
TEST(reviews, the_form_is_checked_by_its_own_rules) {
    const Workbench bench;
    make_review(bench, "whole", kAnswer);
    bench.write("whole/group.toml", "members = [\"Ada Lovelace\"]\n");
    EXPECT_THAT(bench.files(), ElementsAre("whole", "whole.pdf"));
    EXPECT_THAT(ids(bench.dynlab({"check", "whole", "--json"})), ElementsAre());
    EXPECT_THAT(bench.dynlab({"new", "review", "whole"}).error_output, HasSubstr("whole"));  // and is left alone
    const auto check = [&](const std::string& name) {
        return ids(bench.dynlab({"check", name + ".pdf", "--template", "peer_review", "--json"}));
    };
    make_review(bench, "empty", "");
    EXPECT_THAT(check("empty"), ElementsAre("section-empty", "pages-few"));
    make_review(bench, "long", std::string(kAnswer) + kAnswer + kAnswer + kAnswer);
    EXPECT_THAT(check("long"), ElementsAre("pages"));
    make_review(bench, "open", std::string(kAnswer) + "TODO: say where.");
    EXPECT_THAT(check("open"), ElementsAre("placeholder-left"));
    make_review(bench, "guided", std::string(kAnswer) + "Describe strengths as precisely as weaknesses.");
    EXPECT_THAT(check("guided"), ElementsAre("guidance-left"));
    bench.write("short/analysis.lua", bench.read("whole/analysis.lua"));
    std::string form = bench.read("whole/report.md");
    form.erase(form.find("# Greatest strength"), form.find("# Suggestions") - form.find("# Greatest strength"));
    bench.write("short/report.md", form);
    CourseBench::expect_done(bench.dynlab({"report", "short", "-o", "short.pdf"}));
    EXPECT_THAT(check("short"), ElementsAre("section-missing", "pages-few"));
}

// oracle: the roster; a review with a name in it is reported at once and never released
TEST(reviews, that_contain_a_name_are_reported_at_receipt) {
    CourseBench course(3, 2);
    const Workbench& bench = course.bench();
    for (int i = 1; i <= 3; ++i)
        bench.write("in/" + CourseBench::group(i) + ".pdf", small_pdf("by Student " + std::to_string(i)));
    const ChildResult first = course.course({"submit", "in", "--at", "2026-03-01 10:00"});
    EXPECT_THAT(first.output,
                AllOf(HasSubstr("rules violated"), Not(HasSubstr("a name was found"))));  // they may be signed
    CourseBench::expect_done(course.course({"review", "assign", "--at", "2026-03-02 10:00"}));
    make_review(bench, "fair", kAnswer);
    make_review(bench, "loose", std::string(kAnswer) + "Student 3 of group-03 told us more.");
    const auto submit_file = [&](const std::string& file, int place) {
        const std::string report =
            bench
                .shell("$DYNLAB course --course k review pairs | awk '$1 == \"group-01\" {print $2}' | sed -n " +
                       std::to_string(place) + "p")
                .output;
        return course
            .course({"review", "collect", file, "--from", "group-01", "--of", report.substr(0, report.find('\n')),
                     "--at", "2026-03-03 10:00"})
            .output;
    };
    EXPECT_THAT(submit_file("fair.pdf", 1), AllOf(HasSubstr("on time"), Not(HasSubstr("broken"))));
    EXPECT_THAT(submit_file("loose.pdf", 2), HasSubstr("rules violated: a name was found"));
    const ChildResult findings = course.course({"issues", "group-01", "--stage", "review"});
    EXPECT_EQ(findings.exit_code, 1);
    EXPECT_THAT(findings.output,
                AllOf(ContainsRegex("reviews: review of report-[0-9]+ v1, received Tue 2026-03-03 10:00"),
                      HasSubstr("nothing to fix; checked as peer_review: names of 3 people"),
                      HasSubstr("The name of Student 3 appears in the text"),
                      HasSubstr("The group name group-03 appears in the text")));
    const ChildResult released = course.course({"review", "release", "--at", "2026-03-09 10:00"});
    EXPECT_THAT(released.output, HasSubstr("1 sent now"));
    EXPECT_THAT(released.error_output, HasSubstr("review of group-01 was not sent: page 1: The name of Student 3"));
    EXPECT_THAT(course.course({"status", "--at", "2026-03-09 11:00"}).output,
                ::testing::ContainsRegex("group-01 .* a review by it was not released: see review release\n"));
}

// oracle: what dynlab check says of the same file
TEST(reviews, findings_of_stored_versions_are_shown_as_check_shows_them) {
    CourseBench bench(2);
    bench.submit_file("group-01.pdf", small_pdf("one TODO"), "2026-03-01 10:00");
    bench.submit_file("group-01.pdf", small_pdf("two"), "2026-03-01 11:00");
    bench.submit_file("group-02.pdf", small_pdf("unseen"), "2026-03-01 11:00", {"--no-checks"});
    const std::string checked = bench.bench().dynlab({"check", "group-01.pdf", "--template", "lab_report"}).output;
    const ChildResult newest = bench.course({"issues", "group-01"});
    EXPECT_EQ(newest.exit_code, 1);
    EXPECT_THAT(newest.output, HasSubstr("group-01, first version: report v2, received Sun 2026-03-01 11:00\n"));
    EXPECT_THAT(newest.output, HasSubstr(checked.substr(checked.find("Rules violated"))));
    EXPECT_THAT(newest.output, Not(HasSubstr("placeholder-left")));
    EXPECT_THAT(bench.course({"issues", "group-01", "--version", "1"}).output, HasSubstr("placeholder-left"));
    EXPECT_THAT(bench.course({"issues", "group-02"}).output, HasSubstr("not checked"));
    EXPECT_THAT(bench.course({"issues", "group-01", "--stage", "final"}).error_output,
                HasSubstr("group-01 has submitted no final version for crane"));
    EXPECT_THAT(bench.course({"issues", "gruop-01"}).error_output, HasSubstr("group-01"));
}

// oracle: the roster's own entries
TEST(reviews, check_looks_for_the_people_of_a_roster) {
    const Workbench bench;
    bench.write("r.csv", "id,name,email,group\n20214711,Zoe Brandtner,zoe.brandtner@uni.example,group-07\n");
    const auto names_in = [&](const std::string& text) {
        bench.write("a.pdf", small_pdf(text));
        std::vector<std::string> found = ids(bench.dynlab({"check", "a.pdf", "--roster", "r.csv", "--json"}));
        std::erase_if(found, [](const std::string& id) { return !id.starts_with("name-"); });
        return found;
    };
    for (const char* text : {"by Zoe Brandtner", "BRANDTNER, Zoe", "number 20214711", "zoe.brandtner@uni.example",
                             "handed in by group-07"})
        EXPECT_THAT(names_in(text), ElementsAre("name-in-text")) << text;
    EXPECT_THAT(names_in("by nobody whom you know, 20214712"), ElementsAre());
    bench.write("r.csv", "number,name\n1,Zoe\n");
    const ChildResult wrong = bench.dynlab({"check", "a.pdf", "--roster", "r.csv"});
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_THAT(wrong.error_output, HasSubstr("the column \"id\" is missing"));
    EXPECT_EQ(bench.dynlab({"check", "a.pdf", "--roster", "none.csv"}).exit_code, 2);
}

}  // namespace test_reviews
}  // namespace dynlab::test
