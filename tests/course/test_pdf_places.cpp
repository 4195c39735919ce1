// Names that stand in a PDF where poppler finds no words. Oracle: how each file was made; viewers show all of the text.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "leak_corpus.h"

namespace dynlab {
namespace test_pdf_places {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

class pdf_places : public LeakCorpus {
  protected:
    /// In the codes of the font of page_with: letters are one off, of two bytes.
    static std::string coded(const std::string& ascii) {
        std::string codes = "<";
        char code[8];
        for (const char c : ascii) {
            std::snprintf(code, sizeof code, "%04X", c + 1);
            codes += code;
        }
        return codes + ">";
    }

    /// A page whose font /F1 has codes of its own, as XeTeX, Typst and browsers write them.
    std::filesystem::path page_with(const std::string& content, const std::string& catalogue = "") const {
        const std::string map =
            "1 begincodespacerange <0000> <FFFF> endcodespacerange 1 beginbfrange <0021> <007F> <0020> endbfrange";
        write(
            "own.pdf",
            pdf_of({"<</Type/Catalog/Pages 2 0 R" + catalogue + ">>", "<</Type/Pages/Kids[3 0 R]/Count 1>>",
                    "<</Type/Page/Parent 2 0 R/MediaBox[0 0 595 842]/Contents 4 0 R/Resources<</Font<</F1 5 0 R>>>>>>",
                    stream_of(content),
                    "<</Type/Font/Subtype/Type0/BaseFont/Helvetica/Encoding/Identity-H/DescendantFonts[6 0 R]"
                    "/ToUnicode 8 0 R>>",
                    "<</Type/Font/Subtype/CIDFontType2/BaseFont/Helvetica/CIDSystemInfo<</Registry(Adobe)"
                    "/Ordering(Identity)/Supplement 0>>/FontDescriptor 7 0 R/DW 600>>",
                    "<</Type/FontDescriptor/FontName/Helvetica/Flags 32/FontBBox[0 -200 1000 800]/ItalicAngle 0"
                    "/Ascent 800/Descent -200/CapHeight 700/StemV 80>>",
                    stream_of(map)}));
        return file("own.pdf");
    }

