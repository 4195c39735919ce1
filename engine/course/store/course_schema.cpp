#include "course/store/course_schema.h"

#include <fmt/format.h>
#include <unistd.h>

#include "platform/error.h"

namespace dynlab::inline course {
namespace {

constexpr std::int64_t kApplicationId = 0x64796E6C;  // "dynl"

/// What each version adds to the one before; never changed once published. Times are seconds since 1970, UTC.
const std::vector<const char*> kSteps = {
    R"(
CREATE TABLE course (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE groups (id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE COLLATE NOCASE, joined_at INTEGER NOT NULL,
  left_at INTEGER, left_reason TEXT);
CREATE TABLE students (id TEXT PRIMARY KEY, name TEXT NOT NULL, mail TEXT NOT NULL, moodle TEXT NOT NULL,
  canvas TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE memberships (student TEXT NOT NULL REFERENCES students, group_id INTEGER NOT NULL REFERENCES groups,
  since INTEGER NOT NULL, until INTEGER, PRIMARY KEY (student, group_id, since)) WITHOUT ROWID;
CREATE TABLE assignments (id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE COLLATE NOCASE,
  kind TEXT NOT NULL CHECK (kind IN ('report', 'presentation')), lesson TEXT NOT NULL, first_due INTEGER NOT NULL,
  review_due INTEGER, final_due INTEGER, grace INTEGER NOT NULL CHECK (grace >= 0),
  reviews INTEGER NOT NULL CHECK (reviews >= 0), seed INTEGER NOT NULL, made_at INTEGER NOT NULL);
CREATE TABLE criteria (assignment INTEGER NOT NULL REFERENCES assignments, place INTEGER NOT NULL, name TEXT NOT NULL,
  most REAL NOT NULL CHECK (most > 0), PRIMARY KEY (assignment, place), UNIQUE (assignment, name)) WITHOUT ROWID;
CREATE TABLE files (hash TEXT PRIMARY KEY, bytes INTEGER NOT NULL, stored_at INTEGER NOT NULL) WITHOUT ROWID;
CREATE TABLE pseudonyms (assignment INTEGER NOT NULL REFERENCES assignments, group_id INTEGER NOT NULL REFERENCES groups,
  role TEXT NOT NULL CHECK (role IN ('author', 'reviewer')), number INTEGER NOT NULL,
  PRIMARY KEY (assignment, group_id, role), UNIQUE (assignment, role, number)) WITHOUT ROWID;
CREATE TABLE allocations (id INTEGER PRIMARY KEY, assignment INTEGER NOT NULL REFERENCES assignments,
  seed INTEGER NOT NULL, made_at INTEGER NOT NULL, explanation TEXT NOT NULL);
CREATE TABLE pairs (id INTEGER PRIMARY KEY, allocation INTEGER NOT NULL REFERENCES allocations,
  assignment INTEGER NOT NULL REFERENCES assignments, reviewer INTEGER NOT NULL REFERENCES groups,
  author INTEGER NOT NULL REFERENCES groups, ended_at INTEGER, ended_reason TEXT, CHECK (reviewer <> author));
CREATE UNIQUE INDEX pairs_once ON pairs (assignment, reviewer, author) WHERE ended_at IS NULL;
CREATE TABLE versions (id INTEGER PRIMARY KEY, assignment INTEGER NOT NULL REFERENCES assignments,
  group_id INTEGER NOT NULL REFERENCES groups, stage TEXT NOT NULL CHECK (stage IN ('first', 'review', 'final')),
  pair INTEGER REFERENCES pairs, part TEXT NOT NULL, number INTEGER NOT NULL CHECK (number > 0),
  hash TEXT NOT NULL REFERENCES files, name TEXT NOT NULL, received_at INTEGER NOT NULL, due_at INTEGER NOT NULL,
  late INTEGER NOT NULL CHECK (late >= 0), findings TEXT NOT NULL, signature TEXT NOT NULL,
  CHECK ((stage = 'review') = (pair IS NOT NULL)));
CREATE UNIQUE INDEX versions_once ON versions (assignment, group_id, stage, ifnull(pair, 0), part, number);
CREATE TABLE sendings (id INTEGER PRIMARY KEY, pair INTEGER NOT NULL REFERENCES pairs,
  way TEXT NOT NULL CHECK (way IN ('to reviewer', 'to author')), version INTEGER NOT NULL REFERENCES versions,
  hash TEXT NOT NULL REFERENCES files, made_at INTEGER NOT NULL);
CREATE TABLE scores (pair INTEGER NOT NULL REFERENCES pairs, criterion INTEGER NOT NULL, given_at INTEGER NOT NULL,
  points REAL NOT NULL CHECK (points >= 0), PRIMARY KEY (pair, criterion, given_at)) WITHOUT ROWID;
CREATE TABLE oral_scores (assignment INTEGER NOT NULL REFERENCES assignments,
  group_id INTEGER NOT NULL REFERENCES groups, criterion INTEGER NOT NULL, given_at INTEGER NOT NULL,
  points REAL NOT NULL CHECK (points >= 0), PRIMARY KEY (assignment, group_id, criterion, given_at)) WITHOUT ROWID;
CREATE TABLE overrides (id INTEGER PRIMARY KEY, assignment INTEGER NOT NULL REFERENCES assignments,
  group_id INTEGER NOT NULL REFERENCES groups, what TEXT NOT NULL CHECK (what IN ('work', 'reviews')),
  percent REAL NOT NULL CHECK (percent BETWEEN 0 AND 100), reason TEXT NOT NULL, made_at INTEGER NOT NULL);
CREATE TABLE journal (id INTEGER PRIMARY KEY, at INTEGER NOT NULL, what TEXT NOT NULL);
)",
    R"(
CREATE TABLE former_names (student TEXT NOT NULL REFERENCES students, name TEXT NOT NULL, mail TEXT NOT NULL,
  until INTEGER NOT NULL, PRIMARY KEY (student, name, mail)) WITHOUT ROWID;
)",
    // Each amendment is a separate row, and the newest row is valid; the received version stays as it was signed.
    R"(
CREATE TABLE arrivals (id INTEGER PRIMARY KEY, version INTEGER NOT NULL REFERENCES versions,
  received_at INTEGER NOT NULL, due_at INTEGER NOT NULL, late INTEGER NOT NULL CHECK (late >= 0),
  reason TEXT NOT NULL, made_at INTEGER NOT NULL, signature TEXT NOT NULL);
CREATE INDEX arrivals_of_version ON arrivals (version);
CREATE TABLE extensions (id INTEGER PRIMARY KEY, assignment INTEGER NOT NULL REFERENCES assignments,
  group_id INTEGER NOT NULL REFERENCES groups, stage TEXT NOT NULL CHECK (stage IN ('first', 'review', 'final')),
  due_at INTEGER, reason TEXT NOT NULL, made_at INTEGER NOT NULL);
CREATE INDEX extensions_of_group ON extensions (assignment, group_id, stage);
CREATE TABLE withdrawals (id INTEGER PRIMARY KEY, version INTEGER NOT NULL REFERENCES versions,
  withdrawn INTEGER NOT NULL CHECK (withdrawn IN (0, 1)), reason TEXT NOT NULL, made_at INTEGER NOT NULL);
CREATE INDEX withdrawals_of_version ON withdrawals (version);
CREATE TABLE holds (id INTEGER PRIMARY KEY, assignment INTEGER NOT NULL REFERENCES assignments,
  group_id INTEGER NOT NULL REFERENCES groups, pair INTEGER REFERENCES pairs,
  held INTEGER NOT NULL CHECK (held IN (0, 1)), reason TEXT NOT NULL, made_at INTEGER NOT NULL);
CREATE TABLE pair_wishes (id INTEGER PRIMARY KEY, assignment INTEGER NOT NULL REFERENCES assignments,
  reviewer INTEGER NOT NULL REFERENCES groups, author INTEGER NOT NULL REFERENCES groups,
  wish TEXT NOT NULL CHECK (wish IN ('set', 'forbid', 'free')), reason TEXT NOT NULL, made_at INTEGER NOT NULL,
  CHECK (reviewer <> author));
CREATE TABLE instructor_scores (assignment INTEGER NOT NULL REFERENCES assignments,
  group_id INTEGER NOT NULL REFERENCES groups, stage TEXT NOT NULL CHECK (stage IN ('first', 'final')),
  criterion INTEGER NOT NULL, given_at INTEGER NOT NULL, points REAL NOT NULL CHECK (points >= 0),
  PRIMARY KEY (assignment, group_id, stage, criterion, given_at)) WITHOUT ROWID;
CREATE TABLE returns (id INTEGER PRIMARY KEY, group_id INTEGER NOT NULL REFERENCES groups, place TEXT NOT NULL,
  hash TEXT NOT NULL, made_at INTEGER NOT NULL);
CREATE TABLE seals (id INTEGER PRIMARY KEY, at INTEGER NOT NULL, contents TEXT NOT NULL, signature TEXT NOT NULL);
ALTER TABLE assignments ADD COLUMN costs TEXT NOT NULL DEFAULT '';
ALTER TABLE assignments ADD COLUMN final_weight REAL NOT NULL DEFAULT 50;
ALTER TABLE overrides RENAME TO former_overrides;
CREATE TABLE overrides (id INTEGER PRIMARY KEY, assignment INTEGER NOT NULL REFERENCES assignments,
  group_id INTEGER NOT NULL REFERENCES groups, what TEXT NOT NULL CHECK (what IN ('work', 'reviews')),
  percent REAL CHECK (percent >= 0), reason TEXT NOT NULL, made_at INTEGER NOT NULL);
INSERT INTO overrides SELECT id, assignment, group_id, what, percent, reason, made_at FROM former_overrides;
DROP TABLE former_overrides;
CREATE INDEX versions_of_pair ON versions (pair);
CREATE INDEX versions_of_hash ON versions (hash);
CREATE INDEX sendings_of_pair ON sendings (pair);
)",
    // Points of students at the oral: null takes back what was given.
    R"(
CREATE TABLE student_scores (assignment INTEGER NOT NULL REFERENCES assignments,
  student TEXT NOT NULL REFERENCES students, criterion INTEGER NOT NULL, given_at INTEGER NOT NULL,
  points REAL CHECK (points >= 0), PRIMARY KEY (assignment, student, criterion, given_at)) WITHOUT ROWID;
CREATE TABLE oral_comments (id INTEGER PRIMARY KEY, assignment INTEGER NOT NULL REFERENCES assignments,
  group_id INTEGER NOT NULL REFERENCES groups, student TEXT REFERENCES students, comment TEXT NOT NULL,
  made_at INTEGER NOT NULL);
)",
    // Pairs and pseudonyms are stored as they were drawn; there is no seed that they follow from.
    R"(
ALTER TABLE assignments DROP COLUMN seed;
ALTER TABLE allocations DROP COLUMN seed;
)",
    // Labs are assignments like reports and talks. An assignment has a weight in the total, a lab what it is graded
    // with, a student what a group's own data are drawn from. `results` is what the checks gave a version, `marks` what
    // the instructor gave instead (item: a check, or * for the whole; null takes back), `refusals` the files that were
    // not taken. Every score can be taken back: null points. `stops`: copies
    // that a name stopped.
    R"(
