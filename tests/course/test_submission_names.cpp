#include <fmt/format.h>
#include <gmock/gmock.h>

#include "base/reader.h"
#include "course/course_bench.h"
#include "course/grading_bench.h"
#include "course/intake/owners.h"

namespace dynlab::test {
namespace test_submission_names {
namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

struct Person {
    std::string given, family;
};

/// Made-up people: every given name of a script with every family's name of it. More than twelve scripts, and Latin as
/// half a dozen languages write it.
std::vector<Person> people() {
    const std::vector<std::pair<std::vector<const char*>, std::vector<const char*>>> by_script = {
        {{"Élise", "Zoé", "François", "Ísak", "Örjan"}, {"Lefèvre", "Çelik", "Müller", "de la Cruz"}},
        {{"Łucja", "Žofie", "Őrs", "Ștefan", "İnci"}, {"Wiśniewski-Kos", "Dvořák", "Đặng", "O'Breen"}},
        {{"Maïté", "Günther", "Søren", "Åse", "Þóra"}, {"van der Berg", "Weiß", "Ærøsund", "Nuñez Peña"}},
        {{"Αλέξης", "Δάφνη", "Ιάσων", "Ζωή"}, {"Παπαδάκης", "Ξένου", "Ψαρράς", "Άνθη"}},
        {{"Мария", "Сергей", "Юлія", "Ђорђе"}, {"Ёлкина", "Щукин", "Їжак", "Йовић"}},
        {{"דוד", "מרים", "שרה", "יעל"}, {"כהן", "לוינסון", "פרץ", "גולדמן"}},
        {{"محمد", "فاطمة", "أحمد", "آمنة"}, {"الحسيني", "بن يوسف", "القرشي", "مؤمن"}},
        {{"अनिल", "प्रिया", "कृष्ण", "ज़ोया"}, {"शर्मा", "वर्मा", "गुप्ता", "मिश्रा"}},
        {{"অরুণ", "মিতা", "সৌরভ", "রিয়া"}, {"চট্টোপাধ্যায়", "ঘোষ", "দাশ", "সেন"}},
        {{"கவிதா", "முருகன்", "செல்வி", "அருள்"}, {"சுப்பிரமணியன்", "ராமன்", "கோபால்", "நாதன்"}},
        {{"สมชาย", "มาลี", "กิตติ", "น้ำฝน"}, {"ศรีสุข", "ทองดี", "แก้วใส", "จันทร์เพ็ญ"}},
        {{"გიორგი", "ნინო", "თამარ", "ლევან"}, {"ბერიძე", "ჯაფარიძე", "წერეთელი", "ყიფიანი"}},
        {{"Արամ", "Անի", "Եվա", "Տիգրան"}, {"Սարգսյան", "Հակոբյան", "Գրիգորյան", "Ծատուրյան"}},
        {{"민수", "지영", "하늘", "서연"}, {"김", "이", "박", "최"}},
        {{"小明", "麗華", "志强", "雪"}, {"王", "李", "陳", "歐陽"}},
        {{"さくら", "ゆうが", "ジュン", "はぐみ"}, {"山田", "がじま", "ヴィラ", "ぱく"}},
        {{"አበበ", "ሰላም", "ደሳለኝ", "ትዕግስት"}, {"ተስፋዬ", "በቀለ", "ኃይሌ", "ገብረ"}},
    };
    std::vector<Person> all;
    for (const auto& [given, families] : by_script)
        for (const char* family : families)
            for (const char* name : given) all.push_back({name, family});
    return all;
}

constexpr int kFirstId = 200001, kFirstNumber = 900001;

std::vector<Student> class_of(const std::vector<Person>& all, bool with_groups) {
    std::vector<Student> students;
    for (std::size_t i = 0; i < all.size(); ++i) {
        Student student;
        student.id = std::to_string(kFirstId + static_cast<int>(i));
        student.name = all[i].given + " " + all[i].family;
        if (with_groups) student.group = fmt::format("group-{:03}", i + 1);
        students.push_back(student);
    }
    return students;
}

/// Writes exports of a class as platforms and systems do. The size of a file identifies its author: ten bytes plus the
/// student's position.
constexpr const char* kWriters = R"(
import io, sys, tarfile, unicodedata, zipfile
people = [line.rstrip('\n').split('\t') for line in open('people.tsv', encoding='utf-8')]
def content(i): return b'-' * (10 + i)

class Unflagged(zipfile.ZipInfo):
    raw = b''
    def _encodeFilenameFlags(self): return self.raw, self.flag_bits & ~0x800

def write(file, entries):  # entries: name (text: with the flag of UTF-8, as PHP's libzip writes it; bytes: without), content
    with zipfile.ZipFile(file, 'w') as z:
        for name, data in entries:
            if isinstance(name, bytes):
                entry = Unflagged('x')
                entry.raw = name
                z.writestr(entry, data)
            else: z.writestr(name, data)

def old(name):  # as Windows and 7-Zip: the code page of the system where it has the letters, else Unicode
    try: return name.encode('cp850')
    except UnicodeEncodeError: return name

full = [given + ' ' + family for given, family in people]
moodle = lambda i, name: '%s_%d_assignsubmission_file_' % (name, 900001 + i)
write('moodle_folders.zip', [(moodle(i, n) + '/analysis.lua', content(i)) for i, n in enumerate(full)])
write('moodle_files.zip', [(moodle(i, n) + 'analysis.lua', content(i)) for i, n in enumerate(full)])
write('moodle_blind.zip', [(moodle(i, 'Participant') + '/analysis.lua', content(i)) for i, n in enumerate(full)])
write('moodle_default.zip', [(moodle(i, 'Default group-' + n) + '/analysis.lua', content(i)) for i, n in enumerate(full)])
write('moodle_teams.zip', [(moodle(i, 'group-%03d-%s' % (i + 1, n)) + '/analysis.lua', content(i)) for i, n in enumerate(full)])
canvas = lambda i: ''.join(c for c in (people[i][1] + people[i][0]).lower() if c not in " '-")
write('canvas.zip', [('%s%s_%d_%d_analysis%s.lua' % (canvas(i), '_LATE' if i % 3 == 0 else '', 900001 + i, 7000 + i,
                      '-1' if i % 4 == 0 else ''), content(i)) for i in range(len(people))])
scope = ['---\n']
for i, n in enumerate(full):
    scope.append('submission_%d:\n  :submitters:\n  - :name: %s\n    :sid: "%d"\n    :email: s%d@uni.example\n'
                 '  :created_at: 2026-03-01 17:00:00.0 Z\n  :score: 0.0\n' % (5000 + i, n if i % 2 else '?', 200001 + i, i))
write('gradescope.zip', [('assignment_77_export/submission_metadata.yml', ''.join(scope))] +
      [('assignment_77_export/submission_%d/analysis.lua' % (5000 + i), content(i)) for i in range(len(people))])
write('windows.zip', [(old(n + '/analysis.lua'), content(i)) for i, n in enumerate(full)])
write('seven_zip.zip', [(old(people[i][1] + ', ' + people[i][0] + '/analysis.lua'), content(i)) for i in range(len(people))])
mac = []
for i, n in enumerate(full):
    name = unicodedata.normalize('NFD', n)
    mac += [((name + '/analysis.lua').encode(), content(i)), (('__MACOSX/' + name + '/._analysis.lua').encode(), b'mac')]
write('macos.zip', mac)
with tarfile.open('class.tar.gz', 'w:gz', format=tarfile.PAX_FORMAT) as t:
    for i, n in enumerate(full):
        entry = tarfile.TarInfo(n + ' lab 4/analysis.lua')
        entry.size = 10 + i
        t.addfile(entry, io.BytesIO(content(i)))
spellings = ['Group %d', 'group_%d', 'GROUP-%03d', 'gruppe %d final v2', 'group-%03d-lab4-final', 'Équipe %d', 'team%d', 'lab4_group%02d']
write('groups.zip', [((spellings[i % 8] % (i + 1)) + '/analysis.lua', content(i)) for i in range(len(people))])
write('numbers.zip', [('lab4_%d/analysis.lua' % (200001 + i), content(i)) for i in range(len(people))])
)";

/// By the size of its script; -1 where there is none.
long place_of(const Submission& submission) {
    const fs::path script = submission.loose.empty() ? submission.path / "analysis.lua" : submission.loose.front().path;
    return fs::exists(script) ? static_cast<long>(fs::file_size(script)) - 10 : -1;
}

struct Export {
    const char* file;
    bool groups = false;   ///< in the roster
    bool numbers = false;  ///< of Moodle or Canvas, in the roster
};

// oracle: the names that Python's zipfile and tarfile were given
TEST(submission_names, every_owner_is_found_in_what_platforms_and_systems_write) {
    const std::vector<Person> all = people();
    ASSERT_GE(all.size(), 200u);
    const Workbench bench;
    std::string table;
    for (const Person& person : all) table += person.given + "\t" + person.family + "\n";
    bench.write("people.tsv", table);
    bench.write("write.py", kWriters);
    const ChildResult written = bench.shell("python3 write.py");
    ASSERT_EQ(written.exit_code, 0) << written.error_output;
    for (const Export& made :
         {Export{"moodle_folders.zip"}, Export{"moodle_files.zip"}, Export{"moodle_blind.zip", false, true},
          Export{"moodle_default.zip"}, Export{"moodle_teams.zip", true}, Export{"canvas.zip"},
          Export{"gradescope.zip"}, Export{"windows.zip"}, Export{"seven_zip.zip"}, Export{"macos.zip"},
          Export{"class.tar.gz"}, Export{"groups.zip", true}, Export{"numbers.zip"}}) {
        SCOPED_TRACE(made.file);
        std::vector<Student> students = class_of(all, made.groups);
        for (std::size_t i = 0; i < students.size() && made.numbers; ++i)
            students[i].moodle = std::to_string(kFirstNumber + static_cast<int>(i));
        const Owners owners(students);
        const TemporaryFolder to;
        EXPECT_THAT(unpack_export(bench.path(made.file), to.path() / "all", Isolation::kProcess, DYNLAB_PROGRAM),
                    IsEmpty());
        std::vector<Message> left_out;
        const std::vector<Submission> submissions = submissions_in(to.path() / "all", left_out);
        EXPECT_THAT(left_out, IsEmpty());
        EXPECT_THAT(submissions, SizeIs(all.size()));
        std::size_t right = 0;
        for (const Submission& submission : submissions) {
            const Owners::Found found = owners.find(submission);
            const long place = place_of(submission);
            const bool theirs =
                found.anybody() && found.students.size() == 1 && static_cast<long>(found.students[0]) == place;
            EXPECT_TRUE(theirs) << submission.name << " is place " << place << ": " << message_text(found.error_reason);
            right += theirs;
        }
        EXPECT_EQ(right, all.size());
    }
}

Submission called(const std::string& name) {
    Submission submission;
    submission.name = name;
    read_lms_name(submission);
    return submission;
}

std::vector<Student> small_class() {
    return {{"1001", "Anna Müller", "group-1", {}, "anna.mueller@uni.example", "", ""},
            {"1002", "Ben Lee", "group-1", {}, "", "", ""},
            {"1003", "Zoë Ade", "group-12", {}, "", "900003", ""},
            {"1004", "José García", "group-2", {}, "", "", ""},
            {"1005", "Jose Garcia", "group-3", {}, "", "", ""},
            {"1006", "Uma Kepler", "group-4", {}, "", "", ""}};
}

// oracle: who is meant, as a person would read it
TEST(submission_names, one_meaning_is_taken_and_two_are_reported) {
    const std::vector<Student> students = small_class();
    const Owners owners(students, {"group-9"});
    const auto group = [&](const std::string& name) { return owners.find(called(name)).group; };
    for (const char* name :
         {"group-1", "Group 1", "group_01_final", "ANNA MULLER", "Mueller Anna", "muelleranna_5_6_x", "lee ben",
          "Lab 4 - Anna Müller", "1002", "anna.mueller", "Default group-Ben Lee_7_assignsubmission_file_",
          "group-1-Ben Lee_8_assignsubmission_file_", "group-1_against_group-2"})
        EXPECT_EQ(group(name), "group-1") << name << ": " << message_text(owners.find(called(name)).error_reason);
    EXPECT_EQ(group("group-12_report"), "group-12");
    EXPECT_EQ(group("Participant_900003_assignsubmission_file_"), "group-12");
    EXPECT_EQ(group("group-9"), "group-9");
    EXPECT_EQ(group("José García"), "group-2");  // a written accent distinguishes the two
    EXPECT_EQ(group("Jose Garcia"), "group-3");
    const auto error_reason = [&](const std::string& name) {
        return message_text(owners.find(called(name)).error_reason);
    };
    EXPECT_EQ(error_reason("jose GARCIA"), "the name matches several groups or students: group-2, group-3");
    EXPECT_EQ(error_reason("group-1-Zoë Ade_8_assignsubmission_file_"),
              "the name matches several groups or students: group-1, group-12");
    EXPECT_EQ(error_reason("Ben Lee_900003_assignsubmission_file_"),
              "the number 900003 in the name belongs to group-12, but the name matches group-1");
    EXPECT_EQ(error_reason("group-7"), "the name matches no group and no student");
    EXPECT_EQ(error_reason("SYS26 group export"), "the name matches no group and no student");
    EXPECT_EQ(error_reason("Anna"), "the name matches no group and no student");
}

// oracle: Python's code pages, and the roster that the instructor wrote
TEST(submission_names, names_in_code_pages_of_other_scripts_are_held_against_the_roster) {
    const Workbench work;
    work.write("zip.py", R"py(
import zipfile
class Unflagged(zipfile.ZipInfo):
    raw = b''
    def _encodeFilenameFlags(self): return self.raw, self.flag_bits & ~0x800
names = [('Мария Щукина', 'cp866'), ('Сергей Їжак', 'cp1251'), ('王小明', 'gbk'), ('陳麗華', 'big5'),
         ('山田さくら', 'shift_jis'), ('김민수', 'cp949'), ('Пётр Никто', 'cp866')]
with zipfile.ZipFile('all.zip', 'w') as z:
    for i, (name, page) in enumerate(names):
        info = Unflagged('x%d/analysis.lua' % i)
        info.raw = name.encode(page) + b'/analysis.lua'
        z.writestr(info, "answer('x', 42)" if i % 2 else "answer('x', 1)")
)py");
    GradingBench bench("--   x: number\n",
                       "check{id = 'x', points = 2, about = 'X', test = function(a) return near(a.x, 42) end}\n",
                       "answer('x', 42)\n");
    ASSERT_EQ(work.shell("python3 zip.py && cp all.zip '" + bench.bench().path().string() + "'").exit_code, 0);
    bench.bench().write(
        "roster.csv",
        "id,name\n1,Мария Щукина\n2,Сергей Їжак\n3,王小明\n4,陳麗華\n5,山田さくら\n6,김민수\n7,Élise K\n");
    const ChildResult graded =
        bench.bench().dynlab({"grade", "all.zip", "--lesson", "99", "--out", "out", "--isolation", bench.level(),
                              "--no-pdf", "--roster", "roster.csv"});
    EXPECT_EQ(graded.exit_code, 1);  // one submission matches no student
    EXPECT_THAT(graded.error_output + graded.output, HasSubstr("matches no student in the roster"));
    std::string reported;
    for (int student = 1; student <= 7; ++student)
        reported += bench.bench().shell(fmt::format("grep '^{},' out/gradebook.csv | cut -d, -f4,5", student)).output;
    EXPECT_EQ(reported, "graded,0\ngraded,2\ngraded,0\ngraded,2\ngraded,0\ngraded,2\nnothing submitted,\n");
}

TEST(submission_names, the_instructors_list_goes_before_names) {
    const std::vector<Student> students = small_class();
    Owners owners(students);
    const Workbench bench;
    bench.write("owners.csv",
                "Submission;Group;ID\nmy work.zip;Group 2;\nEve_77_assignsubmission_file_;;1006\ngone;group-1;\n");
    owners.read_list(bench.path("owners.csv"));
    EXPECT_EQ(owners.find(called("my work")).group, "group-2");
    EXPECT_EQ(owners.find(called("Eve_77_assignsubmission_file_")).group, "group-4");
    EXPECT_THAT(owners.unmatched_names({called("my work"), called("Eve_77_assignsubmission_file_")}),
                ElementsAre("gone"));
    for (const auto& [table, reported] :
         {std::pair("name,group\n", "the columns \"submission\" and \"group\""),
          std::pair("submission,group\nx,group-77\n", "line 2: unknown group \"group-77\""),
          std::pair("submission,id\nx,9\n", "line 2: no student has the id \"9\""),
          std::pair("submission,id\nx,1001\nx.zip,1002\n", "line 3: \"x\" already has an owner")}) {
        bench.write("bad.csv", table);
        try {
            Owners(students).read_list(bench.path("bad.csv"));
            ADD_FAILURE() << reported;
        } catch (const std::exception& error) {
            EXPECT_THAT(error.what(), HasSubstr(reported));
        }
    }
}

// oracle: the groups that are meant
TEST(submission_names, a_course_takes_files_by_the_same_names) {
    CourseBench bench(4);
    const Workbench& work = bench.bench();
    const std::vector<std::string> places = {"Group 1/report.pdf",
                                             "Default group-STUDENT 2_77_assignsubmission_file_/r.pdf",
                                             "3student_LATE_78_901_report.pdf", "team_04-lab report.pdf"};
    for (std::size_t i = 0; i < places.size(); ++i) work.write("in/" + places[i], small_pdf(std::to_string(i)));
    work.write("in/group-77/report.pdf", small_pdf("of nobody"));
    // What dynlab run drew lies beside the script, whether there is a report or not.
    work.write("in/Group 1/analysis_out/01-times.pdf", small_pdf("a figure"));
    work.write("in/group-78/analysis_out/01-times.pdf", small_pdf("another figure"));
    const ChildResult taken =
        bench.course({"submit", "in", "--at", "2026-03-01 10:00", "--isolation", CourseBench::level()});
    EXPECT_THAT(taken.output, HasSubstr("4 files accepted, 0 late"));
    for (int i = 1; i <= 4; ++i) EXPECT_THAT(taken.output, HasSubstr(CourseBench::group(i)));
    EXPECT_THAT(taken.error_output, HasSubstr("no group or student of the course is named \"group-77\""));
    EXPECT_THAT(bench.course({"status", "crane"}).output,
                HasSubstr("Not accepted: report.pdf, Sun 2026-03-01 10:00: "));
    EXPECT_THAT(bench.course({"verify"}).output, HasSubstr("complete and unaltered"));
    EXPECT_THAT(taken.output + taken.error_output, Not(HasSubstr("01-times")));
}

// oracle: Moodle's worksheet, which names the participants of a blind export
TEST(submission_names, a_worksheet_says_whose_a_participant_s_number_is) {
    CourseBench work(3);
    work.bench().write("all/Participant_9003_assignsubmission_file_/report.pdf", small_pdf("blind"));
    work.bench().write("sheet.csv",
                       "Identifier,Full name,Grade,Maximum Grade,Last modified (submission)\nParticipant 9003,Student "
                       "3,,10,\"Sunday, 1 March 2026, 9:00 AM\"\nParticipant 9001,Student 1,,10,-\n");
    const ChildResult blind = work.course({"submit", "all", "--at", "2026-03-01 10:00", "--no-checks"});
    EXPECT_EQ(blind.exit_code, 1);
    EXPECT_THAT(blind.error_output, HasSubstr("give the owner with"));
    const ChildResult reported =
        work.course({"submit", "all", "--at", "2026-03-01 10:00", "--no-checks", "--times", "sheet.csv"});
    EXPECT_EQ(reported.exit_code, 0) << reported.error_output;
    EXPECT_THAT(reported.output, HasSubstr("group-03"));
}

// oracle: membership when the first version came; who moves later stays its author
TEST(submission_names, a_final_version_is_of_the_group_of_the_first_one) {
    CourseBench bench(3);
    CourseBench::expect_done(
        bench.submit_file("group-01.pdf", small_pdf("first"), "2026-02-27 12:00", {"--no-checks"}));
    bench.bench().write("moved.csv", "id,name,group\ns1,Student 1,group-02\n");
    CourseBench::expect_done(bench.course({"import", "moved.csv"}));
    bench.bench().write("final/Student 1.pdf", small_pdf("of both"));
    bench.bench().write("final/Student 2.pdf", small_pdf("of the other"));
    const ChildResult final =
        bench.course({"submit", "final", "--stage", "final", "--at", "2026-03-14 12:00", "--no-checks"});
    EXPECT_EQ(final.exit_code, 0) << final.error_output;
    EXPECT_THAT(final.output, AllOf(HasSubstr("2 files accepted"), HasSubstr("group-01"), HasSubstr("group-02")));
}

}  // namespace test_submission_names
}  // namespace dynlab::test
