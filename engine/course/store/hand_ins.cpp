#include "course/store/hand_ins.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>

#include "course/store/inspection.h"
#include "course/store/receipts.h"
#include "course/store/review_pairs.h"
#include "course/store/senders.h"
#include "course/store/side_by_side.h"
#include "numerics/error.h"
#include "platform/atomic_file.h"
#include "platform/content_hash.h"
#include "platform/error.h"

namespace dynlab {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostBytes = 200u << 20;
constexpr std::size_t kStart = 1024;

Instant due_of(const Assignment& assignment, const std::string& stage) {
    if (stage == "first") return assignment.first_due;
    const auto& due = stage == "review" ? assignment.review_due : assignment.final_due;
    if (!due)
        throw InvalidArgument(fmt::format("{} is a presentation: it has no {}", assignment.name,
                                          stage == "review" ? "reviews" : "final version"));
    return *due;
}

/// Under which name a file is kept: report, slides, script, review or pack.
std::string part_of(const Assignment& assignment, const std::string& stage, const std::string& kind) {
    if (kind != "pdf") return kind;
    if (stage == "review") return "review";
    return assignment.is_report() ? "report" : "slides";
}

/// As much as its kind can be told from: all of a script.
std::string start_of(const IncomingFile& file) {
    if (file.name.ends_with(".lua")) return read_file(file.file);
    std::string start(kStart, '\0');
    std::ifstream in(file.file, std::ios::binary);
    in.read(start.data(), static_cast<std::streamsize>(kStart));
    if (in.bad() || !in.is_open()) throw EnvironmentError("the file cannot be read");
    start.resize(static_cast<std::size_t>(in.gcount()));
    return start;
}

/// A file on its way into the store.
struct Candidate {
    const IncomingFile* file = nullptr;
    Group group;
    std::string part, hash;
    std::int64_t bytes = 0;
    std::optional<ReviewPair> pair;
    Inspection inspection;
};

class Receiving {
  public:
    Receiving(Course& course, const ReceiveRequest& request)
        : course_(course), request_(request), senders_(course), incoming_(way()) {
        outcome_.assignment = assignment_named(course, request.assignment);
        due_ = due_of(outcome_.assignment, request.stage);
        if (!request.from.empty()) from_ = group_named(course, request.from);
        if (request.stage == "review") pairs_ = review_pairs(course, outcome_.assignment);
    }

    ReceiveOutcome run() {
        for (const fs::path& file : request_.files) incoming_.add(file);
        outcome_.refused = incoming_.left_out();
        for (const IncomingFile& file : incoming_.files()) attempt(file, [&] { identify(file); });
        refuse_doubles();
        keep_all();
        write();
        outcome_.receipts = course_.folder() / "receipts" / outcome_.assignment.name;
        for (const Received& received : outcome_.received) write_receipt(course_, received.id);
        return std::move(outcome_);
    }

  private:
    Incoming::Way way() {
        return {request_.level, request_.program, !request_.from.empty(),
                [this](const Submission& submission) { return senders_.knows(submission); }};
    }

    template <class Work>
    void attempt(const IncomingFile& file, const Work& work) {
        try {
            work();
        } catch (const std::runtime_error& error) {
            if (!incoming_.batch()) throw EnvironmentError(fmt::format("{}: {}", file.source, error.what()));
            outcome_.refused.push_back(fmt::format("{}: {}", file.source, error.what()));
        }
    }

    void identify(const IncomingFile& file) {
        Candidate candidate;
        candidate.file = &file;
        const std::optional<Group> group = from_ ? from_ : senders_.find(file.sender);
        if (!group) throw EnvironmentError(senders_.complaint(file.sender));
        candidate.group = *group;
        candidate.bytes = static_cast<std::int64_t>(fs::file_size(file.file));
        if (candidate.bytes == 0) throw EnvironmentError("the file is empty");
        if (static_cast<std::uintmax_t>(candidate.bytes) > kMostBytes)
            throw EnvironmentError(fmt::format("the file has more than {} MB", kMostBytes >> 20));
        const std::string kind = kind_of_file(file.name, start_of(file));
        const bool script = kind == "script" && !outcome_.assignment.is_report();
        if (kind.empty() || (kind == "script" && !script))
            throw EnvironmentError(outcome_.assignment.is_report()
                                       ? "this is no PDF and no pack (.zip, .tar.gz); ask for one"
                                       : "this is no PDF, no script (.lua) and no pack (.zip, .tar.gz); ask for one");
        candidate.part = part_of(outcome_.assignment, request_.stage, kind);
        if (request_.stage == "review")
            candidate.pair = reviewed_pair(pairs_, *group, request_.of.empty() ? file.name : request_.of);
        candidates_.push_back(std::move(candidate));
    }

    /// Two files of a group for the same thing: nobody can say which holds.
    void refuse_doubles() {
        std::map<std::string, int> count;
        const auto key = [](const Candidate& c) {
            return fmt::format("{}/{}/{}", c.group.id, c.part, c.pair ? c.pair->id : 0);
        };
        for (const Candidate& c : candidates_) ++count[key(c)];
        std::vector<Candidate> single;
        for (Candidate& c : candidates_) {
            if (count[key(c)] == 1) {
                single.push_back(std::move(c));
                continue;
            }
            outcome_.refused.push_back(
                fmt::format("{}: {} gave several files that could be the {}; receive the one that holds alone",
                            c.file->source, c.group.name, c.part));
        }
        candidates_ = std::move(single);
    }

