// What a copy for anonymous readers may still do when it is opened. Oracle: the actions that qpdf shows in it.
#include <gmock/gmock.h>

#include <regex>

#include "course/anonymity/anonymous_copy.h"
#include "leak_corpus.h"

namespace dynlab {
namespace test_pdf_cleaning {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

class pdf_cleaning : public LeakCorpus {
  protected:
    using Strings = std::vector<std::string>;

    /// Actions that run, load or send something, or print; the last is of a kind that does not exist.
    inline static const Strings kActive = {"<</S/JavaScript/JS(app.alert\\(1\\))>>",
                                           "<</S/Launch/F(/bin/sh)>>",
                                           "<</S/Launch/Win<</F(cmd.exe)>>>>",
                                           "<</S/SubmitForm/F<</FS/URL/F(https://example.org/)>>>>",
                                           "<</S/ResetForm/Fields[(a)]>>",
                                           "<</S/ImportData/F(a.fdf)>>",
                                           "<</S/GoToR/F(https://example.org/a.pdf)/D[0/Fit]>>",
                                           "<</S/GoToE/T<</R/C/N(a)>>>>",
                                           "<</S/Rendition/OP 0/JS(app.alert\\(1\\))>>",
                                           "<</S/SetOCGState/State[/OFF]>>",
                                           "<</S/Hide/T(a)>>",
                                           "<</S/Thread/F(a.pdf)/D 0>>",
                                           "<</S/Named/N/Print>>",
                                           "<</Type/Action/S/Unheard>>"};

    /// What a page of text has besides; `objects` are 7 0 R, 8 0 R ...
    struct Parts {
        Strings links, bookmarks, objects;  ///< entries of links and bookmarks
        std::string catalogue, page;        ///< further entries
    };

    static std::string made(const Parts& parts) {
        std::string annotations;
        for (const std::string& link : parts.links)
            annotations += "<</Type/Annot/Subtype/Link/Rect[9 9 99 99]" + link + ">>";
        const std::size_t first = 7 + parts.objects.size(), last = first + parts.bookmarks.size() - 1;
        const auto reference = [](std::size_t number) { return std::to_string(number) + " 0 R"; };
        const bool outlined = !parts.bookmarks.empty();
        Strings objects = {
            "<</Type/Catalog/Pages 2 0 R" + std::string(outlined ? "/Outlines 6 0 R" : "") + parts.catalogue + ">>",
            "<</Type/Pages/Kids[3 0 R]/Count 1>>",
            "<</Type/Page/Parent 2 0 R/MediaBox[0 0 300 300]/Contents 4 0 R/Resources<</Font<</F1 5 0 "
            "R>>>>/Annots[" +
                annotations + "]" + parts.page + ">>",
            stream_of("BT /F1 11 Tf 20 200 Td (The trolley was moved.) Tj ET"),
            "<</Type/Font/Subtype/Type1/BaseFont/Helvetica>>",
            "<</Type/Outlines/First " + reference(first) + "/Last " + reference(last) + ">>"};
        objects.insert(objects.end(), parts.objects.begin(), parts.objects.end());
        for (std::size_t i = 0; outlined && i < parts.bookmarks.size(); ++i) {
            std::string entries = "<</Parent 6 0 R/Title(T" + std::to_string(i) + ")" + parts.bookmarks[i];
            if (i > 0) entries += "/Prev " + reference(first + i - 1);
            if (first + i < last) entries += "/Next " + reference(first + i + 1);
            objects.push_back(entries + ">>");
        }
        return pdf_of(objects);
    }

    std::string as_qpdf_shows(const std::string& pdf) {
        run({"qpdf", "--qdf", "--object-streams=disable", "--no-original-object-ids", pdf, "shown.pdf"});
        return read(file("shown.pdf"));
    }
    /// The kinds of the actions in a PDF as qpdf shows it, sorted.
    static Strings actions_in(const std::string& shown) {
        static const std::regex kind("/S /([A-Za-z0-9]+)");
        Strings kinds;
        for (std::sregex_iterator match(shown.begin(), shown.end(), kind), end; match != end; ++match)
            kinds.push_back((*match)[1]);
        std::sort(kinds.begin(), kinds.end());
        return kinds;
    }

    /// What qpdf shows of the copy.
    std::string cleaned(const Parts& parts) {
        write("own.pdf", made(parts));
        write("copy.pdf", clean_pdf(file("own.pdf")));
        run({"qpdf", "--check", "copy.pdf"});
        EXPECT_THAT(text_of("copy.pdf"), HasSubstr("The trolley was moved."));
        return as_qpdf_shows("copy.pdf");
    }
    /// The actions in the copy; there were `before` of them.
    Strings kept(const Parts& parts, std::size_t before) {
        Strings left = actions_in(cleaned(parts));
        EXPECT_THAT(actions_in(as_qpdf_shows("own.pdf")), SizeIs(before));
        return left;
    }

