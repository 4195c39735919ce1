// The views of the instructor page, and the commands that they add. Oracle: the output of other commands for the same
// course.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "app/office/office_commands.h"
#include "app/office/office_views.h"
#include "app/office_course.h"
#include "course/store/answer_names.h"
#include "platform/error.h"

namespace test_office_views {
using namespace dynlab;
using namespace dynlab::test;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> lines_of_output(const ChildResult& result) {
    EXPECT_EQ(result.exit_code, 0) << result.error_output;
    std::vector<std::string> lines;
    std::istringstream text(result.output);
    for (std::string line; std::getline(text, line);) {
        if (line.ends_with('\r')) line.pop_back();
        lines.push_back(line);
    }
    return lines;
}

std::string lined(int i) {
    return "-- My answer is number " + std::to_string(i) + ".";
}

TEST(office_views, marks_are_those_that_export_writes) {
    OfficeCourse course(6);
    course.add_lab("lab4", lined);
    course.add_report("crane");
    EXPECT_EQ(course.run({"mark", "lab4", "group-002", "q3", "3", "--reason", "good"}).exit_code, 0);
    OfficeViews views(course.folder(), [] {});
    const json marks = json::parse(views.marks());
    const std::vector<std::string> csv = lines_of_output(course.run({"export"}));
    ASSERT_EQ(marks["rows"].size() + 1, csv.size());
    int given = 0;
    for (std::size_t i = 0; i < marks["rows"].size(); ++i) {
        const json& row = marks["rows"][i];
        std::string expected = row["id"].get<std::string>() + "," + row["name"].get<std::string>() + ",";
        EXPECT_TRUE(csv[i + 1].starts_with(expected)) << csv[i + 1];
        std::string cells;
        for (const json& percent : row["percent"]) {
            given += !percent.is_null();
            cells += "," + (percent.is_null() ? std::string() : fmt::format("{:.4g}", percent.get<double>()));
        }
        cells += "," + (!row.contains("total") ? std::string() : fmt::format("{:.4g}", row["total"].get<double>()));
        EXPECT_THAT(csv[i + 1], HasSubstr("," + row["group"].get<std::string>() + cells)) << i;
    }
    EXPECT_GE(given, 7);
}

TEST(office_views, what_changed_since_the_export_is_named) {
    OfficeCourse course(3);
    course.add_lab("lab4", lined);
    OfficeViews views(course.folder(), [] {});
    EXPECT_EQ(json::parse(views.marks())["exported"], "");
    EXPECT_EQ(course.run({"export", "-o", "term.csv"}).exit_code, 0);
    EXPECT_EQ(json::parse(views.marks())["changes"].size(), 0u);
    EXPECT_NE(json::parse(views.marks())["exported"], "");
    EXPECT_EQ(course.run({"mark", "lab4", "group-003", "q3", "4"}).exit_code, 0);
    const json changes = json::parse(views.marks())["changes"];
    std::set<std::string> columns, names;
    for (const json& change : changes) columns.insert(change["column"]), names.insert(change["name"]);
    EXPECT_THAT(names, testing::ElementsAre(OfficeCourse::name(3)));
    EXPECT_THAT(columns, testing::Contains("total percent"));
    EXPECT_THAT(course.run({"history"}).output, HasSubstr("marks of the course written into term.csv"));
    EXPECT_EQ(course.run({"verify"}).exit_code, 0) << "the exported table is a file of the store";
}

TEST(office_views, a_student_is_shown_as_who_shows_them) {
    OfficeCourse course(4);
    course.add_lab("lab4", lined);
    course.add_report("crane");
    EXPECT_EQ(course.run({"extend", "crane", "group-002", "2026-03-20 12:00", "--reason", "illness"}).exit_code, 0);
    OfficeViews views(course.folder(), [] {});
    for (const std::string name : {"group-002", "s003", "Ada Family004"}) {
        const json facts = json::parse(views.student(name, "en"));
        const std::string who = course.run({"who", name}).output;
        int versions = 0;
        for (const json& work : facts["work"]) {
            EXPECT_THAT(who, HasSubstr("\n" + work["name"].get<std::string>() + " ("));
            for (const json& version : work["versions"]) {
                ++versions;
                EXPECT_THAT(who, HasSubstr(fmt::format("{:05}", version["receipt"].get<int>())));
                EXPECT_THAT(who, HasSubstr(version["received"].get<std::string>()));
            }
            for (const json& extension : work["extensions"])
                EXPECT_THAT(who, HasSubstr(extension["due"].get<std::string>() + " (illness)"));
            for (const json& mark : work["marks"])
                if (mark.contains("percent")) {
                    EXPECT_THAT(who,
                                HasSubstr(fmt::format("mark of {}: {:.4g} percent", mark["name"].get<std::string>(),
                                                      mark["percent"].get<double>())));
                }
        }
        EXPECT_GE(versions, 4) << name;
        for (const json& line : facts["history"]) EXPECT_THAT(who, HasSubstr(line["what"].get<std::string>()));
    }
    const json facts = json::parse(views.student("group-002", "en"));
    std::size_t extensions = 0;
    for (const json& work : facts["work"]) extensions += work["extensions"].size();
    EXPECT_EQ(extensions, 1u);
    EXPECT_ANY_THROW(views.student("Mallory", "en"));
}

TEST(office_views, reviews_are_those_of_the_commands_and_scores_can_be_dropped) {
    OfficeCourse course(6);
    course.add_report("crane");
    OfficeViews views(course.folder(), [] {});
    json reviews = json::parse(views.reviews(""));
    const std::string printed = course.run({"marks", "crane"}).output;
    int outliers = 0;
    std::string reviewer, report;
    for (const json& one : reviews["reviews"])
        if (one["outlier"] == true) {
            ++outliers;
            reviewer = one["reviewer"], report = one["report"];
            EXPECT_THAT(printed, HasSubstr("Check the review of " + one["author"].get<std::string>() + " by " +
                                           reviewer + ": its scores are far below the others"));
        }
    EXPECT_EQ(outliers, 2) << "both reviews of the group that gave zeros";
    for (const json& one : reviews["reports"]) {
        EXPECT_EQ(one["scored"], 2);
        EXPECT_THAT(printed, HasSubstr(fmt::format("{:.1f}", one["work"].get<double>())));
    }
    const ChildResult dropped = course.run({"scores", "crane", "--drop", reviewer, report, "--reason", "zeros"});
    EXPECT_EQ(dropped.exit_code, 0) << dropped.error_output;
    EXPECT_EQ(course.run({"scores", "crane", "--drop", reviewer, report, "--reason", "again"}).exit_code, 1);
    reviews = json::parse(views.reviews("crane"));
    for (const json& one : reviews["reports"]) EXPECT_EQ(one["scored"], one["report"] == report ? 1 : 2);
    EXPECT_THAT(course.run({"marks", "crane"}).output, HasSubstr("is based on only one review."));
    EXPECT_THAT(course.run({"history"}).output, HasSubstr("are withdrawn; reason: zeros"));
}

TEST(office_views, what_is_to_be_done_is_what_status_says) {
    OfficeCourse course(5);
    const Assignment lab = course.add("lab4", "lab", "04");
    course.submit(lab, 1, "script", "print(1)");
    course.submit(lab, 2, "script", "print(2)", "2026-03-09 12:00");
    EXPECT_EQ(course.run({"drop", "group-005", "--reason", "left"}).exit_code, 0);
    OfficeViews views(course.folder(), [] {});
    const json today = json::parse(views.today("en"))[0];
    const std::string status = course.run({"status", "lab4"}).output;
    EXPECT_THAT(status, HasSubstr("2 submitted, 1 late, 2 missing"));
    EXPECT_EQ(json({today["present"], today["late"], today["missing"]}), json({2, 1, 2}));
    EXPECT_EQ(today["next"], "dynlab course grade lab4");
    int missing = 0;
    for (const json& task : today["tasks"]) {
        if (task["kind"] == "late-waits") {
            EXPECT_EQ(task["group"], "group-002");
            EXPECT_EQ(task["costs"], 80);
            continue;
        }
        ++missing;
        EXPECT_EQ(task["kind"], "missing");
        EXPECT_THAT(status,
                    testing::ContainsRegex(task["group"].get<std::string>() + ".*" + task["text"].get<std::string>()));
    }
    EXPECT_EQ(missing, 2);
    const ChildResult reminded = course.run({"remind", "lab4", "--only", "group-003", "-o", "mail.csv"});
    EXPECT_EQ(reminded.exit_code, 0) << reminded.error_output;
    EXPECT_THAT(course.bench().read("mail.csv"), AllOf(HasSubstr("s003@"), Not(HasSubstr("s004@"))));
    EXPECT_THAT(course.run({"history"}).output, HasSubstr("lab4: reminders written for group-003"));
}

TEST(office_views, a_file_that_was_not_taken_can_be_taken_later) {
    OfficeCourse course(2);
    course.add("lab4", "lab", "04");
    for (const std::string sender : {"group-001", "Nobody Known"})
        course.bench().write("in/" + sender + "/analysis.lua", "print('" + sender + "')\n");
    course.run({"submit", "in", "--at", "2026-02-28 10:00", "--isolation", "process"});
    OfficeViews views(course.folder(), [] {});
    const json files = json::parse(views.today("en"))[0]["not_taken"];
    ASSERT_EQ(files.size(), 1u) << course.run({"status", "lab4"}).output;
    const std::string hash = files[0]["hash"];
    const ChildResult taken =
        course.run({"submit", hash.substr(0, 16), "--kept", "--from", "group-002", "--isolation", "process"});
    EXPECT_EQ(taken.exit_code, 0) << taken.error_output;
    EXPECT_EQ(json::parse(views.today("en"))[0]["not_taken"].size(), 0u);
    EXPECT_THAT(course.run({"who", "group-002"}).output, HasSubstr("2026-02-28 10:00")) << "it came then";
    EXPECT_EQ(course.run({"submit", "nosuch.lua", "--kept", "--from", "group-002"}).exit_code, 1);
}

TEST(office_views, a_worksheet_of_a_platform_gets_the_percent_of_an_assignment) {
    OfficeCourse course(3);
    course.add_lab("lab4", lined);
    for (int i = 1; i <= 2; ++i) course.run({"mark", "lab4", OfficeCourse::group(i), "q3", std::to_string(2 * i)});
    course.bench().write("sheet.csv",
                         "Identifier,Full name,Email address,Grade,Maximum Grade,Last modified (grade)\n"
                         "Participant 71,x,s001@example.org,,50.00,-\nParticipant 72,x,s002@example.org,,50.00,-\n"
                         "Participant 79,Somebody Else,who@example.org,,50.00,-\n");
    const ChildResult done = course.run({"export", "lab4", "--worksheet", "sheet.csv", "-o", "filled.csv"});
    EXPECT_EQ(done.exit_code, 1) << "one row is nobody's";
    // 5 of 6 points of a check, and 2 or 4 of 4: 70 and 90 percent of 50
    EXPECT_THAT(course.bench().read("filled.csv"),
                AllOf(HasSubstr("Participant 71,x,s001@example.org,35,50.00"),
                      HasSubstr("Participant 72,x,s002@example.org,45,50.00"), HasSubstr("who@example.org,,50.00")));
}

TEST(office_views, answers_are_shown_without_names_and_in_an_order_that_has_no_information) {
    OfficeCourse course(12);
    const std::string script = "-- <script>document.title = 'taken'</script> $\\alpha$ مرحبا 王小明";
    const Assignment lab = course.add_lab("lab4", [&](int i) {
        if (i == 1) return script;
        if (i == 2) return std::string();
        if (i == 3) return "-- " + std::string(1 << 20, 'x');
        if (i == 4) return "-- I am " + OfficeCourse::name(4) + " of " + OfficeCourse::group(4) + ".";
        return i > 10 ? std::string("-- The same.") : lined(i);
    });
    OfficeViews views(course.folder(), [] {});
    const std::string text = views.marking("", "3", "", "en");
    const json marking = json::parse(text);
    EXPECT_EQ(marking["check"], "q3");
    ASSERT_EQ(marking["answers"].size(), 12u);
    EXPECT_LT(text.size(), 60000u) << "of 1 MB the beginning";
    EXPECT_THAT(text, AllOf(Not(HasSubstr("group-0")), Not(HasSubstr("Family")), Not(HasSubstr("\"s0"))));
    const auto of = [&](int i) {
        const std::string name = answer_name(course.course(), lab, course.group_id(i));
        for (const json& one : marking["answers"])
            if (one["name"] == name) return one;
        return json();
    };
    EXPECT_THAT(of(1)["text"].get<std::string>(),
                HasSubstr("<script>document.title = 'taken'</script> $\\alpha$ مرحبا 王小明"));
    EXPECT_EQ(of(2)["text"], "");
    EXPECT_GE(of(3)["bytes"], 1 << 20);
    EXPECT_GE(views.answer("lab4", "3", of(3)["name"]).size(), std::size_t{1} << 20);
    EXPECT_THAT(of(4)["text"].get<std::string>(), HasSubstr("I am [name] of [name]"));
    EXPECT_EQ(of(11)["same"], 1);
    std::vector<std::string> order, other;
    for (const json& one : marking["answers"]) order.push_back(one["name"]);
    const json of_next = json::parse(views.marking("lab4", "4", "", "en"));
    for (const json& one : of_next["answers"]) other.push_back(one["name"]);
    EXPECT_NE(order, other) << "another order for each question";
    EXPECT_THAT(other, testing::UnorderedElementsAreArray(order));
}

TEST(office_views, a_mark_that_was_not_seen_is_not_replaced) {
    OfficeCourse course(2);
    const Assignment lab = course.add_lab("lab4", lined);
    const std::string name = answer_name(course.course(), lab, course.group_id(2));
    OfficeViews views(course.folder(), [] {});
    const auto entry = [&] { return json::parse(views.entry("lab4", name, "q3")); };
    const auto mark = [&](const std::string& points, int after) {
        return course.run({"mark", "lab4", name, "q3", points, "--after", std::to_string(after)});
    };
    EXPECT_EQ(mark("2", 0).exit_code, 0);
    const int first = entry()["id"];
    EXPECT_EQ(course.run({"mark", "lab4", "group-002", "q3", "1", "--reason", "sign is wrong"}).exit_code, 0);
    const ChildResult refused = mark("4", first);
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.error_output,
                AllOf(HasSubstr("the mark was not changed"), HasSubstr("already has the mark 1 for q3"),
                      HasSubstr("sign is wrong"), Not(HasSubstr("group-002"))));
    EXPECT_EQ(entry()["points"], 1);
    const int second = entry()["id"];
    EXPECT_EQ(
        course.run({"withdraw", "lab4", name, "--mark", "q3", "--after", std::to_string(first), "--reason", "undo"})
            .exit_code,
        1);
    EXPECT_EQ(
        course.run({"withdraw", "lab4", name, "--mark", "q3", "--after", std::to_string(second), "--reason", "undo"})
            .exit_code,
        0);
    EXPECT_FALSE(entry().contains("points"));
    EXPECT_EQ(course.run({"mark", "lab4", "group-002", "5"}).exit_code, 1) << "the whole needs a reason";
}

