#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "platform/temporary_folder.h"
#include "support/browser.h"
#include "support/preview_program.h"

namespace dynlab::test {

inline const std::string kHead = "-- ---\n-- title: A document\n-- ---\n\n";
inline const std::string kFirst =
    "-- %% [markdown]\n-- # First\n--\n-- Words at the beginning.\n\n-- %% id=one\nlocal x = 20\nprint(\"x is \" .. "
    "x)\n\n";
inline const std::string kPlot =
    "-- %% id=drawn\nplot({1, 2, 3}, {1, 4, 9}, {title = \"Squares\"})\n\n-- %% [markdown]\n-- Words at the end.\n";

class preview_page : public testing::Test {
  protected:
    std::filesystem::path file(const std::string& name = "analysis.lua") const { return folder.path() / name; }
    void write(const std::string& text, const std::string& name = "analysis.lua") const {
        std::ofstream(file(name)) << text;
    }
    bool shows(Browser& browser, const std::string& text) const {
        return browser.becomes_true("document.getElementById('document')?.innerText.includes('" + text + "')");
    }
    static bool state_is(Browser& browser, const std::string& cell, const std::string& state) {
        return browser.becomes_true("document.querySelector('[data-cell=" + cell + "]')?.dataset.state === '" + state +
                                    "'");
    }
    TemporaryFolder folder;
};

}  // namespace dynlab::test
