#include "workflow/shares/spool.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>

#include "data_io/values/cbor_values.h"
#include "data_io/values/json_values.h"
#include "data_io/values/message_values.h"
#include "platform/error.h"
#include "platform/files/plain_file.h"
#include "platform/files/replacement_file.h"
#include "platform/files/temporary_file.h"
#include "platform/keys/secure_random.h"
#include "platform/signature.h"
#include "platform/system_call.h"

namespace dynlab::inline workflow {

/// What lies in a spool, as data_io/values/described.h stores it.
DYNLAB_DESCRIBE(SpoolIdentity, id, purpose, program, isolation, lease_ms, grace_ms)
DYNLAB_DESCRIBE(ShareJob, kind, common, title, bytes)
DYNLAB_DESCRIBE(ShareResult, worker, node, signature, bytes, trouble)
DYNLAB_DESCRIBE(WorkerStatus, node, isolation, hands, beat, done, trouble, refused, ended)
DYNLAB_DESCRIBE(CoordinatorStatus, beat, wanted, done, given_up, lost, blamed)

namespace {

namespace fs = std::filesystem;

constexpr char kNoticeFile[] = "spool.json";
constexpr std::uintmax_t kMostOfAFile = std::uintmax_t{2} << 30, kMostOfANotice = 1 << 16;
constexpr const char* kSpoolFolders[] = {"jobs",    "suspects", "leases", "done",    "failed", "results",
                                         "refused", "common",   "logs",   "workers", "keys"};
constexpr const char* kSpoolFiles[] = {"spool.json", "identity", "stop", "slurm"};

/// What stands in a spool for anybody to read.
struct SpoolNotice {
    std::string purpose, key;
};
DYNLAB_DESCRIBE(SpoolNotice, purpose, key)

std::optional<SpoolNotice> notice_of(const fs::path& folder) {
    if (!fs::exists(fs::symlink_status(folder / kNoticeFile))) return {};
    try {
        return from_json<SpoolNotice>(read_plain_file(folder / kNoticeFile, kMostOfANotice).value_or(""));
    } catch (const ValueError&) {
        throw EnvironmentError(
            "{} is spoilt; remove {} and begin again: what was finished stays in the folder of results",
            (folder / kNoticeFile).string(), folder.string());
    }
}

std::vector<std::string> names_in(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code gone;
    for (fs::directory_iterator entry(folder, gone), end; !gone && entry != end; entry.increment(gone))
        if (const std::string name = entry->path().filename(); !name.starts_with(".")) names.push_back(name);
    return names;
}

/// Nothing for names that are none of ours.
std::optional<JobFile> job_file_of(const std::string& name) {
    const std::size_t dot = name.find('.');
    if (dot == 0 || dot == std::string::npos) return {};
    const std::string digits = name.substr(dot + 1);
    if (digits.empty() || digits.size() > 4 || digits.find_first_not_of("0123456789") != std::string::npos) return {};
    return JobFile{name.substr(0, dot), std::stoi(digits)};
}

std::optional<Spool::Lease> lease_of(const std::string& name) {
    const std::size_t at = name.find('@');
    if (at == std::string::npos) return {};
    const auto job = job_file_of(name.substr(0, at));
    return job ? std::optional(Spool::Lease{*job, name.substr(at + 1)}) : std::nullopt;
}

template <class T>
std::optional<T> value_of(const std::optional<std::string>& bytes) {
    try {
        if (bytes) return from_cbor<T>(*bytes);
    } catch (const ValueError&) {  // of another version
    }
    return {};
}

[[noreturn]] void refuse_spool_of(const fs::path& folder, const std::string& purpose, const std::string& ours) {
    throw EnvironmentError(
        "the spool {} belongs to other work (\"{}\", not \"{}\"); give this one a folder of its own with --spool "
        "FOLDER, "
        "or end the other first",
        folder.string(), purpose, ours);
}

/// In a stranger's folder jobs and keys would be taken that the stranger put there, and links be followed out of it.
void refuse_places_of_others(const fs::path& folder) {
    struct stat status {};
    if (::stat(folder.c_str(), &status) != 0 || !S_ISDIR(status.st_mode)) return;
    if (status.st_uid != ::geteuid())
        throw EnvironmentError("the spool {} belongs to another user; name a folder of yours with --spool",
                               folder.string());
    for (const char* name : kSpoolFolders) {
        const fs::path inner = folder / name;
        if (::lstat(inner.c_str(), &status) != 0) continue;
        if (!S_ISDIR(status.st_mode) || status.st_uid != ::geteuid())
            throw EnvironmentError(
                "{} is no folder that this spool made; somebody else writes there: name a folder that is yours alone "
                "with --spool",
                inner.string());
    }
}

/// Whether the folder holds what spools hold and nothing else: the process that made or removed one was killed.
bool is_abandoned_spool(const fs::path& folder) {
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename();
        const bool own = entry.is_directory() ? std::ranges::count(kSpoolFolders, name) > 0
                                              : std::ranges::count(kSpoolFiles, name) > 0;
        if (!own || entry.is_symlink()) return false;
    }
    return true;
}

/// Logs are what programs said; and a folder that others may write into is no place to work.
void refuse_open_folder(const fs::path& folder) {
    struct stat status {};
    if (::stat(folder.c_str(), &status) == 0 && (status.st_mode & 077) != 0)
        throw EnvironmentError(
            "others may look into the spool {}; `chmod 700 {}`, or, where its file system keeps no such permissions, "
            "name a folder on another one with --spool",
            folder.string(), folder.string());
}

std::string log_name(const JobFile& job) {
    return job.text() + ".txt";
}

}  // namespace

