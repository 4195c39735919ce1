#include "data_io/mat_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <matio.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdint>

#include "data_io/mat_variable.h"
#include "numerics/error.h"
#include "numerics/signals/random.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"
#include "sample_variables.h"
#include "support/message_texts.h"

namespace dynlab {
namespace test_mat_file {

using test::texts_of;
using testing::HasSubstr;

class mat_file : public testing::Test {
  protected:
    /// A file written by libmatio itself: the second route for what our reader reads.
    void write(mat_ft version, const VariableTable& variables, matio_compression compression = MAT_COMPRESSION_NONE) {
        const MatFile mat(Mat_CreateVer(file_.c_str(), nullptr, version));
        ASSERT_TRUE(mat);
        for (const auto& [name, variable] : variables) {
            ASSERT_EQ(Mat_VarWrite(mat.get(), to_mat(variable, name).get(), compression), 0) << name;
        }
    }

    template <class T>
    void write_array(mat_ft version, matio_classes kind, matio_types type, std::vector<std::size_t> size,
                     std::vector<T> data, int flags = 0) {
        const MatFile mat(Mat_CreateVer(file_.c_str(), nullptr, version));
        const MatVariable x(
            Mat_VarCreate("x", kind, type, static_cast<int>(size.size()), size.data(), data.data(), flags));
        ASSERT_EQ(Mat_VarWrite(mat.get(), x.get(), MAT_COMPRESSION_NONE), 0);
    }

    std::string complaint() {
        try {
            read_mat_file(file_);
        } catch (const EnvironmentError& error) {
            EXPECT_THAT(error.what(), HasSubstr(file_.string()));
            return error.what();
        }
        return "no error";
    }

