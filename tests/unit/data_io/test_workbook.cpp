#include "data_io/workbook.h"

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <random>

#include "base/reader.h"
#include "data_io/data_file.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"

namespace dynlab {
namespace test_workbook {

using testing::ElementsAre;
using testing::HasSubstr;

using Parts = std::map<std::string, std::string>;

/// Workbooks put together by hand, as ECMA-376 part 1 describes them: the oracle is what is written into the cells.
class workbook : public testing::Test {
  protected:
    void write(const Parts& parts) {
        const std::unique_ptr<archive, int (*)(archive*)> zip(::archive_write_new(), ::archive_write_free);
        ::archive_write_set_format_zip(zip.get());
        ASSERT_EQ(::archive_write_open_filename(zip.get(), file_.c_str()), ARCHIVE_OK);
        for (const auto& [path, text] : parts) {
            const std::unique_ptr<archive_entry, void (*)(archive_entry*)> entry(::archive_entry_new(),
                                                                                 ::archive_entry_free);
            ::archive_entry_set_pathname(entry.get(), path.c_str());
            ::archive_entry_set_size(entry.get(), static_cast<la_int64_t>(text.size()));
            ::archive_entry_set_filetype(entry.get(), AE_IFREG);
            ::archive_entry_set_perm(entry.get(), 0644);
            ASSERT_EQ(::archive_write_header(zip.get(), entry.get()), ARCHIVE_OK);
            ASSERT_EQ(::archive_write_data(zip.get(), text.data(), text.size()), static_cast<la_ssize_t>(text.size()));
        }
        ASSERT_EQ(::archive_write_close(zip.get()), ARCHIVE_OK);
    }
    static std::string sheet(const std::string& rows) {
        return "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\"?>\n<worksheet "
               "xmlns=\"http://schemas.openxmlformats.org/spreadsheetml/2006/main\"><sheetData>" +
               rows + "</sheetData></worksheet>";
    }
    static Parts parts_of(const std::string& rows) {
        return {
            {"xl/workbook.xml",
             "<workbook xmlns:r=\"http://schemas.openxmlformats.org/officeDocument/2006/relationships\"><sheets>"
             "<sheet name=\"Run 1\" sheetId=\"1\" r:id=\"rId7\"/><sheet name=\"Run 2\" sheetId=\"2\" r:id=\"rId8\"/>"
             "</sheets></workbook>"},
            {"xl/_rels/workbook.xml.rels",
             "<Relationships><Relationship Id=\"rId8\" Target=\"worksheets/sheet2.xml\"/>"
             "<Relationship Id=\"rId7\" Target=\"/xl/worksheets/sheet1.xml\"/></Relationships>"},
            {"xl/sharedStrings.xml",
             "<sst><si><t>time (s)</t></si><si><r><t>vol</t></r><r><t>tage [V]</t></r></si><si><t>a, \"b\" &amp; "
             "&#233;</t></si></sst>"},
            {"xl/worksheets/sheet1.xml", sheet(rows)},
            {"xl/worksheets/sheet2.xml", sheet("<row><c><v>5</v></c><c><v>6</v></c></row>")}};
    }
    std::string complaint(const std::string& expected = "") {
        try {
            read_sheet(file_, expected);
        } catch (const EnvironmentError& error) {
            EXPECT_THAT(error.what(), HasSubstr(file_.string()));
            return error.what();
        }
        return "no error";
    }

