#include "tests/support/confinement.h"

#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>
#include <utility>

namespace si::test {
namespace {

// Rules of Landlock's first version, which refuses moving files between folders.
constexpr std::uint64_t kChanging = LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR |
                                    LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_CHAR |
                                    LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_REG |
                                    LANDLOCK_ACCESS_FS_MAKE_SOCK | LANDLOCK_ACCESS_FS_MAKE_FIFO |
                                    LANDLOCK_ACCESS_FS_MAKE_BLOCK | LANDLOCK_ACCESS_FS_MAKE_SYM;

bool allow(int rules, const std::filesystem::path& folder) {
    const int at = open(folder.c_str(), O_PATH | O_CLOEXEC);
    if (at < 0) return false;
    landlock_path_beneath_attr beneath{};
    beneath.allowed_access = kChanging;
    beneath.parent_fd = at;
    const bool done = syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &beneath, 0) == 0;
    close(at);
    return done;
}

}  // namespace

std::optional<Confinement> Confinement::for_folder(const std::filesystem::path& folder) {
    landlock_ruleset_attr handled{};
    handled.handled_access_fs = kChanging;
    const int rules = int(syscall(SYS_landlock_create_ruleset, &handled, sizeof handled, 0));
    if (rules < 0) return {};
    Confinement made(rules);
    if (!allow(rules, folder) || !allow(rules, "/dev")) return {};
    return made;
}

Confinement::~Confinement() {
    if (rules_ >= 0) close(rules_);
}

Confinement::Confinement(Confinement&& other) noexcept : rules_(std::exchange(other.rules_, -1)) {}

Confinement& Confinement::operator=(Confinement&& other) noexcept {
    std::swap(rules_, other.rules_);
    return *this;
}

bool Confinement::apply_to_this_process() const {
    return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && syscall(SYS_landlock_restrict_self, rules_, 0) == 0;
}

}  // namespace si::test
