// Every kind of mistake that a student of the course may bring along stops with a message that names its remedy.
// Oracle: student_scripts.txt, written by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "platform/temporary_folder.h"
#include "script_run.h"

namespace test_student_scripts {

using namespace dynlab;
using dynlab::test::error_of;
using testing::HasSubstr;

struct StudentScript {
    std::string group, code, remedy;
};

constexpr const char* kDataSet =
    "local u = prbs(6, 4)\nlocal G = tf({2}, {1, 3, 2})\nlocal d = iddata(lsim(G, u, 0.1), u, 0.1)\n";

std::vector<StudentScript> student_scripts() {
    std::vector<StudentScript> scripts;
    std::string group, code;
    bool head = true;  // of the file
    for (const std::string& line :
         lines_of(read_file(std::string(DYNLAB_SOURCE_DIR) + "/tests/scripting/student_scripts.txt"))) {
        if (line.starts_with("== ")) {
            group = line.substr(3);
            head = false;
        } else if (line.starts_with("=> ")) {
            scripts.push_back({group, code.starts_with('@') ? kDataSet + code.substr(1) : code, line.substr(3)});
            code.clear();
        } else if (!head && !line.empty()) {
            code += line + "\n";
        }
    }
    return scripts;
}

TEST(student_scripts, are_answered_with_the_remedy) {
    const TemporaryFolder folder;
    RunOptions options;
    options.out_folder = options.script_folder = folder.path();
    const std::vector<StudentScript> scripts = student_scripts();
    EXPECT_GE(scripts.size(), 205u);
    for (const StudentScript& script : scripts)
        EXPECT_THAT(error_of(script.code, options), HasSubstr(script.remedy)) << script.group << ":\n" << script.code;
}

}  // namespace test_student_scripts
