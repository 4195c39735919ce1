// The Jupyter kernel over its sockets. Oracles: the protocol (jupyter-client's messaging page), RFC 4231 for
// signatures, arithmetic, the clock and the system's own account of processes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/kernel/input_history.h"
#include "support/kernel_client.h"

namespace test_kernel {
using namespace dynlab;
using namespace dynlab::test;
using nlohmann::json;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using Clock = std::chrono::steady_clock;

constexpr const char* kEndless = "print('on the way') while true do end";

std::vector<pid_t> children_of(pid_t process) {
    std::ifstream list("/proc/" + std::to_string(process) + "/task/" + std::to_string(process) + "/children");
    std::vector<pid_t> all;
    for (pid_t child; list >> child;) all.push_back(child);
    return all;
}

/// The process that runs cells: the only child of the kernel's only child, which keeps it.
pid_t cells_process(pid_t kernel) {
    const std::vector<pid_t> keeper = children_of(kernel);
    const std::vector<pid_t> cells = keeper.size() == 1 ? children_of(keeper[0]) : keeper;
    EXPECT_EQ(cells.size(), 1u);
    return cells.size() == 1 ? cells[0] : 0;
}

double megabytes_of(pid_t process) {
    std::ifstream status("/proc/" + std::to_string(process) + "/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("VmRSS:")) return std::stod(line.substr(6)) / 1024;
    return -1;
}

/// One kernel serves all tests: each leaves it as it was, idle.
class kernel : public testing::Test {
  protected:
    static void SetUpTestSuite() { shared = new KernelClient; }
    static void TearDownTestSuite() { delete shared; }
    static KernelClient& client() { return *shared; }
    static void expect_progress(const std::string& id);
    static KernelClient* shared;
};
KernelClient* kernel::shared = nullptr;

/// One line of output, which is replaced as the work goes on.
void kernel::expect_progress(const std::string& id) {
    json first;
    while (const auto heard = client().next_heard(20'000)) {
        if (heard->parent.value("msg_id", "") != id) continue;
        if (heard->type() == "display_data") first = heard->content;
        if (heard->type() != "update_display_data") continue;
        EXPECT_EQ(heard->content["transient"]["display_id"], first["transient"]["display_id"]);
        EXPECT_THAT(heard->content["data"]["text/plain"].get<std::string>(),
                    testing::ContainsRegex("^\\[#* *\\] [0-9]+ %$"));
        return;
    }
    ADD_FAILURE() << "no progress is told";
}

TEST(kernel_parts, history_keeps_the_last_thousand) {
    InputHistory history;
    for (int i = 1; i <= 1500; ++i) history.add(i, "x" + std::to_string(i), "");
    EXPECT_EQ(history.found({{"hist_access_type", "tail"}, {"n", 2}}), (json{{1, 1499, "x1499"}, {1, 1500, "x1500"}}));
    EXPECT_EQ(history.found({{"hist_access_type", "tail"}, {"n", 5000}}).size(), 1000u);
    EXPECT_EQ(history.found({{"hist_access_type", "range"}, {"start", 600}, {"stop", 602}}),
              (json{{1, 600, "x600"}, {1, 601, "x601"}}));
}

TEST_F(kernel, says_who_it_is_and_beats) {
    const json reported = client().answer("kernel_info_request");
    EXPECT_EQ(reported["language_info"]["name"], "lua");
    EXPECT_EQ(reported["protocol_version"], "5.3");
    EXPECT_EQ(client().answer("kernel_info_request", {}, true)["implementation"], "dynlab");
    EXPECT_TRUE(client().beats());
    EXPECT_EQ(client().answer("comm_info_request")["comms"], json::object());
}

TEST_F(kernel, cells_print_show_values_formulas_and_figures_and_share_locals) {
    auto ran = client().run("local x = 20\nfor i = 1, 3 do print(i) end\nx + 1\nx + 2");
    EXPECT_EQ(ran.reply["status"], "ok");
    EXPECT_EQ(ran.printed, "1\n2\n3\n21\n");
    EXPECT_EQ(ran.first("execute_result")["data"], (json{{"text/plain", "22"}}));
    EXPECT_EQ(ran.first("execute_result")["execution_count"], ran.reply["execution_count"]);
    // Field case 17: a call of a user-defined function shows its value as well. A call without values shows nothing.
    ran = client().run("local function half(x) return x/2 end\nhalf(8)");
    EXPECT_EQ(ran.first("execute_result")["data"], (json{{"text/plain", "4"}}));
    ran = client().run("local t = {f = function(a, b) return a, b end}\nt.f(\n  1,\n  2)");
    EXPECT_EQ(ran.first("execute_result")["data"], (json{{"text/plain", "1\t2"}}));
    EXPECT_EQ(client().run("half(8);").printed, "");
    EXPECT_EQ(client().run("local function quiet() end\nquiet()").printed, "");
    EXPECT_EQ(client().run("print(\"once\")").printed, "once\n");
    ran = client().run("tf({2}, {1, 0.5, 3e-7}, {IODelay = 0.5})");
    EXPECT_EQ(ran.first("execute_result")["data"]["text/latex"],
              "$\\displaystyle G(s) = \\frac{2}{s^{2} + 0.5 s + 3 \\cdot 10^{-7}} e^{-0.5 s}$");
    ran = client().run("x;\nplot({1, x}, {1, 4})");
    const json figure = ran.first("display_data")["data"];
    EXPECT_THAT(figure["image/svg+xml"].get<std::string>(), testing::StartsWith("<svg"));
    EXPECT_THAT(figure["image/png"].get<std::string>(),
                testing::StartsWith("iVBORw0KGgo"));  // base64 of PNG's signature
    EXPECT_THAT(figure["application/pdf"].get<std::string>(), testing::StartsWith("JVBERi0"));  // "%PDF-"
    ran = client().run("-- ---\n-- seed: 7\n-- ---\nprint(rand())");
    EXPECT_EQ(ran.printed, client().run("rng(7) print(rand())").printed);
    EXPECT_THAT(client().run("report.value('fit', 93.25, '%.1f')").printed, HasSubstr("fit: 93.2"));
}

TEST_F(kernel, mistakes_are_reported_with_cell_line_and_text) {
    const auto ran = client().run("local y = 1\nprint(y + nil)");
    EXPECT_EQ(ran.reply["status"], "error");
    const json error = ran.first("error");
    EXPECT_EQ(error["evalue"], ran.reply["evalue"]);
    EXPECT_THAT(error["traceback"].dump(), AllOf(HasSubstr("]:2: "), HasSubstr("print(y + nil)")));
    EXPECT_EQ(client().run("os.exit(3)").reply["status"], "error");
    EXPECT_EQ(client().run("x = = 1").reply["status"], "error");
    EXPECT_EQ(client().run("print(6 * 7)").printed, "42\n");
}

TEST_F(kernel, completes_inspects_and_knows_what_is_whole) {
    client().run("some_table = {alpha = 1, beta = 2}");
    // The cursor counts characters: two bytes of UTF-8 are one.
    const std::string code = "x = '\xC3\xA9'; y = some_table.al";
    json reported = client().answer("complete_request", {{"code", code + " + 1"}, {"cursor_pos", code.size() - 1}});
    EXPECT_EQ(reported["matches"], json{"alpha"});
    EXPECT_EQ(reported["cursor_start"], code.size() - 3);
    EXPECT_EQ(reported["cursor_end"], code.size() - 1);
    reported = client().answer("inspect_request", {{"code", "y = lsim(G, u)"}, {"cursor_pos", 6}, {"detail_level", 0}});
    EXPECT_TRUE(reported["found"]);
    EXPECT_THAT(reported["data"]["text/plain"].get<std::string>(), HasSubstr("lsim(G, u"));
    reported =
        client().answer("inspect_request", {{"code", "some_table.beta"}, {"cursor_pos", 15}, {"detail_level", 0}});
    EXPECT_EQ(reported["data"]["text/plain"], "2");
    reported =
        client().answer("inspect_request", {{"code", "nothing_of_the_kind"}, {"cursor_pos", 3}, {"detail_level", 0}});
    EXPECT_FALSE(reported["found"]);
    EXPECT_THAT(client().run("lsim?").reply["payload"].dump(), HasSubstr("lsim(G, u"));
    const auto state = [](const char* text) {
        return client().answer("is_complete_request", {{"code", text}})["status"].get<std::string>();
    };
    EXPECT_EQ(state("for i = 1, 2 do"), "incomplete");
    EXPECT_EQ(state("for i = 1, 2 do end"), "complete");
    EXPECT_EQ(state("1 + 1"), "complete");
    EXPECT_EQ(state("x = = 1"), "invalid");
}

TEST_F(kernel, an_interrupt_ends_the_cell_that_runs_and_no_other) {
    double worst = 0;
    for (const char* code :
         {kEndless, "print('x') for i = 1, 1e9 do pcall(function() while true do end end) end",
          "print('x') montecarlo{system = tf({1}, {1, 1}), input = prbs(9, 8), Ts = 0.1, sigma = 0.1, "
          "runs = 20000, estimators = {srivc = {{1, 1, 0}}}}"}) {
        const std::string id = client().start(code);
        client().await_output(id);
        if (std::string(code).find("montecarlo") != std::string::npos) expect_progress(id);
        const auto start = Clock::now();
        EXPECT_EQ(client().answer("interrupt_request", {}, true)["status"], "ok");
        const auto ran = client().finish(id);
        worst = std::max(worst, std::chrono::duration<double>(Clock::now() - start).count());
        EXPECT_EQ(ran.reply["ename"], "interrupted") << code << ran.reply.dump();
        EXPECT_EQ(client().run("print(6 * 7)").printed, "42\n");
    }
    RecordProperty("seconds", std::to_string(worst));
    EXPECT_LT(worst, 0.2);
    // Idle, or just about to run or to be done: those that come behind are whole.
    for (int i = 0; i < 60; ++i) {
        client().ask("interrupt_request", {}, true);
        const std::string hit = client().start("for k = 1, " + std::to_string(i * 20'000) + " do end");
        if (i % 3 > 0) std::this_thread::sleep_for(std::chrono::microseconds(i * 50));
        EXPECT_EQ(client().answer("interrupt_request", {}, true)["status"], "ok");
        client().finish(hit);
        const auto ran = client().run("local s = 0 for k = 1, 100000 do s = s + 1 end print(s)");
        EXPECT_EQ(ran.printed, "100000\n") << i << ran.reply.dump();
    }
}

TEST_F(kernel, cells_behind_one_that_failed_are_not_run) {
    client().run("begun = true");
    const pid_t cells = cells_process(client().process());
    ::kill(cells, SIGSTOP);  // until the second has come: the first would fail before
    const std::string fails = client().start("print('x') for i = 1, 1e7 do end error('no')"),
                      behind = client().start("waited = 1"),
                      asked = client().ask("is_complete_request", {{"code", "x"}});
    EXPECT_TRUE(client().beats());
    ::kill(cells, SIGCONT);
    EXPECT_EQ(client().finish(fails).reply["status"], "error");
    EXPECT_EQ(client().finish(behind).reply["status"], "aborted");
    EXPECT_THAT(client().run("print(waited)").reply.dump(), HasSubstr("unknown function or variable"));
}

TEST_F(kernel, what_is_not_signed_or_no_message_is_not_answered) {
    auto frames = client().wire().write(client().wire().made("execute_request", {{"code", "forged = 1"}}, {}));
    for (const auto& change : std::vector<std::function<void(std::vector<std::string>&)>>{
             [](auto& f) { f[1] = std::string(64, '0'); }, [](auto& f) { f[1] = ""; },
             [](auto& f) { f[5] = "{\"code\": \"forged = 2\"}"; }, [](auto& f) { f.resize(3); },
             [](auto& f) { f = {"<IDS|MSG>"}; }, [](auto& f) { f[0] = "nothing"; }}) {
        auto bad = frames;
        change(bad);
        client().send(bad);
    }
    MessageWire& ours = client().wire();
    KernelMessage odd;
    odd.header = json::array({1, 2});
    client().send(ours.write(odd));
    auto deep = ours.made("execute_request", json{{"code", "forged = 3"}}, {});  // as long as the signature is right
    json nested = json::array();
    for (int i = 0; i < 150; ++i) nested = json::array({std::move(nested)});
    deep.content["more"] = std::move(nested);
    client().send(ours.write(deep));
    client().send(ours.write(ours.made("execute_request", json{{"code", 7}, {"silent", "no"}}, {})));
    EXPECT_EQ(client().answer("history_request", {{"hist_access_type", 3}})["status"], "error");
    EXPECT_THAT(client().run("print(forged)").reply.dump(), HasSubstr("unknown function or variable"));
    EXPECT_THAT(client().complaints(), HasSubstr("not answered: a message is not signed with this kernel's key"));
}

/// A client socket that sends raw frames. Sending needs no key.
class RawSocket {
  public:
    RawSocket(const KernelClient& client, int port) {
        socket_.set(zmq::sockopt::linger, 0);
        socket_.connect("ipc://" + (client.folder() / "socket-").string() + std::to_string(port));
    }
    void send(const std::vector<std::string>& frames) {
        std::vector<zmq::message_t> parts(frames.begin(), frames.end());
        zmq::send_multipart(socket_, parts);
    }
    std::vector<std::string> answer() {
        zmq::pollitem_t readable{socket_, 0, ZMQ_POLLIN, 0};
        std::vector<zmq::message_t> parts;
        if (zmq::poll(&readable, 1, std::chrono::seconds(20)) > 0)
            (void)zmq::recv_multipart(socket_, std::back_inserter(parts));
        std::vector<std::string> frames;
        for (const zmq::message_t& part : parts) frames.push_back(part.to_string());
        return frames;
    }

  private:
    zmq::context_t context_{1};
    zmq::socket_t socket_{context_, ZMQ_DEALER};
};

// oracle: ZMTP's pattern of requests and replies: addresses up to an empty frame, then what comes back as it was sent.
// What has no such frame, or nothing behind it, is no request and has no answer.
TEST_F(kernel, heartbeats_of_any_number_of_frames_come_back_and_end_nothing) {
    using Frames = std::vector<std::string>;
    client().run("kept = 7");
    RawSocket raw(client(), 5);
    for (const Frames& beat : {Frames{"", "a", "b"}, Frames{"", ""}, Frames{"", "", "", ""}, Frames{"x", "", "a", "b"},
                               Frames(1000), Frames{"", std::string(1 << 20, 'x'), "y"}}) {
        for (const Frames& none : {Frames{""}, Frames{"a"}, Frames{"a", "b"}}) raw.send(none);
        raw.send(beat);
        EXPECT_EQ(raw.answer(), beat) << beat.size();
    }
    EXPECT_TRUE(client().beats());
    EXPECT_EQ(client().run("print(kept)").printed, "7\n");
}

// oracle: the kernel's answers to its client; the frames are those that the sockets' patterns and Jupyter's mark know
TEST_F(kernel, odd_frames_without_the_key_end_nothing) {
    client().run("kept = 8");
    for (const int port : {1, 3, 4}) {
        RawSocket raw(client(), port);
        for (const std::vector<std::string>& frames : std::vector<std::vector<std::string>>{
                 {""}, {"a"}, {"", ""}, {"<IDS|MSG>"}, {"<IDS|MSG>", "", "{}", "{}", "{}", "{}", ""}})
            raw.send(frames);
        raw.send(std::vector<std::string>(1000));
        for (const bool control : {true, false})
            EXPECT_EQ(client().answer("kernel_info_request", {}, control)["status"], "ok");
    }
    EXPECT_TRUE(client().beats());
    EXPECT_EQ(client().run("print(kept)").printed, "8\n");
}

// oracle: the cell counts its runs; a process that can read a message can also send it again
TEST_F(kernel, a_message_that_comes_again_is_not_answered) {
    MessageWire& ours = client().wire();
    client().run("times = 0");
    const auto frames = ours.write(ours.made("execute_request", {{"code", "times = times + 1"}}, {}));
    for (int i = 0; i < 3; ++i) client().send(frames);
    EXPECT_EQ(client().run("print(times)").printed, "1\n");
    EXPECT_THAT(client().complaints(), HasSubstr("not answered: a message was received twice"));
}

// oracle: the memory use of the kernel; a sender needs no key
TEST_F(kernel, a_frame_of_many_megabytes_is_not_taken) {
    const double before = megabytes_of(client().process());
    client().send({"<IDS|MSG>", std::string(200 << 20, 'x'), "{}", "{}", "{}", "{}"});
    EXPECT_EQ(client().run("print(3)").printed, "3\n");
    EXPECT_LT(megabytes_of(client().process()), before + 100);
}

TEST_F(kernel, a_cell_that_ends_its_process_is_reported_and_the_next_runs) {
    client().run("kept = 1");
    const std::string id = client().start(kEndless);
    client().await_output(id);
    ::kill(cells_process(client().process()), SIGABRT);  // SIGSEGV is caught by the address sanitizer
    const auto ran = client().finish(id);
    EXPECT_EQ(ran.reply["ename"], "process ended");
    EXPECT_THAT(ran.reply["evalue"].get<std::string>(),
                AllOf(HasSubstr("signal 6"), HasSubstr("Its variables are lost; the next cell starts a new process")));
    EXPECT_THAT(client().run("print(kept)").reply.dump(), HasSubstr("unknown function or variable"));
    // Between cells, too: the next says so, and the one behind it runs.
    ::kill(cells_process(client().process()), SIGKILL);
    EXPECT_EQ(client().run("print(1)").reply["ename"], "process ended");
    EXPECT_EQ(client().run("print(2)").printed, "2\n");
    EXPECT_GT(cells_process(client().process()), 0);  // one, and nothing is left of those before
}

/// Memory of the kernel and of its cells' process after some cells and after many more.
void expect_no_growth(int cells) {
    KernelClient client;
    const auto run = [&](int count) {
        for (int i = 0; i < count; ++i) {
            const auto ran = client.run("local v = zeros(1000)\nlocal t = {}\nprint(" + std::to_string(i) + ")\n1 + 1");
            ASSERT_EQ(ran.printed, std::to_string(i) + "\n");
        }
    };
    const auto megabytes = [&] {
        client.run("collectgarbage()");
        return megabytes_of(client.process()) + megabytes_of(cells_process(client.process()));
    };
    run(cells / 5);
    const double before = megabytes();
    run(cells - cells / 5);
    const double after = megabytes();
    std::printf("%d cells: %.1f MB, then %.1f MB\n", cells, before, after);
    EXPECT_LT(after, before + 3);
}

TEST(kernel_memory, does_not_grow_with_500_cells) {
    expect_no_growth(500);
}

TEST(kernel_of_many_cells, does_not_grow_with_10000) {
    expect_no_growth(10'000);
}

TEST(kernel_end, comes_when_it_is_asked_for_even_while_a_cell_runs) {
    KernelClient client;
    const pid_t cells = cells_process(client.process());
    client.await_output(client.start(kEndless));
    EXPECT_EQ(client.answer("shutdown_request", {{"restart", true}}, true),
              (json{{"status", "ok"}, {"restart", true}}));
    EXPECT_TRUE(client.ends_within(5));
    for (int i = 0; i < 500 && ::kill(cells, 0) == 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_NE(::kill(cells, 0), 0);
}

}  // namespace test_kernel
