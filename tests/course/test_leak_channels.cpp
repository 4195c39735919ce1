// Names in places of a PDF that no reader of its text meets. Oracle: what was put where (ISO 32000-1; ITU-T T.81).
#include <fmt/format.h>
#include <ft2build.h>
#include <gmock/gmock.h>
#include FT_FREETYPE_H

#include <cctype>
#include <cmath>

#include "course/anonymity/anonymous_copy.h"
#include "course/anonymity/drawn_letters.h"
#include "course/anonymity/jpeg_parts.h"
#include "documents/work_file.h"
#include "leak_corpus.h"

namespace dynlab {
namespace test_leak_channels {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class leak_channels : public LeakCorpus {
  protected:
    static constexpr const char* kHello = "BT /F1 12 Tf 72 700 Td (The gain is known) Tj ET\n";
    static constexpr const char* kPlainFont = "<</Type/Font/Subtype/Type1/BaseFont/Helvetica>>";

    /// One page of this content, with a font F1 and a form that is not shown.
    std::vector<std::string> found_in(const std::string& content, const std::string& font = kPlainFont,
                                      const std::string& form = "0 0 m 9 9 l S",
                                      const std::vector<std::string>& more = {}) {
        std::vector<std::string> objects = {
            "<</Type/Catalog/Pages 2 0 R>>",
            "<</Type/Pages/Kids[3 0 R]/Count 1>>",
            "<</Type/Page/Parent 2 0 R/MediaBox[0 0 595 842]/Contents 4 0 R/Resources<</Font<</F1 "
            "5 0 R>>/XObject<</X0 6 0 R>>>>>>",
            stream_of(content),
            font,
            stream_of(form, "/Type/XObject/Subtype/Form/BBox[0 0 9 9]")};
        objects.insert(objects.end(), more.begin(), more.end());
        write("own.pdf", pdf_of(objects));
        return found(file("own.pdf"));
    }
};

TEST_F(leak_channels, an_honest_page_raises_no_alarm) {
    EXPECT_THAT(found_in(kHello), IsEmpty());
    EXPECT_THAT(found_in(kHello, kPlainFont, "/CS0 cs 1 scn % of Park and Young\n0 0 m 9 9 l S"), IsEmpty());
    EXPECT_THAT(found_in(std::string("% made by cairo 1.16\n/Span BMC ") + kHello + "EMC /Artifact MP"), IsEmpty());
}

TEST_F(leak_channels, comments_names_and_strange_words_in_content) {
    for (const char* said : {"% by Zoe Brandtner\n", "% brandtner\n", "% /home/somebody/crane.pdf\n",
                             "/Zoe_Brandtner BMC EMC\n", "/Author /ZoeBrandtner DP\n", "/Brandtner MP\n",
                             "BX Brandtner_Z EX\n", "BI /W 4 /H 4 /BPC 8 /CS /G ID Zoe BrandtnerXX EI\n"}) {
        EXPECT_THAT(found_in(kHello + std::string(said)), ElementsAre("name-hidden 1")) << said;
        EXPECT_THAT(found_in(std::string(said) + kHello), ElementsAre("name-hidden 1")) << said;
    }
}

TEST_F(leak_channels, forms_that_are_not_shown) {
    const std::string text = "BT /F1 9 Tf (by Zoe Brandtner) Tj ET";
    EXPECT_THAT(found_in(kHello, kPlainFont, text), ElementsAre("name-hidden 1"));
    EXPECT_THAT(found_in(kHello, kPlainFont, "%\xE2\xE3\xCF\xD3\x01\x02\x03\x04\x80\x81\n" + text),
                ElementsAre("name-hidden 1"));
    EXPECT_THAT(found_in(kHello, kPlainFont, "0 0 m % Zoe Brandtner\n9 9 l S"), ElementsAre("name-inside 1"));
    EXPECT_THAT(found_in(kHello, kPlainFont, "0 0 m % Li Wu\n9 9 l S"), ElementsAre("name-inside 1"));
    EXPECT_THAT(found_in(kHello, kPlainFont, "0 0 m % Brandtner\n9 9 l S"), ElementsAre("name-inside 1"));
}

TEST_F(leak_channels, slanted_text_in_codes_of_a_subset) {
    const std::string font =
        "<</Type/Font/Subtype/Type1/BaseFont/ABCDEF+Helvetica/FirstChar 1/LastChar 8/Encoding<</Type/Encoding"
        "/Differences[1/B/r/a/n/d/t/e/space]>>>>";
    const std::string slanted = "BT /F1 12 Tf 0.94 0.34 -0.34 0.94 200 400 Tm <010203040506040702> Tj ET";
    EXPECT_THAT(found_in(slanted, font), Contains("name-hidden 1"));
    EXPECT_THAT(found_in("BT /F1 12 Tf 0.94 0.34 -0.34 0.94 200 400 Tm <0102030405> Tj ET", font), IsEmpty());
}

TEST_F(leak_channels, slanted_letters_in_any_order) {
    const std::string name = "Zoe Brandtner";
    const std::vector<std::size_t> order = {6, 0, 12, 3, 9, 1, 11, 4, 2, 10, 5, 8, 7};
    const std::string subset =
        "<</Type/Font/Subtype/Type1/BaseFont/ABCDEF+Courier/FirstChar 1/LastChar 10/Encoding<</Type/Encoding"
        "/Differences[1/Z/o/e/space/B/r/a/n/d/t]>>>>";
    const std::string codes = "\1\2\3\4\5\6\7\10\11\12\10\3\6";  // of the name in that font
    for (const double degrees : {5.0, 20.0, -30.0, 120.0}) {
        const double angle = degrees * 3.141592653589793 / 180, c = std::cos(angle), s = std::sin(angle);
        std::string plain = "BT /F1 12 Tf\n", coded = "BT /F1 12 Tf\n", moved = "BT /F1 12 Tf\n";
        for (const std::size_t i : order) {
            if (name[i] == ' ') continue;
            const double step = 7.2 * static_cast<double>(i);
            const auto number = [](double x) { return std::to_string(x) + " "; };
            const std::string matrix = number(c) + number(s) + number(-s) + number(c);
            const std::string place = matrix + number(300 + step * c) + number(400 + step * s) + "Tm ";
            plain += place + "(" + name[i] + ") Tj\n";
            char code[8];
            std::snprintf(code, sizeof code, "<%02X>", static_cast<unsigned>(codes[i]));
            coded += place + code + " Tj\n";
            moved += matrix + "300 400 Tm " + number(step) + "0 Td [(" + name[i] + ")] TJ\n";
        }
        for (const std::string& content : {plain, moved})
            EXPECT_THAT(found_in(content + "ET\n" + kHello), Contains("name-hidden 1")) << degrees;
        EXPECT_THAT(found_in(coded + "ET", subset), Contains("name-hidden 1")) << degrees;
    }
    EXPECT_THAT(
        found_in("BT /F1 12 Tf 1 0 0 1 300 400 Tm (7) Tj 1 0 0 1 100 400 Tm (3) Tj 0.9 0.4 -0.4 0.9 9 9 Tm (B) Tj"
                 " 0.9 0.4 -0.4 0.9 5 7 Tm (Z) Tj ET"),
        IsEmpty());
}

TEST_F(leak_channels, fonts_that_tell_no_letters_are_told) {
    const std::string inner =
        "/DescendantFonts[<</Type/Font/Subtype/CIDFontType2/BaseFont/Own/CIDSystemInfo<</Registry(Adobe)"
        "/Ordering(Identity)/Supplement 0>>>>]";
    EXPECT_THAT(found_in("BT /F1 12 Tf 72 700 Td <00240025> Tj ET",
                         "<</Type/Font/Subtype/Type0/BaseFont/Own/Encoding/Identity-H" + inner + ">>"),
                ElementsAre("not-searched 0"));
    const auto drawn = [](const std::string& names) {
        return "<</Type/Font/Subtype/Type3/FontBBox[0 0 9 9]/FontMatrix[.1 0 0 .1 0 0]/FirstChar 1/LastChar 2"
               "/Widths[9 9]/CharProcs<<>>/Encoding<</Type/Encoding/Differences[1" +
               names + "]>>>>";
    };
    EXPECT_THAT(found_in("BT /F1 12 Tf 72 700 Td <0102> Tj ET", drawn("/g31/g32")), ElementsAre("not-searched 0"));
    EXPECT_THAT(found_in("BT /F1 12 Tf 72 700 Td <0102> Tj ET", drawn("/A/eacute")), IsEmpty());
    const auto simple = [](const std::string& kind, const std::string& entries) {
        return "<</Type/Font/Subtype/" + kind + "/BaseFont/Own/FirstChar 33/LastChar 34/Widths[600 600]" + entries +
               ">>";
    };
    const std::string numbered = "/Encoding<</Differences[33/g500/g501/space]>>",
                      named = "/Encoding<</Differences[33/A/eacute/a31/g5]>>",
                      codes = "BT /F1 12 Tf 72 700 Td <2122> Tj ET";
    for (const char* kind : {"TrueType", "Type1"}) {
        EXPECT_THAT(found_in(codes, simple(kind, numbered)), ElementsAre("not-searched 0")) << kind;
        EXPECT_THAT(found_in(codes, simple(kind, named)), IsEmpty()) << kind;
    }
}

/// A composite font with the whole of a font's file in it, its objects from 7 on: what its codes mean, the file, which
/// glyph each code is, and a CMap.
struct WholeFont {
    std::string file, descendant, key, entries;
    bool numbered = false;  ///< codes are not glyphs but three more
    std::string head = "/Type/Font/Subtype/Type0/Encoding/Identity-H", cmap = "";
    int digits = 4;  ///< of a code
};

constexpr const char* kMonospaced = "/usr/share/fonts/truetype/dejavu/DejaVuSansMono-Bold.ttf";

/// A text in the codes of a font, and lines of the font's table that tell another one of them.
class DrawnText {
  public:
    DrawnText(const WholeFont& font, const std::string& text, const std::string& told) {
        FT_Library library = nullptr;
        FT_Face face = nullptr;
        EXPECT_EQ(FT_Init_FreeType(&library), 0);
        EXPECT_EQ(FT_New_Face(library, font.file.c_str(), 0, &face), 0) << font.file;
        for (std::size_t i = 0; i < text.size(); ++i) {
            char code[16], line[32];
            const unsigned glyph = FT_Get_Char_Index(face, static_cast<unsigned char>(text[i]));
            std::snprintf(code, sizeof code, "%0*X", font.digits, glyph + (font.numbered ? 3 : 0));
            std::snprintf(line, sizeof line, "<%s> <%04X>\n", code, static_cast<unsigned char>(told[i]));
            codes += code;
            lines += line;
        }
        FT_Done_FreeType(library);
    }
    std::string codes, lines;
};

/// Each letter is told to be the next but two, which is a truth of none.
std::string lie_about(std::string text) {
    for (char& c : text)
        if (std::isalnum(static_cast<unsigned char>(c)) != 0)
            c = static_cast<char>(std::isdigit(static_cast<unsigned char>(c)) ? 'a' + (c - '0')
                                  : std::tolower(c) > 'w'                     ? c - 23
                                                                              : c + 3);
    return text;
}

class leak_fonts : public leak_channels {
  protected:
    /// What is found where `text` is drawn and `told` is what the font's table says of it.
    std::vector<std::string> found_of(const WholeFont& font, const std::string& text, const std::string& told) {
        const DrawnText drawn(font, text, told);
        const std::string map = "begincmap 1 begincodespacerange <0000> <FFFF> endcodespacerange\n100 beginbfchar\n" +
                                drawn.lines + "endbfchar endcmap";
        std::string numbers(6, '\0');  // of codes 0 to 2: no glyph
        for (unsigned glyph = 0; glyph < 3000; ++glyph) {
            numbers += static_cast<char>(glyph >> 8);
            numbers += static_cast<char>(glyph & 0xFF);
        }
        const std::string entries = font.key == "FontFile3" ? "/Subtype/OpenType" : "";
        return found_in("BT /F1 12 Tf 72 700 Td <" + drawn.codes + "> Tj ET",
                        "<<" + font.head + "/BaseFont/Own/ToUnicode 7 0 R/DescendantFonts[<</Type/Font/Subtype/" +
                            font.descendant +
                            "/BaseFont/Own/CIDSystemInfo<</Registry(Adobe)/Ordering(Identity)/Supplement 0>>/"
                            "FontDescriptor<</Type/FontDescriptor/FontName/Own/Flags 4/" +
                            font.key + " 8 0 R>>" + font.entries + ">>]>>",
                        "0 0 m 9 9 l S",
                        {stream_of(map), stream_of(read(font.file), entries), stream_of(numbers),
                         stream_of(font.cmap, "/Type/CMap/CMapName/Own")});
    }
    const std::string honest_ = "The gain of the crane is known from 3 records", named_ = "made by Zoe Brandtner";
};

TEST_F(leak_fonts, a_table_that_lies_of_its_letters) {
    const std::vector<WholeFont> fonts = {
        {kMonospaced, "CIDFontType2", "FontFile2", "/CIDToGIDMap 9 0 R", true},
        {"/usr/share/texmf/fonts/opentype/public/lm/lmsans10-bold.otf", "CIDFontType0", "FontFile3", ""},
        {"/usr/share/texmf/fonts/opentype/public/lm/lmsans10-oblique.otf", "CIDFontType0", "FontFile3", ""}};
    const std::string numbered = "as 20214711 says";
    for (const WholeFont& font : fonts) {
        EXPECT_THAT(found_of(font, honest_, lie_about(honest_)), IsEmpty()) << font.file;
        EXPECT_THAT(found_of(font, named_, lie_about(named_)), Contains("name-hidden 1")) << font.file;
        if (font.numbered) continue;  // a large font: once is enough
        EXPECT_THAT(found_of(font, honest_, honest_), IsEmpty()) << font.file;
        EXPECT_THAT(found_of(font, numbered, lie_about(numbered)), Contains("name-hidden 1")) << font.file;
    }
}

/// A letter has the code 33 and on as it comes first in the text, as programs number those of a subset: the table of a
/// TrueType file that says so, in the place of its own.
std::string file_with_codes(std::string font, const std::vector<unsigned>& glyphs) {
    const auto number = [](std::size_t value, int bytes) {
        std::string written;
        for (int i = bytes - 1; i >= 0; --i) written += static_cast<char>(value >> (8 * i) & 0xFF);
        return written;
    };
    std::string table = number(0, 2) + number(1, 2) + number(1, 2) + number(0, 2) + number(12, 4) + number(6, 2) +
                        number(10 + 2 * glyphs.size(), 2) + number(0, 2) + number(33, 2) + number(glyphs.size(), 2);
    for (const unsigned glyph : glyphs) table += number(glyph, 2);
    const std::size_t entry = font.find("cmap");
    return font.replace(entry + 8, 8, number(font.size(), 4) + number(table.size(), 4)) + table;
}

// Oracle: pdftoppm draws the letters; ISO 32000-1, 9.6.6.4 (codes of simple TrueType fonts).
TEST_F(leak_fonts, simple_fonts_are_read_by_what_they_draw) {
    const auto found_of_simple = [&](const std::string& text, const std::string& told, const std::string& encoding) {
        FT_Library library = nullptr;
        FT_Face face = nullptr;
        EXPECT_EQ(FT_Init_FreeType(&library), 0);
        EXPECT_EQ(FT_New_Face(library, kMonospaced, 0, &face), 0);
        std::string codes, lines, seen;
        std::vector<unsigned> glyphs;
        for (std::size_t i = 0; i < text.size(); ++i) {
            const std::size_t known = seen.find(text[i]);
            char code[8], line[32];
            std::snprintf(code, sizeof code, "%02X", static_cast<unsigned>(33 + std::min(known, seen.size())));
            std::snprintf(line, sizeof line, "<%s> <%04X>\n", code,
                          told.empty() ? 0U : static_cast<unsigned char>(told[i]));
            codes += code, lines += line;
            if (known != std::string::npos) continue;
            seen += text[i];
            glyphs.push_back(FT_Get_Char_Index(face, static_cast<unsigned char>(text[i])));
        }
        FT_Done_FreeType(library);
        const std::string map = "begincmap 1 begincodespacerange <00> <FF> endcodespacerange\n100 beginbfchar\n" +
                                lines + "endbfchar endcmap";
        const std::string table = told.empty() ? "" : "/ToUnicode 7 0 R";
        return found_in("BT /F1 12 Tf 72 700 Td <" + codes + "> Tj ET",
                        "<</Type/Font/Subtype/TrueType/BaseFont/Own/FirstChar 33/LastChar 34/Widths[600 600]" + table +
                            encoding + "/FontDescriptor<</Type/FontDescriptor/FontName/Own/Flags 4/FontFile2 8 0 R>>>>",
                        "0 0 m 9 9 l S", {stream_of(map), stream_of(file_with_codes(read(kMonospaced), glyphs))});
    };
    EXPECT_THAT(found_of_simple(named_, lie_about(named_), ""), Contains("name-hidden 1"));
    EXPECT_THAT(found_of_simple(honest_, lie_about(honest_), ""), IsEmpty());
    EXPECT_THAT(found_of_simple(honest_, honest_, ""), IsEmpty());
    EXPECT_THAT(found_of_simple(honest_, "", ""), ElementsAre("not-searched 0"));
    EXPECT_THAT(found_of_simple(named_, "", ""), AllOf(Contains("name-hidden 1"), Contains("not-searched 0")));
    EXPECT_THAT(found_of_simple(named_, "", "/Encoding/WinAnsiEncoding"), Contains("name-hidden 1"));
}

// Oracle: ISO 32000-1, 9.7.5 and 9.7.6.2, what each CMap says; pdftoppm draws the letters in all.
TEST_F(leak_fonts, a_font_is_known_by_its_parts_and_its_codes) {
    WholeFont font{kMonospaced, "CIDFontType2", "FontFile2", "/CIDToGIDMap 9 0 R", true};
    const std::string identity =
        "/CMapName /Own def 1 begincodespacerange <0000> <FFFF> endcodespacerange\n1 begincidrange <0000> <FFFF> 0 "
        "endcidrange";
    const auto expect_read = [&] {
        EXPECT_THAT(found_of(font, honest_, lie_about(honest_)), IsEmpty()) << font.head << font.cmap;
        EXPECT_THAT(found_of(font, named_, lie_about(named_)), Contains("name-hidden 1")) << font.head << font.cmap;
    };
    for (const char* head : {"/Subtype/Type0/Encoding/Identity-H", "/Type/Other/Subtype/Type0/Encoding/Identity-V",
                             "/Subtype/Type1/Encoding/Identity-H"}) {
        font.head = head;
        expect_read();
    }
    font.head = "/Type/Font/Subtype/Type0/Encoding 10 0 R";
    font.cmap = identity;
    expect_read();
    for (const std::string& other : {identity + " 1 begincidchar <0041> 66 endcidchar", std::string("nothing")}) {
        font.cmap = other;
        EXPECT_THAT(found_of(font, named_, lie_about(named_)), ElementsAre("not-searched 0")) << other;
    }
    font.head = "/Type/Font/Subtype/Type0/Encoding/UniGB-UCS2-H";
    EXPECT_THAT(found_of(font, named_, lie_about(named_)), ElementsAre("not-searched 0"));
    font.head = "/Type/Font/Subtype/Type0/Encoding 10 0 R";
    font.cmap = "1 begincodespacerange <00> <FF> endcodespacerange 1 begincidrange <00> <FF> 0 endcidrange";
    font.digits = 2;
    expect_read();
}

std::uint16_t glyph_of(char letter) {
    const WholeFont font{kMonospaced, "", "", ""};
    return static_cast<std::uint16_t>(std::stoul(DrawnText(font, std::string(1, letter), " ").codes, nullptr, 16));
}

// Oracle: which glyph each letter has in the font's own table, as FreeType reads it.
TEST(drawn_letters, each_code_of_a_glyph_is_judged_by_what_is_told_of_it) {
    GlyphCodes codes;
    const std::uint16_t k = glyph_of('k'), r = glyph_of('R');
    codes.glyphs = {0, k, k, k, 0, r, k, 0};
    const CodeMap told{2, {{1, "k"}, {2, "q"}, {3, "K"}, {5, "x"}, {7, "q"}}};
    const std::vector<CodeMap> drawn = DrawnLetters(known_fonts()).read(read_work_file(kMonospaced), codes, told);
    ASSERT_EQ(drawn.size(), 1u);
    const auto letter = [&](std::uint32_t code) {
        const auto found = drawn[0].text.find(code);
        return found == drawn[0].text.end() ? "" : found->second;
    };
    EXPECT_EQ(letter(1), "k");
    EXPECT_TRUE(letter(2) == "k" || letter(2) == "K") << letter(2);
    EXPECT_EQ(letter(3), "K");
    EXPECT_EQ(letter(5), "R");
    EXPECT_TRUE(letter(6) == "k" || letter(6) == "K") << letter(6);
    EXPECT_EQ(letter(7), "q");
}

TEST(drawn_letters, codes_are_as_long_as_they_are_said_to_be) {
    GlyphCodes codes;
    codes.bytes = 1;
    codes.glyphs = {glyph_of('R')};
    const std::vector<CodeMap> drawn =
        DrawnLetters(known_fonts()).read(read_work_file(kMonospaced), codes, {2, {{0, "x"}}});
    ASSERT_EQ(drawn.size(), 1u);
    EXPECT_EQ(drawn[0].bytes, 1u);
}

TEST_F(leak_channels, names_of_fonts_and_soft_hyphens) {
    EXPECT_THAT(found_in(kHello, "<</Type/Font/Subtype/Type1/BaseFont/ZoeBrandtnerHand>>"), Contains("name-inside 1"));
    const std::string latin =
        "<</Type/Font/Subtype/Type1/BaseFont/Helvetica/Encoding<</Type/Encoding/BaseEncoding/WinAnsiEncoding"
        "/Differences[173/uni00AD]>>>>";
    EXPECT_THAT(found_in("BT /F1 12 Tf 14 TL 72 700 Td (as by Brandt\\255) Tj T* (ner in the text) Tj ET", latin),
                ElementsAre("name-in-text 1"));
}

std::string segment(unsigned char kind, const std::string& content) {
    const std::size_t length = content.size() + 2;
    return std::string("\xFF") + static_cast<char>(kind) + static_cast<char>(length >> 8) +
           static_cast<char>(length & 0xFF) + content;
}

TEST_F(leak_channels, of_a_jpeg_only_the_first_picture_stays) {
    run({"gnuplot", "-e", "set terminal jpeg size 80,60; set output 'plain.jpg'; plot x"});
    const std::string plain = read(file("plain.jpg"));
    const std::string picture = parts_of_jpeg(plain).picture, name = "by Zoe Brandtner";
    ASSERT_TRUE(picture.starts_with("\xFF\xD8") && picture.ends_with("\xFF\xD9"));
    EXPECT_EQ(parts_of_jpeg(picture).picture, picture);
    const std::string body = plain.substr(2), end = "\xFF\xD9";
    const std::string open = plain.substr(0, plain.size() - 2);
    ASSERT_TRUE(plain.ends_with(end));
    const std::map<std::string, std::string> cases = {
        {"behind the scan", open + segment(0xFE, name) + end},
        {"behind fill bytes", "\xFF\xD8\xFF\xFF\xFF" + segment(0xFE, name) + body},
        {"fill bytes behind the scan", open + "\xFF\xFF" + segment(0xE1, name) + end},
        {"a second picture", plain + "\xFF\xD8" + segment(0xFE, name) + body},
        {"behind the end, and another end", plain + name + end},
        {"a reserved segment", "\xFF\xD8" + segment(0xF0, name) + body},
        {"between segments", "\xFF\xD8" + name + body},
        {"behind the tables",
         "\xFF\xD8" + segment(0xDB, std::string(1, '\x01') + std::string(64, '\x01') + name) + body}};
    for (const auto& [where, bytes] : cases) {
        const JpegParts parts = parts_of_jpeg(bytes);
        EXPECT_THAT(parts.picture, Not(HasSubstr("Brandtner"))) << where;
        EXPECT_THAT(parts.words + parts.tables, HasSubstr(name)) << where;
        if (where != "behind the tables") {
            EXPECT_EQ(parts.picture, picture) << where;
        }
    }
    const std::string table =
        "\xFF\xD8" + segment(0xDB, '\x03' + std::string("Zoe Brandtner ") + std::string(50, ' ')) + body;
    EXPECT_THAT(parts_of_jpeg(table).tables, HasSubstr("Zoe Brandtner")) << "as a table that is not used";
    for (const std::string bad :
         {"\xFF\xD8", "\xFF\xD8\xFF", "\xFF\xD8\xFF\xDA", "\xFF\xD8\xFF\xFE\xFF\xFF", "\xFF\xD8xx"})
        EXPECT_EQ(parts_of_jpeg(bad).picture.substr(0, 2), "\xFF\xD8");
}

std::string hexadecimal(const std::string& bytes) {
    std::string digits;
    for (const char c : bytes) digits += fmt::format("{:02x}", static_cast<unsigned char>(c));
    return digits;
}

// Oracle: ISO 32000-1, 8.9.5 (bytes of samples); ITU-T T.88, 7.3 (62 is an extension, which draws nothing).
TEST_F(leak_channels, what_pictures_hold_besides_their_samples) {
    const std::string grey = "/ColorSpace/DeviceGray/BitsPerComponent 8", black = "/ImageMask true",
                      author = "Author: Zoe Brandtner", samples(64, '\x80');
    const auto copied = [&](const std::string& data, const std::string& entries) {
        write("own.pdf", pdf_of({"<</Type/Catalog/Pages 2 0 R>>", "<</Type/Pages/Kids[3 0 R]/Count 1>>",
                                 "<</Type/Page/Parent 2 0 R/MediaBox[0 0 595 842]/Contents 4 0 R/Resources<</Font<</F1 "
                                 "5 0 R>>/XObject<</X0 6 0 R>>>>>>",
                                 stream_of(std::string(kHello) + "q 9 0 0 9 72 600 cm /X0 Do Q"), kPlainFont,
                                 stream_of(data, "/Type/XObject/Subtype/Image/Width 8/Height 8" + entries)}));
        write("copy.pdf", clean_pdf(file("own.pdf")));
        return found(file("own.pdf"));
    };
    for (const std::string filter : {"", "/Filter/ASCIIHexDecode"}) {
        const auto coded = [&](const std::string& bytes) { return filter.empty() ? bytes : hexadecimal(bytes) + ">"; };
        EXPECT_THAT(copied(coded(samples + author), grey + filter), ElementsAre("name-in-image 1")) << filter;
        EXPECT_THAT(found(file("copy.pdf")), IsEmpty()) << filter;
        EXPECT_THAT(copied(coded(samples), grey + filter), IsEmpty()) << filter;
        EXPECT_THAT(copied(coded(samples.substr(0, 8) + author), black + filter), ElementsAre("name-in-image 1"));
        EXPECT_THAT(copied(coded(samples + author), "/ColorSpace/Unheard/BitsPerComponent 8" + filter),
                    ElementsAre("name-in-image 1"));
        EXPECT_THAT(copied(coded(author + samples.substr(author.size())), grey + filter),
                    ElementsAre("name-in-image 1"));
    }
    const std::string page_segment =
                          std::string("\0\0\0\0\x30\0\x01\0\0\0\x13\0\0\0\x08\0\0\0\x08", 19) + std::string(11, '\0'),
                      comment = std::string("Author\0Zoe Brandtner\0\0", 22);
    const std::string extension = std::string("\0\0\0\x01\x3E\0\x01\0\0\0\x1A\x20\0\0\0", 15) + comment;
    EXPECT_THAT(copied(page_segment + extension, grey + "/Filter/JBIG2Decode"), ElementsAre("name-in-image 1"));
    EXPECT_THAT(copied(std::string("\xFF\xFF\0\x10\x01\0\x10\x01", 8) + author,
                       "/ColorSpace/DeviceGray/BitsPerComponent 1/Filter/CCITTFaxDecode"
                       "/DecodeParms<</K -1/Columns 8/Rows 8>>"),
                ElementsAre("name-in-image 1"));
}

/// zlib's format (RFC 1950 and 1951) in one block that is stored.
std::string deflated(const std::string& bytes) {
    unsigned a = 1, b = 0;
    for (const char c : bytes) {
        a = (a + static_cast<unsigned char>(c)) % 65521;
        b = (b + a) % 65521;
    }
    const auto size = static_cast<unsigned>(bytes.size()), check = b << 16 | a;
    std::string packed = "\x78\x01\x01";
    for (const unsigned byte : {size, size >> 8, ~size, ~size >> 8}) packed += static_cast<char>(byte & 0xFF);
    packed += bytes;
    for (const int shift : {24, 16, 8, 0}) packed += static_cast<char>(check >> shift & 0xFF);
    return packed;
}

// Oracle: ISO 32000-1, 7.4: packed data end at a mark of their own, and filters follow one another.
TEST_F(leak_channels, nothing_stands_behind_the_end_of_packed_data_in_copies) {
    const std::string author = "Author: Zoe Brandtner";
    run({"gnuplot", "-e", "set terminal jpeg size 80,60; set output 'plain.jpg'; plot x"});
    const std::string plain = read(file("plain.jpg")), photograph = "/ColorSpace/DeviceRGB/BitsPerComponent 8";
    const std::string named = plain.substr(0, plain.size() - 2) + segment(0xFE, author) + "\xFF\xD9";
    const auto copied = [&](const std::string& content, const std::string& picture) {
        write("own.pdf", pdf_of({"<</Type/Catalog/Pages 2 0 R>>", "<</Type/Pages/Kids[3 0 R]/Count 1>>",
                                 "<</Type/Page/Parent 2 0 R/MediaBox[0 0 595 842]/Contents 4 0 R/Resources<</Font<</F1 "
                                 "5 0 R>>/XObject<</X0 6 0 R>>>>>>",
                                 content, kPlainFont, picture}));
        write("copy.pdf", clean_pdf(file("own.pdf")));
        EXPECT_THAT(found(file("copy.pdf")), IsEmpty());
        EXPECT_THAT(text_of("copy.pdf"), HasSubstr("The gain is known"));
        run({"qpdf", "--stream-data=uncompress", "copy.pdf", "written_out.pdf"});
        return read(file("copy.pdf")) + read(file("written_out.pdf"));
    };
    const auto image = [](const std::string& data, const std::string& entries) {
        return stream_of(data, "/Type/XObject/Subtype/Image/Width 80/Height 60" + entries);
    };
    const std::string shown = std::string(kHello) + "q 9 0 0 9 72 600 cm /X0 Do Q";
    const std::string samples(80 * 60 * 3, '\x80');
    for (const auto& [content, picture] :
         {std::pair(stream_of(deflated(shown) + author, "/Filter/FlateDecode"),
                    image(plain, photograph + "/Filter/DCTDecode")),
          std::pair(stream_of(hexadecimal(shown) + ">" + author, "/Filter[/ASCIIHexDecode]"),
                    image(hexadecimal(named) + ">" + author, photograph + "/Filter[/ASCIIHexDecode/DCTDecode]")),
          std::pair(stream_of(shown), image(deflated(named) + author,
                                            photograph + "/Filter[/FlateDecode/DCTDecode]/DecodeParms[null null]")),
          std::pair(stream_of(shown), image(deflated(samples) + author, photograph + "/Filter/FlateDecode"))}) {
        const std::string bytes = copied(content, picture);
        for (const std::string& name : {std::string("Brandtner"), hexadecimal("Brandtner")})
            EXPECT_THAT(bytes, Not(HasSubstr(name)));
    }
}

// Oracle: the page as pdftoppm draws it, before and after.
TEST_F(leak_channels, a_cleaned_photograph_looks_as_before) {
    run({"gnuplot", "-e", "set terminal jpeg size 80,60; set output 'plain.jpg'; plot x"});
    const std::string plain = read(file("plain.jpg"));
    write("plain.jpg", plain.substr(0, plain.size() - 2) + segment(0xFE, "by Zoe Brandtner") + "\xFF\xD9");
    const auto own = latex("\\usepackage{graphicx}\n", std::string(kProse) + "\\includegraphics{plain.jpg}");
    EXPECT_THAT(found(own), ElementsAre("name-in-image 1"));
    AnonymousCopySetup setup;
    setup.names = *names_;
    const AnonymousCopy copy = anonymous_copy(own, file("copy.pdf"), setup);
    ASSERT_TRUE(copy.made) << message_text(copy.trouble);
    for (const char* name : {"own", "copy"}) run({"pdftoppm", "-r", "50", std::string(name) + ".pdf", name});
    EXPECT_EQ(read(file("own-1.ppm")), read(file("copy-1.ppm")));
}

}  // namespace test_leak_channels
}  // namespace dynlab
