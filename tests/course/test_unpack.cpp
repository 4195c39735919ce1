#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>

#include "course/course_bench.h"
#include "course/grading_bench.h"
#include "course/intake/submission.h"
#include "support/message_texts.h"

namespace dynlab::test {
namespace test_unpack {
namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// Runs a program of Python, whose own modules write the archives.
void make_with_python(const Workbench& bench, const std::string& program) {
    bench.write("make.py", "import io, tarfile, zipfile\n" + program);
    const ChildResult made = bench.shell("python3 make.py");
    ASSERT_EQ(made.exit_code, 0) << made.error_output;
}

std::vector<Isolation> isolation_levels() {
    std::vector<Isolation> all = {Isolation::kProcess};
    if (!obstacle_to(Isolation::kFull)) all.push_back(Isolation::kFull);
    return all;
}

struct FilesOut {
    std::map<std::string, std::string> files;  ///< place -> content
    std::vector<Message> left_out;
};

FilesOut files_out_of(const Workbench& bench, const std::string& archive, Isolation level) {
    const TemporaryFolder to;
    FilesOut result;
    result.left_out = unpack_submission(bench.path(archive), to.path() / "all", level, DYNLAB_PROGRAM);
    for (const auto& entry : fs::recursive_directory_iterator(to.path() / "all"))
        if (entry.is_regular_file())
            result.files[entry.path().lexically_relative(to.path() / "all").string()] = read_file(entry.path());
    return result;
}

// oracle: the names and contents given to Python's modules. With # instead of letters, zipfile writes no flag of UTF-8;
// the test puts in the bytes afterwards.
TEST(unpack, names_keep_their_letters_in_every_kind_of_archive) {
    const Workbench bench;
    make_with_python(bench, R"(
files = {'Élise – v2/analysis.lua': b'script', 'Élise – v2/données.csv': b'table'}
with zipfile.ZipFile('flag.zip', 'w') as z:
    for name, content in files.items(): z.writestr(name, content)
with zipfile.ZipFile('plain.zip', 'w') as z:
    for name, content in files.items(): z.writestr(name.replace('É', '#1').replace('–', '#22').replace('é', '#3'), content)
data = open('plain.zip', 'rb').read()
for mark, letter in ((b'#1', 'É'), (b'#22', '–'), (b'#3', 'é')): data = data.replace(mark, letter.encode())
open('plain.zip', 'wb').write(data)
for archive, manner, kind in (('pax.tar.gz', 'w:gz', tarfile.PAX_FORMAT), ('gnu.tar', 'w', tarfile.GNU_FORMAT)):
    with tarfile.open(archive, manner, format=kind) as t:
        for name, content in files.items():
            entry = tarfile.TarInfo(name)
            entry.size = len(content)
            t.addfile(entry, io.BytesIO(content))
with zipfile.ZipFile('cp850.zip', 'w') as z: z.writestr('donn#es.csv', b'table')
data = open('cp850.zip', 'rb').read().replace(b'#', b'\x82')
open('cp850.zip', 'wb').write(data)
)");
    const std::map<std::string, std::string> given = {{"Élise – v2/analysis.lua", "script"},
                                                      {"Élise – v2/données.csv", "table"}};
    for (const Isolation level : isolation_levels()) {
        for (const char* archive : {"flag.zip", "plain.zip", "pax.tar.gz", "gnu.tar"}) {
            SCOPED_TRACE(archive);
            const FilesOut all = files_out_of(bench, archive, level);
            EXPECT_EQ(all.files, given);
            EXPECT_THAT(all.left_out, IsEmpty());
        }
        const std::map<std::string, std::string> old = {{"données.csv", "table"}};
        EXPECT_EQ(files_out_of(bench, "cp850.zip", level).files, old);
    }
}

// oracle: what was done to each name
TEST(unpack, says_of_each_entry_why_it_is_left_out) {
    const Workbench bench;
    make_with_python(bench, R"(
with zipfile.ZipFile('mixed.zip', 'w') as z:
    for name in ('../up.csv', '/tmp/absolute.csv', 'C:/drive.csv', 'd/'*20 + 'deep.csv', 'l'*256, 'two\nlines.csv', 'é.csv', 'good.csv'):
        z.writestr(name, name)
    link = zipfile.ZipInfo('link.csv')
    link.external_attr = 0o120777 << 16
    z.writestr(link, '/etc/passwd')
data = open('mixed.zip', 'rb').read().replace('é.csv'.encode(), b'\x82\x82.csv')
open('mixed.zip', 'wb').write(data)
)");
    const std::map<std::string, std::string> good = {{"good.csv", "good.csv"}};
    for (const Isolation level : isolation_levels()) {
        const FilesOut all = files_out_of(bench, "mixed.zip", level);
        EXPECT_EQ(all.files, good);
        EXPECT_THAT(texts_of(all.left_out), ElementsAre("\"../up.csv\" points outside the archive",
                                                        "\"/tmp/absolute.csv\" points outside the archive",
                                                        "\"C:/drive.csv\" points outside the archive",
                                                        AllOf(HasSubstr("deep.csv\" is nested deeper than 20 folders")),
                                                        HasSubstr("\" contains a name longer than 255 bytes"),
                                                        "\"two\nlines.csv\" has a name with control characters",
                                                        "the name of a file in the archive cannot be read",
                                                        "\"link.csv\" is a link or not a regular file"));
    }
}

// oracle: the names that the platform's zip was given, and 40 + 2
TEST(unpack, a_class_with_accents_in_all_its_names_is_graded) {
    const std::string solution = "answer('x', sum(load('données.csv').y))\n";
    GradingBench bench("--   x: number\n", "check{id = 'x', test = function(a) return a.x == 42 end}\n",
                       "answer('x', 42)\n");
    const Workbench& work = bench.bench();
    work.write("analysis.lua", solution);
    work.write("table.csv", "y\n40\n2\n");
    make_with_python(work, R"(
with zipfile.ZipFile('inner.zip', 'w') as z:
    z.write('analysis.lua', 'Été/analysis.lua')
    z.write('table.csv', 'Été/données.csv')
with zipfile.ZipFile('all.zip', 'w') as z:
    z.write('inner.zip', 'Chloé Lefèvre_900001_assignsubmission_file_/rendu n°1.zip')
    z.write('analysis.lua', 'Jörg Weiß_900002_assignsubmission_file_/analysis.lua')
    z.write('table.csv', 'Jörg Weiß_900002_assignsubmission_file_/données.csv')
    z.writestr('note.txt', 'x')
    z.writestr('é.zip', 'x')
data = open('all.zip', 'rb').read().replace('é.zip'.encode(), b'\x82\x82.zip')
open('all.zip', 'wb').write(data)
)");
    work.write("roster.csv", "id,name,moodle\n1,Chloé Lefèvre,900001\n2,Jörg Weiß,900002\n");
    const ChildResult graded = work.dynlab({"grade", "all.zip", "--lesson", "99", "--out", "out", "--roster",
                                            "roster.csv", "--isolation", GradingBench::level(), "--no-pdf"});
    EXPECT_THAT(graded.output, HasSubstr("2 submissions: 2 graded now"));
    for (const char* name :
         {"Chloé Lefèvre_900001_assignsubmission_file_", "Jörg Weiß_900002_assignsubmission_file_"}) {
        EXPECT_EQ(GradingBench::score(bench.result(name)), 1) << name << GradingBench::error_reason(bench.result(name));
        EXPECT_THAT(work.read("out/gradebook.csv"), HasSubstr(fmt::format("{},graded,1,1", name)));
    }
    EXPECT_THAT(graded.error_output,
                AllOf(HasSubstr("\"note.txt\" is neither a folder nor an archive (.zip, .tar.gz); left out"),
                      HasSubstr("the name of a file in the archive cannot be read; left out")));
}

// oracle: the names that the platform's zip was given
TEST(unpack, a_course_receives_files_with_accents_in_their_names) {
    CourseBench bench(2);
    bench.bench().write("one.pdf", small_pdf("one"));
    bench.bench().write("two.pdf", small_pdf("two"));
    make_with_python(bench.bench(), R"(
with zipfile.ZipFile('SYS26-Bericht Kran-5512.zip', 'w') as z:
    z.write('one.pdf', 'Student 1_4711_assignsubmission_file_/Bericht für Übung 3.pdf')
    z.write('two.pdf', 'Student 2_4712_assignsubmission_file_/rapport_zélé v2.pdf')
    z.writestr('é.pdf', 'x')
data = open('SYS26-Bericht Kran-5512.zip', 'rb').read().replace('é.pdf'.encode(), b'\x82\x82.pdf')
open('SYS26-Bericht Kran-5512.zip', 'wb').write(data)
)");
    const ChildResult taken = bench.course(
        {"submit", "SYS26-Bericht Kran-5512.zip", "--at", "2026-03-01 10:00", "--isolation", CourseBench::level()});
    EXPECT_THAT(taken.output,
                AllOf(HasSubstr("2 files accepted, 0 late"), HasSubstr("group-01"), HasSubstr("group-02")));
    EXPECT_THAT(taken.error_output, AllOf(HasSubstr("the name of a file in the archive cannot be read; left out"),
                                          Not(HasSubstr("points outside"))));
}

}  // namespace test_unpack
}  // namespace dynlab::test