std::string JobFile::text() const {
    return fmt::format("{}.{}", key, losses);
}

std::string Spool::Lease::text() const {
    return job.text() + "@" + worker;
}

void Spool::make_folders() const {
    std::error_code error;
    fs::create_directories(folder_.parent_path(), error);
    if (::mkdir(folder_.c_str(), 0700) != 0 && errno != EEXIST) fail_to_write(folder_ / kNoticeFile, errno);
    if (::chmod(folder_.c_str(), 0700) != 0)
        throw EnvironmentError("the spool {} cannot be made yours alone: {}", folder_.string(), system_reason(errno));
    refuse_open_folder(folder_);
    for (const char* name : kSpoolFolders)
        if (::mkdir((folder_ / name).c_str(), 0700) != 0 && errno != EEXIST) fail_to_write(folder_ / name, errno);
}

Spool Spool::begin(const fs::path& folder, const fs::path& key_file, SpoolIdentity identity) {
    const fs::path place = fs::absolute(folder).lexically_normal();
    const fs::path key = fs::absolute(key_file).lexically_normal();
    refuse_places_of_others(place);
    remove_leftover_files(place);
    for (const char* name : kSpoolFolders) remove_leftover_files(place / name);
    const auto notice = notice_of(place);
    if (notice && (notice->purpose != identity.purpose || notice->key != key))
        refuse_spool_of(place, notice->purpose, identity.purpose);
    if (!notice && fs::is_directory(place) && !is_abandoned_spool(place))
        throw EnvironmentError(
            "{} holds other things than a spool; name an empty folder, or one that is not there yet, with --spool",
            place.string());
    if (notice && fs::exists(key)) {
        Spool spool(place, SessionKey::in_file(key));
        spool.key_file_ = key;
        const auto before = value_of<SpoolIdentity>(spool.read_sealed(place / "identity", "identity"));
        if (before && before->program == identity.program) {
            spool.identity_ = *before;
            spool.make_folders();
            return spool;
        }
    }
    fs::remove_all(place);  // of another program, or its key is gone: nobody can read it any more
    Spool spool(place, SessionKey::fresh());
    spool.key_file_ = key;
    spool.make_folders();
    spool.key_.save(key);
    identity.id = spool.key_.name_of(secure_bytes(32));
    spool.identity_ = identity;
    spool.write_sealed(place / "identity", "identity", cbor_of(identity));
    write_plain_file(place / kNoticeFile, json_of(SpoolNotice{identity.purpose, key}, 2) + "\n");
    return spool;
}

Spool Spool::open(const fs::path& folder) {
    const fs::path place = fs::absolute(folder).lexically_normal();
    refuse_places_of_others(place);
    const auto notice = notice_of(place);
    if (notice) refuse_open_folder(place);
    if (!notice)
        throw EnvironmentError(
            "there is no spool {} here; `dynlab grade --on` makes one, and this machine must see it under the same "
            "name",
            place.string());
    Spool spool(place, SessionKey::in_file(notice->key));
    spool.key_file_ = notice->key;
    const auto identity = value_of<SpoolIdentity>(spool.read_sealed(place / "identity", "identity"));
    if (!identity) throw EnvironmentError("the key {} does not belong to the spool {}", notice->key, place.string());
    spool.identity_ = *identity;
    return spool;
}

bool Spool::exists() const {
    return fs::exists(folder_ / kNoticeFile);
}