ALTER TABLE scores RENAME TO former_scores;
CREATE TABLE scores (pair INTEGER NOT NULL REFERENCES pairs, criterion INTEGER NOT NULL, given_at INTEGER NOT NULL,
  points REAL CHECK (points >= 0), PRIMARY KEY (pair, criterion, given_at)) WITHOUT ROWID;
INSERT INTO scores SELECT pair, criterion, given_at, points FROM former_scores;
DROP TABLE former_scores;
ALTER TABLE oral_scores RENAME TO former_scores;
CREATE TABLE oral_scores (assignment INTEGER NOT NULL REFERENCES assignments,
  group_id INTEGER NOT NULL REFERENCES groups, criterion INTEGER NOT NULL, given_at INTEGER NOT NULL,
  points REAL CHECK (points >= 0), PRIMARY KEY (assignment, group_id, criterion, given_at)) WITHOUT ROWID;
INSERT INTO oral_scores SELECT assignment, group_id, criterion, given_at, points FROM former_scores;
DROP TABLE former_scores;
ALTER TABLE instructor_scores RENAME TO former_scores;
CREATE TABLE instructor_scores (assignment INTEGER NOT NULL REFERENCES assignments,
  group_id INTEGER NOT NULL REFERENCES groups, stage TEXT NOT NULL CHECK (stage IN ('first', 'final')),
  criterion INTEGER NOT NULL, given_at INTEGER NOT NULL, points REAL CHECK (points >= 0),
  PRIMARY KEY (assignment, group_id, stage, criterion, given_at)) WITHOUT ROWID;
