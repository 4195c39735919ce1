// The workbench's server, asked as no page asks, on disks and with files as they happen to be. Oracle: the files, what
// is still answered afterwards, and the rules of workbench_session.h and permissions.h.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <thread>

#include "documents/text_lines.h"
#include "support/page_client.h"
#include "support/workbench.h"

namespace test_workbench_attacks {
using namespace dynlab;
using namespace dynlab::test;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

constexpr int kOk = 200, kFailed = 500;

/// A client that has the page's cookie.
class Asker : public PageClient {
  public:
    using PageClient::PageClient;
    /// All that a page shows: the event with which a stream begins.
    json page() const {
        std::string reported;
        get("/events", [&](const char* bytes, std::size_t count) {
            reported.append(bytes, count);
            return reported.find("\n\n") == std::string::npos;
        });
        const std::size_t from = reported.find("data: ");
        return from == std::string::npos ? json()
                                         : json::parse(reported.substr(from + 6, reported.find('\n', from) - from - 6));
    }
    /// Puts this text in the script's place.
    httplib::Result write(const std::string& text, bool held = false) const {
        return post("/script", json{{"revision", page()["revision"]},
                                    {"edits", json::array()},
                                    {"whole", true},
                                    {"text", text},
                                    {"goes_on", false},
                                    {"unsaved", held}}
                                   .dump());
    }
    httplib::Result look(const json& variables, const json& settings) const {
        return post("/look", json{{"variables", variables}, {"settings", settings.dump()}, {"data_until", 0}}.dump());
    }
    template <class Holds>
    bool becomes_true(const Holds& holds) const {
        for (int i = 0; i < 200; ++i) {
            const json now = page();
            if (now.is_object() && holds(now)) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
        ADD_FAILURE() << page().dump().substr(0, 2000);
        return false;
    }
    bool reports(const std::string& words) const {
        return becomes_true([&](const json& page) {
            return page.contains("error") &&
                   page["error"]["message"].get<std::string>().find(words) != std::string::npos;
        });
    }
    bool prints(const std::string& cell, const std::string& text) const {
        return becomes_true([&](const json& page) { return page["printed"].value(cell, "") == text; });
    }
};

class workbench_attacks : public workbench_page {
  protected:
    std::unique_ptr<PageProgram> allowed(const std::string& name, const std::string& script) const {
        write(name, script);
        return app(name, {"--run"});
    }
    /// `program` opened with what earlier ones allowed.
    std::unique_ptr<PageProgram> reopened(const std::string& name) const {
        return std::make_unique<PageProgram>(std::vector<std::string>{"app", name}, cache.path(), folder.path());
    }
    static std::string simulated_data(int samples) {
        std::string text = "t,u,y\n";
        for (int k = 0; k < samples; ++k)
            text += std::to_string(k) + "," + std::to_string(k % 7) + "," + std::to_string(k % 5) + "\n";
        return text;
    }
    TemporaryFolder cache;
};

const std::string kPrints = "-- %% id=a\nprint(1 + 1)\n";

TEST_F(workbench_attacks, a_script_that_is_too_long_is_refused_and_ends_nothing) {
    const auto program = allowed("s.lua", kPrints);
    const Asker page(program->address());
    ASSERT_TRUE(page.prints("a", "2\n"));
    const std::string largest_script = "--" + std::string(kMaxSourceSize - 2, 'x');
    EXPECT_EQ(page.write(largest_script + "x")->status, kFailed);
    EXPECT_EQ(text_of("s.lua"), kPrints);
    write("s.lua", largest_script + "x");
    ASSERT_TRUE(page.reports("4 MB"));
    write("s.lua", "-- %% id=a\nprint(1 + 2)\n");
    ASSERT_TRUE(page.prints("a", "3\n"));
    EXPECT_FALSE(page.page().contains("error"));
    EXPECT_EQ(page.write(largest_script)->status, kOk) << "what fits can be read again";
    EXPECT_EQ(text_of("s.lua"), largest_script);
    EXPECT_EQ(page.write(kPrints)->status, kOk) << "after one line of 4 MB";
    EXPECT_TRUE(page.prints("a", "2\n"));
}

TEST_F(workbench_attacks, settings_that_are_nested_deep_are_refused) {
    const auto program = allowed("s.lua", kPrints);
    const Asker page(program->address());
    const int depth = 20000;
    const std::string deep = R"({"a":)" + std::string(depth, '[') + std::string(depth, ']') + "}";
    const auto answer =
        page.post("/look", json{{"variables", json::array()}, {"settings", deep}, {"data_until", 0}}.dump());
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, kFailed);
    EXPECT_THAT(answer->body, HasSubstr("nested"));
    EXPECT_TRUE(page.prints("a", "2\n"));
}

/// The path of the script is a folder for a while, so that writing fails for every user.
TEST_F(workbench_attacks, what_is_not_saved_is_reported_until_it_is) {
    const auto program = allowed("s.lua", kPrints);
    const Asker page(program->address());
    ASSERT_TRUE(page.prints("a", "2\n"));
    const auto is_unsaved = [](const json& now) { return now["unsaved"] != ""; };
    fs::remove(file("s.lua"));
    fs::create_directory(file("s.lua"));
    const std::string mine = "-- %% id=a\nprint(7)\n";
    ASSERT_TRUE(page.write(mine));
    ASSERT_TRUE(page.prints("a", "7\n"));
    EXPECT_TRUE(page.becomes_true(is_unsaved)) << "also when it has run";
    fs::remove(file("s.lua"));
    page.write(mine + "-- more\n");
    EXPECT_TRUE(page.becomes_true(std::not_fn(is_unsaved)));
    EXPECT_EQ(text_of("s.lua"), mine + "-- more\n");
}

TEST_F(workbench_attacks, a_slider_that_is_held_to_the_last_is_saved) {
    const auto program = allowed("s.lua", kPrints);
    const Asker page(program->address());
    ASSERT_TRUE(page.write("-- %% id=a\nprint(8)\n", true));
    ASSERT_TRUE(page.prints("a", "8\n"));
    EXPECT_EQ(text_of("s.lua"), kPrints);
    program->end();
    EXPECT_EQ(text_of("s.lua"), "-- %% id=a\nprint(8)\n");
}

TEST_F(workbench_attacks, a_data_file_that_changes_goes_and_comes_is_noticed) {
    write("r.csv", simulated_data(50));
    const auto program = allowed("s.lua", "-- %% id=a\nlocal d = load(\"r.csv\")\nprint(#d.y)\n");
    const Asker page(program->address());
    ASSERT_TRUE(page.prints("a", "50\n"));
    write("r.csv", simulated_data(80));
    EXPECT_TRUE(page.prints("a", "80\n"));
    fs::remove(file("r.csv"));
    EXPECT_TRUE(page.reports("r.csv"));
    write("r.csv", simulated_data(60));
    EXPECT_TRUE(page.prints("a", "60\n"));
}

TEST_F(workbench_attacks, processes_that_are_killed_are_replaced_or_reported) {
    const std::string work = "local s = 0\nfor i = 1, 1e6 do s = s + i end\n";
    const std::string script = "-- %% id=a\n" + work + "-- %% id=b\n" + work + "-- %% id=c\n" + work;
    const auto program = allowed("s.lua", script + "print(1)\n");
    const Asker page(program->address());
    ASSERT_TRUE(page.prints("c", "1\n"));
    ASSERT_TRUE(page.becomes_true([](const json& now) { return !now["running"]; }));
    std::vector<pid_t> all = program->processes();
    ASSERT_GE(all.size(), 3u) << "the program, the first, and one that keeps a state";
    ::kill(all[2], SIGKILL);
    page.write(script + "print(2)\n");
    EXPECT_TRUE(page.prints("c", "2\n"));
    ::kill(all[1], SIGKILL);
    page.write(script + "print(3)\n");
    EXPECT_TRUE(page.reports("restart dynlab"));
    EXPECT_THAT(text_of("s.lua"), HasSubstr("print(3)"));
}

TEST_F(workbench_attacks, a_yes_is_for_this_script_as_it_was) {
    const auto asks = [&](const std::string& name) {
        const auto program = reopened(name);
        return Asker(program->address()).page()["asking"].get<bool>();
    };
    write("mine.lua", kPrints);
    write("other.lua", kPrints);
    {
        const auto program = reopened("mine.lua");
        const Asker page(program->address());
        EXPECT_TRUE(page.page()["asking"]);
        page.post("/allow");
        ASSERT_TRUE(page.prints("a", "2\n"));
    }
    EXPECT_FALSE(asks("mine.lua"));
    EXPECT_TRUE(asks("other.lua"));
    {
        const auto program = reopened("mine.lua");
        Asker(program->address()).write(kPrints + "print(3)\n");
    }
    EXPECT_FALSE(asks("mine.lua")) << "changed at the page";
    write("mine.lua", "print(\"a stranger's\")\n");
    EXPECT_TRUE(asks("mine.lua"));
}

TEST_F(workbench_attacks, what_is_refused_is_reported_in_the_script_s_language) {
    const std::string mistake = "-- %% id=a\npritn(1 + 1)\n";
    const auto refuses = [&](const std::string& name, const std::string& forbidden, const std::string& stops,
                             const std::string& conflict) {
        const auto program = reopened(name);
        const Asker page(program->address());
        const auto expect = [&](int status, const std::string& words) {
            const httplib::Result answer = page.get("/document.pdf");
            ASSERT_TRUE(answer);
            EXPECT_EQ(answer->status, status);
            EXPECT_THAT(answer->body, HasSubstr(words));
        };
        expect(403, forbidden);
        page.post("/allow");
        ASSERT_TRUE(page.reports(stops));
        expect(409, conflict);
        expect(409, stops);
    };
    write("english.lua", mistake);
    refuses("english.lua", "This script is not allowed to run yet. Press \"Run it\" on the page.",
            "unknown function or variable", "A report cannot be created from a script with an error: ");
    write("french.lua", "-- ---\n-- language: fr\n-- ---\n\n" + mistake);
    refuses("french.lua",
            "Ce script n'a pas encore le droit d'être exécuté. Cliquez sur «\u00A0L'exécuter\u00A0» dans la page.",
            "fonction ou variable inconnue", "Un rapport ne peut pas être fait à partir d'un script");
}

TEST_F(workbench_attacks, a_session_begun_here_is_asked_for_when_another_script_lies_there) {
    write("plant.csv", simulated_data(50));
    const auto asks = [&] {
        const auto program = reopened("plant.csv");
        return Asker(program->address()).page()["asking"].get<bool>();
    };
    EXPECT_FALSE(asks());
    EXPECT_FALSE(asks());
    write("plant_session.lua", kPrints);
    EXPECT_TRUE(asks());
}

TEST_F(workbench_attacks, files_of_one_name_at_once_all_stay) {
    const auto program = app("");
    const Asker page(program->address());
    constexpr int kFiles = 8;
    std::vector<std::thread> senders;
    for (int k = 0; k < kFiles; ++k)
        senders.emplace_back([&, k] { page.post("/upload?name=new.csv", simulated_data(50 + k)); });
    for (std::thread& sender : senders) sender.join();
    std::set<std::string> kept;
    for (const auto& entry : fs::directory_iterator(folder.path()))
        if (entry.path().extension() == ".csv") kept.insert(read_text(entry.path()));
    EXPECT_EQ(kept.size(), std::size_t{kFiles});
}

TEST_F(workbench_attacks, records_chosen_at_once_are_all_in_the_script) {
    write("plant.csv", simulated_data(50));
    const auto program = app("plant.csv");
    const Asker page(program->address());
    std::vector<std::thread> senders;
    for (int k = 1; k <= 8; ++k)
        senders.emplace_back([&, k] {
            page.post("/record", json{{"data", "plant.csv"},
                                      {"inputs", {"u"}},
                                      {"outputs", {"y"}},
                                      {"time", "t"},
                                      {"Ts", 0},
                                      {"name", "second" + std::to_string(k)},
                                      {"units", json::object()}}
                                     .dump());
        });
    for (std::thread& sender : senders) sender.join();
    for (int k = 1; k <= 8; ++k)
        EXPECT_THAT(text_of("plant_session.lua"), HasSubstr("second" + std::to_string(k) + " = iddata("));
}

TEST_F(workbench_attacks, records_are_those_of_the_folder_and_of_the_course) {
    const TemporaryFolder elsewhere;
    std::ofstream(elsewhere.path() / "outside.csv") << simulated_data(50);
    write("inside.csv", simulated_data(50));
    fs::create_directory(file("below"));
    write("below/inside.csv", simulated_data(50));
    const auto program = app("");
    const Asker page(program->address());
    const auto status = [&](const std::string& data) { return page.get("/columns?data=" + data)->status; };
    for (const char* data : {"inside.csv", "below/inside.csv", "crane"}) EXPECT_EQ(status(data), kOk) << data;
    const std::string outside = elsewhere.path() / "outside.csv",
                      up = fs::path(outside).lexically_relative(fs::canonical(folder.path()));
    for (const std::string& data : {outside, up, "below/../" + up}) {
        EXPECT_EQ(status(data), kFailed) << data;
        const json order = {{"data", data}, {"inputs", {"u"}}, {"outputs", {"y"}},       {"time", "t"},
                            {"Ts", 0},      {"name", "data"},  {"units", json::object()}};
        EXPECT_EQ(page.post("/record", order.dump())->status, kFailed) << data;
    }
    EXPECT_THAT(text_of("session.lua"), Not(HasSubstr("outside")));
    const auto named = app(outside);
    EXPECT_EQ(Asker(named->address()).get("/columns?data=" + outside)->status, kOk) << "what the session is of";
}

TEST_F(workbench_attacks, what_is_missing_or_senseless_in_an_order_is_reported) {
    const auto program = allowed("s.lua", "-- %% id=a\ndata = iddata(prbs(6, 4), prbs(6, 4), 0.1)\n");
    const Asker page(program->address());
    EXPECT_THAT(page.get("/columns")->body, HasSubstr("\"data\""));
    EXPECT_THAT(page.get("/help")->body, HasSubstr("\"name\""));
    page.look({"data"}, {{"views", {"record", "variables"}},
                         {"raw", "data"},
                         {"sizes", {{"record", {0, 1e9, 1e9}}}},
                         {"save", {{"what", "data"}, {"name", "data"}, {"format", "csv"}}}});
    EXPECT_TRUE(page.becomes_true([](const json& now) {
        const json& views = now["views"];
        return views.contains("variables") && views["variables"].contains("data") &&
               views.value("record", json::object()).contains("error") &&
               views.value("saved", json::object()).contains("error");
    }));
    EXPECT_FALSE(page.page().contains("error"));
}

TEST_F(workbench_attacks, cells_that_are_gone_are_not_reported) {
    const auto program = allowed("s.lua", kPrints);
    const Asker page(program->address());
    ASSERT_TRUE(page.prints("a", "2\n"));
    page.write("-- %% id=b\nprint(5)\n");
    ASSERT_TRUE(page.prints("b", "5\n"));
    const json now = page.page();
    EXPECT_FALSE(now["states"].contains("a"));
    EXPECT_FALSE(now["printed"].contains("a"));
}

}  // namespace test_workbench_attacks
