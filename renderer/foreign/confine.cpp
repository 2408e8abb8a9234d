// Restrictions of a child process that parses foreign files.
#include <fcntl.h>
#include <linux/landlock.h>
#include <seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <initializer_list>

#include "renderer/foreign/sanitized.h"
#include "renderer/foreign/wire.h"

namespace si::foreign {
namespace {

/// Returns the bytes of address space that the process has now.
std::size_t address_space_bytes() {
    unsigned long pages = 0;
    if (std::FILE* file = std::fopen("/proc/self/statm", "re")) {
        if (std::fscanf(file, "%lu", &pages) != 1) pages = 0;
        std::fclose(file);
    }
    return std::size_t(pages) * std::size_t(::sysconf(_SC_PAGESIZE));
}

void limit(decltype(RLIMIT_AS) what, rlim_t soft, rlim_t hard) {
    const rlimit value{soft, hard};
    ::setrlimit(what, &value);
}

/// Leaves only the folder readable. A kernel without Landlock changes nothing.
void restrict_files(bool folder) {
    constexpr std::uint64_t kAll = (LANDLOCK_ACCESS_FS_MAKE_SYM << 1) - 1;  // version 1 of Landlock
    const landlock_ruleset_attr attributes{kAll};
    const int rules = int(::syscall(SYS_landlock_create_ruleset, &attributes, sizeof(attributes.handled_access_fs), 0));
    if (rules < 0) return;
    if (folder) {
        landlock_path_beneath_attr below{};
        below.allowed_access = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
        below.parent_fd = kFolder;
        ::syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &below, 0);
    }
    ::syscall(SYS_landlock_restrict_self, rules, 0);
    ::close(rules);
}

/// Installs the filter of system calls. Others than the listed ones fail with EPERM.
bool restrict_calls(bool folder) {
    const scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ERRNO(EPERM));
    if (!filter) return false;
    bool good = true;
    const auto allow = [&](int call, std::initializer_list<scmp_arg_cmp> conditions = {}) {
        good = good && seccomp_rule_add_array(filter, SCMP_ACT_ALLOW, call, unsigned(conditions.size()),
                                              conditions.begin()) == 0;
    };
    for (const int call : {SCMP_SYS(read),          SCMP_SYS(readv),          SCMP_SYS(pread64),
                           SCMP_SYS(write),         SCMP_SYS(writev),         SCMP_SYS(close),
                           SCMP_SYS(lseek),         SCMP_SYS(fstat),          SCMP_SYS(newfstatat),
                           SCMP_SYS(statx),         SCMP_SYS(munmap),         SCMP_SYS(madvise),
                           SCMP_SYS(brk),           SCMP_SYS(mremap),         SCMP_SYS(futex),
                           SCMP_SYS(rt_sigaction),  SCMP_SYS(rt_sigprocmask), SCMP_SYS(rt_sigreturn),
                           SCMP_SYS(sigaltstack),   SCMP_SYS(sched_yield),    SCMP_SYS(sched_getaffinity),
                           SCMP_SYS(clock_gettime), SCMP_SYS(gettimeofday),   SCMP_SYS(getrandom),
                           SCMP_SYS(getpid),        SCMP_SYS(gettid),         SCMP_SYS(restart_syscall),
                           SCMP_SYS(exit),          SCMP_SYS(exit_group)})
        allow(call);
    for (const int call : {SCMP_SYS(mmap), SCMP_SYS(mprotect)})
        allow(call, {SCMP_A2(SCMP_CMP_MASKED_EQ, PROT_EXEC, 0)});
    allow(SCMP_SYS(tgkill), {SCMP_A0(SCMP_CMP_EQ, scmp_datum_t(::getpid()))});  // abort()
    if (folder) {
        constexpr scmp_datum_t kWriting = O_ACCMODE | O_CREAT | O_TRUNC | O_APPEND;
        allow(SCMP_SYS(openat), {SCMP_A2(SCMP_CMP_MASKED_EQ, kWriting, O_RDONLY)});
        allow(SCMP_SYS(getdents64));
    }
    good = good && seccomp_load(filter) == 0;
    seccomp_release(filter);
    return good;
}

}  // namespace

bool confine(std::size_t memory_bytes, int processor_s, bool folder) {
    ::close_range(folder ? kFolder + 1 : kFolder, ~0u, 0);
    ::prctl(PR_SET_DUMPABLE, 0);
    if (!kSanitized) {  // sanitizers reserve terabytes
        const rlim_t bytes = rlim_t(address_space_bytes() + memory_bytes);
        limit(RLIMIT_AS, bytes, bytes);
    }
    limit(RLIMIT_CPU, rlim_t(processor_s), rlim_t(processor_s) + 1);
    limit(RLIMIT_CORE, 0, 0);
    limit(RLIMIT_FSIZE, 0, 0);
    if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return false;
    restrict_files(folder);
    return restrict_calls(folder);
}

}  // namespace si::foreign