    static Strings each(const std::string& before, const Strings& actions, const std::string& behind = "") {
        Strings entries;
        for (const std::string& action : actions) entries.push_back(before + action + behind);
        return entries;
    }
    static std::string list(const Strings& actions) {
        std::string text = "[";
        for (const std::string& action : actions) text += action;
        return text + "]";
    }

    const std::size_t all_ = kActive.size();
};

TEST_F(pdf_cleaning, plain_actions_stay) {
    Parts parts;
    parts.links = {"/A<</S/URI/URI(https://example.org)>>", "/A<</S/Named/N/NextPage>>", "/Dest[3 0 R/Fit]"};
    parts.bookmarks = {"/A<</S/GoTo/D[3 0 R/Fit]>>", "/A<</S/URI/URI(https://example.net)>>", "/Dest[3 0 R/Fit]"};
    const std::string shown = cleaned(parts);
    EXPECT_THAT(actions_in(shown), ElementsAre("GoTo", "Named", "URI", "URI"));
    EXPECT_THAT(shown, AllOf(HasSubstr("(T0)"), HasSubstr("(T1)"), HasSubstr("(T2)")));
    EXPECT_THAT(shown, HasSubstr("/Next "));  // from one bookmark to the next
    EXPECT_THAT(shown, AllOf(HasSubstr("(https://example.org)"), HasSubstr("(https://example.net)")));
}

// Oracle: RFC 3986, 3.1 (schemes, whose case does not count) and ISO 32000-1, 7.9.2.2 (strings in UTF-16).
TEST_F(pdf_cleaning, addresses_of_the_web_and_of_mail_stay) {
    const auto to = [](const std::string& address) { return "/A<</S/URI/URI" + address + ">>"; };
    Parts parts;
    parts.links = {to("(HTTPS://example.org)"), to("(mailto:a@example.org)"), to("(figures/a.html#b:c)")};
    for (const char* address :
         {"(//example.org/a)", "(\\\\\\\\example.org\\\\a)", "(/\\\\example.org/a)", "(file:///home/ada/a.pdf)",
          "(javascript:alert\\(1\\))", "( javascript:1)", "(smb://example.org/a)", "(vbscript:x)",
          "<FEFF00660069006C0065003A002F0061>", "12", "null"})
        parts.links.push_back(to(address));
    parts.bookmarks = {to("(http://example.net)"), to("(ftp://example.net)")};
    const std::string shown = cleaned(parts);
    EXPECT_THAT(actions_in(shown), ElementsAre("URI", "URI", "URI", "URI"));
    EXPECT_THAT(shown, AllOf(HasSubstr("(HTTPS://example.org)"), HasSubstr("(mailto:a@example.org)"),
                             HasSubstr("(figures/a.html#b:c)"), HasSubstr("(http://example.net)")));
}

TEST_F(pdf_cleaning, actions_of_bookmarks) {
    Parts parts;
    parts.bookmarks = each("/A", kActive);
    const std::string shown = cleaned(parts);
    EXPECT_THAT(actions_in(shown), IsEmpty());
    for (std::size_t i = 0; i < all_; ++i) EXPECT_THAT(shown, HasSubstr("(T" + std::to_string(i) + ")"));
    parts.objects = kActive;
    for (std::size_t i = 0; i < all_; ++i) parts.bookmarks[i] = "/A " + std::to_string(7 + i) + " 0 R";
    EXPECT_THAT(kept(parts, all_), IsEmpty());
}

TEST_F(pdf_cleaning, actions_of_links) {
    Parts parts;
    parts.objects = kActive;
    for (std::size_t i = 0; i < all_; ++i) parts.links.push_back("/A " + std::to_string(7 + i) + " 0 R");
    for (const Strings& more : {each("/A", kActive), each("/PA", kActive), each("/AA<</E", kActive, ">>")})
        parts.links.insert(parts.links.end(), more.begin(), more.end());
    parts.links.push_back("/PA<</S/URI/URI(https://example.org)>>");
    EXPECT_THAT(kept(parts, 4 * all_ + 1), IsEmpty());
}

TEST_F(pdf_cleaning, chains_behind_plain_actions) {
    const Strings chains = {"/Next" + list(kActive), "/Next<</S/GoTo/D[0/Fit]/Next" + list(kActive) + ">>"};
    Parts parts;
    for (const std::string& chain : chains) parts.links.push_back("/A<</S/URI/URI(https://example.org)" + chain + ">>");
    for (const std::string& action : kActive) parts.bookmarks.push_back("/A<</S/GoTo/D[0/Fit]/Next" + action + ">>");
    const Strings left = kept(parts, 3 + 4 * all_);
    EXPECT_EQ(std::count(left.begin(), left.end(), "URI"), 2);
    EXPECT_EQ(std::count(left.begin(), left.end(), "GoTo"), all_);
    EXPECT_THAT(left, SizeIs(2 + all_));
}

TEST_F(pdf_cleaning, actions_of_the_document_and_its_pages) {
    Parts parts;
    parts.catalogue = "/OpenAction" + kActive[0] + "/AA<</WC" + kActive[1] + "/WP" + kActive[2] +
                      ">>/Names<</JavaScript<<"
                      "/Names[(a)" +
                      kActive[0] + "]>>/Own<</Names[(a)" + kActive[0] + "]>>>>/Own" + list(kActive);
    parts.page = "/AA<</O" + kActive[0] + "/C" + kActive[3] + ">>/PresSteps<</Type/NavNode/NA" + kActive[0] +
                 "/PA<</S/Unheard>>>>";
    EXPECT_THAT(kept(parts, 9 + all_), IsEmpty());
}

TEST_F(pdf_cleaning, actions_in_disguise) {
    Parts parts;
    parts.objects = {"/JavaScript", "<</S 7 0 R/JS(hidden kind)>>", "8 0 R",
                     stream_of("", "/S/JavaScript/JS(in a stream)")};
    parts.links = {"/A 8 0 R", "/A 9 0 R", "/A 10 0 R", "/A<</S/J#61vaScript/JS(other spelling)>>"};
    parts.bookmarks = {"/A 8 0 R", "/A 9 0 R", "/A 10 0 R", "/A<</S/Unheard/JS(unheard)>>"};
    parts.catalogue = "/Own" + std::string(450, '[') + kActive[0] + std::string(450, ']') + "/More 10 0 R";
    const std::string shown = cleaned(parts);
    EXPECT_THAT(actions_in(shown), IsEmpty());
    EXPECT_THAT(shown, Not(HasSubstr("/JS")));
}

// Oracle: ISO 32000-1, 14.7.2 (roles in the structure) and 12.5.4 (borders), where /S is no kind of action.
TEST_F(pdf_cleaning, what_is_no_action_stays) {
    Parts parts;
    parts.catalogue = "/StructTreeRoot<</Type/StructTreeRoot/K<</S/Document/A<</O/Layout/Placement/Block>>>>>>";
    parts.links = {"/BS<</S/D>>/A<</S/URI/URI(https://example.org)>>"};
    const std::string shown = cleaned(parts);
    EXPECT_THAT(actions_in(shown), ElementsAre("D", "Document", "URI"));
    EXPECT_THAT(shown, HasSubstr("/Placement /Block"));
}

// Oracle: ISO 32000-1, 7.3.8.1 (a stream whose data stand in another file) and 8.10.4 (pages of another file).
TEST_F(pdf_cleaning, nothing_is_fetched_from_other_files) {
    Parts parts;
    parts.objects = {
        stream_of("own data", "/F<</FS/URL/F(https://example.org/a)>>/FFilter/FlateDecode"),
        stream_of("own form", "/Type/XObject/Subtype/Form/BBox[0 0 9 9]/Ref<</F(https://example.org/b)/Page 0>>")};
    parts.catalogue = "/Own[7 0 R 8 0 R]";
    EXPECT_THAT(cleaned(parts), AllOf(HasSubstr("own data"), HasSubstr("own form"), Not(HasSubstr("example.org"))));
}

// Oracle: ISO 32000-1, 12.6.4.7 (what addresses are relative to), 7.11.5 (files by their address) and 7.7.4 (names).
TEST_F(pdf_cleaning, nothing_leads_addresses_elsewhere) {
    Parts parts;
    parts.links = {"/A<</S/URI/URI(figures/a.html)>>"};
    parts.objects = {"<</Type/Filespec/FS/URL/F(https://example.org/a)>>"};
    parts.catalogue =
        "/URI<</Base(javascript:)>>/Own 7 0 R/More[7 0 R<</FS/URL/F(https://example.org/b)>>]/Names<</URLS<</Names[(c)"
        "<</URL(https://example.org/c)>>]>>/Renditions<</Names[(d)<</N(https://example.org/d)>>]>>>>/OutputIntents[<<"
        "/Type/OutputIntent/DestOutputProfileRef<</URLs[<</FS/URL/F(https://example.org/e)>>]>>>>]";
    EXPECT_THAT(cleaned(parts),
                AllOf(HasSubstr("(figures/a.html)"), Not(HasSubstr("javascript")), Not(HasSubstr("example.org"))));
}

}  // namespace test_pdf_cleaning
}  // namespace dynlab
