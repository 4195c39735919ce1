// Names that pdflatex has no letters for. Oracle: the text, the fonts, the boxes of words and the pixels that poppler
// reads from the PDF.
#include <gmock/gmock.h>

#include <algorithm>
#include <regex>

#include "base/reader.h"
#include "document_fixture.h"
#include "platform/child_process.h"
#include "platform/program_lookup.h"
#include "platform/utf8.h"
#include "support/environment_variable.h"
#include "support/pdf_inspection.h"

namespace dynlab {
namespace test_names_in_all_scripts {

using test::inspect_pdf;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

struct Name {
    const char *text, *font;  ///< the font that has its letters
};
constexpr Name kNames[] = {{"Nguyễn", "LMRoman"},
                           {"İpek", "LMRoman"},
                           {"Oğuz", "LMRoman"},
                           {"Adébáyọ̀", "LMRoman"},
                           {"Παπαδόπουλος", "NotoSerif-"},
                           {"Дмитрий", "NotoSerif-"},
                           {"გიორგი", "NotoSerifGeorgian"},
                           {"Հայկ", "NotoSerifArmenian"},
                           {"क्षत्रिय", "NotoSerifDevanagari"},
                           {"محمد", "NotoNaskhArabic"},
                           {"דוד", "NotoSerifHebrew"},
                           {"王小明", "NotoSerifCJK"},
                           {"ひらがな", "NotoSerifCJK"},
                           {"김민준", "NotoSerifCJK"}};

std::string output_of(std::vector<std::string> command) {
    ChildOptions child;
    child.command = std::move(command);
    return run_child(child, "poppler-utils").output;
}

/// Without the signs that only direct the text.
std::string without_directions(const std::string& text) {
    std::u32string kept = characters_in(text);
    std::erase_if(kept, [](char32_t c) { return c == 0x200E || (c >= 0x202A && c <= 0x202E); });
    return utf8_of(kept);
}

class names_in_all_scripts : public DocumentTest {
  protected:
    /// A word, or a letter of one that runs from right to left; in points.
    struct Box {
        std::string text;
        double left = 0, top = 0, right = 0, bottom = 0;
    };

    static std::string text_of(const std::filesystem::path& pdf) {
        std::string text;
        for (const std::string& page : inspect_pdf(pdf).pages) text += page;
        return without_directions(text);
    }

    static std::string producer_of(const std::filesystem::path& pdf) {
        for (const auto& [key, value] : inspect_pdf(pdf).metadata)
            if (key == "Producer") return value;
        return "";
    }

    static std::vector<Box> boxes_of(const std::filesystem::path& pdf) {
        const std::string words = without_directions(output_of({"pdftotext", "-bbox", pdf.string(), "-"}));
        const std::regex word(
            "<word xMin=\"([0-9.]+)\" yMin=\"([0-9.]+)\" xMax=\"([0-9.]+)\" yMax=\"([0-9.]+)\">([^<]*)</word>");
        std::vector<Box> boxes;
        for (auto it = std::sregex_iterator(words.begin(), words.end(), word); it != std::sregex_iterator(); ++it)
            boxes.push_back(
                {(*it)[5], std::stod((*it)[1]), std::stod((*it)[2]), std::stod((*it)[3]), std::stod((*it)[4])});
        return boxes;
    }

    /// Around all that is as high on the page as `box`.
    static Box line_of(const std::vector<Box>& boxes, Box box) {
        for (const Box& other : boxes) {
            if (other.top > box.bottom - 4 || other.bottom < box.top + 4) continue;
            box.left = std::min(box.left, other.left);
            box.right = std::max(box.right, other.right);
        }
        return box;
    }