    std::filesystem::path page_with_text(const std::string& matrix, const std::string& text) const {
        return page_with("BT /F1 11 Tf " + matrix + " 250 300 Tm " + coded(text) + " Tj ET");
    }
};

TEST_F(pdf_places, slanted_and_mirrored_text_in_codes_of_its_own_font) {
    EXPECT_THAT(found(page_with_text("1 0 0 1", "A report by Brandtner, Zoe")), ElementsAre("name-in-text 1"));
    for (const double degrees : {5., 20., 45., 75., 135.}) {
        const double angle = degrees * std::numbers::pi / 180;
        const std::string c = std::to_string(std::cos(angle)), s = std::to_string(std::sin(angle));
        const std::string matrix = c + " " + s + " " + std::to_string(-std::sin(angle)) + " " + c;
        EXPECT_THAT(found(page_with_text(matrix, "A report by Brandtner, Zoe")), ElementsAre("name-hidden 1"))
            << degrees;
        EXPECT_THAT(found(page_with_text(matrix, "The speed in rad/s")), IsEmpty()) << degrees;
    }
    EXPECT_THAT(found(page_with_text("-1 0 0 1", "A report by Brandtner")), ElementsAre("name-hidden 1"));
}

/// Slanted text in the codes of the last of many fonts, each with its own: letters are as many off as it has
/// predecessors.
TEST_F(pdf_places, codes_of_many_fonts) {
    const auto page_with_fonts = [this](int fonts) {
        std::string names, code;
        std::vector<std::string> objects = {"<</Type/Catalog/Pages 2 0 R>>", "<</Type/Pages/Kids[3 0 R]/Count 1>>", "",
                                            ""};
        const auto hexadecimal = [](int number) {
            char digits[16];
            std::snprintf(digits, sizeof digits, "<%04X>", number);
            return std::string(digits);
        };
        for (int i = 0; i < fonts; ++i) {
            names += "/F" + std::to_string(i) + " " + std::to_string(5 + 2 * i) + " 0 R";
            objects.push_back("<</Type/Font/Subtype/Type0/BaseFont/Helvetica/Encoding/Identity-H/ToUnicode " +
                              std::to_string(6 + 2 * i) + " 0 R>>");
            objects.push_back(
                stream_of("1 beginbfrange " + hexadecimal(0x20 + i) + hexadecimal(0x7E + i) + "<0020> endbfrange"));
        }
        for (const char c : std::string("by Brandtner")) code += hexadecimal(c + fonts - 1).substr(1, 4);
        objects[2] =
            "<</Type/Page/Parent 2 0 R/MediaBox[0 0 595 842]/Contents 4 0 R/Resources<</Font<<" + names + ">>>>>>";
        objects[3] = stream_of("BT /F" + std::to_string(fonts - 1) + " 11 Tf -1 0 0 1 250 300 Tm <" + code + "> Tj ET");
        write("fonts.pdf", pdf_of(objects));
        return file("fonts.pdf");
    };
    EXPECT_THAT(found(page_with_fonts(60)), ElementsAre("name-hidden 1"));
    EXPECT_THAT(found(page_with_fonts(250)), ElementsAre("not-searched 0"));
}

TEST_F(pdf_places, behind_five_megabytes_of_lines) {
    std::string content;
    while (content.size() < 5'000'000) content += "10 10 m 20 20 l S\n";
    EXPECT_THAT(found(page_with(content + "BT /F1 11 Tf -1 0 0 1 250 300 Tm " + coded("by Brandtner") + " Tj ET")),
                ElementsAre("name-hidden 1"));
}

TEST_F(pdf_places, strings_of_marked_content) {
    EXPECT_THAT(
        found(page_with("/Note <</Own (by Brandtner)>> BDC BT /F1 11 Tf 100 300 Td " + coded("x") + " Tj ET EMC")),
        ElementsAre("name-hidden 1"));
    EXPECT_THAT(found(page_with("/Note <</Own <4272616E64746E6572>>> BDC BT /F1 11 Tf 100 300 Td " + coded("x") +
                                " Tj ET EMC")),
                ElementsAre("name-hidden 1"));
}

TEST_F(pdf_places, letters_beyond_the_first_plane) {
    const auto bold = [](const std::string& small_letters) {
        std::string hexadecimal = "<";
        char unit[8];
        for (const char c : small_letters) {
            std::snprintf(unit, sizeof unit, "%04X", 0xDC1A + c - 'a');
            hexadecimal += std::string("D835") + unit;
        }
        return hexadecimal + ">";
    };
    EXPECT_THAT(found(page_with("", "/Own " + bold("brandtner"))), Contains("name-inside 0"));
}

// Oracle: ISO 32000-1, 7.9.2.2 and annex D.3 (PDFDocEncoding); programs write UTF-8 without a mark nevertheless.
TEST_F(pdf_places, text_strings_of_each_encoding) {
    for (const char* name :
         {"(by M\\374llhauser)", "(by M\\303\\274llhauser)", "(\\357\\273\\277by M\\303\\274llhauser)",
          "<FEFF004D00FC006C006C006800610075007300650072>", "<004D00FC006C006C006800610075007300650072>",
          "<004200720061006E00640074006E00650072>", "<FFFE4D00FC006C006C006800610075007300650072000000>"})
        EXPECT_THAT(found(page_with("", std::string("/Own ") + name)), Contains("name-inside 0")) << name;
}

TEST_F(pdf_places, strings_nested_as_deep_as_qpdf_reads) {
    const std::string open(450, '['), close(450, ']');
    EXPECT_THAT(found(page_with("", "/Own " + open + "(Zoe Brandtner)" + close)), Contains("name-inside 0"));
}

}  // namespace test_pdf_places
}  // namespace dynlab