    void keep_all() {
        std::optional<Inspector> inspector;
        if (request_.checks) inspector.emplace(request_.stage == "review" ? everybody() : nullptr);
        const auto work = [&](std::size_t i) { keep(candidates_[i], inspector); };
        side_by_side(candidates_.size(), work, request_.progress);
        std::vector<std::string> hashes;
        for (const Candidate& candidate : candidates_) hashes.push_back(candidate.hash);
        course_.settle(hashes);
    }

    std::shared_ptr<const SoughtNames> everybody() const {
        return std::make_shared<const SoughtNames>(Roster(students_of(course_)));
    }

    void keep(Candidate& candidate, const std::optional<Inspector>& inspector) const {
        const std::string content = read_file(candidate.file->file);
        candidate.bytes = static_cast<std::int64_t>(content.size());
        candidate.hash = course_.keep(content);
        if (inspector && inspector->looks_at(candidate.part))
            candidate.inspection = inspector->inspect(course_.file(candidate.hash), candidate.part);
    }

    void write() {
        std::sort(candidates_.begin(), candidates_.end(),
                  [](const Candidate& a, const Candidate& b) { return a.group.name < b.group.name; });
        Transaction transaction(course_.database());
        int fresh = 0;
        for (const Candidate& candidate : candidates_) {
            outcome_.received.push_back(take(candidate));
            if (!outcome_.received.back().known) ++fresh;
        }
        if (fresh > 0)
            course_.note(fmt::format("{}: {} received, {}", outcome_.assignment.name, fresh, request_.stage),
                         request_.at);
        transaction.commit();
    }

    Received take(const Candidate& c) {
        Database& db = course_.database();
        std::optional<std::int64_t> pair;
        if (c.pair) pair = c.pair->id;
        Received received;
        received.group = c.group.name, received.part = c.part;
        received.rules_broken = c.inspection.rules_broken, received.trouble = c.inspection.trouble;
        received.names = c.inspection.names;
        if (c.pair) received.about = c.pair->report_pseudonym();
        Rows before = db.query(
            "SELECT id, number, hash, late FROM versions WHERE assignment = ? AND group_id = ? AND stage = ? AND "
            "ifnull(pair, 0) = ? AND part = ? ORDER BY number DESC LIMIT 1",
            outcome_.assignment.id, c.group.id, request_.stage, pair.value_or(0), c.part);
        const bool any = before.next();
        if (any && before.text(2) == c.hash) {
            received.known = true, received.id = before.integer(0), received.version = before.integer(1);
            received.late = before.integer(3);
            return received;
        }
        received.version = any ? before.integer(1) + 1 : 1;
        const Assignment& a = outcome_.assignment;
        received.late = request_.at > due_ + a.grace ? request_.at - due_ : 0;
        course_.record_file(c.hash, c.bytes, request_.at);
        const Receipt receipt{course_.name(), a.name,           c.group.name, request_.stage, c.part,      c.file->name,
                              c.hash,         received.version, c.bytes,      received.late,  request_.at, due_};
        db.run(
            "INSERT INTO versions (assignment, group_id, stage, pair, part, number, hash, name, received_at, due_at, "
            "late, findings, signature) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
            a.id, c.group.id, request_.stage, pair, c.part, received.version, c.hash, c.file->name, request_.at, due_,
            received.late, c.inspection.json, hmac_sha256(course_.key(), receipt_text(receipt)));
        received.id = db.last_id();
        return received;
    }

    Course& course_;
    const ReceiveRequest& request_;
    Senders senders_;
    Incoming incoming_;
    Instant due_ = 0;
    std::optional<Group> from_;
    std::vector<ReviewPair> pairs_;
    std::vector<Candidate> candidates_;
    ReceiveOutcome outcome_;
};

}  // namespace

std::string kind_of_file(const std::string& name, std::string_view content) {
    const auto begins = [&](std::string_view magic) { return content.substr(0, magic.size()) == magic; };
    if (content.substr(0, 1024).find("%PDF-") != std::string_view::npos) return "pdf";
    const bool archive = begins("PK\x03\x04") || begins("\x1F\x8B") ||
                         begins(std::string_view("\xFD"
                                                 "7zXZ\0",
                                                 6)) ||
                         begins("BZh") || content.substr(0, 262).ends_with("ustar");
    if (archive && archive_stem(name)) return "pack";
    if (name.ends_with(".lua") && content.find('\0') == std::string_view::npos) return "script";
    return {};
}

fs::path write_receipt(Course& course, std::int64_t version) {
    const Receipt receipt = receipt_of(course, version);
    const fs::path folder = course.folder() / "receipts" / receipt.assignment;
    fs::create_directories(folder);
    const fs::path file =
        folder / fmt::format("{:05}-{}-{}-{}.txt", version, receipt.group, receipt.stage, receipt.part);
    if (!fs::exists(file)) write_file_atomically(file, signed_receipt(receipt, course.key()));
    return file;
}

ReceiveOutcome receive(Course& course, const ReceiveRequest& request) {
    return Receiving(course, request).run();
}

}  // namespace dynlab