    TemporaryFolder folder_;
    std::filesystem::path file_ = folder_.path() / "x.mat";
};

/// What level 4 can hold: full matrices and text.
VariableTable plain_variables() {
    VariableTable plain;
    for (const char* name : {"number", "vector", "matrix", "complex_matrix"}) plain[name] = sample_variables()[name];
    return plain;
}

TEST_F(mat_file, reads_back_what_it_wrote) {
    write_mat_file(file_, sample_variables());
    EXPECT_TRUE(equal(read_mat_file(file_), sample_variables()));
    EXPECT_TRUE(equal(read_mat_file(file_, false), sample_variables()));
}

/// Oracle: libmatio, which reads what was not written by it; the sizes that deflating must and cannot give.
TEST_F(mat_file, compresses_large_arrays_where_it_pays) {
    constexpr Index kCount = 600000;
    Vector steps(kCount);
    for (Index k = 0; k < kCount; ++k) steps[k] = static_cast<double>((k / 20) % 7);
    const Vector noise = RandomStream(1).normal(kCount);
    const std::size_t plain = 8 * static_cast<std::size_t>(kCount);
    const auto table = std::make_shared<VariableTable>(VariableTable{{"u", {steps}}, {"text", {std::string("a")}}});
    const std::vector<std::pair<VariableTable, bool>> cases = {{{{"steps", {steps}}}, true},
                                                               {{{"noise", {noise}}}, false},
                                                               {{{"run", {table}}}, true},
                                                               {{{"steps", {steps}}, {"z", {1.5}}}, true}};
    for (const auto& [variables, shrinks] : cases) {
        write_mat_file(file_, variables);
        EXPECT_TRUE(equal(read_mat_file(file_), variables));
        const std::size_t size = std::filesystem::file_size(file_);
        EXPECT_EQ(size < plain / 10, shrinks) << size;
        EXPECT_LT(size, plain + 1000);
    }
    write_mat_file(file_, {{"a", {noise}}, {"b", {steps}}, {"c", {noise}}});
    EXPECT_TRUE(equal(read_mat_file(file_), {{"a", {noise}}, {"b", {steps}}, {"c", {noise}}}));
}

TEST_F(mat_file, reads_every_version) {
    write(MAT_FT_MAT4, plain_variables());
    EXPECT_TRUE(equal(read_mat_file(file_), plain_variables()));
    write(MAT_FT_MAT5, sample_variables());
    EXPECT_TRUE(equal(read_mat_file(file_), sample_variables()));
    write(MAT_FT_MAT5, sample_variables(), MAT_COMPRESSION_ZLIB);
    EXPECT_TRUE(equal(read_mat_file(file_), sample_variables()));
    write(MAT_FT_MAT73, sample_variables());
    EXPECT_TRUE(equal(read_mat_file(file_), sample_variables()));
    write(MAT_FT_MAT73, sample_variables(), MAT_COMPRESSION_ZLIB);
    EXPECT_TRUE(equal(read_mat_file(file_), sample_variables()));
}

template <class T>
constexpr bool kIsSigned = std::numeric_limits<T>::is_signed;

// Oracle: the numbers given to libmatio, all exact in double precision.
TEST_F(mat_file, reads_every_numeric_class_as_double) {
    const auto check = [this]<class T>(matio_classes kind, matio_types type, T) {
        const std::vector<T> data = {1, 2, kIsSigned<T> ? static_cast<T>(-3) : static_cast<T>(3), 100};
        for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
            write_array(version, kind, type, {4, 1}, data);
            const Vector x = std::get<Vector>(read_mat_file(file_).at("x").value);
            EXPECT_EQ(x, (Vector{{1, 2, kIsSigned<T> ? -3.0 : 3.0, 100}})) << kind;
        }
    };
    check(MAT_C_DOUBLE, MAT_T_DOUBLE, double{});
    check(MAT_C_SINGLE, MAT_T_SINGLE, float{});
    check(MAT_C_INT8, MAT_T_INT8, std::int8_t{});
    check(MAT_C_UINT8, MAT_T_UINT8, std::uint8_t{});
    check(MAT_C_INT16, MAT_T_INT16, std::int16_t{});
    check(MAT_C_UINT16, MAT_T_UINT16, std::uint16_t{});
    check(MAT_C_INT32, MAT_T_INT32, std::int32_t{});
    check(MAT_C_UINT32, MAT_T_UINT32, std::uint32_t{});
    check(MAT_C_INT64, MAT_T_INT64, std::int64_t{});
    check(MAT_C_UINT64, MAT_T_UINT64, std::uint64_t{});
}

TEST_F(mat_file, reads_logical_arrays_as_zeros_and_ones) {
    for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
        write_array<std::uint8_t>(version, MAT_C_UINT8, MAT_T_UINT8, {1, 3}, {1, 0, 1}, MAT_F_LOGICAL);
        EXPECT_EQ(std::get<Vector>(read_mat_file(file_).at("x").value), (Vector{{1, 0, 1}}));
    }
}

TEST_F(mat_file, rows_become_columns_and_empty_arrays_keep_their_size) {
    for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
        write_array<double>(version, MAT_C_DOUBLE, MAT_T_DOUBLE, {1, 3}, {1, 2, 3});
        EXPECT_EQ(std::get<Vector>(read_mat_file(file_).at("x").value), (Vector{{1, 2, 3}}));
        for (const auto& size : {std::vector<std::size_t>{0, 0}, {1, 0}, {0, 1}}) {
            write_array<double>(version, MAT_C_DOUBLE, MAT_T_DOUBLE, size, {});
            EXPECT_EQ(std::get<Vector>(read_mat_file(file_).at("x").value).size(), 0);
        }
        write_array<double>(version, MAT_C_DOUBLE, MAT_T_DOUBLE, {0, 3}, {});
        EXPECT_EQ(std::get<Matrix>(read_mat_file(file_).at("x").value).cols(), 3);
        write_array<double>(version, MAT_C_DOUBLE, MAT_T_DOUBLE, {2, 2, 1}, {1, 2, 3, 4});
        EXPECT_EQ(std::get<Matrix>(read_mat_file(file_).at("x").value), (Matrix{{1, 3}, {2, 4}}));
    }
}

