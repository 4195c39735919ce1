#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "data_io/values/cbor_values.h"
#include "documents/record_description.h"

namespace dynlab {
namespace test_run_record {

RunRecord sample() {
    RunRecord record;
    record.script = "lesson.lua";
    record.seed = 7;
    record.values["fit"] = {0.1, "0.1"};
    record.values["name"] = {std::nullopt, "P1 \"quoted\"\n"};
    record.tables["models"] = {{"Model", "Fit"}, {{"P1", "93"}}};
    record.figures["raw"].caption = "Raw";
    record.figures["raw"].file = "/tmp/somewhere/raw.pdf";
    record.texts["end"] = {"**done**"};
    record.outputs["cell-1"] = {{"x\n", "raw"}};
    record.error = RecordedError{Message("{} needs {}", "srivc", plural(4, "{} sample", "{} samples")),
                                 "lesson.lua",
                                 3,
                                 {{Message("ran lesson.lua"), "a.lua", 1}}};
    record.files_read = {"/home/someone/data.csv"};
    record.timings["cell-1"] = 0.25;
    return record;
}

// Oracle: a second JSON reading of the text gives back what was put in.
TEST(run_record, json_holds_everything_that_was_recorded) {
    const auto json = nlohmann::json::parse(to_json(sample()));
    EXPECT_EQ(json["script"], "lesson.lua");
    EXPECT_EQ(json["seed"], 7);
    EXPECT_EQ(json["values"]["fit"]["number"].get<double>(), 0.1);
    EXPECT_EQ(json["values"]["name"]["text"], "P1 \"quoted\"\n");
    EXPECT_FALSE(json["values"]["name"].contains("number"));
    EXPECT_EQ(json["tables"]["models"]["rows"][0][1], "93");
    EXPECT_EQ(json["figures"]["raw"]["caption"], "Raw");
    EXPECT_EQ(json["texts"]["end"], "**done**");
    EXPECT_EQ(json["outputs"]["cell-1"][0]["printed"], "x\n");
    EXPECT_EQ(json["outputs"]["cell-1"][1]["figure"], "raw");
    EXPECT_EQ(json["error"]["message"]["id"], "{} needs {}");
    EXPECT_EQ(json["error"]["message"]["arguments"][0]["text"], "srivc");
    EXPECT_EQ(json["error"]["file"], "lesson.lua");
    EXPECT_EQ(json["error"]["line"], 3);
}

TEST(run_record, json_has_no_timings_and_no_folders) {
    const std::string text = to_json(sample());
    EXPECT_EQ(text, to_json(sample()));
    EXPECT_EQ(text.find("timings"), std::string::npos);
    EXPECT_EQ(text.find("/home"), std::string::npos);
    EXPECT_EQ(text.find("/tmp"), std::string::npos);
    EXPECT_EQ(from_cbor<RunRecord>(cbor_of(sample())).timings.at("cell-1"), 0.25);
}

TEST(run_record, numbers_read_back_exactly) {
    for (double number : {0.1, 1.0 / 3.0, 9.79, 1e300, std::numeric_limits<double>::denorm_min()}) {
        RunRecord record;
        record.values["x"] = {number, ""};
        EXPECT_EQ(nlohmann::json::parse(to_json(record))["values"]["x"]["number"].get<double>(), number);
    }
}

// Oracle: the JSON of what went in, and beside it what JSON leaves out.
TEST(run_record, comes_back_from_cbor_with_all_but_the_curves) {
    RunRecord record = sample();
    record.answers["gain"] = {"number", R"({"kind":"number","value":2.0})"};
    record.figures["raw"].order = 3;
    const RunRecord back = from_cbor<RunRecord>(cbor_of(record));
    EXPECT_EQ(to_json(back), to_json(record));
    EXPECT_EQ(back.timings, record.timings);
    EXPECT_EQ(back.figures.at("raw").file, record.figures.at("raw").file);
    EXPECT_EQ(back.figures.at("raw").order, 3u);
    EXPECT_EQ(back.files_read, record.files_read);
    EXPECT_EQ(back.answers.at("gain").kind, "number");
    EXPECT_EQ(back.answers.at("gain").json, record.answers.at("gain").json);
    EXPECT_EQ(back.outputs.at("cell-1").size(), 1u);
}

// Oracle: what went in, without folders and timings.
TEST(run_record, comes_back_from_its_own_json) {
    RunRecord record = sample();
    record.answers["gain"] = {"number", R"({"kind":"number","value":2.0})"};
    const RunRecord back = record_from_json(to_json(record));
    EXPECT_EQ(to_json(back), to_json(record));
    EXPECT_EQ(back.answers.at("gain").kind, "number");
    EXPECT_EQ(back.answers.at("gain").json, record.answers.at("gain").json);
    EXPECT_EQ(back.error->message, record.error->message);
    EXPECT_EQ(back.error->text(), "lesson.lua:3: srivc needs 4 samples");
    EXPECT_EQ(back.files_read, std::vector<std::filesystem::path>{"data.csv"});
    for (const char* text : {"", "[]", "{}", R"({"script": 1})"}) EXPECT_THROW(record_from_json(text), ValueError);
}

// Oracle: what went in.
TEST(run_record, error_comes_back_with_its_message_and_place) {
    const RecordedError error = *sample().error, back = from_cbor<RecordedError>(cbor_of(error));
    EXPECT_EQ(back.message, error.message);
    EXPECT_EQ(back.message.many(), "");
    EXPECT_EQ(back.file, "lesson.lua");
    EXPECT_EQ(back.line, 3);
    EXPECT_EQ(back.line_in("lesson.lua"), 3);
    EXPECT_EQ(back.line_in("tools.lua"), 0);
    ASSERT_EQ(back.calls.size(), 1u);
    EXPECT_EQ(back.calls.front().what, error.calls.front().what);
    EXPECT_EQ(RecordedError{Message("interrupted")}.text(), "interrupted");
}

// Another process may write anything: messages whose arguments do not fit are refused, not shown.
TEST(run_record, error_with_a_message_that_does_not_fit_is_refused) {
    const auto json = nlohmann::json::parse(to_json(sample()));
    const auto with = [&](const char* message) {
        auto changed = json;
        changed["error"]["message"] = nlohmann::json::parse(message);
        return changed.dump();
    };
    EXPECT_EQ(record_from_json(with(R"({"id": "no {}", "arguments": [{"text": "{}"}]})")).error->text(),
              "lesson.lua:3: no {}");
    for (const char* message :
         {R"("no")", R"({"id": "no {}"})", R"({"id": "no", "arguments": [{"text": "x"}]})",
          R"({"id": "no {}", "arguments": [{"text": "x", "count": 1}]})", R"({"id": "no {}", "arguments": [{}]})",
          R"({"id": "{} x", "many": "{} xs", "arguments": [{"text": "x"}]})"})
        EXPECT_THROW(record_from_json(with(message)), ValueError) << message;
}

}  // namespace test_run_record
}  // namespace dynlab
