// Text of content streams and the maps of their fonts. Oracle: ISO 32000-1, 7.3.4, 9.10.3 and 14.6.
#include "course/names/content_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dynlab {
namespace test_content_text {

using testing::HasSubstr;

TEST(content_text, strings_of_dictionaries_in_a_stream_are_read) {
    EXPECT_EQ(shown_text(shown_pieces("/Span <</ActualText (Ada Li) /E <41 64 61>>> BDC (x) Tj EMC")),
              "\nAda LiAda\n\nx");
    EXPECT_EQ(shown_text(shown_pieces("/P << /A << /B (inner) >> >> BDC <616263> Tj")), "\n\ninner\n\n\nabc");
    EXPECT_EQ(shown_text(shown_pieces("(Love) Tj [(la) -20 (ce) -300 (A)] TJ")), "Lovelace A");
}

TEST(content_text, one_stream_is_read_with_several_maps) {
    const std::vector<ShownPiece> pieces = shown_pieces("<0102> Tj 0 -12 Td <03> Tj");
    const CodeMap first = code_map("2 beginbfchar <01> <0041> <02> <00E9> endbfchar");
    const CodeMap second = code_map("1 beginbfrange <01> <03> <0061> endbfrange");
    EXPECT_EQ(shown_text(pieces, &first), "Aé\n ");
    EXPECT_EQ(shown_text(pieces, &second), "ab\nc");
}

TEST(content_text, maps_know_characters_of_two_units_and_ranges_with_lists) {
    const CodeMap map = code_map(
        "/CIDSystemInfo << /Registry (Adobe) /Ordering (UCS) /Supplement 0 >> def\n"
        "1 begincodespacerange <0000> <FFFF> endcodespacerange\n"
        "1 beginbfchar <0001> <D835DC00> endbfchar\n"
        "3 beginbfrange <0010> <0012> <D835DC01> <0020> <0022> [<0041> <D835DC00> <00660066>] <0030> <0031> <0078> "
        "endbfrange");
    EXPECT_EQ(map.bytes, 2u);
    const std::map<std::uint32_t, std::string> wanted = {
        {0x01, "\U0001D400"}, {0x10, "\U0001D401"}, {0x11, "\U0001D402"}, {0x12, "\U0001D403"}, {0x20, "A"},
        {0x21, "\U0001D400"}, {0x22, "ff"},         {0x30, "x"},          {0x31, "y"}};
    EXPECT_EQ(map.text, wanted);
}

// oracle: ISO 32000-1, 9.7.5, and the operators of Adobe's technical note 5014
TEST(content_text, maps_of_codes_to_themselves) {
    const std::string two = "1 begincodespacerange <0000> <FFFF> endcodespacerange ",
                      one = "1 begincodespacerange <00> <FF> endcodespacerange ";
    const std::map<std::string, std::size_t> cases = {
        {"%!PS-Adobe-3.0\n/CIDInit /ProcSet findresource begin 12 dict begin begincmap /CIDSystemInfo 3 dict dup begin "
         "/Registry (Adobe) def /Ordering (Identity) def /Supplement 0 def end def /CMapType 1 def " +
             two + "1 begincidrange <0000> <FFFF> 0 endcidrange endcmap end end",
         2},
        {one + "1 begincidrange <00> <FF> 0 endcidrange", 1},
        {two + "2 begincidrange <0000> <00ff> 0 <0100> <01ff> 256 endcidrange 1 begincidchar <0300> 768 endcidchar", 2},
        {two + "2 begincidrange <0000> <00ff> 0 <0100> <01ff> 255 endcidrange", 0},
        {two + "1 begincidrange <0000> <FFFF> 0 endcidrange 1 begincidchar <0041> 66 endcidchar", 0},
        {two + "1 begincidrange <0041> <0042> endcidrange", 0},
        {one + two + "1 begincidrange <0000> <FFFF> 0 endcidrange", 0},
        {one + "1 begincidrange <0000> <FFFF> 0 endcidrange", 0},
        {"/UniGB-UCS2-H usecmap " + two + "1 begincidrange <0000> <FFFF> 0 endcidrange", 0},
        {two, 0},
        {"", 0}};
    for (const auto& [cmap, bytes] : cases) EXPECT_EQ(bytes_of_identity(cmap), bytes) << cmap;
}

}  // namespace test_content_text
}  // namespace dynlab
