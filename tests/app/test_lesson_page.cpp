// A user-written lesson as a page of a site. Oracle: the few lines of the lesson, read by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "platform/atomic_file.h"
#include "platform/cache.h"
#include "platform/temporary_folder.h"
#include "workflow/site/lesson_page.h"

namespace dynlab::test {
namespace test_lesson_page {
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

constexpr const char* kLesson = R"(-- ---
-- title: Springs & masses
-- subtitle: Lesson 8
-- ---
-- %% [markdown]
-- ## Stiffness
-- The spring has `k`{.value} N/m.
--
-- ::: {.table name=rows}
-- :::
-- %% id=load

local d = load("spring")
if #d.y < 3 then print("<three>") end
report.value("k", 3*d.y[1], "%.1f")
report.table("rows", {{"name", "value"}, {"first", "7"}})
-- %% id=setup echo=false
print("of the hidden cell")
-- %% id=answer
-- BEGIN SOLUTION
local found = 12345
-- STARTER: local found = 0
-- END SOLUTION
plot(d.y)
)";

struct OwnLesson {
    TemporaryFolder folder;
    Lesson lesson;
    LessonPage made;

    OwnLesson() {
        const fs::path place = folder.path() / "08_springs";
        fs::create_directories(place);
        write_file_atomically(place / "lesson.lua", kLesson);
        write_file_atomically(place / "spring.csv", "t,y\n0,1.5\n1,2.5\n");
        write_file_atomically(place / "checks.lua", "check(\"k\", 1, function() return true end)\n");
        write_file_atomically(place / "hints.md", "# Question 1\n\n1. Pull.\n2. Pull harder.\n");
        write_file_atomically(place / "talk.md", "# Why?\n\nBecause of 54321.\n");
        write_file_atomically(place / "photo.png", std::string("\x89PNG\0\xff", 6));
        lesson = *lesson_in(place);
        const Cache cache;
        made = LessonPages(folder.path() / "work", cache, true).make(lesson, "en", "08");
    }
};

TEST(lesson_page, has_each_cell_with_its_source_and_results) {
    const OwnLesson own;
    const std::string& html = own.made.page.body;
    EXPECT_EQ(own.made.page.file, "lessons/08/index.html");
    EXPECT_EQ(own.made.page.title, "Springs & masses");
    EXPECT_THAT(html, HasSubstr("<main id=\"lesson\" data-root=\"../../\" data-lesson=\"08_springs\" "
                                "data-file=\"analysis.lua\" data-language=\"en\">"));
    // 3 times 1.5.
    EXPECT_THAT(html, HasSubstr("<span class=\"value\" data-name=\"k\">4.5</span>"));
    EXPECT_THAT(html, HasSubstr("data-table=\"rows\""));
    // Line 12 is empty.
    EXPECT_THAT(html, HasSubstr("<section class=\"cell\" data-cell=\"load\" data-first=\"13\" data-last=\"16\">\n"
                                "<pre class=\"code\">local d = load(&quot;spring&quot;)\nif #d.y &lt; 3 then"));
    EXPECT_THAT(html, HasSubstr("&lt;three&gt;</code></pre>"));
    EXPECT_THAT(html,
                HasSubstr("data-cell=\"setup\" data-first=\"18\" data-last=\"18\">\n<pre class=\"code\" hidden>"));
    EXPECT_THAT(html, HasSubstr("of the hidden cell</code></pre>"));
    EXPECT_THAT(html,
                HasSubstr("-- YOUR CODE HERE\nlocal found = 0\nplot(d.y)</pre>\n<div class=\"results\">\n<figure"));
    EXPECT_LT(html.find("data-cell=\"load\""), html.find("data-cell=\"setup\""));
    EXPECT_LT(html.find("data-cell=\"setup\""), html.find("data-cell=\"answer\""));
    EXPECT_THAT(html, Not(HasSubstr("12345")));
}

TEST(lesson_page, description_has_the_files_of_the_copy) {
    const OwnLesson own;
    const json lesson = json::parse(own.made.description);
    EXPECT_EQ(lesson["lesson"], "08_springs");
    EXPECT_EQ(lesson["title"], "Springs & masses");
    std::map<std::string, json> files;
    for (const json& file : lesson["files"]) files[file["name"]] = file;
    EXPECT_THAT(files["analysis.lua"]["text"].get<std::string>(), HasSubstr("local found = 0\n"));
    EXPECT_EQ(files["data/spring/spring.csv"]["text"], "t,y\n0,1.5\n1,2.5\n");
    EXPECT_EQ(files["photo.png"]["base64"], "iVBORwD/");
    EXPECT_EQ(lesson["checks"].size(), 2u);
    EXPECT_EQ(lesson["checks"]["hints.md"], "# Question 1\n\n1. Pull.\n2. Pull harder.\n");
    for (const char* secret : {"12345", "54321"}) EXPECT_THAT(own.made.description, Not(HasSubstr(secret)));
}

TEST(lesson_page, lessons_of_one_number_have_their_whole_names) {
    const auto folders = numbers_of({{"01_one", {}}, {"03_crane", {}}, {"03_workflow", {}}});
    EXPECT_EQ(folders.at("01_one"), "01");
    EXPECT_EQ(folders.at("03_crane"), "03_crane");
    EXPECT_EQ(folders.at("03_workflow"), "03_workflow");
}

}  // namespace test_lesson_page
}  // namespace dynlab::test
