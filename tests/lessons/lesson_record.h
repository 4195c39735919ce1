#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "platform/atomic_file.h"
#include "support/lesson_list.h"
#include "support/program.h"

namespace dynlab::test {

/// The results of a lesson's reference solution, as `dynlab run` writes them (documents/run_record.h). The solution
/// runs once for all tests of a build, and again after a change of the program, the lesson or the data.
inline nlohmann::json record_of_lesson(const std::string& lesson) {
    const Workbench bench(Workbench::Memory::kShared);
    const std::filesystem::path folder = bench.cache() / "records" / lesson;
    std::filesystem::create_directories(folder);
    const std::string lesson_files = lesson_folder(lesson).string();
    const ChildResult run =
        bench.shell("set -e; cd '" + folder.string() + "'; exec 9>lock; flock 9\n" +
                    "changed() { find \"$(dirname \"$DYNLAB\")\" -maxdepth 1 -name '*dynlab*' -newer record.json; "
                    "find '" +
                    lesson_files +
                    "' \"$DYNLAB_HOME/data\" -newer record.json; }\n"
                    "[ -e record.json ] && [ -z \"$(changed)\" ] && exit 0\n"
                    "rm -f record.json; $DYNLAB run '" +
                    lesson_files + "/lesson.lua' --out . || { rm -f record.json; exit 1; }");
    EXPECT_EQ(run.exit_code, 0) << run.error_output;
    return nlohmann::json::parse(read_file(folder / "record.json"));
}

/// A lesson's task sheet as a PDF, in a language. Made once for all tests.
inline std::string shared_sheet(const std::string& lesson, const std::string& language = "en") {
    std::vector<std::string> command{"sheet", lesson};
    if (language != "en") command.insert(command.end(), {"--lang", language});
    return shared_document(command, lesson + "_sheet." + language + ".pdf");
}

/// A value that the solution reports.
inline double number(const nlohmann::json& record, const std::string& name) {
    return record.at("values").at(name).at("number");
}

}  // namespace dynlab::test
