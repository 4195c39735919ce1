#include "data_io/dataset_index.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "data_io/csv_file.h"
#include "data_io/mat_file.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"
#include "sample_variables.h"
#include "support/environment_variable.h"

namespace dynlab {
namespace test_dataset_index {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;

/// An installation with two data sets, and a folder of scripts.
class dataset_index : public testing::Test {
  protected:
    void SetUp() override {
        folder_before_ = fs::current_path();
        fs::current_path(project_.path());
        add_set(home_.path() / "data", "heat_exchanger", "Course file: heatexchanger_data.mat\n");
        add_set(home_.path() / "data", "step_response", "Text.\nCourse file: step_reponse_data.mat, step_data.mat\n");
        fs::create_directories(home_.path() / "data/not_a_set");
    }
    void TearDown() override { fs::current_path(folder_before_); }

    static void add_set(const fs::path& data, const std::string& name, const std::string& source) {
        fs::create_directories(data / name);
        write_file_atomically(data / name / "SOURCE.md", source);
        write_file_atomically(data / name / (name + ".csv"), "# Ts: 0.5\n# unit y: deg C\ny,label\n1,one\n2,two\n");
    }
    static void write_mat(const fs::path& file, double marker) {
        VariableTable variables;
        variables["y"] = {marker};
        write_mat_file(file, variables);
    }
    LoadedData load(const std::string& name, bool graded = false) { return load_data(name, scripts_.path(), graded); }
    std::string complaint(const std::string& name, bool graded = false) {
        return complaint_in(scripts_.path(), name, graded);
    }
    static std::string complaint_in(const fs::path& folder, const std::string& name, bool graded = false) {
        try {
            load_data(name, folder, graded);
        } catch (const EnvironmentError& error) {
            return error.what();
        }
        return "no error";
    }

