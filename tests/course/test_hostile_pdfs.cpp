// Files that are no sound PDF. Oracle: how each was made.
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "base/reader.h"
#include "check_fixture.h"
#include "course/issues/issues_report.h"
#include "documents/pdf/guarded_pdf.h"

namespace dynlab {
namespace test_hostile_pdfs {

using testing::HasSubstr;
using testing::Not;

class hostile_pdfs : public CheckTest {
  protected:
    CheckResult check_bytes(const std::string& bytes) {
        write("handed in.pdf", bytes);
        return check(file("handed in.pdf"));
    }

    std::string sound_pdf() {
        check_latex("", kProse);
        return read(file("own.pdf"));
    }

    /// A PDF of empty pages. Every entry of the page list is the last page object.
    static std::string blank_pages(int count) {
        std::string kids;
        for (int i = 0; i < count; ++i) kids += "3 0 R ";
        return "%PDF-1.4\n1 0 obj<</Type/Catalog/Pages 2 0 R>>endobj\n2 0 obj<</Type/Pages/Kids[" + kids + "]/Count " +
               std::to_string(count) + ">>endobj\n3 0 obj<</Type/Page/Parent 2 0 R/MediaBox[0 0 595 842]>>endobj\n" +
               "trailer<</Size 4/Root 1 0 R>>\n%%EOF\n";
    }
};

TEST_F(hostile_pdfs, no_pdf_at_all) {
    EXPECT_THAT(message_text(only(check_bytes(""), "not-pdf").what), HasSubstr("empty"));
    EXPECT_THAT(message_text(only(check_bytes("PK\x03\x04 a document of a word processor"), "not-pdf").what),
                HasSubstr("not a PDF"));
    EXPECT_THAT(message_text(only(check_bytes(std::string(5000, '\0')), "not-pdf").remedy), HasSubstr("dynlab report"));
    EXPECT_THROW(check(file("none.pdf")), PdfRefusal);
    EXPECT_THROW(check(folder_.path()), PdfRefusal);
    ASSERT_EQ(::mkfifo(file("pipe.pdf").c_str(), 0600), 0);
    EXPECT_THROW(check(file("pipe.pdf")), PdfRefusal);  // without waiting for a writer
}

TEST_F(hostile_pdfs, cut_off_at_any_place) {
    const std::string sound = sound_pdf();
    for (const double part : {0.1, 0.5, 0.9, 0.999}) {
        const auto bytes = static_cast<std::size_t>(part * static_cast<double>(sound.size()));
        EXPECT_THAT(message_text(only(check_bytes(sound.substr(0, bytes)), "damaged").what),
                    HasSubstr("its end is missing"))
            << part;
    }
    only(check_bytes("%PDF-1.5\nnothing\n%%EOF\n"), "damaged");
}

TEST_F(hostile_pdfs, changed_bytes_never_end_the_check) {
    const std::string sound = sound_pdf();
    for (std::size_t seed = 1; seed <= 40; ++seed) {
        std::string changed = sound;
        for (std::size_t i = 0; i < 30; ++i)
            changed[(seed * 7919 + i * 104729) % changed.size()] ^= static_cast<char>(1 + seed % 255);
        const CheckResult result = check_bytes(changed);
        EXPECT_FALSE(issues_as_text(result, false).empty());
    }
}

TEST_F(hostile_pdfs, encrypted_or_protected) {
    sound_pdf();
    const auto encrypt = [this](const std::string& user_password) {
        ChildOptions qpdf;
        qpdf.command = {"qpdf", "--encrypt", user_password, "owner", "256", "--", file("own.pdf"), file("locked.pdf")};
        EXPECT_EQ(run_child(qpdf, "qpdf").exit_code, 0);
        return check(file("locked.pdf"));
    };
    standard_ = DocumentStandard();
    EXPECT_THAT(message_text(only(encrypt("secret"), "encrypted").what), HasSubstr("password"));
    EXPECT_EQ(only(encrypt(""), "protected").severity, Severity::kHint);
}

TEST_F(hostile_pdfs, pages_without_text) {
    EXPECT_THAT(message_text(only(check_bytes(small_pdf()), "scanned").what), HasSubstr("pictures"));
}

TEST_F(hostile_pdfs, more_than_the_limits) {
    EXPECT_THAT(message_text(only(check_bytes(blank_pages(201)), "too-large").what),
                HasSubstr("201 pages; the limit is 200"));
    const std::string sound = sound_pdf();
    PdfLimits limits;
    limits.words = 10;
    EXPECT_THAT(message_text(only(check_pdf(file("own.pdf"), {standard_, {}}, limits), "too-large").what),
                HasSubstr("more than 10 words"));
    limits = {};
    limits.file_bytes = 1000;
    EXPECT_THAT(message_text(only(check_pdf(file("own.pdf"), {standard_, {}}, limits), "too-large").what),
                HasSubstr("the limit is"));
    limits = {};
    limits.time = std::chrono::milliseconds(0);
    EXPECT_THAT(message_text(only(check_pdf(file("own.pdf"), {standard_, {}}, limits), "too-large").what),
                HasSubstr("The file was not read: reading used more than 0 s of processor time"));
}

// oracle: a process that waits uses no processor time
TEST(guarded_pdf, says_which_limit_of_time_was_reached) {
    const auto wait = []() -> std::string {
        for (;;) ::pause();
    };
    try {
        run_guarded_on_pdf(wait, {.time = {std::chrono::milliseconds(100)}});
        ADD_FAILURE() << "it has ended";
    } catch (const PdfRefusal& refusal) {
        EXPECT_STREQ(refusal.what(), "The file was not read: reading did not finish within 0.5 s.");
    }
}

// Oracle: the characters that a terminal obeys.
TEST_F(hostile_pdfs, nothing_from_a_file_reaches_the_terminal_as_a_command) {
    const std::string name = "a\x1B[31m\n\"b\".pdf";
    write(name, "no PDF");
    const CheckResult result = check(file(name));
    const std::string words = issues_as_text(result, false);
    EXPECT_THAT(words, Not(HasSubstr("\x1B")));
    EXPECT_THAT(words, HasSubstr("a?[31m?\"b\".pdf"));
    EXPECT_EQ(nlohmann::json::parse(issues_as_json(result)).at("findings").at(0).at("id"), "not-pdf");
}

}  // namespace test_hostile_pdfs
}  // namespace dynlab
