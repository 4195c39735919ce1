#include <gtest/gtest.h>
#include <matio.h>
#include <sys/resource.h>

#include <chrono>
#include <random>

#include "data_io/mat_file.h"
#include "data_io/mat_variable.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"
#include "sample_variables.h"

namespace dynlab {
namespace test_mat_mutations {

// Oracle: the contract. Whatever the bytes, reading gives variables or an EnvironmentError, and this process lives on.
std::chrono::seconds processor_time_of_children() {
    rusage use = {};
    ::getrusage(RUSAGE_CHILDREN, &use);
    return std::chrono::seconds(use.ru_utime.tv_sec + use.ru_stime.tv_sec);
}

void read_mutations(mat_ft version, matio_compression compression, const VariableTable& variables, int trials) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "x.mat";
    {
        const MatFile mat(Mat_CreateVer(file.c_str(), "MATLAB 5.0 MAT-file, of a test", version));
        for (const auto& [name, variable] : variables) {
            ASSERT_EQ(Mat_VarWrite(mat.get(), to_mat(variable, name).get(), compression), 0) << name;
        }
    }
    const std::string bytes = read_file(file);
    std::mt19937 random(20240611);
    int refused = 0;
    for (int trial = 0; trial < trials; ++trial) {
        std::string wrong = bytes;
        for (unsigned k = 0; k <= random() % 8; ++k) wrong[random() % wrong.size()] = static_cast<char>(random());
        write_file_atomically(file, wrong);
        const auto before = processor_time_of_children();
        try {
            read_mat_file(file);
        } catch (const EnvironmentError& error) {
            ++refused;
            EXPECT_EQ(std::string(error.what()).rfind(file.string(), 0), 0u) << error.what();
        }
        EXPECT_LT(processor_time_of_children() - before, std::chrono::seconds(10));
    }
    testing::Test::RecordProperty("refused", refused);
    EXPECT_GT(refused, 0);
}

VariableTable plain_variables() {
    VariableTable plain;
    for (const char* name : {"number", "vector", "matrix", "complex_matrix"}) plain[name] = sample_variables()[name];
    return plain;
}

TEST(mat_mutations, level_4) {
    read_mutations(MAT_FT_MAT4, MAT_COMPRESSION_NONE, plain_variables(), 100);
}
TEST(mat_mutations, level_5) {
    read_mutations(MAT_FT_MAT5, MAT_COMPRESSION_NONE, sample_variables(), 100);
}
TEST(mat_mutations, level_5_compressed) {
    read_mutations(MAT_FT_MAT5, MAT_COMPRESSION_ZLIB, sample_variables(), 100);
}
TEST(mat_mutations, level_7_3) {
    read_mutations(MAT_FT_MAT73, MAT_COMPRESSION_NONE, sample_variables(), 100);
}

}  // namespace test_mat_mutations
}  // namespace dynlab
