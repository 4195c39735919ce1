// How people write names, numbers, groups and folders, and what only looks like them. Oracle: who is meant.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "course/anonymity/identity_matcher.h"

namespace dynlab {
namespace test_name_forms {

Student known(const char* id, const char* name, const char* group, const char* mail = "") {
    Student student;
    student.id = id;
    student.name = name;
    student.group = group;
    student.mail = mail;
    return student;
}

/// The authors Lovelace, Li and Wu of group-01, and others of their course.
IdentityMatcher course() {
    IdentityMatcher names;
    names.add(known("20214711", "Ada Lovelace", "group-01", "ada.l@uni.example"), true);
    names.add(known("20214712", "Bo Li", "group-01"), true);
    names.add(known("20214713", "Meiling Wu", "group-01"), true);
    names.add(known("20215000", "Grace Brewster Hopper", "group-02"));
    names.add(known("20215001", "Renée Müller-Lüdenscheid", "group-11"));
    names.add(known("20215002", "Mark Young", "group-12"));
    names.add(known("20215003", "Сергей Новиков", "group-12"));
    return names;
}

std::string found(const IdentityMatcher& names, const std::string& text, TextManner manner = TextManner::kProse) {
    std::string result;
    for (const NameHit& hit : names.find(text, manner))
        result += (result.empty() ? "" : ", ") + hit.who + (hit.certain ? "" : "?");
    return result;
}

void expect_certain(const std::vector<std::string>& texts, TextManner manner = TextManner::kProse) {
    const IdentityMatcher names = course();
    for (const std::string& text : texts) {
        const auto hits = names.find(text, manner);
        EXPECT_TRUE(std::any_of(hits.begin(), hits.end(), [](const NameHit& hit) { return hit.certain; }))
            << text << ": " << found(names, text, manner);
    }
}

void expect_hint(const std::vector<std::string>& texts) {
    const IdentityMatcher names = course();
    for (const std::string& text : texts) {
        const auto hits = names.find(text, TextManner::kProse);
        EXPECT_FALSE(hits.empty()) << text;
        for (const NameHit& hit : hits) EXPECT_FALSE(hit.certain) << text << ": " << hit.who;
    }
}

TEST(name_forms, numbers_of_accounts_and_in_groups) {
    expect_certain({"see s20214711 for it", "SN20214711", "st20214711@uni.example", "u20214711.github.io",
                    "student20214711", "2021 4711", "2021-4711", "2021/4711", "number 20 214 711", "(s20214711)",
                    "data20214711.csv", "crane_run20214711final.csv", "20214711b.pdf", "student_20214711rev2"});
}

// Numbers of a sentence may count something; beside a name, in brackets, after "student" or alone they are a person's.
TEST(name_forms, numbers_that_may_count_are_not_certain) {
    IdentityMatcher names;
    names.add(known("123456", "Ada Lovelace", "group-01"));
    const auto certain = [&](const std::string& text) {
        const auto hits = names.find(text, TextManner::kProse);
        EXPECT_FALSE(hits.empty()) << text;
        return std::ranges::any_of(hits, &NameHit::certain);
    };
    for (const char* text :
         {"The record has 123456 samples.", "with N = 123456 here", "after 123456 steps", "some 123456\nof them"})
        EXPECT_FALSE(certain(text)) << text;
    for (const char* text :
         {"Student 123456", "Lovelace (123456) and others", "Ada Lovelace 123456", "123456", "ID: 123456 was"})
        EXPECT_TRUE(certain(text)) << text;
}

TEST(name_forms, numbers_of_one_digit_say_nothing) {
    IdentityMatcher names;
    names.add(known("1", "Ada Lovelace", "group-01"), true);
    names.add(known("12", "Bo Linwood", "group-02", "b2@uni.example"));
    names.add(known("a7", "Grace Hopper", "group-03"));
    names.add(known("123", "Mei Wuthering", "group-04"));
    for (const char* text : {"1", "12", "a7", "b2", "No. 1", "number 12", "ID 1"})
        for (const TextManner manner : {TextManner::kData, TextManner::kProse})
            EXPECT_EQ(found(names, text, manner), "");
    EXPECT_EQ(found(names, "student 123"), "Mei Wuthering");
    EXPECT_EQ(found(names, "123", TextManner::kData), "Mei Wuthering");
}

TEST(name_forms, groups_in_other_words) {
    expect_certain({"Groupe n° 1", "Group no. 1", "by Group one", "Group I wrote", "by Group 1 of the course",
                    "group1.pdf", "Group #1", "by team 01", "Team 1", "G01", "groupe 01", "Gruppe 1", "GROUP-1",
                    "group_1", "group1data.csv", "group01_data", "Gr. 1", "gr. 01"});
    expect_hint({"as Group 2 did", "group2.csv", "Team 12"});
}

TEST(name_forms, groups_without_a_number) {
    IdentityMatcher names;
    names.add(known("20214711", "Ada Lovelace", "Les Loups"), true);
    names.add(known("20214712", "Bo Linwood", "Zephyrians"), true);
    names.add(known("20214713", "Grace Hopper", "Signal"), true);
    names.add(known("20215000", "Mei Wuthering", "Blue Herons"));
    names.add(known("20215001", "Mark Youngman", "Falconers"));
    EXPECT_EQ(found(names, "by the Les Loups team"), "Les Loups");
    EXPECT_EQ(found(names, "les_loups.pdf"), "Les Loups");
    EXPECT_EQ(found(names, "We, the zephyrians, measured"), "Zephyrians");
    EXPECT_EQ(found(names, "as Blue Herons did"), "Blue Herons");
    EXPECT_EQ(found(names, "the signal of the falconers"), "") << "a word, and one word of others";
}

TEST(name_forms, surnames_in_small_letters_and_identifiers) {
    expect_certain({"fig_lovelace.pdf", "lovelace_hopper", "crane_lovelace2", "a.lovelace", "LovelaceHopper",
                    "author = lovelace", "plotHopper(x)", "/srv/hopper/crane", "hopper@laptop", "data_hopper = 3"});
    expect_hint({"the hopper of the mill", "a lovelace of it"});
}

TEST(name_forms, short_names_with_initials_and_together) {
    expect_certain({"B. Li made the figures", "Wu, M.", "by Wu & Li", "Li and Wu", "Ada and Bo", "Ada L. and Bo",
                    "Bo et Meiling", "Lovelace & Wu", "Ada L. wrote it"});
}

TEST(name_forms, halves_plurals_and_second_initials) {
    expect_certain({"Renee Mueller", "Renée Müller", "Luedenscheid, Renee", "the Lovelaces' work", "Hoppers report",
                    "Dr. G. M. Hopper", "G. M. Hopper", "\u00A9 Lovelace 2026", "(c) Hopper 2026"});
    expect_hint({"P. M. Hopper", "Hopper (2008)", "Lovelace, P.", "Hopper et al.", "R. Lovelace, 1999"});
}

TEST(name_forms, folders_and_prompts) {
    expect_certain({"D:\\ada\\work", "\\\\server\\ada$", "~ada/crane", "ada@laptop:~$ dynlab", "/export/home2/ada",
                    "someone@pc-17:~/x$", "\\\\server\\home\\someone\\x"});
    expect_certain({"/home2/someone"}, TextManner::kData);
}

TEST(name_forms, letters_that_look_like_others) {
    expect_certain({"by L\u043Evel\u0430ce",  // Cyrillic o and a
                    "\u041D\u043Epper",       // Cyrillic capital En, o
                    "L\u03BFvelace",          // Greek omicron
                    "L\uFE0Fove\u2061lace", "Love\u180Elace", "Lo\u202Cvelace", "\u24C1ovelace"});
    expect_hint({"\u029F\u1D0F\u1D20\u1D07\u029F\u1D00\u1D04\u1D07",    // small capitals
                 "\u1D38\u1D52\u1D5B\u1D49\u02E1\u1D43\u1D9C\u1D49"});  // raised letters
    expect_certain({"НОВИКОВ", "Новиков", "новиков Сергей"});
}

TEST(name_forms, broken_and_spaced) {
    expect_certain({"Love\u00AD\nlace", "Love-\nlace", "Lo ve la ce", "L O V E L A C E", "Love\u00ADlace"});
}

TEST(name_forms, white_space_within_words) {
    expect_certain({"by A da Lovel ace", "Gra ce Hopper", "by Ada Love lace"});
    expect_hint({"the Love lace of the mill"});
}

// Oracle: RFC 3986, 2.1; Latin-1 is what older programs encode.
TEST(name_forms, percent_encoded) {
    expect_certain({"https://example.org/%41da%20Lovelace", "mailto:%61da%2El@uni.example", "Ren%C3%A9e%20M%C3%BCller",
                    "Ren%E9e+M%FCller", "Ren%25C3%25A9e_M%25C3%25BCller"});
    EXPECT_EQ(found(course(), "100% of 20%, %zz %2"), "");
}

// Oracle: NFKC (UAX #15) and the property Equivalent_Unified_Ideograph.
TEST(name_forms, compatibility_forms) {
    IdentityMatcher names;
    names.add(known("20215005", "王小明", "group-04"));
    names.add(known("20214711", "Ada Lovelace", "group-01"));
    for (const char* text : {"王小明", "\u2EA9\u2F29明", "\u2F92 小明"})
        EXPECT_EQ(found(names, text), std::string(text).starts_with("\u2F92") ? "" : "王小明") << text;
    for (const char* text : {"\uFF21\uFF44\uFF41 Lovelace", "\u00B2\u2070\u00B2\u00B9\u2074\u2077\u00B9\u00B9",
                             "\u2461\u24EA\u2461\u2460\u2463\u2466\u2460\u2460", "20,214,711", "20'214'711"})
        EXPECT_EQ(found(names, text), "Ada Lovelace") << text;
}

TEST(name_forms, accounts_of_initial_and_surname) {
    expect_certain({"https://example.org/~alovelace", "alovelace@laptop", "/srv/alovelace/x", "data_ghopper.csv",
                    "data_hopperg.csv", "lovelacea@laptop", "/srv/adal/x", "adal@laptop:~$"});
    EXPECT_EQ(found(course(), "some alovelace here"), "");
}

// Oracle: who has an ordinary word for a name, and what a sentence says.
TEST(name_forms, ordinary_words_are_never_certain) {
    IdentityMatcher names;
    names.add(known("1001", "Null Null", "group-01"));
    names.add(known("1002", "Ada Page", "group-02"));
    names.add(known("1003", "Eva Long", "group-03"));
    const auto hits = names.find("The figure on Page shows that Long and Null wrote it.", TextManner::kProse);
    ASSERT_EQ(hits.size(), 3u);
    for (const NameHit& hit : hits) EXPECT_TRUE(hit.ordinary && !hit.certain) << hit.who;
    for (const char* text :
         {"Page 3 of 12", "a long page, null and void", "The end. Long runs follow.", "null", "/Page"})
        EXPECT_EQ(found(names, text), "") << text;
    EXPECT_EQ(found(names, "by Ada Page"), "Ada Page");
    names.add(known("1004", "Max Count", "group-04"), true);
    EXPECT_EQ(found(names, "as Page, Long and Count say"), "Max Count?") << "of the document's authors only";
}

// Oracle: the entries, as BibTeX defines their fields.
TEST(name_forms, cited_authors_are_no_students) {
    IdentityMatcher names;
    names.add(known("1016", "Wei Wang", "group-08"));
    names.add(known("1017", "Lennart Ljungqvist", "group-08"));
    names.add(known("1018", "Xin Wangler", "group-08"));
    EXPECT_EQ(found(names, "Garnier, Hugues, and Liuping Wang, eds. 2008."), "Wei Wang");
    names.add_cited({cited_author("Garnier, Hugues"), cited_author("Wang, Liuping"), cited_author("Xin Wangler")});
    for (const char* text : {"Garnier, Hugues, and Liuping Wang, eds. 2008.", "L. Wang", "Garnier and Wang",
                             "Wang et al.", "Wang (2008)", "Wang, Liuping"})
        EXPECT_EQ(found(names, text), "") << text;
    EXPECT_EQ(found(names, "by Wei Wang"), "Wei Wang");
    EXPECT_EQ(found(names, "our thanks to Wang for it"), "Wei Wang");
    EXPECT_EQ(found(names, "by Xin Wangler"), "Xin Wangler?");
}

TEST(name_forms, bibliographies_of_the_lessons) {
    const auto has = [](const char* surname, const char* given) {
        return std::ranges::any_of(cited_authors(), [&](const CitedAuthor& author) {
            return author.surname == surname && author.given.front() == given;
        });
    };
    EXPECT_TRUE(has("wang", "liuping"));
    EXPECT_TRUE(has("ljung", "lennart"));
    EXPECT_TRUE(has("noel", "jeanphilippe"));
    EXPECT_TRUE(has("vandenhof", "paul") || has("hof", "paul"));
}

// Oracle: no student of the course is meant.
TEST(name_forms, what_only_looks_like_them) {
    const IdentityMatcher names = course();
    for (const char* text : {"0x20214711",
                             "120214711",
                             "1.20214711e5",
                             "20214711e5",
                             "3x20214711",
                             "20214711.5",
                             "the year 2021 and 4711 samples",
                             "2021, 4711",
                             "2021.4711",
                             "2021\n4711",
                             "see group 1 of the gains",

                             "G11 and G12 of the plant",
                             "G02 = tf(s)",
                             "The vector u and Li are variables",
                             "adapted",
                             "the Adam method",
                             "Adagio",
                             "wu = 3",
                             "ada-ptive",
                             "boli",
                             "In bold, limits",
                             "an ion, a cation",
                             "mark, young crane",
                             "Young's filter",
                             "a hop per step",

                             "the Love of lace",
                             "\u03B1 and \u03C9 of the \u03BBovel",
                             "f:~x",
                             "at 3:~ 5",
                             "Meilings",
                             "W. U. and L. I. are initials",
                             "x = lo * ve",
                             "Wu and other Li-like signs",
                             "move la ce lo"})
        EXPECT_EQ(found(names, text), "") << text;
}

}  // namespace test_name_forms
}  // namespace dynlab