    TemporaryFolder folder_;
    std::filesystem::path file_ = folder_.path() / "x.xlsx";
};

constexpr const char* kRows =
    "<row r=\"2\"><c r=\"A2\" t=\"s\"><v>0</v></c><c r=\"B2\" t=\"s\"><v>1</v></c><c r=\"C2\" "
    "t=\"inlineStr\"><is><t>label"
    "</t></is></c></row>"
    "<row r=\"3\"><c r=\"A3\"><v>0</v></c><c r=\"B3\"><f>1+1</f><v>2.5000000000000001E-2</v></c><c r=\"C3\" "
    "t=\"s\"><v>2</v>"
    "</c></row>"
    "<row r=\"5\"><c r=\"A5\"><v>1</v></c><c r=\"C5\" t=\"str\"><v>x</v></c></row>"
    "<row r=\"6\"><c r=\"A6\"><v>2</v></c><c r=\"B6\" t=\"e\"><v>#N/A</v></c></row>";

TEST_F(workbook, a_sheet_becomes_text_line_by_line) {
    write(parts_of(kRows));
    const SheetText text = read_sheet(file_, "");
    EXPECT_EQ(
        text.csv,
        "\n\"time (s)\",\"voltage [V]\",\"label\"\n0,2.5000000000000001E-2,\"a, \"\"b\"\" & \u00E9\"\n\n1,,\"x\"\n2,"
        "\"#N/A\",\n");
    EXPECT_THAT(text.sheets, ElementsAre("Run 1", "Run 2"));
    EXPECT_EQ(read_sheet(file_, "Run 2").csv, "5,6\n");
}

TEST_F(workbook, is_read_as_a_table) {
    write(parts_of(kRows));
    const LoadedData data = read_data_file(file_, true);
    EXPECT_THAT(data.columns, ElementsAre("time", "voltage", "label"));
    EXPECT_EQ(std::get<Vector>(data.variables.at("time").value), (Vector{{0, 1, 2}}));
    const Vector voltage = std::get<Vector>(data.variables.at("voltage").value);
    EXPECT_EQ(voltage[0], 0.025);
    EXPECT_TRUE(std::isnan(voltage[1]) && std::isnan(voltage[2]));
    EXPECT_EQ(data.units.at("voltage"), "V");
    EXPECT_THAT(message_text(data.notes.front()), HasSubstr("dynlab reads the first of the sheets Run 1, Run 2; to"));
    ImportOptions second;
    second.sheet = "Run 2";
    EXPECT_EQ(std::get<Vector>(read_data_file(file_, true, second).variables.at("c1").value), (Vector{{5}}));
    write(parts_of(
        "<row r=\"1\"><c r=\"A1\" t=\"s\"><v>0</v></c></row><row r=\"2\"><c r=\"A2\"><v>1</v></c></row>"
        "<row r=\"3\"><c r=\"A3\" t=\"str\"><v>five</v></c></row><row r=\"4\"><c r=\"A4\"><v>2</v></c></row>"));
    try {
        read_data_file(file_, true);
        ADD_FAILURE() << "no error";
    } catch (const EnvironmentError& error) {
        EXPECT_THAT(error.what(), HasSubstr("x.xlsx, line 3, column time: expected a number, got \"five\""));
    }
}

// Oracle: the sentence that the separate process wrote, with the arguments of this file.
TEST_F(workbook, refusal_is_a_message_that_can_be_translated) {
    write(parts_of(kRows));
    try {
        read_sheet(file_, "Run 3");
        FAIL() << "there is no such sheet";
    } catch (const EnvironmentError& error) {
        EXPECT_EQ(error.message(), Message("{} has no sheet \"{}\"; the sheets are {}", file_.string(), "Run 3",
                                           listed({"Run 1", "Run 2"})));
    }
}

TEST_F(workbook, says_what_is_wrong) {
    EXPECT_THAT(complaint(), HasSubstr("no such file"));
    write_file_atomically(file_, "t,y\n0,1\n");
    EXPECT_THAT(complaint(), HasSubstr("is not a workbook (.xlsx): it is not a zip archive"));
    write({{"other.xml", "<a/>"}});
    EXPECT_THAT(complaint(), HasSubstr("is damaged or is not a workbook: its part xl/workbook.xml"));
    write(parts_of(kRows));
    EXPECT_THAT(complaint("Run 3"), HasSubstr("has no sheet \"Run 3\"; the sheets are Run 1, Run 2"));
    const std::string bytes = read_file(file_);
    write_file_atomically(file_, std::string_view(bytes).substr(0, bytes.size() / 2));
    EXPECT_NE(complaint(), "no error");
    for (const char* rows :
         {"<row r=\"2\"/><row r=\"1\"/>", "<row r=\"9999999\"/>", "<row><c r=\"ZZZZ1\"><v>1</v></c></row>",
          "<row><c r=\"7\"><v>1</v></c></row>", "<row><c t=\"s\"><v>99</v></c></row>",
          "<row><c t=\"s\"><v>x</v></c></row>", "<row><c><v>1</c></row>", "<row r=\"two\"/>"}) {
        write(parts_of(rows));
        EXPECT_THAT(complaint(), HasSubstr("is damaged: ")) << rows;
    }
}

TEST_F(workbook, large_sheets_are_read) {
    constexpr int kRowCount = 200'000;
    std::string rows, csv;
    for (int i = 1; i <= kRowCount; ++i) {
        rows += fmt::format("<row r=\"{}\">", i);
        for (int j = 0; j < 8; ++j) {
            rows += fmt::format("<c r=\"{}{}\"><v>{}.{}</v></c>", static_cast<char>('A' + j), i, i % 977, j + 1);
            csv += fmt::format("{}.{}{}", i % 977, j + 1, j < 7 ? ',' : '\n');
        }
        rows += "</row>";
    }
    write(parts_of(rows));
    EXPECT_TRUE(read_sheet(file_, "").csv == csv);
}

TEST_F(workbook, prefixes_and_empty_sheets_are_read) {
    Parts parts = parts_of("");
    parts["xl/worksheets/sheet1.xml"] =
        "<x:worksheet xmlns:x=\"http://schemas.openxmlformats.org/spreadsheetml/2006/main\"><!-- sheetData -->"
        "<x:sheetData><x:row r=\"1\"><x:c r=\"A1\"><x:v>1</x:v></x:c></x:row><x:row r=\"2\"/>"
        "<x:row r=\"3\"><x:c r=\"B3\"><x:v>2</x:v></x:c></x:row></x:sheetData></x:worksheet>";
    parts["xl/worksheets/sheet2.xml"] = "<worksheet><sheetData/></worksheet>";
    write(parts);
    EXPECT_EQ(read_sheet(file_, "").csv, "1,\n\n,2\n");
    EXPECT_EQ(read_sheet(file_, "Run 2").csv, "");
}

// oracle: the limits that the header states
TEST_F(workbook, bombs_do_not_go_off) {
    Parts parts = parts_of(kRows);
    parts["xl/worksheets/sheet1.xml"] =
        "<!DOCTYPE a [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;\"><!ENTITY f SYSTEM "
        "\"file:///etc/hostname\">]>" +
        std::string("<worksheet><sheetData><row><c t=\"str\"><v>&b;&f;</v></c></row></sheetData></worksheet>");
    write(parts);
    EXPECT_EQ(read_sheet(file_, "").csv, "\"&b;&f;\"\n");
    parts["xl/huge.xml"] = std::string((std::size_t{256} << 20) + 1, ' ');
    write(parts);
    EXPECT_LT(std::filesystem::file_size(file_), 2u << 20);
    EXPECT_THAT(complaint(), HasSubstr("is larger than 256 MB when unpacked"));
    std::string rows;  // one cell at the far end of many rows
    for (int i = 1; i <= 60000; ++i) rows += fmt::format("<row r=\"{0}\"><c r=\"XFD{0}\"><v>1</v></c></row>", i);
    write(parts_of(rows));
    EXPECT_THAT(complaint(), HasSubstr("has a sheet larger than 64 MB"));
    Parts texts = parts_of(kRows);  // many of them: what is made of a part takes more than the part
    std::string& items = texts["xl/sharedStrings.xml"] = "<sst>";
    for (int i = 1; i <= 20'000'000; ++i) items += "<si/>";
    items += "</sst>";
    write(texts);
    EXPECT_LT(std::filesystem::file_size(file_), 2u << 20);
#ifndef __SANITIZE_ADDRESS__  // which lets no limit of memory be set
    const std::string refusal = complaint();
    EXPECT_THAT(refusal, HasSubstr("reading it requires more than 512 MB of memory, the limit for a file of "));
    EXPECT_THAT(refusal, HasSubstr("save the sheet as CSV"));
#endif
    std::string nested;
    for (int i = 0; i < 100000; ++i) nested += "<row>";
    write(parts_of(nested));
    EXPECT_NE(complaint(), "no error");
}

// oracle: the contract; whatever the bytes, reading gives a sheet or an EnvironmentError
TEST_F(workbook, mutations_are_read_or_refused) {
    write(parts_of(kRows));
    const std::string bytes = read_file(file_);
    std::mt19937 random(20240611);
    int refused = 0;
    for (int trial = 0; trial < 60; ++trial) {
        std::string wrong = bytes;
        for (unsigned k = 0; k <= random() % 8; ++k) wrong[random() % wrong.size()] = static_cast<char>(random());
        write_file_atomically(file_, wrong);
        const std::string message = complaint();
        EXPECT_THAT(message, testing::Not(HasSubstr("crash")));
        refused += message != "no error";
    }
    EXPECT_GT(refused, 0);
}

}  // namespace test_workbook
}  // namespace dynlab
