// Loaded before the C library (LD_PRELOAD), to test what a program leaves behind when the machine fails. The library
// counts the calls that change files or folders, but not pipes and terminals. It does not count fsync: a kill before
// fsync leaves the same behind as a kill before the next change. FAULT names the fault and the call:
//
//   kill 7    the process is killed before the seventh call
//   full 7    the disk is full from the seventh call on
//
// On a normal exit, the library writes the count to the file that FAULT_COUNT names. It leaves child programs alone.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

struct Fault {
    bool kills = false, fills = false;
    int at = 0, count = 0;
    std::string file;
    Fault() {
        const char *const text = std::getenv("FAULT"), *const place = std::getenv("FAULT_COUNT");
        char word[8] = {};
        if (text && std::sscanf(text, "%7s %d", word, &at) == 2) kills = word[0] == 'k', fills = word[0] == 'f';
        if (place) file = place;
        for (const char* name : {"FAULT", "FAULT_COUNT", "LD_PRELOAD"}) unsetenv(name);
    }
    ~Fault() {
        if (std::FILE* out = file.empty() ? nullptr : std::fopen(file.c_str(), "w")) {
            const int counted = count;
            std::fprintf(out, "%d\n", counted);
            std::fclose(out);
        }
    }
};
Fault fault;

bool changes_file(int descriptor) {
    struct stat status {};
    return fstat(descriptor, &status) == 0 && (S_ISREG(status.st_mode) || S_ISDIR(status.st_mode));
}

/// Whether the disk is full now.
bool step() {
    ++fault.count;
    if (fault.kills && fault.count == fault.at) std::raise(SIGKILL);
    return fault.fills && fault.count >= fault.at;
}

template <class Call>
Call* real(const char* name) {
    return reinterpret_cast<Call*>(dlsym(RTLD_NEXT, name));
}

template <class Result>
Result full() {
    errno = ENOSPC;
    return -1;
}

}  // namespace

extern "C" {

ssize_t write(int fd, const void* data, size_t size) {
    static auto* const call = real<ssize_t(int, const void*, size_t)>("write");
    if (changes_file(fd) && step()) return full<ssize_t>();
    return call(fd, data, size);
}
ssize_t pwrite64(int fd, const void* data, size_t size, off64_t at) {
    static auto* const call = real<ssize_t(int, const void*, size_t, off64_t)>("pwrite64");
    if (step()) return full<ssize_t>();
    return call(fd, data, size, at);
}
ssize_t pwrite(int fd, const void* data, size_t size, off_t at) {
    return pwrite64(fd, data, size, at);
}
int ftruncate64(int fd, off64_t size) {
    static auto* const call = real<int(int, off64_t)>("ftruncate64");
    if (step()) return full<int>();
    return call(fd, size);
}
int ftruncate(int fd, off_t size) {
    return ftruncate64(fd, size);
}
int rename(const char* from, const char* to) noexcept {
    static auto* const call = real<int(const char*, const char*)>("rename");
    step();
    return call(from, to);
}
int unlink(const char* file) noexcept {
    static auto* const call = real<int(const char*)>("unlink");
    step();
    return call(file);
}
int mkdir(const char* folder, mode_t mode) noexcept {
    static auto* const call = real<int(const char*, mode_t)>("mkdir");
    if (step()) return full<int>();
    return call(folder, mode);
}
}
