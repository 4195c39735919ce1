// The kernel with Jupyter's own programs: jupyter_kernel_test, jupyter_client, nbconvert. Oracle: these.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/program.h"

namespace test_kernel_clients {
using namespace dynlab;
using namespace dynlab::test;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A folder whose Jupyter knows the built program's kernel.
class kernel_clients : public testing::Test {
  protected:
    ChildResult jupyter(const std::string& command) const {
        return bench.shell(
            "export JUPYTER_DATA_DIR=$PWD/jupyter JUPYTER_RUNTIME_DIR=$PWD/run JUPYTER_CONFIG_DIR=$PWD/config "
            "IPYTHONDIR=$PWD/ipython PYTHONWARNINGS=ignore; " +
            command);
    }
    void SetUp() override {
        const ChildResult installed = jupyter("$DYNLAB kernel install");
        ASSERT_EQ(installed.exit_code, 0) << installed.error_output;
    }
    ChildResult python(const std::string& script) const {
        return jupyter("/usr/bin/python3 " +
                       (std::filesystem::path(DYNLAB_SOURCE_DIR) / "tests/app" / script).string());
    }
    Workbench bench;
};

TEST_F(kernel_clients, jupyter_kernel_test_finds_no_fault) {
    const ChildResult tried = python("kernel_conformance.py");
    EXPECT_EQ(tried.exit_code, 0) << tried.error_output;
    EXPECT_THAT(tried.error_output, HasSubstr("OK"));
}

TEST_F(kernel_clients, jupyter_client_interrupts_and_restarts_it) {
    const ChildResult tried = python("kernel_sessions.py");
    EXPECT_EQ(tried.exit_code, 0) << tried.output << tried.error_output;
    std::printf("%s", tried.output.c_str());
}

TEST_F(kernel_clients, nbconvert_runs_a_notebook_and_makes_a_page_of_it) {
    bench.write("a.lua",
                "-- %% [markdown]\n-- # A head\n\n-- %%\nlocal x = 21\nprint(2*x)\n\n-- %%\nplot({1, 2}, {1, x})\n\n"
                "-- %%\ntf(1, {1, 2})\n");
    EXPECT_EQ(bench.dynlab({"notebook", "a.lua"}).exit_code, 0);
    const ChildResult made = jupyter("/usr/bin/python3 -m nbconvert --execute --to html a.ipynb");
    ASSERT_EQ(made.exit_code, 0) << made.error_output;
    EXPECT_THAT(bench.read("a.html"),
                AllOf(HasSubstr("42"), HasSubstr("<svg"), HasSubstr("\\frac{1}{s + 2}"), HasSubstr("A head")));
}

TEST_F(kernel_clients, doctor_reports_whether_the_kernel_is_there) {
    const auto reported = [&] { return jupyter("$DYNLAB doctor | grep Jupyter").output; };
    EXPECT_THAT(reported(), AllOf(HasSubstr("ok"), HasSubstr("installed\n")));
    EXPECT_EQ(jupyter("$DYNLAB kernel remove").exit_code, 0);
    EXPECT_THAT(reported(), HasSubstr("not installed (dynlab kernel install"));
    EXPECT_EQ(jupyter("$DYNLAB kernel remove").exit_code, 1);
    bench.write("jupyter/kernels/dynlab/kernel.json", R"({"argv": ["/nowhere/dynlab"]})");
    EXPECT_THAT(reported(), AllOf(HasSubstr("--"), HasSubstr("/nowhere/dynlab does not exist")));
    bench.write("jupyter/kernels/dynlab/kernel.json", "[");
    EXPECT_THAT(reported(), HasSubstr("not installed"));
    bench.write("c.json", "{\"ip\": 3}");
    EXPECT_THAT(jupyter("$DYNLAB kernel run c.json").error_output,
                HasSubstr("not a Jupyter connection file. Do not start the kernel yourself"));
    bench.write("c.json", R"({"ip": "127.0.0.1", "key": "", "shell_port": 1, "control_port": 2, "stdin_port": 3,)"
                          R"( "iopub_port": 4, "hb_port": 5})");
    EXPECT_THAT(jupyter("$DYNLAB kernel run c.json").error_output, HasSubstr("c.json has no key"));
}

}  // namespace test_kernel_clients
