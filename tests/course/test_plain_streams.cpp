// PDFs with their streams written out. Oracle: what poppler and qpdf read in the file as it was.
#include "documents/pdf/plain_streams.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "documents/pdf/content_paths.h"
#include "leak_corpus.h"

namespace dynlab {
namespace test_plain_streams {

using testing::HasSubstr;
using testing::Not;

class plain_streams : public LeakCorpus {
  protected:
    std::string made(const std::string& preamble = "") {
        return read(
            latex(preamble, std::string("\\section{Process}") + kProse + "\\newpage $\\omega^2 = k/m$ " + kProse));
    }
    std::string by_qpdf(const std::string& pdf, std::vector<std::string> how) {
        write("in.pdf", pdf);
        how.insert(how.begin(), "qpdf");
        how.insert(how.end(), {"in.pdf", "out.pdf"});
        run(how);
        return read(file("out.pdf"));
    }
    std::string boxes_of(const std::string& pdf) {
        write("boxes.pdf", pdf);
        run({"pdftotext", "-bbox-layout", "boxes.pdf", "boxes.html"});
        return read(file("boxes.html"));
    }
    /// What poppler reads in a file that need not be sound.
    std::string boxes_if_any(const std::string& pdf) {
        std::filesystem::remove(file("boxes.html"));
        write("boxes.pdf", pdf);
        ChildOptions child;
        child.command = {"pdftotext", "-bbox-layout", "boxes.pdf", "boxes.html"};
        child.folder = folder_.path();
        return std::to_string(run_child(child, "pdftotext").exit_code) + read(file("boxes.html"));
    }
    /// A PDF of one page whose content is the stream.
    static std::string page_of(const std::string& dictionary, const std::string& data) {
        return pdf_of({"<</Type/Catalog/Pages 2 0 R>>", "<</Type/Pages/Kids[3 0 R]/Count 1>>",
                       "<</Type/Page/Parent 2 0 R/MediaBox[0 0 9 9]/Contents 4 0 R>>",
                       "<<" + dictionary + ">>\nstream\n" + data + "\nendstream"});
    }
    void expect_plain_and_equal(const std::string& pdf) {
        const std::string plain = with_plain_streams(pdf);
        EXPECT_THAT(pdf, Not(HasSubstr(" Tf")));
        EXPECT_THAT(plain, HasSubstr(" Tf"));          // a page's content
        EXPECT_THAT(plain, HasSubstr("/FontName /"));  // a font
        EXPECT_EQ(boxes_of(plain), boxes_of(pdf));
        write("checked.pdf", plain);
        run({"qpdf", "--check", "checked.pdf"});
    }
};

TEST_F(plain_streams, packed_objects_and_plain_tables_read_the_same) {
    const std::string packed = made();
    ASSERT_THAT(packed, HasSubstr("/ObjStm"));
    expect_plain_and_equal(packed);
    expect_plain_and_equal(made("\\pdfobjcompresslevel=0\n"));
    expect_plain_and_equal(by_qpdf(packed, {"--object-streams=generate"}));  // whose table holds differences
    expect_plain_and_equal(by_qpdf(packed, {"--object-streams=disable"}));
    expect_plain_and_equal(by_qpdf(packed, {"--linearize"}));
}

// oracle: the operators of ISO 32000-1, annex A, by hand
TEST_F(plain_streams, paths_are_left_out_and_nothing_else) {
    const std::map<std::string, std::string> cases = {
        {"1 0 0 1 5 5 cm 1 2 m 3 4 l S BT /F1 12 Tf 7 0 Td (a) Tj ET",
         "1 0 0 1 5 5 cm    BT /F1 12 Tf 7 0 Td (a) Tj ET"},
        {"q 0 0 9 9 re W* n 1 g f* Q", "q    1 g  Q"},
        {"-1.5 +.5 m % 1 2 l\n.3 -4 l h b*", " % 1 2 l\n  "},
        {"1 2 m BT(1 2 m \\) 3 4 l S) Tj (a(b) 1 2 m) Tj", " BT(1 2 m \\) 3 4 l S) Tj (a(b) 1 2 m) Tj"},
        {"1 2 m BT <31 20 6D> Tj [(a)-250(b m)]TJ ET 3 4 l", " BT <31 20 6D> Tj [(a)-250(b m)]TJ ET "},
        {"/m 1 Tf /f BMC EMC << /l 1 >> gs 1 2 m", "/m 1 Tf /f BMC EMC << /l 1 >> gs "},
        {"1 2 m BI /W 1 ID 3 4 l EI 5 6 l S", " BI /W 1 ID 3 4 l EI 5 6 l S"},
        {"1 2 mm 3 4 l2 m2 5 6 m 5", "1 2 mm 3 4 l2 m2  5"},
        {"1 2 m(never ended 1 2 m", "(never ended 1 2 m"},
        {"1 2 m<31 1 2 m", "<31 1 2 m"},
        {"1 2 m BT(a)Tj ET 3 4 l BT[(b)]TJ ET", " BT(a)Tj ET  BT[(b)]TJ ET"},
        {"", ""}};
    for (const auto& [content, rest] : cases) EXPECT_EQ(without_paths(content), rest) << content;
    for (const std::string faulty : {"1 2 m (a) f", "1 2 m 1 2 3 l", "1 2 m l", "1 2 m null h", "1 2 m [ 3 4 l ] TJ",
                                     "1 2 m ]", "1 2 m << /a [ >>", "1 2 m >", "1 2 m )", "1 2 m }",
                                     "1 2 m BT 1 2 l ET", "1 2 m (a) Tj", "1 2 m [(a)] TJ", "1 2 m BT ET (a) '"})
        EXPECT_EQ(without_paths(faulty), faulty);
}

// oracle: what poppler reads in the file as it was
TEST_F(plain_streams, pieces_of_a_content_keep_their_paths) {
    const auto encoded = [](const std::string& content, const std::string& entries = "") {
        std::string digits;
        char two[4];
        for (const char c : content) {
            std::snprintf(two, sizeof two, "%02X", static_cast<unsigned>(c));
            digits += two;
        }
        return stream_of(digits + ">", "/Filter/ASCIIHexDecode" + entries);
    };
    const auto page = [](const std::string& contents) {
        return "<</Type/Page/Parent 2 0 R/MediaBox[0 0 595 842]/Resources<</Font<</F1 3 0 R>>>>/Contents " + contents +
               ">>";
    };
    const std::string pieces = "[4 0 R 5 0 R 6 0 R]";
    for (const std::string kind : {"", "/Subtype/Form", "/Type/XObject/Subtype/Form/BBox[0 0 9 9]"})
        for (const std::string& first : {page(pieces), page("8 0 R")})
            for (const std::string& second : {page(pieces), page("5 0 R")}) {
                const std::string pdf =
                    pdf_of({"<</Type/Catalog/Pages 2 0 R>>", "<</Type/Pages/Kids[7 0 R 9 0 R]/Count 2>>",
                            "<</Type/Font/Subtype/Type1/BaseFont/Helvetica>>",
                            encoded("BT /F1 12 Tf 72 700 Td (The student number is "), encoded("20214711 0 l", kind),
                            encoded(" and so on) Tj ET"), first, pieces, second});
                const std::string plain = with_plain_streams(pdf);
                EXPECT_THAT(boxes_of(pdf), HasSubstr(">20214711<"));
                EXPECT_THAT(plain, HasSubstr("(The student number is "));
                EXPECT_EQ(boxes_of(plain), boxes_of(pdf)) << kind << first << second;
            }
}

// oracle: what poppler reads in the file as it was
TEST_F(plain_streams, pages_of_any_operators_read_the_same) {
    const std::vector<std::string> drawing = {
        "1 20 m", "-3.5 300 l", ".5 0 1 2 3 4 c", "9 9 40 40 re",   "5 5 6 6 v", "h", "S",    "f*",
        "W n",    "B*",         "1 2 m 3 4 l S",  "1 0 0 1 3 3 cm", "q",         "Q", ".3 g", "1 0 0 rg",
        "/a gs",  "%m l\n",     "<31 20 6D> pop", "(1 2 m) pop",    "2 w"};
    const std::vector<std::string> writing = {
        "(a)Tj",           "(two) Tj",  "T*",        "3 0 Td",    "0 -9 TD", "1 0 0 1 50 700 Tm",
        "[(k)-400(l)]TJ",  "<41> Tj",   "(x\\)) Tj", "((y)m) Tj", "12 TL",   "2 Tr",
        "(1 2 m 3 4 l)Tj", "%3 0 Td\n", "/Span BMC", "EMC"};
    const std::vector<std::string> faults = {"l",
                                             "4 re",
                                             "1 2",
                                             "true",
                                             ")",
                                             ">",
                                             "[",
                                             "]",
                                             "<<",
                                             ">>",
                                             "null",
                                             "/a",
                                             "BI /W 1 /H 1 /BPC 8 /CS /G ID m EI",
                                             "Do",
                                             "d",
                                             "1 2 m",
                                             "(b)Tj",
                                             "BT",
                                             "ET"};
    std::mt19937 random(11);
    int shorter = 0;
    for (int file = 0; file < 6; ++file) {
        constexpr int kPages = 30;
        std::string kids;
        std::vector<std::string> objects = {"<</Type/Catalog/Pages 2 0 R>>", "",
                                            "<</Type/Font/Subtype/Type1/BaseFont/Helvetica>>"};
        for (int page = 0; page < kPages; ++page) {
            std::string content = "BT /F1 12 Tf 14 TL 1 0 0 1 50 600 Tm (begun) Tj ET\n";
            for (int i = 0; i < 60; ++i) {
                const bool writes = i / 6 % 2 == 0;
                if (i % 6 == 0)
                    content += writes ? " BT /F1 9 Tf 1 0 0 1 50 " + std::to_string(40 + 9 * i) + " Tm " : " ET ";
                const std::vector<std::string>& some = random() % 80 == 0 ? faults : writes ? writing : drawing;
                content += some[random() % some.size()] + (random() % 4 == 0 ? "\n" : " ");
            }
            content += " ET BT /F1 12 Tf 1 0 0 1 90 90 Tm (ended) Tj ET";
            shorter += without_paths(content).size() < content.size();
            const std::string number = std::to_string(objects.size() + 1);
            kids += number + " 0 R ";
            objects.push_back(
                "<</Type/Page/Parent 2 0 R/MediaBox[0 0 595 842]/Resources<</Font<</F1 3 0 R>>>>/Contents " +
                std::to_string(objects.size() + 2) + " 0 R>>");
            objects.push_back(stream_of(content));
        }
        objects[1] = "<</Type/Pages/Kids[" + kids + "]/Count " + std::to_string(kPages) + ">>";
        const std::string pdf = by_qpdf(pdf_of(objects), {"--compress-streams=y"});
        const std::string plain = with_plain_streams(pdf);
        EXPECT_NE(plain, pdf);
        EXPECT_EQ(boxes_of(plain), boxes_of(pdf)) << file;
    }
    EXPECT_GT(shorter, 100);
}

TEST_F(plain_streams, figures_read_the_same) {
    run({"gnuplot", "-e",
         "set terminal pdfcairo; set output 'figure.pdf'; set xlabel 'time t in s'; set title 'Curves'; set samples "
         "500; plot sin(x) title 'measured', cos(x) with points title 'made'"});
    const std::string pdf =
        read(latex("\\usepackage{graphicx}", std::string(kProse) + "\\includegraphics{figure.pdf}\\newpage " + kProse));
    const std::string plain = with_plain_streams(pdf);
    EXPECT_THAT(boxes_of(pdf), HasSubstr("measured"));
    EXPECT_EQ(boxes_of(plain), boxes_of(pdf));
    EXPECT_LT(plain.size(), by_qpdf(pdf, {"--stream-data=uncompress"}).size());
}

TEST_F(plain_streams, unusual_files_stay_as_they_are) {
    const std::string sound = made();
    const std::string updated = sound + "\nstartxref\n" + std::to_string(sound.rfind("startxref")) + "\n%%EOF\n";
    for (const std::string& unusual :
         {by_qpdf(sound, {"--encrypt", "", "owner", "256", "--"}), updated, sound.substr(0, sound.size() / 2),
          sound.substr(5), std::string(), std::string("%PDF-1.4\nstartxref\n9\n")})
        EXPECT_EQ(with_plain_streams(unusual), unusual);
}

// oracle: RFC 1950 for the eleven bytes, ISO 32000-1 7.3.8 for the dictionary
TEST_F(plain_streams, streams_of_unusual_form_stay_compressed) {
    const std::string data("\x78\x9c\x4b\x4c\x4a\x06\x00\x02\x4d\x01\x27", 11);  // "abc"
    const std::string usual = "/Length 11/Filter/FlateDecode";
    const auto inflates = [&](const std::string& dictionary, const std::string& bytes) {
        return with_plain_streams(page_of(dictionary, bytes)).find("stream\nabc\nendstream") != std::string::npos;
    };
    EXPECT_TRUE(inflates(usual, data));
    EXPECT_TRUE(inflates("/Length 11/Filter[/FlateDecode]/A(a\\)b)/B<</C[1 0 R<41>]>>", data));
    std::string damaged = data;
    damaged[2] = 0x07;  // a block of no kind
    EXPECT_THAT(with_plain_streams(page_of(usual, damaged)), HasSubstr(damaged));
    EXPECT_FALSE(inflates("/Length 10/Filter/FlateDecode", data));
    for (const char* unusual : {"/DecodeParms<</Predictor 12>>", "/Decode#50arms<</Predictor 12>>", "/F(other.bin)",
                                "/Filter/FlateDecode", "/Subtype/Image", "/Type/EmbeddedFile", "/DP<</Predictor 12>>"})
        EXPECT_FALSE(inflates(usual + unusual, data)) << unusual;
    EXPECT_FALSE(inflates("/Length 11/Filter[/FlateDecode/FlateDecode]", data));
    EXPECT_FALSE(inflates("/Length 4 0 R/Filter/FlateDecode", data));
}

TEST_F(plain_streams, what_is_very_large_stays_compressed) {
    const std::string data(65u << 20, ' ');
    const std::string packed =
        by_qpdf(page_of("/Length " + std::to_string(data.size()), data), {"--compress-streams=y"});
    ASSERT_LT(packed.size(), 1u << 20);
    EXPECT_LT(with_plain_streams(packed).size(), 1u << 20);
}

// Oracle: what poppler reads in three hundred of three thousand damaged files, with their streams written out or not.
TEST_F(plain_streams, damage_is_read_as_it_was) {
    const std::string sound = by_qpdf(made(), {"--object-streams=disable"});
    const std::size_t table = sound.rfind("xref", sound.rfind("startxref") - 1);
    std::mt19937 random(5);
    int compared = 0;
    for (int round = 0; round < 3000; ++round) {
        std::string pdf = sound;
        for (int i = 0; i < 3; ++i) {
            const std::size_t from = random() % 2 == 0 ? 0 : table;
            pdf[from + random() % (pdf.size() - from)] = "0123456789<>[]()/% Rn\xff"[random() % 22];
        }
        const std::string plain = with_plain_streams(pdf);
        if (plain == pdf || round % 10 != 0) continue;
        EXPECT_EQ(boxes_if_any(plain), boxes_if_any(pdf)) << round;
        ++compared;
    }
    EXPECT_GT(compared, 20);
}

}  // namespace test_plain_streams
}  // namespace dynlab