void Spool::remove() {
    std::error_code ignored;
    fs::remove(folder_ / kNoticeFile, ignored);
    fs::remove_all(folder_, ignored);
    fs::remove(key_file_, ignored);
}

bool Spool::stopped() const {
    return fs::exists(folder_ / "stop") || !exists();
}

void Spool::stop() const {
    (void)open_plain_file(folder_ / "stop");
}

void Spool::unstop() const {
    ::unlink((folder_ / "stop").c_str());
}

bool Spool::move(const fs::path& from, const fs::path& to) const {
    return ::rename((folder_ / from).c_str(), (folder_ / to).c_str()) == 0;
}

std::optional<std::string> Spool::read_sealed(const fs::path& file, const std::string& place) const {
    const auto sealed = read_plain_file(file, kMostOfAFile);
    return sealed ? key_.open(*sealed, place) : std::nullopt;
}

void Spool::write_sealed(const fs::path& file, const std::string& place, const std::string& bytes) const {
    const std::string sealed = key_.seal(bytes, place);
    if (sealed.size() > kMostOfAFile)
        throw EnvironmentError("{} MB at once are too many for a spool, which takes {} MB", sealed.size() >> 20,
                               kMostOfAFile >> 20);
    write_plain_file(file, sealed);
}

/// In place, without waiting for the disk: what a full disk still takes. Who reads a half of it does not open it.
void Spool::overwrite_sealed(const fs::path& file, const std::string& place, std::string bytes) const {
    const std::string sealed = key_.seal(bytes, place);
    const FileDescriptor opened = open_plain_file(file);
    if (!opened) return;
    if (::pwrite(opened.get(), sealed.data(), sealed.size(), 0) == static_cast<ssize_t>(sealed.size()))
        (void)!::ftruncate(opened.get(), static_cast<off_t>(sealed.size()));
}

std::string Spool::key_of(const ShareJob& job) const {
    return key_.name_of(cbor_of(job));
}

void Spool::put(const std::string& key, const ShareJob& job, int losses) const {
    write_sealed(folder_ / "jobs" / JobFile{key, losses}.text(), "job " + key, cbor_of(job));
}

std::string Spool::put_common(const std::string& bytes) const {
    const std::string name = key_.name_of(bytes);
    if (!common(name)) write_sealed(folder_ / "common" / name, "common " + name, bytes);
    return name;
}

std::optional<std::string> Spool::common(const std::string& name) const {
    return read_sealed(folder_ / "common" / name, "common " + name);
}

std::map<std::string, int> Spool::listed(const char* folder) const {
    std::map<std::string, int> jobs;
    for (const std::string& name : names_in(folder_ / folder)) {
        const auto job = job_file_of(name.substr(0, name.find('@')));
        if (job) jobs[job->key] = std::max(jobs[job->key], job->losses);
    }
    return jobs;
}

std::set<std::string> Spool::results() const {
    const std::vector<std::string> names = names_in(folder_ / "results");
    return {names.begin(), names.end()};
}

std::string Spool::signed_text(const std::string& key, const ShareResult& result) const {
    std::string text = "dynlab share";
    const std::string trouble = result.trouble ? cbor_of(*result.trouble) : "";
    for (const std::string& part : {identity_.id, key, result.worker, result.node, result.bytes, trouble})
        text += fmt::format("\n{}:", part.size()) + part;
    return text + (result.trouble ? "!" : "");
}

std::optional<ShareResult> Spool::result(const std::string& key) const {
    auto result = value_of<ShareResult>(read_sealed(folder_ / "results" / key, "result " + key));
    if (!result) return {};
    if (result->worker.find('/') != std::string::npos) return {};
    const auto public_key = read_sealed(folder_ / "keys" / result->worker, "key " + result->worker);
    if (!public_key || !is_signature(result->signature, signed_text(key, *result), *public_key)) return {};
    return result;
}

void Spool::refuse_result(const std::string& key) const {
    move("results/" + key, "refused/" + key);
    for (const auto& [done, losses] : listed("done"))
        if (done == key) move("done/" + JobFile{key, losses}.text(), "jobs/" + JobFile{key, losses}.text());
}

void Spool::accept_result(const std::string& key) const {
    for (const char* folder : {"done", "jobs", "suspects"})
        for (const std::string& name : names_in(folder_ / folder))
            if (name.starts_with(key + ".")) ::unlink((folder_ / folder / name).c_str());
}

void Spool::forget(const std::string& key) const {
    ::unlink((folder_ / "results" / key).c_str());
}