TEST_F(mat_file, char_rows_become_a_list_of_texts) {
    // 'ab ' above 'xyz', stored column by column.
    const std::vector<std::uint16_t> units = {'a', 'x', 'b', 'y', ' ', 'z'};
    for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
        write_array(version, MAT_C_CHAR, MAT_T_UINT16, {2, 3}, units);
        const auto rows = std::get<std::shared_ptr<VariableList>>(read_mat_file(file_).at("x").value);
        ASSERT_EQ(rows->size(), 2u);
        EXPECT_EQ(std::get<std::string>((*rows)[0].value), "ab");
        EXPECT_EQ(std::get<std::string>((*rows)[1].value), "xyz");
    }
    write_array<char>(MAT_FT_MAT4, MAT_C_CHAR, MAT_T_UINT8, {1, 3}, {'a', 'b', 'c'});
    EXPECT_EQ(std::get<std::string>(read_mat_file(file_).at("x").value), "abc");
}

TEST_F(mat_file, reads_arrays_of_structs_as_a_list) {
    std::size_t size[2] = {2, 1};
    const char* fields[] = {"a"};
    for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
        {
            const MatFile mat(Mat_CreateVer(file_.c_str(), nullptr, version));
            const MatVariable x(Mat_VarCreateStruct("x", 2, size, fields, 1));
            for (std::size_t i = 0; i < 2; ++i) {
                Mat_VarSetStructFieldByIndex(x.get(), 0, i, to_mat({static_cast<double>(i)}, "a").release());
            }
            ASSERT_EQ(Mat_VarWrite(mat.get(), x.get(), MAT_COMPRESSION_NONE), 0);
        }
        const auto list = std::get<std::shared_ptr<VariableList>>(read_mat_file(file_).at("x").value);
        ASSERT_EQ(list->size(), 2u);
        const auto second = std::get<std::shared_ptr<VariableTable>>((*list)[1].value);
        EXPECT_EQ(std::get<double>(second->at("a").value), 1.0);
    }
}

// oracle: the three numbers that are stored, and zeros
TEST_F(mat_file, sparse_matrices_are_read_with_their_zeros) {
    std::uint32_t rows[] = {1, 0, 2}, starts[] = {0, 1, 1, 3};
    double values[] = {5, -2, 7};
    mat_sparse_t sparse = {3, rows, 3, starts, 4, 3, values};
    const auto write = [&](std::size_t row_count) {
        std::size_t size[2] = {row_count, 3};
        const MatFile mat(Mat_CreateVer(file_.c_str(), nullptr, MAT_FT_MAT5));
        const MatVariable x(Mat_VarCreate("x", MAT_C_SPARSE, MAT_T_DOUBLE, 2, size, &sparse, 0));
        ASSERT_EQ(Mat_VarWrite(mat.get(), x.get(), MAT_COMPRESSION_NONE), 0);
    };
    write(3);
    const VariableTable read = read_mat_file(file_, true);
    EXPECT_EQ(std::get<Matrix>(read.at("x").value), (Matrix{{0, 0, -2}, {5, 0, 0}, {0, 0, 7}}));
    write(100'000'000);
    EXPECT_THAT(complaint(), HasSubstr("MB of memory"));
}

TEST_F(mat_file, names_what_cannot_be_represented) {
    write_array<double>(MAT_FT_MAT5, MAT_C_DOUBLE, MAT_T_DOUBLE, {1, 2, 2}, {1, 2, 3, 4});
    EXPECT_THAT(complaint(), HasSubstr("variable x has 3 dimensions"));
    // Byte 144 holds the class (MAT-File Format, array flags): 3 object, 16 function handle, 17 opaque.
    write_array<double>(MAT_FT_MAT5, MAT_C_DOUBLE, MAT_T_DOUBLE, {1, 2}, {1, 2});
    const std::string bytes = read_file(file_);
    for (const auto& [kind, expected] : {std::pair{3, "x is an object"}, {16, "x is a function handle"}}) {
        std::string other = bytes;
        other[144] = static_cast<char>(kind);
        write_file_atomically(file_, other);
        EXPECT_THAT(complaint(), HasSubstr(expected));
    }
}