INSERT INTO instructor_scores SELECT assignment, group_id, stage, criterion, given_at, points FROM former_scores;
DROP TABLE former_scores;
CREATE TABLE stops (pair INTEGER NOT NULL REFERENCES pairs,
  way TEXT NOT NULL CHECK (way IN ('to reviewer', 'to author')), version INTEGER NOT NULL REFERENCES versions,
  made_at INTEGER NOT NULL, PRIMARY KEY (pair, way, version)) WITHOUT ROWID;
CREATE TABLE new_assignments (id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE COLLATE NOCASE,
  kind TEXT NOT NULL CHECK (kind IN ('lab', 'report', 'talk')), lesson TEXT NOT NULL, first_due INTEGER NOT NULL,
  review_due INTEGER, final_due INTEGER, grace INTEGER NOT NULL CHECK (grace >= 0),
  reviews INTEGER NOT NULL CHECK (reviews >= 0), made_at INTEGER NOT NULL, costs TEXT NOT NULL DEFAULT '',
  final_weight REAL NOT NULL DEFAULT 50, weight REAL NOT NULL DEFAULT 1 CHECK (weight >= 0),
  reviews_weight REAL NOT NULL DEFAULT 20 CHECK (reviews_weight BETWEEN 0 AND 100), checks TEXT NOT NULL DEFAULT '',
  secret TEXT NOT NULL DEFAULT '', keep TEXT NOT NULL DEFAULT 'best' CHECK (keep IN ('best', 'newest')));
