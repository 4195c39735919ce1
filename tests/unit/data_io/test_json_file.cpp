// Variables in JSON files. Oracles: the text of the files, written by hand; what was written, read again.
#include "data_io/json_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "data_io/data_file.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"
#include "support/peak_memory.h"

namespace dynlab::test {
namespace test_json_file {
using testing::HasSubstr;

template <class Call>
std::string refusal_of(Call call) {
    try {
        call();
    } catch (const EnvironmentError& error) {
        return error.what();
    }
    return "";
}

class json_file : public testing::Test {
  protected:
    std::filesystem::path file(const std::string& text) const {
        const std::filesystem::path path = folder_.path() / "a.json";
        write_file_atomically(path, text);
        return path;
    }
    TemporaryFolder folder_;
};

TEST_F(json_file, gives_numbers_vectors_matrices_and_structs) {
    const VariableTable read =
        read_json_file(file("{\"x\": 2.5, \"v\": [1, null, 3], \"M\": [[1, 2], [3, 4], [5, 6]], \"s\": {\"on\": true, "
                            "\"text\": \"\\u00e9\"},"
                            " \"mixed\": [1, \"a\"], \"empty\": []}"));
    EXPECT_EQ(std::get<double>(read.at("x").value), 2.5);
    const Vector v = std::get<Vector>(read.at("v").value);
    EXPECT_TRUE(v.size() == 3 && v[0] == 1 && std::isnan(v[1]) && v[2] == 3);
    const Matrix M = std::get<Matrix>(read.at("M").value);
    EXPECT_TRUE(M.rows() == 3 && M.cols() == 2 && M(2, 0) == 5 && M(0, 1) == 2);
    const VariableTable& s = *std::get<std::shared_ptr<VariableTable>>(read.at("s").value);
    EXPECT_TRUE(std::get<bool>(s.at("on").value));
    EXPECT_EQ(std::get<std::string>(s.at("text").value), "é");
    EXPECT_EQ(std::get<std::shared_ptr<VariableList>>(read.at("mixed").value)->size(), 2u);
    EXPECT_EQ(std::get<Vector>(read.at("empty").value).size(), 0);
    EXPECT_EQ(read_data_file(folder_.path() / "a.json", true).variables.size(), 6u);
}

TEST_F(json_file, keeps_every_bit_and_the_same_bytes) {
    const std::filesystem::path path = folder_.path() / "b.json";
    Matrix M(2, 2);
    M << 0.1, 1e-300, -3, 1.0 / 3;
    const VariableTable written = {
        {"M", {M}}, {"row", {Matrix(M.row(0))}}, {"x", {INFINITY}}, {"t", {std::string("a\"b")}}};
    write_json_file(path, written);
    const VariableTable read = read_json_file(path);
    EXPECT_EQ(std::get<Matrix>(read.at("M").value), M);
    EXPECT_EQ(std::get<Vector>(read.at("row").value), Vector(M.row(0)));
    EXPECT_TRUE(std::isnan(std::get<double>(read.at("x").value)));
    EXPECT_EQ(std::get<std::string>(read.at("t").value), "a\"b");
    const std::string bytes = read_file(path);
    write_json_file(path, written);
    EXPECT_EQ(read_file(path), bytes);
}

TEST_F(json_file, refuses_what_is_none_with_its_place) {
    const auto reported = [&](const std::string& text) {
        const std::filesystem::path path = file(text);
        return refusal_of([&] { read_json_file(path); });
    };
    EXPECT_THAT(reported("{\"x\": 1,\n \"y\" 2}"), HasSubstr("a.json is not JSON: line 2, column 6"));
    EXPECT_THAT(reported(""), HasSubstr("is not JSON"));
    EXPECT_THAT(reported("[1, 2]"), HasSubstr("the outermost value must be an object"));
    EXPECT_THAT(reported("{\"x\": 1, \"x\": 2}"), HasSubstr("the name \"x\" occurs twice"));
    EXPECT_THAT(reported("{\"x\": " + std::string(5000, '[') + std::string(5000, ']') + "}"),
                HasSubstr("deeper than 100 levels"));
    EXPECT_THAT(reported("{\"x\": \"\xff\"}"), HasSubstr("is not JSON"));
    EXPECT_THAT(refusal_of([&] { read_json_file(folder_.path() / "none.json"); }), HasSubstr("none.json"));
}

TEST_F(json_file, lists_become_matrices_where_all_rows_are_equal) {
    const VariableTable read = read_json_file(file(
        "{\"ragged\": [[1, 2], [3]], \"late\": [[1, 2], [3, 4], \"a\"], \"numbers\": [1, 2, \"a\"], \"cube\": [[[1, "
        "2]], [[3, 4]]], \"row\": [[1, 2, 3]], \"mixed\": [1, [2]], \"hollow\": [[], []], \"on\": [true, false]}"));
    const auto list = [&read](const char* name) {
        return *std::get<std::shared_ptr<VariableList>>(read.at(name).value);
    };
    EXPECT_EQ(std::get<Vector>(list("ragged").at(0).value), (Vector{{1, 2}}));
    EXPECT_EQ(std::get<Vector>(list("ragged").at(1).value), (Vector{{3}}));
    ASSERT_EQ(list("late").size(), 3u);
    EXPECT_EQ(std::get<Vector>(list("late")[1].value), (Vector{{3, 4}}));
    EXPECT_EQ(std::get<std::string>(list("late")[2].value), "a");
    ASSERT_EQ(list("numbers").size(), 3u);
    EXPECT_EQ(std::get<double>(list("numbers")[1].value), 2);
    EXPECT_EQ(std::get<Matrix>(list("cube").at(1).value), (Matrix{{3, 4}}));
    EXPECT_EQ(std::get<Matrix>(read.at("row").value), (Matrix{{1, 2, 3}}));
    EXPECT_EQ(std::get<Vector>(list("mixed").at(1).value), (Vector{{2}}));
    EXPECT_EQ(list("hollow").size(), 2u);
    EXPECT_FALSE(std::get<bool>(list("on").at(1).value));
}

// Oracle: the numbers that the text is made of. In quadratic time these files take hours.
TEST_F(json_file, long_lists_and_tables_are_read_and_written) {
    constexpr int kCount = 500'000;
    std::string text = "{\"a\": [";
    for (int i = 0; i < kCount; ++i) text += fmt::format("{{\"x\": {}}},", i);
    text += "{}]";
    for (int i = 0; i < kCount; ++i) text += fmt::format(",\"{}\": {}", i, 2 * i);
    const VariableTable read = read_json_file(file(text + "}"));
    ASSERT_EQ(read.size(), kCount + 1u);
    EXPECT_EQ(std::get<double>(read.at("499999").value), 999998);
    const VariableList& list = *std::get<std::shared_ptr<VariableList>>(read.at("a").value);
    ASSERT_EQ(list.size(), kCount + 1u);
    const VariableTable& entry = *std::get<std::shared_ptr<VariableTable>>(list[1234].value);
    EXPECT_EQ(std::get<double>(entry.at("x").value), 1234);
    write_json_file(folder_.path() / "b.json", read);
    EXPECT_EQ(read_json_file(folder_.path() / "b.json").size(), read.size());
}

// Oracle: 160 MB for eight bytes a number, 40 MB for the text, and what the allocator keeps of the smaller blocks from
// which the two grew (64 MB each). With sixteen bytes a number it would be 160 MB more.
TEST_F(json_file, numbers_take_the_memory_of_numbers) {
    constexpr int kCount = 20'000'000;
    std::string text = "{\"x\": [";
    for (int i = 0; i < kCount; ++i) text += "7,";
    const std::filesystem::path numbers = file(text + "8]}");
    text = {};
    const double before = peak_memory([] {});
    const double taken = peak_memory([&] {
        const VariableTable read = read_json_file(numbers);
        EXPECT_EQ(std::get<Vector>(read.at("x").value).sum(), 7.0 * kCount + 8);
    });
    EXPECT_LT(taken - before, 160 + 40 + 2 * 64);
}

// Oracle: the limit that the header of reading_memory states, as the kernel counts it.
TEST_F(json_file, many_values_take_a_memory_with_a_limit) {
    std::string text = "{\"a\": [";
    for (int i = 0; i < 8'000'000; ++i) text += "[],";
    const std::filesystem::path lists = file(text + "1]}");
    const double before = peak_memory([] {});
    const double taken = peak_memory([&] {
        EXPECT_THAT(refusal_of([&] { read_json_file(lists); }), HasSubstr("reading it requires more than 512 MB"));
    });
    EXPECT_LT(taken - before, 512);
}

}  // namespace test_json_file
}  // namespace dynlab::test