/// A data element of level 5: type, number of bytes, content filled up to a multiple of 8.
std::string element_5(std::uint32_t type, const std::string& content) {
    const auto bytes = static_cast<std::uint32_t>(content.size());
    std::string element(reinterpret_cast<const char*>(&type), 4);
    element.append(reinterpret_cast<const char*>(&bytes), 4);
    return element + content + std::string((8 - bytes % 8) % 8, '\0');
}

// The form in which MATLAB saves tables and string arrays: flags of class 17, name, "MCOS", the class's name, numbers.
TEST_F(mat_file, reports_where_a_table_is) {
    VariableTable one;
    one["a"] = {1.0};
    write(MAT_FT_MAT5, one);
    const std::string numbers = element_5(14, element_5(6, std::string("\x0D\0\0\0\0\0\0\0", 8)) +
                                                  element_5(5, std::string("\x02\0\0\0\x01\0\0\0", 8)) +
                                                  element_5(1, "") + element_5(6, std::string(8, '\1')));
    const std::string table = element_5(6, std::string("\x11\0\0\0\0\0\0\0", 8)) + element_5(1, "weather") +
                              element_5(1, "MCOS") + element_5(1, "table") + numbers;
    write_file_atomically(file_, read_file(file_) + element_5(14, table));
    std::vector<Message> left_out;
    EXPECT_TRUE(equal(read_mat_file(file_, true, &left_out), one));
    EXPECT_THAT(texts_of(left_out), testing::ElementsAre(testing::StartsWith(
                                        "variable number 2 (after a) is an object, a table or a string array")));
    // What follows it is read as well.
    VariableTable last;
    last["z"] = {Vector{{1, 2, 3}}};
    const std::string begin = read_file(file_);
    write(MAT_FT_MAT5, last);
    write_file_atomically(file_, begin + read_file(file_).substr(128));
    EXPECT_TRUE(equal(read_mat_file(file_, true, &left_out), {{"a", {1.0}}, {"z", {Vector{{1, 2, 3}}}}}));
    EXPECT_EQ(left_out.size(), 1u);
}

// Oracle: the variables that were written; the three-dimensional variable is between them.
TEST_F(mat_file, an_unreadable_variable_does_not_block_the_others) {
    std::size_t size[3] = {1, 2, 2};
    std::vector<double> numbers = {1, 2, 3, 4};
    for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
        for (const auto compression : {MAT_COMPRESSION_NONE, MAT_COMPRESSION_ZLIB}) {
            {
                const MatFile mat(Mat_CreateVer(file_.c_str(), nullptr, version));
                const MatVariable cube(
                    Mat_VarCreate("b", MAT_C_DOUBLE, MAT_T_DOUBLE, 3, size, numbers.data(), MAT_F_DONT_COPY_DATA));
                ASSERT_EQ(Mat_VarWrite(mat.get(), to_mat({Vector{{5, 6}}}, "a").get(), compression), 0);
                ASSERT_EQ(Mat_VarWrite(mat.get(), cube.get(), compression), 0);
                ASSERT_EQ(Mat_VarWrite(mat.get(), to_mat({7.0}, "c").get(), compression), 0);
            }
            for (const bool guarded : {true, false}) {
                std::vector<Message> left_out;
                EXPECT_TRUE(equal(read_mat_file(file_, guarded, &left_out), {{"a", {Vector{{5, 6}}}}, {"c", {7.0}}}));
                EXPECT_EQ(left_out.at(0),
                          Message("variable {} has {} dimensions; only vectors and matrices can be read", "b", 3));
                EXPECT_THAT(texts_of(left_out),
                            testing::ElementsAre("variable b has 3 dimensions; only vectors and matrices can "
                                                 "be read"));
            }
        }
    }
}

// Oracle: the file that the link points to contains 41, 42, 43; tests/reference/data/README.md explains how both were
// made.
TEST_F(mat_file, a_link_to_another_file_is_not_followed) {
    const std::filesystem::path data = DYNLAB_SOURCE_DIR "/tests/reference/data";
    std::filesystem::copy_file(data / "external_link.mat", file_);
    std::filesystem::copy_file(data / "link_target.mat", folder_.path() / "outside.mat");
    EXPECT_TRUE(equal(read_mat_file(folder_.path() / "outside.mat"), {{"y", {Vector{{41, 42, 43}}}}}));
    std::vector<Message> left_out;
    const Vector numbers{{1, 2, 3}};
    EXPECT_TRUE(equal(read_mat_file(file_, true, &left_out), {{"x", {numbers}}, {"z", {numbers}}}));
    EXPECT_THAT(texts_of(left_out),
                testing::ElementsAre("a variable that is damaged or stored in another file cannot be read"));
}