INSERT INTO new_assignments (id, name, kind, lesson, first_due, review_due, final_due, grace, reviews, made_at, costs,
  final_weight) SELECT id, name, replace(kind, 'presentation', 'talk'), lesson, first_due, review_due, final_due, grace,
  reviews, made_at, costs, final_weight FROM assignments;
DROP TABLE assignments;
ALTER TABLE new_assignments RENAME TO assignments;
ALTER TABLE students ADD COLUMN language TEXT NOT NULL DEFAULT '';
ALTER TABLE students ADD COLUMN own_data INTEGER;
CREATE TABLE results (id INTEGER PRIMARY KEY, version INTEGER NOT NULL REFERENCES versions, possible REAL NOT NULL,
  checks TEXT NOT NULL, fingerprint TEXT NOT NULL, made_at INTEGER NOT NULL);
CREATE INDEX results_of_version ON results (version);
CREATE TABLE marks (id INTEGER PRIMARY KEY, assignment INTEGER NOT NULL REFERENCES assignments,
  group_id INTEGER NOT NULL REFERENCES groups, student TEXT REFERENCES students, item TEXT NOT NULL,
  points REAL CHECK (points >= 0), reason TEXT NOT NULL, made_at INTEGER NOT NULL,
  version INTEGER REFERENCES versions);
CREATE INDEX marks_of_group ON marks (assignment, group_id);
CREATE TABLE refusals (id INTEGER PRIMARY KEY, assignment INTEGER NOT NULL REFERENCES assignments,
  group_id INTEGER REFERENCES groups, stage TEXT NOT NULL, name TEXT NOT NULL, hash TEXT REFERENCES files,
  reason TEXT NOT NULL, received_at INTEGER NOT NULL);
)",
    // One store of marks: of a check, of a criterion, or of the whole submission (item *), by the instructor or, with a
    // pair, by a reviewer; null points withdraw a mark. Reports and talks have the additional items `reviews` and
    // `comment`, which has only a text. A file that was not accepted, or whose sender is unknown, is a version of the
    // part `unreadable`: every file leaves a trace.
    R"(
CREATE TABLE new_marks (id INTEGER PRIMARY KEY, assignment INTEGER NOT NULL REFERENCES assignments,
  group_id INTEGER NOT NULL REFERENCES groups, student TEXT REFERENCES students,
  stage TEXT NOT NULL DEFAULT 'first' CHECK (stage IN ('first', 'final')), pair INTEGER REFERENCES pairs,
  version INTEGER REFERENCES versions, item TEXT NOT NULL, points REAL CHECK (points >= 0), reason TEXT NOT NULL,
  made_at INTEGER NOT NULL);
INSERT INTO new_marks (id, assignment, group_id, student, version, item, points, reason, made_at)
  SELECT m.id, m.assignment, m.group_id, m.student, m.version,
  CASE WHEN a.kind <> 'lab' AND m.item = 'work' THEN '*' ELSE m.item END, m.points, m.reason, m.made_at
  FROM marks m JOIN assignments a ON a.id = m.assignment;
