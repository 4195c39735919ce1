#pragma once
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "platform/temporary_folder.h"
#include "support/browser.h"

namespace dynlab::test {

inline const std::string kHead = "-- ---\n-- title: A document\n-- ---\n\n";
inline const std::string kFirst =
    "-- %% [markdown]\n-- # First\n--\n-- Words at the beginning.\n\n-- %% id=one\nlocal x = 20\nprint(\"x is \" .. "
    "x)\n\n";
inline const std::string kPlot =
    "-- %% id=drawn\nplot({1, 2, 3}, {1, 4, 9}, {title = \"Squares\"})\n\n-- %% [markdown]\n-- Words at the end.\n";

/// The program that serves a document, as a user starts it.
class Preview {
  public:
    explicit Preview(const std::filesystem::path& document, bool run = true,
                     const std::vector<std::string>& options = {}) {
        const std::filesystem::path address = out.path() / "address";
        std::vector<std::string> words = {"dynlab", "preview", document, "--no-browser"};
        if (run) words.push_back("--run");
        words.insert(words.end(), options.begin(), options.end());
        std::vector<char*> pointers;
        for (std::string& word : words) pointers.push_back(word.data());
        pointers.push_back(nullptr);
        process_ = ::fork();
        if (process_ == 0) {
            ::setenv("XDG_CACHE_HOME", out.path().c_str(), 1);
            ::setenv("DYNLAB_HOME", DYNLAB_SOURCE_DIR, 1);
            if (!std::freopen(address.c_str(), "w", stdout)) ::_exit(1);
            ::execv(DYNLAB_PROGRAM, pointers.data());
            ::_exit(1);
        }
        for (int i = 0; i < 1000 && address_.empty(); ++i) {
            std::ifstream file(address);
            std::getline(file, address_);
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
    }
    ~Preview() { end(); }
    void end() {
        if (process_ <= 0) return;
        ::kill(process_, SIGINT);
        ::waitpid(process_, nullptr, 0);
        process_ = 0;
    }
    const std::string& address() const { return address_; }
    pid_t process() const { return process_; }
    TemporaryFolder out;

  private:
    pid_t process_ = 0;
    std::string address_;
};

class preview_page : public testing::Test {
  protected:
    std::filesystem::path file(const std::string& name = "analysis.lua") const { return folder.path() / name; }
    void write(const std::string& text, const std::string& name = "analysis.lua") const {
        std::ofstream(file(name)) << text;
    }
    bool shows(Browser& browser, const std::string& text) const {
        return browser.comes("document.getElementById('document').innerText.includes('" + text + "')");
    }
    static bool state_is(Browser& browser, const std::string& cell, const std::string& state) {
        return browser.comes("document.querySelector('[data-cell=" + cell + "]')?.dataset.state === '" + state + "'");
    }
    TemporaryFolder folder;
};

}  // namespace dynlab::test