TEST_F(mat_file, says_what_is_wrong_with_a_file) {
    EXPECT_THAT(complaint(), HasSubstr("no such file or directory"));
    write_file_atomically(file_, "");
    EXPECT_THAT(complaint(), HasSubstr("is empty"));
    write_file_atomically(file_, "t,y\n0,1\n1,2\n");
    EXPECT_THAT(complaint(), HasSubstr("is not a MATLAB file"));
    write_file_atomically(file_, std::string(100000, '7'));
    EXPECT_THAT(complaint(), HasSubstr("is not a MATLAB file"));
    write_mat_file(file_, sample_variables());
    std::string bytes = read_file(file_);
    bytes[125] = 3;
    write_file_atomically(file_, bytes);
    EXPECT_THAT(complaint(), HasSubstr("has the unknown MAT version 0x0300"));
    EXPECT_THROW(read_mat_file(folder_.path()), EnvironmentError);
}

TEST_F(mat_file, every_beginning_of_a_file_is_refused) {
    const auto check = [this](std::size_t first, std::size_t step) {
        const std::string bytes = read_file(file_);
        for (std::size_t length = first; length < bytes.size(); length += step) {
            write_file_atomically(file_, std::string_view(bytes).substr(0, length));
            EXPECT_NE(complaint(), "no error") << length << " of " << bytes.size();
        }
    };
    VariableTable one;
    one["x"] = {Vector{{1, 2, 3, 4, 5, 6, 7}}};
    write(MAT_FT_MAT4, one);
    check(0, 1);
    write(MAT_FT_MAT5, one);
    check(129, 3);
    write_mat_file(file_, one);
    check(129, 1);
    write(MAT_FT_MAT73, one);
    check(1, 199);
}

TEST_F(mat_file, huge_sizes_are_refused) {
    VariableTable one;
    one["x"] = {Matrix(Matrix::Ones(3, 4))};
    const auto with_word = [this](std::size_t position, std::uint32_t word) {
        std::string bytes = read_file(file_);
        bytes.replace(position, 4, reinterpret_cast<const char*>(&word), 4);
        write_file_atomically(file_, bytes);
    };
    write(MAT_FT_MAT4, one);
    with_word(4, 0xFFFFFFFF), with_word(8, 0xFFFFFFFF);  // rows and columns
    EXPECT_THAT(complaint(), HasSubstr("is truncated"));
    for (const std::uint32_t huge : {0x7FFFFFFFu, 0xFFFFFFFFu, 0x10000000u}) {
        write(MAT_FT_MAT5, one);
        with_word(160, huge), with_word(164, huge);  // the dimensions
        EXPECT_NE(complaint(), "no error");
    }
}

TEST_F(mat_file, writes_the_same_bytes_for_the_same_variables) {
    write_mat_file(file_, sample_variables());
    write_mat_file(folder_.path() / "again.mat", sample_variables());
    EXPECT_EQ(read_file(file_), read_file(folder_.path() / "again.mat"));
    const std::string description = "MATLAB 5.0 MAT-file, written by dynlab";  // libmatio's own would hold the date
    EXPECT_THAT(read_file(file_).substr(0, 116), testing::StartsWith(description));
    EXPECT_EQ(read_file(file_).substr(0, 116).find_first_not_of(std::string_view(" \0", 2), description.size()),
              std::string::npos);
}

