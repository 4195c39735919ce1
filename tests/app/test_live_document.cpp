// A live document that follows its files, without a browser. Oracles: the files that the test writes, and the order of
// the states that the reader sees.
#include "app/live/live_document.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <semaphore>
#include <thread>

#include "platform/temporary_folder.h"
#include "support/environment_variable.h"

namespace test_live_document {
using namespace dynlab;
using nlohmann::json;
using testing::ElementsAre;
using namespace std::chrono_literals;

class live_document : public testing::Test {
  protected:
    live_document() {
        ::setenv("DYNLAB_HOME", DYNLAB_SOURCE_DIR, 1);
        std::ofstream(folder.path() / "analysis.lua") << "-- %% id=one\nprint(\"it is \" .. 3 + 4)\n";
    }

    /// Shows the document until its run is over and keeps the reported states.
    void open() {
        readings = 0, reported.clear();
        std::counting_semaphore<> over(0);
        ScriptRunner runner;
        LivePage page;
        const auto read = [this] {
            return report_of_script(read_percent_script((folder.path() / "analysis.lua").string()), "preview.html");
        };
        LiveDocument document(read, runner, page);
        document.on_reading([this](const auto&) { ++readings; });
        document.on_change([&] {
            const json shown = json::parse(page.whole());
            const std::string whose = shown["recalled"] == true ? "of before" : "own";
            const std::string what = page.settled() ? "settled" : shown["running"] == true ? "running" : "waiting";
            if (reported.empty() || reported.back() != whose + ", " + what) reported.push_back(whose + ", " + what);
            if (page.settled() && shown["html"].dump().find("it is 7") != std::string::npos) over.release();
        });
        document.allow_runs();
        const std::jthread reader([&] {
            if (over.try_acquire_for(30s)) std::this_thread::sleep_for(300ms);  // no state is reported after that
            document.end();
        });
        document.work();
    }

    TemporaryFolder folder;
    test::EnvironmentVariable cache_home{"XDG_CACHE_HOME", folder.path() / "cache"};
    int readings = 0;
    std::vector<std::string> reported;
};

/// `on_reading` runs once for the document, after the end of the run.
TEST_F(live_document, of_before_is_shown_until_its_run_is_over_and_read_once) {
    open();
    ASSERT_FALSE(reported.empty());
    EXPECT_EQ(reported.back(), "own, settled");
    open();
    EXPECT_THAT(reported,
                ElementsAre("of before, waiting", "of before, running", "of before, waiting", "own, settled"));
    EXPECT_EQ(readings, 1);
}

}  // namespace test_live_document
