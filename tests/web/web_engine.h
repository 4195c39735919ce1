#pragma once
#include <httplib.h>

#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include "platform/atomic_file.h"
#include "support/program.h"

namespace dynlab::test {

/// What scripts/build web makes; empty where it was not run.
inline std::filesystem::path web_engine_folder() {
    const std::filesystem::path folder = std::filesystem::path(DYNLAB_SOURCE_DIR) / "build/web/engine";
    return std::filesystem::exists(folder / "dynlab.wasm") ? folder : std::filesystem::path();
}

#define SKIP_WITHOUT_WEB_ENGINE() \
    if (web_engine_folder().empty()) GTEST_SKIP() << "the engine for browsers is not built (scripts/build web)"

/// A small site with lessons 02 and 04 (make_test_site.py), served below a folder of a server as any web server does.
class TestSite {
  public:
    TestSite() {
        const std::string source = DYNLAB_SOURCE_DIR;
        const ChildResult made = bench_.shell("python3 " + source + "/tests/web/make_test_site.py $DYNLAB " + source +
                                              " " + web_engine_folder().string() + " " + folder().string() + " 02 04");
        if (made.exit_code != 0) throw std::runtime_error(made.error_output);
        server_.set_mount_point("/course/", folder().string());
        port_ = server_.bind_to_any_port("127.0.0.1");
        thread_ = std::thread([this] { server_.listen_after_bind(); });
    }
    ~TestSite() {
        server_.stop();
        thread_.join();
    }
    std::filesystem::path folder() const { return bench_.path("site"); }
    const Workbench& bench() const { return bench_; }
    std::string address(const std::string& page) const {
        return "http://127.0.0.1:" + std::to_string(port_) + "/course/" + page;
    }

  private:
    Workbench bench_;
    httplib::Server server_;
    int port_ = 0;
    std::thread thread_;
};

}  // namespace dynlab::test
