// Receipts through the commands: what a student can verify without the course, and what the course alone can. Oracles:
// OpenSSL, another implementation of Ed25519 and of HMAC; the definition of a signature.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "course/course_bench.h"

namespace dynlab::test {
namespace test_receipts {
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A course that took group-01's report; the receipt and the public key in the student's own folder, "mine".
class receipts : public testing::Test {
  protected:
    static const CourseBench& begun() {
        static const CourseBench bench = [] {
            CourseBench made(2);
            CourseBench::expect_done(made.submit_file("group-01.pdf", small_pdf("one"), "2026-03-01 10:00"));
            CourseBench::expect_done(made.bench().shell(
                "mkdir mine && cp k/receipts/crane/*-group-01-first-report.txt mine/r.txt && cp k/course.pub mine"));
            return made;
        }();
        return bench;
    }
    ChildResult shell(const std::string& command) { return course_.bench().shell(command); }
    ChildResult verify(std::vector<std::string> words) {
        words.insert(words.begin(), "verify");
        return course_.bench().dynlab(words);
    }
    std::string read(const std::string& file) { return course_.bench().read(file); }
    void write(const std::string& file, const std::string& text) { course_.bench().write(file, text); }

    CourseBench course_{begun()};
};

TEST_F(receipts, are_verified_without_the_course) {
    EXPECT_THAT(course_.course({"verify", "mine/r.txt"}).output, HasSubstr("mine/r.txt: genuine"));
    CourseBench::expect_done(shell("rm -r k"));
    const ChildResult genuine = verify({"mine/r.txt"});
    EXPECT_EQ(genuine.exit_code, 0) << genuine.error_output;
    EXPECT_EQ(genuine.output, "mine/r.txt: genuine, signed by the course \"k\"\n");
    CourseBench::expect_done(shell("mv mine/course.pub key.txt"));
    EXPECT_EQ(verify({"mine/r.txt", "--key", "key.txt"}).exit_code, 0);
    const ChildResult without = verify({"mine/r.txt"});
    EXPECT_EQ(without.exit_code, 0);
    EXPECT_THAT(without.output, AllOf(HasSubstr("genuine, signed with the key that it contains"),
                                      HasSubstr(read("key.txt").substr(read("key.txt").find("ed25519: ") + 9))));
    // The key in a receipt does not make an altered receipt genuine.
    std::string text = read("mine/r.txt");
    text.replace(text.find("group-01"), 8, "group-02");
    write("mine/r2.txt", text);
    EXPECT_EQ(verify({"mine/r2.txt"}).exit_code, 1);
}

// Oracle: OpenSSL verifies the lines above the signature with the key of course.pub.
TEST_F(receipts, are_signed_by_ed25519_as_other_programs_know_it) {
    const ChildResult reported = shell(
        "cd mine && sed '/^public key:/,$d' r.txt > text && sed -n 's/^signature: //p' r.txt | xxd -r -p > signature "
        "&& "
        "(echo 302a300506032b6570032100; sed -n 's/^ed25519: //p' course.pub) | xxd -r -p > key.der && "
        "openssl pkeyutl -verify -pubin -keyform DER -inkey key.der -rawin -in text -sigfile signature");
    EXPECT_EQ(reported.exit_code, 0) << reported.error_output;
    EXPECT_THAT(reported.output, HasSubstr("Signature Verified Successfully"));
}

TEST_F(receipts, forged_and_altered_ones_are_refused) {
    const std::string text = read("mine/r.txt");
    const auto refused = [&](const std::string& forged) {
        write("mine/forged.txt", forged);
        const ChildResult result = verify({"mine/forged.txt", "--key", "mine/course.pub"});
        EXPECT_EQ(result.exit_code, 1) << forged;
        EXPECT_THAT(result.output, HasSubstr("mine/forged.txt: NOT genuine"));
        EXPECT_EQ(course_.course({"verify", "mine/forged.txt"}).exit_code, 1) << forged;
    };
    const auto changed = [&text](const std::string& from, const std::string& to) {
        std::string result = text;
        EXPECT_NE(result.find(from), std::string::npos) << from;
        return result.replace(result.find(from), from.size(), to);
    };
    refused(changed("group-01", "group-02"));
    refused(changed("T10:00:00Z", "T09:00:00Z"));
    refused(changed("receipt 2", "receipt 3"));
    refused(text.substr(0, text.size() - 2) + (text[text.size() - 2] == '0' ? "1\n" : "0\n"));  // one digit
    refused(text.substr(0, text.find("signature: ")));
    refused(text.substr(0, text.find("signature: ") + 11) + std::string(128, '0') + "\n");
    refused("late: no\n" + text);
    refused("");
    // A code made with what everybody knows, the public key, is no code of the course.
    write("mine/coded.txt", changed("receipt 2", "receipt 1").substr(0, text.find("public key: ")));
    CourseBench::expect_done(
        shell("cd mine && code=$(openssl dgst -sha256 -hmac \"$(sed -n 's/^ed25519: //p' course.pub)\" coded.txt | sed "
              "'s/.*= //') && echo \"signature: $code\" >> coded.txt"));
    EXPECT_THAT(course_.course({"verify", "mine/coded.txt"}).output, HasSubstr("NOT genuine"));
    EXPECT_EQ(verify({"mine/coded.txt"}).exit_code, 1);
}

TEST_F(receipts, of_another_course_are_refused) {
    CourseBench other(3);  // courses of equal size share a key
    CourseBench::expect_done(other.submit_file("group-01.pdf", small_pdf("one"), "2026-03-01 10:00"));
    write("theirs.pub", other.bench().read("k/course.pub"));
    EXPECT_NE(read("theirs.pub"), read("mine/course.pub"));
    const ChildResult result = verify({"mine/r.txt", "--key", "theirs.pub"});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.output, HasSubstr("mine/r.txt: NOT genuine: altered, or signed by another course"));
}

// Oracle: what was done in the course since.
TEST_F(receipts, that_are_shown_again_are_compared_with_what_came_after) {
    const auto verify_output = [&](const std::string& file) { return course_.course({"verify", file}).output; };
    EXPECT_EQ(verify_output("mine/r.txt"), "mine/r.txt: genuine\n");
    CourseBench::expect_done(course_.submit_file("group-02.pdf", small_pdf("two"), "2026-03-01 10:00"));
    EXPECT_EQ(verify_output("mine/r.txt"), "mine/r.txt: genuine\n");
    CourseBench::expect_done(course_.submit_file("group-01.pdf", small_pdf("newer"), "2026-03-01 11:00"));
    EXPECT_THAT(verify_output("mine/r.txt"), HasSubstr("genuine, but a newer version was submitted"));
    CourseBench::expect_done(course_.course({"withdraw", "crane", "group-01", "--reason", "the wrong file"}));
    EXPECT_THAT(verify_output("k/receipts/crane/00003-group-01-first-report.txt"),
                HasSubstr("but the file was withdrawn"));
    EXPECT_EQ(verify_output("mine/r.txt"), "mine/r.txt: genuine\n");
    CourseBench::expect_done(
        course_.course({"set-received", "crane", "group-01", "2026-03-01 12:30", "--reason", "it came by mail"}));
    EXPECT_THAT(verify_output("mine/r.txt"), HasSubstr("but the time was corrected"));
    const std::string corrected = "k/receipts/crane/00001-group-01-first-report-corrected-1.txt";
    EXPECT_EQ(verify_output(corrected), corrected + ": genuine\n");
}

TEST_F(receipts, are_for_one_file) {
    const ChildResult right = verify({"mine/r.txt", "group-01.pdf"});
    EXPECT_EQ(right.exit_code, 0) << right.output << right.error_output;
    write("other.pdf", small_pdf("other"));
    const ChildResult wrong = verify({"mine/r.txt", "other.pdf"});
    EXPECT_EQ(wrong.exit_code, 1);
    EXPECT_THAT(wrong.output, HasSubstr("genuine, but NOT for other.pdf: that file has a different SHA-256"));
}

TEST_F(receipts, bad_keys_and_words_are_reported) {
    for (const std::string& bad :
         {std::string("nothing\n"), std::string(), "dynlab receipt key 1\ned25519: 12\n" + std::string(64, '0'),
          "dynlab receipt key 1\ned25519: " + std::string(64, 'x') + "\n"}) {
        write("bad.pub", bad);
        const ChildResult result = verify({"mine/r.txt", "--key", "bad.pub"});
        EXPECT_EQ(result.exit_code, 1) << bad;
        EXPECT_THAT(result.error_output, HasSubstr("bad.pub: the file is not the public key of a course")) << bad;
    }
    EXPECT_EQ(verify({}).exit_code, 2);
    EXPECT_EQ(verify({"nowhere.txt"}).exit_code, 2);
    EXPECT_EQ(verify({"mine/r.txt", "--key", "nowhere.pub"}).exit_code, 2);
}

TEST_F(receipts, the_public_key_is_shown_and_the_secret_is_not) {
    const ChildResult shown = course_.course({"verify", "--key"});
    EXPECT_EQ(shown.exit_code, 0) << shown.error_output;
    EXPECT_THAT(shown.output, AllOf(HasSubstr(read("mine/course.pub")), HasSubstr("k/course.pub")));
    const std::string secret = read("k/course.key");
    for (const std::string& open : {shown.output, read("mine/course.pub"), read("mine/r.txt")})
        EXPECT_THAT(open, Not(HasSubstr(secret.substr(0, 64))));
    EXPECT_EQ(shell("stat -c %a k/course.key").output, "600\n");
}

// A course of before has no public key, codes in its store, and receipts with codes. Oracle: OpenSSL's HMAC.
TEST_F(receipts, of_courses_of_before_are_still_known_to_the_course) {
    CourseBench::expect_done(shell(
        "rm k/course.pub && sed '/^public key:/,$d' mine/r.txt | sed '1s/2$/1/' > old.txt && "
        "code=$(openssl dgst -sha256 -hmac \"$(cat k/course.key)\" old.txt | sed 's/.*= //') && "
        "echo \"signature: $code\" >> old.txt && cp old.txt k/receipts/crane/*-group-01-first-report.txt && "
        "sqlite3 k/course.db \"UPDATE versions SET signature = '$code'; DROP VIEW standing; DROP "
        "VIEW arrived; DROP TABLE arrivals; DROP TABLE extensions; DROP TABLE withdrawals; DROP TABLE holds; DROP "
        "TABLE pair_wishes; DROP TABLE returns; DROP TABLE seals; DROP TABLE marks; DROP TABLE results; DROP TABLE "
        "stops; " +
        std::string(CourseBench::kTablesOfScores) +
        "ALTER TABLE students DROP COLUMN own_data; ALTER TABLE students DROP COLUMN language; DROP INDEX "
        "versions_of_pair; DROP INDEX versions_of_hash; DROP INDEX sendings_of_pair; ALTER TABLE assignments DROP "
        "COLUMN costs; ALTER TABLE assignments DROP COLUMN final_weight; ALTER TABLE assignments ADD COLUMN seed "
        "INTEGER "
        "NOT NULL DEFAULT 7; ALTER TABLE allocations ADD COLUMN seed INTEGER NOT NULL DEFAULT 7; PRAGMA user_version = "
        "2\""));
    EXPECT_THAT(course_.course({"verify"}).output, HasSubstr("1 file, 1 version: complete and unaltered"));
    EXPECT_THAT(course_.course({"verify", "old.txt"}).output, HasSubstr("old.txt: genuine"));
    const ChildResult alone = verify({"old.txt", "--key", "mine/course.pub"});
    EXPECT_EQ(alone.exit_code, 1);
    EXPECT_THAT(alone.output, HasSubstr("old.txt: cannot be decided: the receipt has a code instead of a signature"));
    std::string altered = read("old.txt");
    altered.replace(altered.find("group-01"), 8, "group-02");
    write("altered.txt", altered);
    EXPECT_THAT(course_.course({"verify", "altered.txt"}).output, HasSubstr("NOT genuine"));
    // What comes from now on is signed, and the key is there again, the same.
    CourseBench::expect_done(course_.submit_file("group-02.pdf", small_pdf("two"), "2026-03-01 10:00"));
    EXPECT_EQ(read("k/course.pub"), read("mine/course.pub"));
    CourseBench::expect_done(shell("cp k/receipts/crane/*-group-02-first-report.txt new.txt"));
    EXPECT_EQ(verify({"new.txt", "--key", "mine/course.pub"}).exit_code, 0);
    EXPECT_THAT(course_.course({"verify"}).output, HasSubstr("2 files, 2 versions: complete and unaltered"));
    CourseBench::expect_done(shell("sqlite3 k/course.db \"UPDATE versions SET late = 7 WHERE id = 1\""));
    EXPECT_THAT(course_.course({"verify"}).error_output, HasSubstr("version 1: the data differ from the"));
}

}  // namespace test_receipts
}  // namespace dynlab::test
