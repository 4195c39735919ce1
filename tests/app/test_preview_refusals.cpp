// What `dynlab preview` cannot show: exit code and the whole message.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <future>
#include <thread>

#include "platform/system_call.h"
#include "support/page_client.h"
#include "support/program.h"

namespace test_preview_refusals {
using namespace dynlab;
using namespace dynlab::test;
namespace fs = std::filesystem;

class preview_refusals : public testing::Test {
  protected:
    /// The error message of a preview that refuses to start.
    std::string refusal(std::vector<std::string> words, int exit_code = 1) const {
        words.insert(words.begin(), {"preview", "--no-browser"});
        const ChildResult result = bench.dynlab(words);
        EXPECT_EQ(result.exit_code, exit_code);
        EXPECT_EQ(result.output, "");
        return result.error_output;
    }
    Workbench bench;
};

TEST_F(preview_refusals, files_and_folders) {
    EXPECT_EQ(refusal({"nothere.lua"}), "dynlab: file not found: nothere.lua\n");
    fs::create_directory(bench.path("empty"));
    EXPECT_EQ(refusal({"empty"}),
              "dynlab: empty has no analysis.lua; a report needs analysis.lua and report.md (dynlab new LESSON DIR "
              "creates them)\n");
    bench.write("big.lua", std::string(5'000'000, 'a'));
    EXPECT_EQ(refusal({"big.lua"}),
              "dynlab: big.lua: the size limit of a script or template is 4 MB, but the size of this file is 5 MB\n");
    fs::create_directory(bench.path("folder.lua"));
    EXPECT_THAT(refusal({"folder.lua"}), testing::HasSubstr("folder.lua has no analysis.lua"));
}

TEST_F(preview_refusals, ports) {
    bench.write("a.lua", "print(1)\n");
    const FileDescriptor taken(::socket(AF_INET, SOCK_STREAM, 0));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof address;
    ASSERT_EQ(::bind(taken.get(), reinterpret_cast<sockaddr*>(&address), length), 0);
    ASSERT_EQ(::listen(taken.get(), 1), 0);
    ASSERT_EQ(::getsockname(taken.get(), reinterpret_cast<sockaddr*>(&address), &length), 0);
    const std::string port = std::to_string(ntohs(address.sin_port));
    EXPECT_EQ(refusal({"a.lua", "--port", port}),
              "dynlab: port " + port + " is in use or not permitted; omit --port to use a free port\n");
    EXPECT_THAT(refusal({"a.lua", "--port", "99999"}, 2), testing::HasSubstr("99999 not in range 1 to 65535"));
}

/// Without a browser the address is all one needs; Ctrl-C ends it.
TEST_F(preview_refusals, a_missing_browser_is_no_reason_to_stop) {
    bench.write("a.lua", "print(1)\n");
    bench.hide_program("xdg-open");
    const ChildResult result = bench.shell("timeout --signal=INT 2 $DYNLAB preview a.lua");
    EXPECT_THAT(result.output, testing::StartsWith("http://dynlab-"));
    EXPECT_EQ(result.error_output, "");
}

/// All users of a machine see the words of every command (ps). Oracle: /proc, and the modes of the file and its folder.
TEST_F(preview_refusals, the_browser_gets_the_address_where_no_other_user_sees_it) {
    bench.write("a.lua", "print(1)\n");
    bench.write("bin/xdg-open",
                "#!/bin/bash\n"
                "grep -a token= /proc/[0-9]*/cmdline /proc/[0-9]*/comm >seen\n"
                "stat -c %a \"$1\" >modes; stat -c %a \"$(dirname \"$1\")\" >>modes\n"
                "cp \"$1\" copy; mv copy opened; sleep 3\n");
    auto preview = std::async(std::launch::async, [this] {
        return bench.shell(
            "chmod +x bin/xdg-open; export DISPLAY=:1 PATH=$PWD/bin:$PATH; umask 022; timeout --signal=INT 5 $DYNLAB "
            "preview a.lua");
    });
    for (int i = 0; i < 400 && !fs::exists(bench.path("opened")); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    const std::string opened = bench.read("opened");
    const std::size_t from = opened.find("http://");
    ASSERT_NE(from, std::string::npos) << opened;
    const std::string address = opened.substr(from, opened.find('"', from) - from);
    EXPECT_NO_THROW(PageClient{address});
    EXPECT_ANY_THROW(PageClient{address}) << "a second time";
    preview.get();
    EXPECT_EQ(bench.read("seen"), "");
    EXPECT_EQ(bench.read("modes"), "600\n700\n");
}

}  // namespace test_preview_refusals