TEST(office_commands, are_those_of_a_list_with_their_options) {
    using Words = std::vector<std::string>;
    EXPECT_EQ(office_command({"course", "mark", "lab4", "group-01", "q3", "2", "--reason=it's right"}).line,
              R"(dynlab course mark lab4 group-01 q3 2 '--reason=it'\''s right')");
    EXPECT_NO_THROW(office_command({"course", "remind", "lab4", "--out=exports/mail.csv"}));
    for (const Words& words : std::vector<Words>{{"course", "init", "x"},
                                                 {"run", "x.lua"},
                                                 {"course"},
                                                 {},
                                                 {"course", "export"},
                                                 {"course", "export", "--json", "--out=exports/a"},
                                                 {"course", "export", "--out=../a"},
                                                 {"course", "export", "--out=exports/../../a"},
                                                 {"course", "export", "--out=exports/.hidden"},
                                                 {"course", "export", "--out=/tmp/a"},
                                                 {"course", "submit", "/etc/passwd", "--from=group-01"},
                                                 {"course", "scores", "crane", "/etc/passwd"},
                                                 {"course", "mark", "lab4", "--course", "/tmp"},
                                                 {"course", "mark", "lab4", "g", "2", "--reason=a\nb"},
                                                 {"course", "mark", "lab4", "g", "2", "--reason=\x1b[2J"}})
        EXPECT_THROW(office_command(words), EnvironmentError) << testing::PrintToString(words);
}

}  // namespace test_office_views
