// A notebook in Jupyter's own page, in a real browser. Oracle: what a reader sees there.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <cstdlib>

#include "platform/system_call.h"
#include "support/browser.h"
#include "support/program.h"

namespace test_kernel_browser {
using namespace dynlab;
using namespace dynlab::test;

int free_port() {
    const FileDescriptor socket(::socket(AF_INET, SOCK_STREAM, 0));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    ::bind(socket.get(), reinterpret_cast<sockaddr*>(&address), size);
    ::getsockname(socket.get(), reinterpret_cast<sockaddr*>(&address), &size);
    return ntohs(address.sin_port);
}

ChildOptions notebook_server(const Workbench& bench, const std::string& port) {
    ChildOptions options;
    options.command = {"/usr/bin/jupyter-notebook",
                       "--no-browser",
                       "--ip=127.0.0.1",
                       "--port=" + port,
                       "--NotebookApp.token=t",
                       "--allow-root",
                       "--NotebookApp.port_retries=0"};
    options.folder = bench.path();
    for (const char* variable : {"JUPYTER_DATA_DIR", "JUPYTER_RUNTIME_DIR", "JUPYTER_CONFIG_DIR", "IPYTHONDIR"})
        options.environment.emplace_back(variable, bench.path("jupyter").string());
    options.environment.emplace_back("DYNLAB_HOME", DYNLAB_SOURCE_DIR);
    options.environment.emplace_back("XDG_CACHE_HOME", bench.path("cache").string());
    options.environment.emplace_back("XDG_STATE_HOME", bench.path("state").string());
    return options;
}

TEST(kernel_browser, shows_values_figures_formulas_stops_and_goes_on) {
    const Workbench bench;
    bench.write("a.lua",
                "-- ---\n-- title: T\n-- ---\n\n-- %% [markdown]\n-- # A record\n\n-- %%\nlocal x = 21\nprint(2*x)\n\n"
                "-- %%\nplot({1, 2, 3}, {1, 4, 9}, {title = \"Squares\"})\n\n-- %%\ntf({2}, {1, 0.5, 1})\n\n"
                "-- %%\nprint(\"on the way\")\nwhile x == 21 do end\n\n-- %%\nprint(\"not reached\")\n");
    ASSERT_EQ(bench.dynlab({"notebook", "a.lua"}).exit_code, 0);
    ASSERT_EQ(bench.shell("JUPYTER_DATA_DIR=$PWD/jupyter $DYNLAB kernel install").exit_code, 0);
    const std::string port = std::to_string(free_port());
    ChildProcess server(notebook_server(bench, port), "jupyter-notebook");
    ASSERT_EQ(bench
                  .shell("bash -c 'for i in $(seq 300); do (: < /dev/tcp/127.0.0.1/" + port +
                         ") && exit 0; sleep 0.1; done; exit 1' 2> /dev/null")
                  .exit_code,
              0);
    Browser browser;
    browser.open("http://127.0.0.1:" + port + "/notebooks/a.ipynb?token=t");
    ASSERT_TRUE(
        browser.becomes_true("window.Jupyter && Jupyter.notebook && Jupyter.notebook.kernel && "
                             "Jupyter.notebook.kernel.is_connected() && Jupyter.notebook.get_cells().length === 7"));
    const auto output_of = [](int cell, const std::string& says) {
        return "document.querySelectorAll('.cell')[" + std::to_string(cell) + "].querySelector('.output')?." + says;
    };
    browser.evaluate("Jupyter.notebook.execute_all_cells()");
    EXPECT_TRUE(browser.becomes_true(output_of(2, "innerText.includes('42')")));
    EXPECT_TRUE(browser.becomes_true(output_of(3, "querySelector('svg, img')?.getBoundingClientRect().width > 100")));
    EXPECT_TRUE(browser.becomes_true(output_of(4, "querySelector('.output_latex')")));
    EXPECT_TRUE(browser.becomes_true(output_of(5, "innerText.includes('on the way')")));
    browser.click("button[data-jupyter-action='jupyter-notebook:interrupt-kernel']");
    EXPECT_TRUE(browser.becomes_true(output_of(5, "innerText.includes('interrupted')")));
    EXPECT_TRUE(
        browser.becomes_true("Jupyter.notebook.get_cell(6).get_text().includes('not reached') && "
                             "!document.body.innerText.includes('not reached\\n\\n')"));
    if (const char* folder = std::getenv("DYNLAB_SCREENSHOTS"))
        browser.photograph(std::string(folder) + "/notebook.png");
    // The cell is changed, and runs; what a cell kept is still there.
    browser.evaluate(
        "Jupyter.notebook.get_cell(5).set_text('print(x + 1)'); Jupyter.notebook.select(5); "
        "Jupyter.notebook.execute_cell()");
    EXPECT_TRUE(browser.becomes_true(output_of(5, "innerText.includes('22')")));
    if (const char* folder = std::getenv("DYNLAB_SCREENSHOTS")) {
        browser.evaluate("document.querySelectorAll('.cell')[5].scrollIntoView()");
        browser.photograph(std::string(folder) + "/notebook_end.png");
    }
}

}  // namespace test_kernel_browser