INSERT INTO new_marks (assignment, group_id, item, points, reason, made_at)
  SELECT assignment, group_id, replace(what, 'work', '*'), percent, reason, made_at FROM overrides ORDER BY id;
INSERT INTO new_marks (assignment, group_id, pair, version, item, points, reason, made_at)
  SELECT p.assignment, p.author, s.pair, (SELECT w.id FROM versions w WHERE w.pair = s.pair AND w.part IN ('review',
  'pack') AND w.received_at <= s.given_at AND NOT ifnull((SELECT x.withdrawn FROM withdrawals x WHERE x.version = w.id
  AND x.made_at < s.given_at ORDER BY x.id DESC LIMIT 1), 0) ORDER BY w.part = 'review' DESC, w.number DESC LIMIT 1),
  c.name, s.points, '', s.given_at FROM scores s JOIN pairs p ON p.id = s.pair
  JOIN criteria c ON c.assignment = p.assignment AND c.place = s.criterion ORDER BY s.given_at;
INSERT INTO new_marks (assignment, group_id, stage, item, points, reason, made_at)
  SELECT s.assignment, s.group_id, s.stage, c.name, s.points, '', s.given_at FROM instructor_scores s
  JOIN criteria c ON c.assignment = s.assignment AND c.place = s.criterion ORDER BY s.given_at;
INSERT INTO new_marks (assignment, group_id, item, points, reason, made_at)
  SELECT s.assignment, s.group_id, c.name, s.points, '', s.given_at FROM oral_scores s
  JOIN criteria c ON c.assignment = s.assignment AND c.place = s.criterion ORDER BY s.given_at;
INSERT INTO new_marks (assignment, group_id, student, item, points, reason, made_at)
  SELECT s.assignment, (SELECT m.group_id FROM memberships m WHERE m.student = s.student ORDER BY m.until IS NOT NULL,
  m.since LIMIT 1), s.student, c.name, s.points, '', s.given_at FROM student_scores s
  JOIN criteria c ON c.assignment = s.assignment AND c.place = s.criterion ORDER BY s.given_at;
INSERT INTO new_marks (assignment, group_id, student, item, points, reason, made_at)
  SELECT assignment, group_id, student, 'comment', NULL, comment, made_at FROM oral_comments ORDER BY id;
DROP TABLE marks;
ALTER TABLE new_marks RENAME TO marks;
CREATE INDEX marks_of_group ON marks (assignment, group_id);
DROP TABLE overrides;
DROP TABLE scores;
DROP TABLE instructor_scores;
DROP TABLE oral_scores;
DROP TABLE student_scores;
DROP TABLE oral_comments;
DROP TABLE refusals;
CREATE TABLE new_versions (id INTEGER PRIMARY KEY, assignment INTEGER NOT NULL REFERENCES assignments,
  group_id INTEGER REFERENCES groups, stage TEXT NOT NULL CHECK (stage IN ('first', 'review', 'final')),
  pair INTEGER REFERENCES pairs, part TEXT NOT NULL, number INTEGER NOT NULL CHECK (number > 0),
  hash TEXT NOT NULL REFERENCES files, name TEXT NOT NULL, received_at INTEGER NOT NULL, due_at INTEGER NOT NULL,
  late INTEGER NOT NULL CHECK (late >= 0), findings TEXT NOT NULL, signature TEXT NOT NULL,
  CHECK (part = 'unreadable' OR (group_id IS NOT NULL AND (stage = 'review') = (pair IS NOT NULL))));
INSERT INTO new_versions SELECT * FROM versions;
DROP TABLE versions;
ALTER TABLE new_versions RENAME TO versions;
CREATE UNIQUE INDEX versions_once ON versions (assignment, group_id, stage, ifnull(pair, 0), part, number);
CREATE INDEX versions_of_pair ON versions (pair);
CREATE INDEX versions_of_hash ON versions (hash);
)"};