    std::string notes() const {
        std::string text;
        for (const Message& note : notes_) text += message_text(note) + "\n";
        return replaced(text, folder_.path().string() + "/", "");
    }
};

TEST_F(names_in_all_scripts, each_name_is_text_of_its_font_and_ink) {
    std::string text;
    for (const Name& name : kNames) text += std::string(name.text) + "\n\n";
    const auto pdf = make(text, "out.pdf");
    const std::string read = text_of(pdf), fonts = output_of({"pdffonts", pdf.string()});
    const auto boxes = boxes_of(pdf);
    constexpr int kDotsPerInch = 144;
    const std::string picture =
        output_of({"pdftoppm", "-r", std::to_string(kDotsPerInch), "-gray", "-singlefile", pdf.string()});
    std::istringstream header(picture.substr(0, 40));
    std::string format;
    std::size_t width = 0, height = 0;
    header >> format >> width >> height;
    ASSERT_EQ(format, "P5");
    const std::size_t pixels = picture.size() - width * height;
    std::size_t at = 0;
    for (const Name& name : kNames) {
        at = read.find(name.text, at);
        EXPECT_NE(at, std::string::npos) << name.text << " is not in its place in: " << read;
        at = at == std::string::npos ? 0 : at;
        EXPECT_THAT(fonts, HasSubstr(name.font));
        const auto in_name = [&name](const Box& box) {
            return std::string(name.text).find(box.text) != std::string::npos;
        };
        const auto part = std::ranges::find_if(boxes, in_name);
        ASSERT_NE(part, boxes.end()) << name.text;
        const Box box = line_of(boxes, *part);
        int dark = 0, all = 0;
        const auto pixel = [](double points) { return static_cast<std::size_t>(points * kDotsPerInch / 72); };
        for (std::size_t y = pixel(box.top); y < pixel(box.bottom); ++y)
            for (std::size_t x = pixel(box.left); x < pixel(box.right); ++x, ++all)
                dark += static_cast<unsigned char>(picture[pixels + y * width + x]) < 128;
        EXPECT_GT(dark, all / 40) << name.text;
    }
    EXPECT_EQ(notes(),
              "report.md:7: Because pdflatex cannot print \"◌̀\" "
              "(U+0300), LuaLaTeX creates this PDF, which takes longer\n");
    EXPECT_EQ(producer_of(pdf), "LuaTeX");
}

TEST_F(names_in_all_scripts, right_to_left_names_keep_numbers_and_words_in_their_places) {
    std::vector<Box> line = boxes_of(make("BEFORE דוד בן 12 MIDDLE محمد علي 34 AFTER\n", "out.pdf"));
    std::erase_if(line, [&line](const Box& box) { return box.top > line.front().bottom; });
    std::ranges::sort(line, {}, &Box::left);
    std::string shown;
    for (const Box& box : line) shown += box.text + " ";
    EXPECT_EQ(shown, "BEFORE ן ב ד ו ד 12 MIDDLE ي ل ع د م ح م 34 AFTER ");
}

TEST_F(names_in_all_scripts, names_in_a_column_begin_at_its_left_edge) {
    record_.tables["marks"] = {{"name", "points"}, {{"Wilhelmina", "12.5"}, {"Дмитрий", "4"}, {"דוד", "3"}}};
    const auto boxes = boxes_of(make("::: {.table name=marks}\n:::\n", "out.pdf"));
    const auto left_of = [&boxes](const std::string& text) {
        const auto box = std::ranges::find(boxes, text, &Box::text);
        EXPECT_NE(box, boxes.end()) << text;
        return box == boxes.end() ? 0 : box->left;
    };
    EXPECT_NEAR(left_of("Дмитрий"), left_of("Wilhelmina"), 1);
    EXPECT_NEAR(left_of("ד"), left_of("Wilhelmina"), 1) << "its last letter";
}

TEST_F(names_in_all_scripts, pdflatex_sets_what_it_can) {
    const auto pdf = make(
        "---\ntitle: Nguyễn ω\n---\n# Đặng\n\nŁukasz, İpek, Oğuz, Trần Quốc *Nguyễn* **Phương**, "
        "Rene\u0301, ω ≤ θ.\n\n```lua\n-- Nguyễn\n```\n",
        "out.pdf");
    EXPECT_EQ(producer_of(pdf), "pdfTeX");
    EXPECT_THAT(notes_, IsEmpty());
    for (const char* word : {"Đặng", "Łukasz", "İpek", "Oğuz", "Trần Quốc Nguyễn Phương", "René", "-- Nguyễn"})
        EXPECT_THAT(text_of(pdf), HasSubstr(word));
}

TEST_F(names_in_all_scripts, greek_letters_are_symbols_and_greek_words_are_text) {
    EXPECT_EQ(producer_of(make("Δω and αβγ of $ω_n$\n", "out.pdf")), "pdfTeX");
    const auto pdf = make("Νικος and $ω_n$\n", "out.pdf");
    EXPECT_EQ(producer_of(pdf), "LuaTeX");
    EXPECT_THAT(text_of(pdf), HasSubstr("Νικος"));
}

// Oracle: the definition of reproducible.
TEST_F(names_in_all_scripts, two_runs_give_the_same_bytes_with_and_without_cache) {
    const std::string text = "---\ntitle: Дмитрий\ntoc: true\n---\n# Ю\n\n![](figure:raw){#fig:raw}\n\n$$ x $$\n";
    add_figure("raw", "Дмитрий", DocumentFormat::kPdf);
    const std::string first = read(make(text, "out.pdf"));
    EXPECT_EQ(first, read(make(text, "out.pdf")));
    EXPECT_EQ(passes(), 1) << "contents and pages are known";
    DocumentSource source;
    source.template_file = file("report.md");
    source.record = &record_;
    DocumentMaker({.use_cache = false}).make(source, file("other.pdf"), DocumentFormat::kPdf, nullptr);
    EXPECT_EQ(first, read(file("other.pdf")));
    for (const char* trace : {"/CreationDate", "/ModDate", "/PTEX", "/ID"}) EXPECT_THAT(first, Not(HasSubstr(trace)));
}

TEST_F(names_in_all_scripts, only_a_letter_that_no_font_has_is_replaced) {
    const auto pdf = make("Дмитрий \uE000 and \uE001 é\n", "out.pdf");
    EXPECT_THAT(text_of(pdf), HasSubstr("Дмитрий ? and ? é"));
    EXPECT_THAT(
        notes(),
        HasSubstr("report.md:1: no installed font has the following letters, which are printed as \"?\": \uE000 "
                  "(U+E000, line 1), \uE001 (U+E001, line 1). To add fonts, run sudo apt install fonts-noto"));
}

// oracle: a command ends before a letter beyond ASCII; fonts of formulas have Greek letters and no ideographs
TEST_F(names_in_all_scripts, formulas_and_unknown_letters_are_set_beside_them) {
    const std::string text = text_of(make("Дмитрий, $\\alpha中 + \\omegaτ$ and \uFFFD.\n", "out.pdf"));
    EXPECT_THAT(text, HasSubstr("ωτ"));
    EXPECT_THAT(text, HasSubstr("中"));
    EXPECT_THAT(notes(), Not(HasSubstr("U+4E2D")));
    EXPECT_THAT(text, HasSubstr("and ?."));
    EXPECT_THAT(notes(), HasSubstr("(U+FFFD, line 1)"));
}

TEST_F(names_in_all_scripts, without_lualatex_single_letters_are_replaced_and_the_note_says_what_to_install) {
    for (const char* program : {"pandoc", "pdflatex"})
        std::filesystem::create_symlink(*find_program(program), file(program));
    const test::EnvironmentVariable path("PATH", folder_.path().string());
    const auto pdf = make("Élise, Björn – Дя, o\u0323\u0300\n", "out.pdf");
    EXPECT_EQ(producer_of(pdf), "pdfTeX");
    EXPECT_THAT(text_of(pdf), HasSubstr("Élise, Björn – ??, ọ"));
    EXPECT_EQ(
        notes(),
        "report.md:1: LuaLaTeX is not installed, and pdflatex cannot print the following letters, which are printed as "
        "\"?\": \u25CC\u0300 (U+0300, line 1), Д (U+0414, line 1), я (U+044F, line 1). To print them, run sudo "
        "apt install texlive-luatex fonts-noto-core fonts-noto-cjk\n");
}

TEST_F(names_in_all_scripts, slides_formulas_tables_and_code_are_set_too) {
    record_.tables["marks"] = {{"name", "points"}, {{"Дмитрий", "12.5"}, {"محمد", "3"}}};
    const auto pdf = make(
        "---\ntitle: Юлия\nlayout: slides\nlang: fr\n---\n# Дмитрий : « oui »\n\n$ω ≤ θ$\n\n"
        "```lua\nx = 1 -- Юлия\n```\n\n::: {.table name=marks}\n:::\n",
        "out.pdf");
    EXPECT_EQ(producer_of(pdf), "LuaTeX");
    for (const char* words : {"Юлия", "Дмитрий : « oui »", "ω≤θ", "x = 1 -- Юлия", "12,5", "محمد"})
        EXPECT_THAT(replaced(text_of(pdf), "\u00A0", " "), HasSubstr(words));
}

// Oracle: the words as they are written. A letter that one font lacks is printed where another has it.
TEST_F(names_in_all_scripts, letters_of_code_and_formulas_are_printed_there_and_in_the_text) {
    const auto pdf =
        make("Σωκράτης, Ж and é.\n\nCode `Σωκράτης Ж`, formula $v_{é} + \\mathrm{Ж} + α + x^{Дя}$, ☺ and → here.\n",
             "out.pdf");
    const std::string text = text_of(pdf);
    for (const char* words : {"Σωκράτης, Ж and é.", "Code Σωκράτης Ж", "vé + Ж + α + xДя", "☺ and →"})
        EXPECT_THAT(text, HasSubstr(words));
    EXPECT_THAT(text, Not(HasSubstr("?")));
    EXPECT_THAT(notes(), Not(HasSubstr("no installed font")));
}

// Oracle: the program that is named in the PDF.
TEST_F(names_in_all_scripts, signs_that_only_direct_the_text_need_no_other_program) {
    const auto pdf = make("A\u200E b \u202Ax\u202C \uFEFFc, `co\u200Ede`.\n\n```\na\u200Fb\n```\n", "out.pdf");
    EXPECT_EQ(producer_of(pdf), "pdfTeX");
    EXPECT_THAT(text_of(pdf), AllOf(HasSubstr("A b x c, code."), HasSubstr("ab")));
    EXPECT_THAT(notes(), IsEmpty());
}

TEST_F(names_in_all_scripts, an_error_is_reported_with_its_line_as_pdflatex_would) {
    const std::string message = refusal("# Юлия\n\nText.\n\nA formula $a + x^1^2$ here.\n", "out.pdf");
    EXPECT_THAT(message, HasSubstr("report.md:5: "));
    EXPECT_THAT(message, HasSubstr("Double superscript"));
}

}  // namespace test_names_in_all_scripts
}  // namespace dynlab