TEST_F(mat_file, refuses_names_that_matlab_does_not_allow) {
    for (const std::string name : {"", "1x", "a b", "_x", "x-y", "\xC3\xA9"}) {
        VariableTable one;
        one[name] = {1.0};
        EXPECT_THROW(write_mat_file(file_, one), InvalidArgument) << name;
        VariableTable nested;
        nested["s"] = {std::make_shared<VariableTable>(one)};
        EXPECT_THROW(write_mat_file(file_, nested), InvalidArgument) << name;
    }
    EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(mat_file, a_full_disk_leaves_the_old_file) {
    write_mat_file(file_, plain_variables());
    VariableTable large;
    large["x"] = {Vector(Vector::Random(100000))};
    rlimit before;
    getrlimit(RLIMIT_FSIZE, &before);
    const auto signal_before = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{20000, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
    EXPECT_THROW(write_mat_file(file_, large), EnvironmentError);
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, signal_before);
    EXPECT_TRUE(equal(read_mat_file(file_), plain_variables()));
    EXPECT_THROW(write_mat_file(folder_.path() / "none/x.mat", large), EnvironmentError);
}

// Wherever the disk becomes full, the old file remains, complete: libmatio does not report every failed write.
TEST_F(mat_file, no_place_where_a_disk_fills_up_is_passed_over) {
    VariableTable many = sample_variables();
    many["noise"] = {Vector(Vector::Random(30000))};
    many["large"] = {Vector(Vector::Random(600000))};  // not compressed
    rlimit before;
    getrlimit(RLIMIT_FSIZE, &before);
    const auto signal_before = std::signal(SIGXFSZ, SIG_IGN);
    for (const rlim_t bytes :
         {rlim_t{100}, rlim_t{130}, rlim_t{5000}, rlim_t{65536}, rlim_t{200000}, rlim_t{3000000}}) {
        write_mat_file(file_, plain_variables());
        const rlimit limit{bytes, before.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
        std::string message;
        try {
            write_mat_file(file_, many);
        } catch (const EnvironmentError& error) {
            message = error.what();
        }
        setrlimit(RLIMIT_FSIZE, &before);
        EXPECT_THAT(message, HasSubstr("no space for the temporary file in")) << bytes;
        EXPECT_TRUE(equal(read_mat_file(file_), plain_variables())) << bytes;
    }
    std::signal(SIGXFSZ, signal_before);
    write_mat_file(file_, many);
    EXPECT_TRUE(equal(read_mat_file(file_), many));
}

// Oracle: the limit that the header of reading_memory states.
TEST_F(mat_file, small_files_of_many_values_are_refused) {
    VariableTable zeros;
    zeros["x"] = {Vector(Vector::Zero(34'000'000))};
    write(MAT_FT_MAT5, zeros, MAT_COMPRESSION_ZLIB);
    EXPECT_LT(std::filesystem::file_size(file_), 1u << 20);
    const std::string message = complaint();
    EXPECT_THAT(message, HasSubstr("variable x has 3.4e+07 values: reading it requires more than 512 MB of memory"));
    EXPECT_THAT(message, testing::Not(HasSubstr("damaged")));
}

// Oracle: the values that libmatio wrote. Digital oscilloscopes produce such data.
TEST_F(mat_file, long_records_of_short_integers_are_read) {
    constexpr std::size_t kCount = 8'000'000;
    const auto expect_read = [this] {
        const Vector x = std::get<Vector>(read_mat_file(file_).at("x").value);
        ASSERT_EQ(x.size(), static_cast<Index>(kCount));
        for (const Index i : {Index{0}, Index{5'345'678}, Index{kCount - 1}}) EXPECT_EQ(x[i], i % 100);
    };
    std::vector<std::int16_t> words(kCount);
    std::vector<std::uint8_t> bytes(kCount);
    for (std::size_t i = 0; i < kCount; ++i)
        words[i] = static_cast<std::int16_t>(i % 100), bytes[i] = static_cast<std::uint8_t>(i % 100);
    write_array(MAT_FT_MAT5, MAT_C_INT16, MAT_T_INT16, {kCount, 1}, std::move(words));
    expect_read();
    write_array(MAT_FT_MAT5, MAT_C_UINT8, MAT_T_UINT8, {kCount, 1}, std::move(bytes));
    expect_read();
}

}  // namespace test_mat_file
}  // namespace dynlab