void Spool::give_up(const JobFile& job) const {
    move("suspects/" + job.text(), "failed/" + job.text());
}

void Spool::clear_of_suspicion(const JobFile& job) const {
    move("suspects/" + job.text(), "jobs/" + job.text());
}

void Spool::retry_failed() const {
    for (const auto& [key, losses] : listed("failed"))
        move("failed/" + JobFile{key, losses}.text(), "jobs/" + JobFile{key, 0}.text());
}

std::optional<Spool::Claimed> Spool::claim(const std::string& worker) const {
    std::vector<JobFile> jobs;
    for (const std::string& name : names_in(folder_ / "jobs"))
        if (const auto job = job_file_of(name)) jobs.push_back(*job);
    // In any order, so that workers do not run after the same one; those that lost a worker when nothing else is left.
    shuffle_items(jobs, secure_below);
    std::stable_sort(jobs.begin(), jobs.end(), [](const JobFile& a, const JobFile& b) { return a.losses < b.losses; });
    for (const JobFile& job : jobs) {
        const Lease lease{job, worker};
        if (fs::exists(folder_ / "results" / job.key)) continue;  // the coordinator will look at it
        // A network file system may say that it failed when it was done.
        if (!move("jobs/" + job.text(), "leases/" + lease.text()) && !fs::exists(folder_ / "leases" / lease.text()))
            continue;
        if (auto known = value_of<ShareJob>(read_sealed(folder_ / "leases" / lease.text(), "job " + job.key)))
            return Claimed{lease, *std::move(known)};
        move("leases/" + lease.text(), "refused/" + job.text());  // nobody of this session wrote it
    }
    return {};
}

void Spool::finish(const Lease& lease, const ShareResult& result) const {
    const std::string& key = lease.job.key;
    write_sealed(folder_ / "results" / key, "result " + key, cbor_of(result));
    move("leases/" + lease.text(), "done/" + lease.job.text());
}

void Spool::give_back(const Lease& lease) const {
    move("leases/" + lease.text(), "jobs/" + lease.job.text());
}

void Spool::lose(const Lease& lease) const {
    const JobFile next{lease.job.key, lease.job.losses + 1};
    move("leases/" + lease.text(), (next.losses < kTries ? "jobs/" : "suspects/") + next.text());
}

std::vector<Spool::Lease> Spool::leases() const {
    std::vector<Lease> leases;
    for (const std::string& name : names_in(folder_ / "leases"))
        if (auto lease = lease_of(name)) leases.push_back(*std::move(lease));
    return leases;
}

FileDescriptor Spool::log_of(const JobFile& job) const {
    return open_plain_file(folder_ / "logs" / log_name(job), O_APPEND);
}

std::string Spool::logged(const JobFile& job, std::size_t most) const {
    return start_of_plain_file(folder_ / "logs" / log_name(job), most);
}

void Spool::drop_empty_log(const JobFile& job) const {
    std::error_code ignored;
    const fs::path file = folder_ / "logs" / log_name(job);
    if (fs::file_size(file, ignored) == 0 && !ignored) fs::remove(file, ignored);
}

void Spool::note(const std::string& name, const std::string& bytes) const {
    write_sealed(folder_ / name, "note " + name, bytes);
}

std::optional<std::string> Spool::noted(const std::string& name) const {
    return read_sealed(folder_ / name, "note " + name);
}

void Spool::admit(const std::string& worker, const std::string& public_key) const {
    write_sealed(folder_ / "keys" / worker, "key " + worker, public_key);
}

void Spool::tell(const std::string& worker, const WorkerStatus& status) const {
    overwrite_sealed(folder_ / "workers" / worker, "worker " + worker, cbor_of(status));
}

std::optional<WorkerStatus> Spool::worker(const std::string& id) const {
    if (id.find('/') != std::string::npos) return {};
    return value_of<WorkerStatus>(read_sealed(folder_ / "workers" / id, "worker " + id));
}

std::map<std::string, WorkerStatus> Spool::workers() const {
    std::map<std::string, WorkerStatus> all;
    for (const std::string& name : names_in(folder_ / "workers"))
        if (auto status = worker(name)) all[name] = *std::move(status);
    return all;
}

void Spool::tell(const CoordinatorStatus& status) const {
    overwrite_sealed(folder_ / "coordinator", "coordinator", cbor_of(status));
}

std::optional<CoordinatorStatus> Spool::coordinator() const {
    return value_of<CoordinatorStatus>(read_sealed(folder_ / "coordinator", "coordinator"));
}

}  // namespace dynlab::inline workflow