/// Versions with time and deadline as corrected; and those that are not withdrawn, with their lateness: a version with
/// the content of an earlier one is as late as that one.
constexpr char kViews[] = R"(
CREATE VIEW arrived AS SELECT v.id, v.assignment, v.group_id, v.stage, v.pair, v.part, v.number, v.hash, v.name,
  v.findings, a.grace,
  ifnull((SELECT c.received_at FROM arrivals c WHERE c.version = v.id ORDER BY c.id DESC LIMIT 1), v.received_at)
    AS received_at,
  ifnull((SELECT e.due_at FROM extensions e WHERE e.assignment = v.assignment AND e.group_id = v.group_id AND
    e.stage = v.stage ORDER BY e.id DESC LIMIT 1),
    CASE v.stage WHEN 'first' THEN a.first_due WHEN 'review' THEN a.review_due ELSE a.final_due END) AS due_at,
  ifnull((SELECT w.withdrawn FROM withdrawals w WHERE w.version = v.id ORDER BY w.id DESC LIMIT 1), 0) AS withdrawn
  FROM versions v JOIN assignments a ON a.id = v.assignment;
CREATE VIEW standing AS SELECT *,
  CASE WHEN first_at > due_at + grace THEN first_at - due_at ELSE 0 END AS late
  FROM (SELECT w.*, (SELECT min(e.received_at) FROM arrived e WHERE e.hash = w.hash AND e.number <= w.number AND
    NOT e.withdrawn AND e.assignment = w.assignment AND e.group_id IS w.group_id AND e.stage = w.stage AND
    ifnull(e.pair, 0) = ifnull(w.pair, 0) AND e.part = w.part) AS first_at
    FROM arrived w WHERE NOT w.withdrawn);
)";

std::int64_t pragma(Database& database, const char* name) {
    Rows rows = database.query(fmt::format("PRAGMA {}", name));
    rows.next();
    return rows.integer(0);
}

}  // namespace

const std::vector<std::string>& course_tables() {
    static const std::vector<std::string> tables = {
        "course",      "groups", "students",    "memberships", "assignments", "criteria",     "files",    "pseudonyms",
        "allocations", "pairs",  "versions",    "sendings",    "journal",     "former_names", "arrivals", "extensions",
        "withdrawals", "holds",  "pair_wishes", "returns",     "results",     "marks",        "stops",    "seals"};
    return tables;
}

const std::vector<const char*>& course_steps() {
    return kSteps;
}

void keep_before_migration(Database& database, const std::filesystem::path& file) {
    namespace fs = std::filesystem;
    const std::int64_t version = pragma(database, "user_version");
    const auto newest = static_cast<std::int64_t>(kSteps.size());
    if (pragma(database, "application_id") != kApplicationId || version >= newest) return;
    const fs::path kept = fmt::format("{}.before-version-{}", file.string(), newest);
    if (fs::exists(kept)) return;
    // Of two programs that open the course at once each copies it for itself.
    const fs::path copy = fmt::format("{}.{}.unfinished", kept.string(), ::getpid());
    fs::remove(copy);
    database.run("VACUUM INTO ?", copy.string());
    fs::permissions(copy, fs::perms::owner_read | fs::perms::owner_write);
    fs::rename(copy, kept);
}

bool migrate_course(Database& database, Database::Opening opening, const std::string& file,
                    const std::vector<const char*>& steps) {
    const auto newest = static_cast<std::int64_t>(steps.size());
    const auto version_of = [&] {
        const std::int64_t version = pragma(database, "user_version"), id = pragma(database, "application_id");
        const bool fresh = opening == Database::Opening::kNew && version == 0;
        if (!fresh && id != kApplicationId)
            throw EnvironmentError(
                "{}: the file is not the database of a course; create a course with dynlab course init", file);
        if (version > newest)
            throw EnvironmentError(
                "{}: a newer version of dynlab created this course (its tables have version {}, but this program "
                "supports version {}); install the newer version",
                file, version, newest);
        return version;
    };
    const std::int64_t before = version_of();
    if (before == newest) return false;
    if (opening == Database::Opening::kNew) database.execute("PRAGMA journal_mode = WAL");
    // A table that others reference can only be rebuilt while foreign keys are not enforced.
    database.execute("PRAGMA foreign_keys = OFF");
    Transaction transaction(database);
    database.execute("DROP VIEW IF EXISTS standing; DROP VIEW IF EXISTS arrived");
    for (std::int64_t version = version_of(); version < newest; ++version)  // another may have done it meanwhile
        database.execute(steps[static_cast<std::size_t>(version)]);
    database.execute(kViews);
    if (database.query("PRAGMA foreign_key_check").next())
        throw EnvironmentError("{}: a row refers to a missing row. Nothing was changed. Restore a backup", file);
    database.execute(fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}", kApplicationId, newest));
    transaction.commit();
    database.execute("PRAGMA foreign_keys = ON");
    return true;
}

}  // namespace dynlab::inline course