    TemporaryFolder home_, project_, scripts_;
    test::EnvironmentVariable home_variable_{"DYNLAB_HOME", home_.path()};
    fs::path folder_before_;
};

TEST_F(dataset_index, loads_a_table_by_name) {
    const LoadedData data = load("heat_exchanger");
    EXPECT_EQ(std::get<Vector>(data.variables.at("y").value), (Vector{{1, 2}}));
    const auto labels = std::get<std::shared_ptr<VariableList>>(data.variables.at("label").value);
    EXPECT_EQ(std::get<std::string>(labels->at(1).value), "two");
    EXPECT_EQ(std::get<double>(data.variables.at("Ts").value), 0.5);
    EXPECT_EQ(data.units.at("y"), "deg C");
    EXPECT_EQ(data.file, home_.path() / "data/heat_exchanger/heat_exchanger.csv");
}

TEST_F(dataset_index, knows_the_course_names) {
    const fs::path file = load("heat_exchanger").file;
    EXPECT_EQ(load("heatexchanger_data.mat").file, file);
    EXPECT_EQ(load("heatexchanger_data").file, file);
    EXPECT_EQ(load("step_reponse_data.mat").file, load("step_response").file);
    EXPECT_EQ(load("step_data").file, load("step_response").file);
}

TEST_F(dataset_index, prefers_the_original_of_the_course) {
    const fs::path folder = home_.path() / "data/heat_exchanger";
    write_mat(folder / "heat_exchanger.mat", 3);
    EXPECT_EQ(load("heat_exchanger").file, folder / "heat_exchanger.csv");
    EXPECT_EQ(load("heat_exchanger.mat").file, folder / "heat_exchanger.mat");
    write_mat(folder / "heatexchanger_data.mat", 4);
    for (const char* name : {"heat_exchanger", "heatexchanger_data.mat"}) {
        const LoadedData data = load(name);
        EXPECT_EQ(data.file, folder / "heatexchanger_data.mat");
        EXPECT_EQ(std::get<double>(data.variables.at("y").value), 4);
    }
    EXPECT_EQ(load("heat_exchanger.csv").file, folder / "heat_exchanger.csv");
}

TEST_F(dataset_index, searches_script_then_project_then_installation) {
    EXPECT_EQ(load("heat_exchanger").file.string().rfind(home_.path().string(), 0), 0u);
    add_set(project_.path() / "data", "heat_exchanger", "Mine.\n");
    EXPECT_TRUE(fs::equivalent(load("heat_exchanger").file.parent_path(), project_.path() / "data/heat_exchanger"));
    add_set(scripts_.path() / "data", "heat_exchanger", "Mine.\n");
    EXPECT_EQ(load("heat_exchanger").file.parent_path(), scripts_.path() / "data/heat_exchanger");
    write_mat(scripts_.path() / "heat_exchanger.mat", 5);
    EXPECT_EQ(load("heat_exchanger").file, scripts_.path() / "heat_exchanger.mat");
    write_mat(scripts_.path() / "heatexchanger_data.mat", 6);
    EXPECT_EQ(load("heatexchanger_data.mat").file, scripts_.path() / "heatexchanger_data.mat");
}

TEST_F(dataset_index, loads_files_by_path) {
    fs::create_directories(scripts_.path() / "records");
    write_mat(scripts_.path() / "records/a.MAT", 7);
    EXPECT_EQ(std::get<double>(load("records/a.MAT").variables.at("y").value), 7);
    EXPECT_EQ(std::get<double>(load((scripts_.path() / "records/a.MAT").string()).variables.at("y").value), 7);
    write_file_atomically(scripts_.path() / "b.csv", "y\n1\n");
    EXPECT_EQ(std::get<Vector>(load("b.csv").variables.at("y").value).size(), 1);
    EXPECT_EQ(std::get<Vector>(load("b").variables.at("y").value).size(), 1);
}

TEST_F(dataset_index, unknown_names_list_the_known_ones_unless_one_is_near) {
    EXPECT_EQ(complaint("heat_exchangr"), "unknown data set \"heat_exchangr\"; did you mean \"heat_exchanger\"?");
    EXPECT_EQ(complaint("pendulum"),
              "unknown data set \"pendulum\"; the data sets are heat_exchanger, step_response. dynlab searches " +
                  scripts_.path().string() + " for your own files");
    EXPECT_THAT(complaint_in(scripts_.path() / ".", "pendulum"),
                EndsWith("searches " + scripts_.path().string() + " for your own files"));
    EXPECT_EQ(complaint("heat_exchanger_data"),
              "unknown data set \"heat_exchanger_data\"; did you mean \"heatexchanger_data.mat\"?");
    EXPECT_THAT(complaint("step_respose.csv"), HasSubstr("did you mean \"step_response\"?"));
    EXPECT_EQ(complaint("records/none.csv"), "file not found: " + (scripts_.path() / "records/none.csv").string());
    write_file_atomically(scripts_.path() / "notes.doc", "x");
    for (const char* name : {"./notes.doc", "notes.doc"})
        EXPECT_THAT(complaint(name),
                    HasSubstr("notes.doc has an unsupported file type; supported types are .mat, .xlsx, .csv,"));
    for (const char* name : {"", ".", "..", "not_a_set"}) EXPECT_NE(complaint(name), "no error") << name;
}

// oracle: the names of the files; the ending must neither hide a file nor make two names similar
TEST_F(dataset_index, missing_files_suggest_the_nearest_file_of_the_script_folder) {
    fs::create_directories(scripts_.path() / "records");
    for (const char* file : {"measured.csv", "second.xlsx", "a.csv", "measured_notes.txt", "records/first.csv"})
        write_file_atomically(scripts_.path() / file, "y\n1\n");
    add_set(scripts_.path() / "data", "own_kiln", "Mine.\n");
    const auto missing = [&](const std::string& name, const std::string& meant) {
        return "file not found: " + (scripts_.path() / name).string() + "; did you mean \"" + meant + "\"?";
    };
    EXPECT_EQ(complaint("mesured.csv"), missing("mesured.csv", "measured.csv"));
    EXPECT_EQ(complaint("measured.mat"), missing("measured.mat", "measured.csv"));
    EXPECT_EQ(complaint("secnd.xlsx"), missing("secnd.xlsx", "second.xlsx"));
    EXPECT_EQ(complaint("records/frist.csv"), missing("records/frist.csv", "records/first.csv"));
    EXPECT_EQ(complaint("mesured"), "unknown data set \"mesured\"; did you mean \"measured.csv\"?");
    EXPECT_EQ(complaint("own_klin"), "unknown data set \"own_klin\"; did you mean \"own_kiln\"?");
    EXPECT_THAT(complaint("b.csv"), HasSubstr("unknown data set \"b.csv\"; the data sets are"));
}

// oracle: a script must not learn the names of files outside of its folder
TEST_F(dataset_index, missing_files_elsewhere_suggest_nothing) {
    write_file_atomically(project_.path() / "measured.csv", "y\n1\n");
    const std::string file = (project_.path() / "mesured.csv").string();
    EXPECT_EQ(complaint(file), "file not found: " + file);
    fs::create_directory_symlink(project_.path(), scripts_.path() / "link");
    EXPECT_EQ(complaint("link/mesured.csv"), "file not found: " + (scripts_.path() / "link/mesured.csv").string());
}

TEST_F(dataset_index, lists_the_installed_sets) {
    EXPECT_THAT(dataset_names(), ElementsAre("heat_exchanger", "step_response"));
}

TEST_F(dataset_index, damaged_files_of_a_student_are_refused) {
    write_mat(scripts_.path() / "mine.mat", 1);
    const std::string bytes = read_file(scripts_.path() / "mine.mat");
    write_file_atomically(scripts_.path() / "mine.mat", bytes.substr(0, bytes.size() - 3));
    EXPECT_THAT(complaint("mine.mat"), HasSubstr("is truncated"));
}

TEST_F(dataset_index, says_how_to_get_a_record_of_a_package) {
    const fs::path folder = home_.path() / "data/kiln";
    fs::create_directories(folder);
    write_file_atomically(folder / "SOURCE.md", "A kiln\n\nPackage: no-kilns-here /nowhere/kiln.gz 10 samples 0.5 s\n");
    EXPECT_EQ(complaint("kiln"),
              "this data set is part of the Debian package no-kilns-here, which is not installed: run sudo apt-get "
              "install no-kilns-here");
    EXPECT_EQ(missing_package("kiln"), "no-kilns-here");
    EXPECT_EQ(missing_package("heat_exchanger"), std::nullopt);
    write_file_atomically(folder / "SOURCE.md", "A kiln\n\nPackage: nothing but words\n");
    EXPECT_THAT(complaint("kiln"), HasSubstr("unknown data set \"kiln\""));
    write_file_atomically(folder / "SOURCE.md", "A kiln\n\nPackage: libc6 /nowhere/kiln.gz 10 samples 0.5 s\n");
    write_mat(folder / "kiln.mat", 8);
    EXPECT_EQ(std::get<double>(load("kiln").variables.at("y").value), 8);
    EXPECT_EQ(missing_package("kiln"), std::nullopt);
}

// oracle: a file elsewhere, which must not be read
TEST_F(dataset_index, course_files_lie_in_the_data_sets_own_folder) {
    write_mat(project_.path() / "elsewhere.mat", 9);
    const fs::path data = scripts_.path() / "data";
    fs::create_directories(data / "mine/deeper");
    write_mat(data / "mine/deeper/elsewhere.mat", 9);
    for (const std::string& path :
         {(project_.path() / "elsewhere.mat").string(),
          "../../../" + project_.path().filename().string() + "/elsewhere.mat", std::string("deeper/elsewhere.mat")}) {
        write_file_atomically(data / "mine/SOURCE.md", "Mine.\nCourse file: " + path + "\n");
        for (const char* name : {"mine", "elsewhere.mat", "elsewhere"})
            EXPECT_EQ(complaint(name), (data / "mine/SOURCE.md").string() +
                                           ": \"Course file:\" must be followed by names of files in the folder of the "
                                           "data set, but the path \"" +
                                           path + "\" was given");
    }
    write_file_atomically(data / "mine/SOURCE.md", "Mine.\nCourse file: elsewhere.mat\n");
    write_mat(data / "mine/elsewhere.mat", 8);
    EXPECT_EQ(std::get<double>(load("mine").variables.at("y").value), 8);
}

// oracle: definition; whether a file is there must not be found out by naming it as a package's
TEST_F(dataset_index, packages_are_named_by_the_installation_only) {
    const auto source = [](const fs::path& file) {
        return "A kiln\n\nPackage: no-kilns-here " + file.string() + " 10 samples 0.5 s\n";
    };
    const fs::path mine = scripts_.path() / "data/kiln", there = project_.path() / "there.gz";
    write_file_atomically(there, "title\nsettings\n1\n2\n");
    fs::create_directories(mine);
    for (const fs::path& file : {there, project_.path() / "not_there.gz"}) {
        write_file_atomically(mine / "SOURCE.md", source(file));
        EXPECT_THAT(complaint("kiln"), HasSubstr("unknown data set \"kiln\""));
    }
    // A copy of an installed data set, as in a lesson's bundle, still refers to the installed one.
    fs::create_directories(home_.path() / "data/kiln");
    write_file_atomically(home_.path() / "data/kiln/SOURCE.md", source("/nowhere/kiln.gz"));
    EXPECT_THAT(complaint("kiln"), HasSubstr("this data set is part of the Debian package no-kilns-here"));
}

// oracle: the file that the links point to, which is readable outside of grading
TEST_F(dataset_index, links_lead_a_graded_script_nowhere) {
    write_mat(project_.path() / "elsewhere.mat", 9);
    fs::create_symlink(project_.path() / "elsewhere.mat", scripts_.path() / "link.mat");
    fs::create_directory_symlink(project_.path(), scripts_.path() / "records");
    fs::create_directories(scripts_.path() / "data/mine");
    write_file_atomically(scripts_.path() / "data/mine/SOURCE.md", "Mine.\n");
    fs::create_symlink(project_.path() / "elsewhere.mat", scripts_.path() / "data/mine/mine.mat");
    for (const char* name : {"link", "link.mat", "records/elsewhere.mat", "mine", "mine.mat"}) {
        EXPECT_EQ(std::get<double>(load(name).variables.at("y").value), 9) << name;
        EXPECT_THAT(complaint(name, true), HasSubstr("is outside the folder")) << name;
    }
    write_mat(scripts_.path() / "own.mat", 7);
    fs::create_symlink("own.mat", scripts_.path() / "own_link.mat");
    for (const char* name : {"own", "own_link.mat", "heat_exchanger"}) EXPECT_EQ(complaint(name, true), "no error");
}

TEST_F(dataset_index, refusal_to_leave_the_folder_is_known_where_another_message_quotes_it) {
    const Message refusal = refusal_outside("../a.csv");
    EXPECT_TRUE(is_refusal_outside(refusal));
    EXPECT_TRUE(is_refusal_outside(Message("{}: {}", "load", Message("{}{}", "a.lua:3: ", refusal))));
    EXPECT_FALSE(is_refusal_outside(Message("{}: {}", "load", message_text(refusal)))) << "the same words";
}

TEST_F(dataset_index, refuses_damaged_records_of_packages) {
    const fs::path folder = home_.path() / "data/kiln", file = folder / "kiln.gz";
    fs::create_directories(folder);
    write_file_atomically(folder / "SOURCE.md", "A kiln\n\nPackage: kilns " + file.string() + " 10 samples 0.5 s\n");
    write_file_atomically(file, "title\nsettings\n1\n2\n");
    EXPECT_THAT(complaint("kiln"),
                HasSubstr("kiln.gz ends early or contains text at input sample 1 of 10: reinstall the package kilns"));
}

// Facts: 1000 samples, a binary input of 3.41 and 6.41, one sample every 0.08 s; first and last values of the file.
TEST(hairdryer, holds_the_facts) {
    const LoadedData data = load_data("hairdryer", "/");
    const Vector u = std::get<Vector>(data.variables.at("u").value), y = std::get<Vector>(data.variables.at("y").value);
    ASSERT_EQ(u.size(), 1000);
    ASSERT_EQ(y.size(), 1000);
    for (double level : u) EXPECT_TRUE(level == 3.41 || level == 6.41) << level;
    EXPECT_EQ(u[0], 6.41);
    EXPECT_EQ(u[1], 3.41);
    EXPECT_EQ(y[999], 4.683079);
    EXPECT_EQ(std::get<double>(data.variables.at("Ts").value), 0.08);
}

// Facts: 1024 samples; first values of the file. Second route: the outputs end where the example's seeds begin.
TEST(robot_arm, holds_the_facts) {
    const LoadedData data = load_data("robot_arm", "/");
    const Vector u = std::get<Vector>(data.variables.at("u").value), y = std::get<Vector>(data.variables.at("y").value);
    ASSERT_EQ(u.size(), 1024);
    ASSERT_EQ(y.size(), 1024);
    EXPECT_EQ(u[0], 2.2183165e-01);
    EXPECT_EQ(u[1], 3.9027807e-02);
    EXPECT_LT(y.cwiseAbs().maxCoeff(), 10);  // the seeds are 1998 and 1999
    EXPECT_EQ(std::get<double>(data.variables.at("Ts").value), 1);
}

// Facts: 30 Games from 1896 to 2024, none in 1916, 1940 and 1944; automatic timing since 1968; best times of 1968 and
// 2012.
TEST(winning_times, hold_the_facts) {
    const LoadedData data = load_data("winning_time.mat", "/");
    EXPECT_EQ(data.file, fs::path(getenv("DYNLAB_HOME")) / "data/winning_times/winning_times.csv");
    const Vector year = std::get<Vector>(data.variables.at("year").value);
    const Vector time = std::get<Vector>(data.variables.at("time").value);
    ASSERT_EQ(year.size(), 30);
    std::vector<double> games;
    for (double y = 1896; y <= 2024; y += 4) {
        if (y != 1916 && y != 1940 && y != 1944) games.push_back(y);
    }
    EXPECT_EQ(std::vector<double>(year.begin(), year.end()), games);
    const auto timing = std::get<std::shared_ptr<VariableList>>(data.variables.at("timing").value);
    for (Index i = 0; i < 30; ++i) {
        const bool automatic = std::get<std::string>(timing->at(static_cast<std::size_t>(i)).value) == "auto";
        EXPECT_EQ(automatic, year[i] >= 1968) << year[i];
        const double decimals = automatic ? 100 : 10;
        EXPECT_NEAR(std::round(time[i] * decimals), time[i] * decimals, 1e-9) << year[i];
    }
    EXPECT_EQ(time[0], 12.0);
    EXPECT_EQ(time[15], 9.95);
    EXPECT_EQ(time.minCoeff(), 9.63);
    EXPECT_EQ(time[29], 9.79);
    EXPECT_EQ(data.units.at("time"), "s");
    EXPECT_EQ(std::get<std::shared_ptr<VariableList>>(data.variables.at("athlete").value)->size(), 30u);
}

// Oracle: a second route; both files of the set must say the same.
TEST(winning_times, are_the_same_in_both_files) {
    const LoadedData csv = load_data("winning_times.csv", "/"), mat = load_data("winning_times.mat", "/");
    EXPECT_EQ(mat.file.filename(), "winning_times.mat");
    EXPECT_TRUE(equal(mat.variables, csv.variables));
}

}  // namespace test_dataset_index
}  // namespace dynlab
