#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "platform/atomic_file.h"
#include "platform/temporary_folder.h"
#include "support/browser.h"
#include "support/preview_program.h"

namespace dynlab::test {

/// A session of `dynlab app` in a separate folder, and the user's actions on its page.
class workbench_page : public testing::Test {
  protected:
    std::filesystem::path file(const std::string& name) const { return folder.path() / name; }
    void write(const std::string& name, const std::string& text) const { std::ofstream(file(name)) << text; }
    std::string text_of(const std::string& name) const { return read_text(file(name)); }
    std::unique_ptr<PageProgram> app(const std::string& subject, std::vector<std::string> options = {}) const {
        std::vector<std::string> words = {"app"};
        if (!subject.empty()) words.push_back(subject);
        words.insert(words.end(), options.begin(), options.end());
        return std::make_unique<PageProgram>(words, std::filesystem::path(), folder.path());
    }
    /// A second-order plant with noise, as a user's CSV file.
    void write_data_set(const std::string& name = "plant.csv") const {
        std::ofstream out(file(name));
        out << "time (s),valve (%),level (cm)\n";
        double x = 0, v = 0;
        for (int k = 0; k < 800; ++k) {
            const double u = (k / 37 + k / 59) % 2 == 0 ? 1 : -1, noise = 0.02 * std::sin(12.9898 * k * k);
            out << 0.1 * k << ',' << 50 + 10 * u << ',' << 20 + 5 * x + noise << '\n';
            for (int i = 0; i < 20; ++i) {
                v += 0.005 * (2 * u - 3 * x - 2 * v);
                x += 0.005 * v;
            }
        }
    }
    static bool is_ready(Browser& browser) {
        return browser.becomes_true(
            "['up to date', 'à jour', 'stopped at an error'].includes(document.getElementById('state').textContent)");
    }
    /// Opens a session of the data of write_data_set() and waits for its picture.
    std::unique_ptr<PageProgram> open(Browser& browser) const {
        write_data_set();
        auto program = app("plant.csv");
        browser.open(program->address());
        EXPECT_TRUE(view_appears(browser, "record"));
        EXPECT_TRUE(is_ready(browser));
        return program;
    }
    /// Clicks the visible button with these words. Returns false if there is none.
    static bool press(Browser& browser, const std::string& words) {
        return browser.becomes_true(
            "(() => { const found = [...document.querySelectorAll('button')].find((one) => one.textContent.trim() === "
            "`" +
                words + "` && one.offsetParent && !one.disabled); found?.click(); return found; })()",
            10);
    }
    static bool script_has(Browser& browser, const std::string& text) {
        return browser.becomes_true("document.querySelector('.CodeMirror')?.CodeMirror.getValue().includes(`" + text +
                                    "`)");
    }
    static bool view_appears(Browser& browser, const std::string& view) {
        return browser.becomes_true("document.querySelector('.tile[data-view=" + view + "] canvas')");
    }
    static bool says(Browser& browser, const std::string& text) {
        return browser.becomes_true("document.body.innerText.includes(`" + text + "`)");
    }
    TemporaryFolder folder;
};

}  // namespace dynlab::test
