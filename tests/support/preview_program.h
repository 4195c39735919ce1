#pragma once
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "platform/temporary_folder.h"
#include "support/page_client.h"
#include "support/program.h"

namespace dynlab::test {

/// The program that serves a page, as a user starts it.
class PageProgram {
  public:
    /// `words`: the command and its arguments. Without `cache`, the program has a separate cache with the formats of
    /// LaTeX that tests have made.
    explicit PageProgram(std::vector<std::string> words, const std::filesystem::path& cache = {},
                         const std::filesystem::path& folder = {}) {
        const std::filesystem::path address = out.path() / "address";
        words.insert(words.begin(), "dynlab");
        words.push_back("--no-browser");
        std::vector<char*> pointers;
        for (std::string& word : words) pointers.push_back(word.data());
        pointers.push_back(nullptr);
        if (cache.empty()) lend_formats(out.path());
        process_ = ::fork();
        if (process_ == 0) {
            ::setenv("XDG_CACHE_HOME", cache.empty() ? out.path().c_str() : cache.c_str(), 1);
            ::setenv("DYNLAB_HOME", DYNLAB_SOURCE_DIR, 1);
            if (!std::freopen(address.c_str(), "w", stdout)) ::_exit(1);
            if (!folder.empty()) std::filesystem::current_path(folder);
            ::execv(DYNLAB_PROGRAM, pointers.data());
            ::_exit(1);
        }
        address_ = printed_address(0);
    }
    ~PageProgram() { end(); }
    PageProgram(const PageProgram&) = delete;
    PageProgram& operator=(const PageProgram&) = delete;
    void end() {
        if (process_ <= 0) return;
        ::kill(process_, SIGINT);
        ::waitpid(process_, nullptr, 0);
        process_ = 0;
        keep_formats(out.path());
    }
    /// Stops the processes that run scripts until `go_on`, however long a browser takes meanwhile.
    void hold() const {
        for (std::size_t held = 0;; held = runners().size()) {
            for (const pid_t runner : runners()) ::kill(runner, SIGSTOP);
            if (runners().size() == held) return;
        }
    }
    void go_on() const {
        for (const pid_t runner : runners()) ::kill(runner, SIGCONT);
    }
    const std::string& address() const { return address_; }
    /// The address that the program prints for the next client, after the first address was used.
    std::string next_address() const {
        PageClient::client_of(PageClient::host_of(address_)).Get(address_.substr(address_.find("/?")));
        return printed_address(1);
    }
    pid_t process() const { return process_; }
    /// The program's process and all that come from it, the eldest first.
    std::vector<pid_t> processes() const {
        std::vector<pid_t> all = {process_};
        for (std::size_t i = 0; i < all.size(); ++i) {
            std::error_code gone;
            for (const auto& thread :
                 std::filesystem::directory_iterator("/proc/" + std::to_string(all[i]) + "/task", gone)) {
                std::ifstream children(thread.path() / "children");
                for (pid_t child = 0; children >> child;) all.push_back(child);
            }
        }
        return all;
    }
    TemporaryFolder out;

  private:
    /// Empty when it does not come.
    std::string printed_address(int number) const {
        for (int i = 0; i < 1000; ++i) {
            std::ifstream file(out.path() / "address");
            int found = 0;
            for (std::string line; std::getline(file, line);)
                if (line.starts_with("http://") && !file.eof() && found++ == number) return line;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return {};
    }
    std::vector<pid_t> runners() const {
        std::vector<pid_t> all = processes();
        all.erase(all.begin());
        return all;
    }

    pid_t process_ = 0;
    std::string address_;
};

/// `dynlab preview`.
class Preview : public PageProgram {
  public:
    explicit Preview(const std::filesystem::path& document, bool run = true,
                     const std::vector<std::string>& options = {}, const std::filesystem::path& cache = {})
        : PageProgram(words_of(document, run, options), cache) {}

  private:
    static std::vector<std::string> words_of(const std::filesystem::path& document, bool run,
                                             const std::vector<std::string>& options) {
        std::vector<std::string> words = {"preview", document};
        if (run) words.push_back("--run");
        words.insert(words.end(), options.begin(), options.end());
        return words;
    }
};

}  // namespace dynlab::test
