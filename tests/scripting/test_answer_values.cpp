// Answers as JSON and back. Oracles: equality of what was written with what is written again; the form by hand; the
// contract for texts from anybody.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "numerics/error.h"
#include "script_run.h"
#include "scripting/answers/answer_value.h"

namespace test_answer_values {

using namespace dynlab;
using nlohmann::json;
using testing::HasSubstr;

class answer_values : public testing::Test {
  protected:
    answer_values() : runtime_({}, renderer_) {}

    std::string answer(const std::string& expression) {
        const RunRecord made = runtime_.run_code("value = " + expression, "value.lua");
        EXPECT_FALSE(made.error) << expression;
        lua_getglobal(L(), "value");
        const AnswerValue value = answer_value(L(), -1);
        lua_settop(L(), 0);
        EXPECT_EQ(value.kind, json::parse(value.json).at("kind"));
        return value.json;
    }
    std::string again(const std::string& text) {
        push_answer_value(L(), text);
        const std::string written = answer_value(L(), -1).json;
        lua_settop(L(), 0);
        return written;
    }
    std::string refusal(const std::string& text) {
        try {
            push_answer_value(L(), text);
        } catch (const InvalidArgument& error) {
            lua_settop(L(), 0);
            return error.what();
        }
        lua_settop(L(), 0);
        return "";
    }
    lua_State* L() { return runtime_.state(); }

    GnuplotRenderer renderer_;
    Runtime runtime_;
};

const char* const kExpressions[] = {
    "0.1 + 0.2",
    "0/0",
    "'a\\n\"b\"'",
    "{1, 'x', {deep = true, list = {}}}",
    "vector{1, 0/0, -1/0}",
    "matrix{{1, 2, 3}, {4, 5, 6}}",
    "iddata(vector{1, 2, 3}, vector{4, 5, 6}, 0.1, {InputName = 'voltage'})",
    "merge(iddata(vector{1, 2}, vector{4, 5}, 0.1), iddata(vector{1, 2, 7}, vector{4, 5, 1}, 0.1))",
    "tf({2}, {1, 1})",
    "idproc('P2D', {Kp = 2, Tp1 = 3, Tp2 = 1, Td = 0.5})",
    "ss(tf({2}, {1, 3, 1}))",
    "idfrd({{1, 2}, {3, -4}}, {1, 2}, {variance = {0.1, 0.2}, Ts = 0.5, InterSample = 'zoh'})",
    "(function() local u = prbs(4, 50) return arx(iddata(lsim(tf({1}, {1, 1}), u, 0.05) + 0.1*randn(#u), u, 0.05), {1, "
    "1, 1}) end)()",
    "(function() local u = prbs(4, 50) return srivc(iddata(lsim(tf({1}, {1, 1}), u, 0.05) + 0.1*randn(#u), u, 0.05), "
    "{1, 1, 0}) end)()"};

TEST_F(answer_values, come_back_as_they_were) {
    for (const char* expression : kExpressions) {
        const std::string text = answer(expression);
        EXPECT_EQ(again(text), text) << expression;
    }
}

TEST_F(answer_values, have_the_form_that_checks_and_people_read) {
    EXPECT_EQ(json::parse(answer("{1, {x = true}}")), json::parse(R"({"kind": "table", "fields": {}, "items": [
        {"kind": "number", "value": 1.0},
        {"kind": "table", "items": [], "fields": {"x": {"kind": "truth", "value": true}}}]})"));
    EXPECT_EQ(json::parse(answer("vector{1, 0/0}")),
              json::parse(R"({"kind": "vector", "rows": 2, "columns": 1, "values": [1.0, "NaN"]})"));
    EXPECT_EQ(json::parse(answer("idproc('P1', {Kp = 2, Tp1 = 4})")), json::parse(R"({"kind": "model", "outputs": 1,
        "channels": [], "function": {"num": [0.5], "den": [1.0, 0.25], "Ts": 0.0, "delay": 0.0},
        "process": {"structure": "P1", "parameters": [2.0, 4.0]}})"));
    EXPECT_EQ(json::parse(answer("iddata(vector{1, 2}, vector{3, 4}, 0.5)")), json::parse(R"({"kind": "data",
        "Ts": 0.5, "hold": "zoh", "input_names": ["u1"], "output_names": ["y1"], "input_units": [""],
        "output_units": [""], "time_unit": "s", "experiments": [{"name": "", "start_time": 0.0, "t": [],
        "y": {"rows": 2, "columns": 1, "values": [1.0, 2.0]}, "u": {"rows": 2, "columns": 1, "values": [3.0, 4.0]},
        "r": {"rows": 0, "columns": 0, "values": []}}]})"));
}

TEST_F(answer_values, that_do_not_fit_together_are_refused_with_their_place) {
    const auto changed = [&](const std::string& expression, const std::string& place, const json& value) {
        json answer = json::parse(this->answer(expression));
        answer[json::json_pointer(place)] = value;
        return refusal(answer.dump());
    };
    const std::string data = kExpressions[6], process = kExpressions[9], model = kExpressions[12];
    EXPECT_THAT(changed(data, "/input_names", json::array()), HasSubstr("channels, names and units differ"));
    EXPECT_THAT(changed(data, "/experiments/0/y/rows", 2), HasSubstr("experiments[1].y: "));
    EXPECT_THAT(changed(data, "/experiments/0/y/values/1", "NaN"), HasSubstr("output"));
    EXPECT_THAT(changed(data, "/hold", "spline"), HasSubstr("hold: expected one of zoh, foh"));
    EXPECT_THAT(changed(process, "/process/structure", "P9"), HasSubstr("process.structure"));
    EXPECT_THAT(changed(process, "/process/parameters", {1.0}), HasSubstr("process"));
    EXPECT_THAT(changed(process, "/function/den", std::vector<double>(102, 1.0)),
                HasSubstr("the order of a polynomial is too high"));
    EXPECT_THAT(changed(process, "/outputs", 0), HasSubstr("complete outputs"));
    EXPECT_THAT(changed(model, "/estimate/theta", {1.0}), HasSubstr("estimate: the numbers of parameters, names"));
    EXPECT_THAT(changed("ss(tf({2}, {1, 3}))", "/state_space/B/columns", 7), HasSubstr("state_space.B"));
    EXPECT_THAT(refusal(R"({"kind": "prize", "value": 1})"), HasSubstr("unknown kind"));
    EXPECT_THAT(refusal(R"({"kind": "number"})"), HasSubstr("the member \"value\" is missing"));
    EXPECT_THAT(refusal("{\"kind\""), HasSubstr("damaged"));
    std::string deep = R"({"kind": "number", "value": 1})";
    for (int i = 0; i < 9; ++i) deep = R"({"kind": "table", "fields": {}, "items": [)" + deep + "]}";
    EXPECT_THAT(refusal(deep), HasSubstr("nested too deeply"));
    EXPECT_NE(refusal(std::string(1'000'000, '[')), "");
}

TEST_F(answer_values, of_changed_texts_are_values_or_are_refused) {
    std::mt19937 random(3);
    int refused = 0, trials = 0;
    for (const char* expression : kExpressions) {
        const std::string text = answer(expression);
        for (int trial = 0; trial < 300; ++trial, ++trials) {
            std::string wrong = text;
            for (unsigned k = 0; k <= random() % 3; ++k)
                wrong[random() % wrong.size()] = "0123456789eE+-.,:[]{}\"aN"[random() % 24];
            refused += refusal(wrong).empty() ? 0 : 1;
        }
    }
    EXPECT_GT(refused, trials / 4);
    EXPECT_LT(refused, trials);
}

}  // namespace test_answer_values
