// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/confinement.hpp"
#include "core/error.hpp"
#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <string>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <vector>

namespace fretwork::core {
namespace {

static_assert(process_refused == SIGSYS);

#if defined(__x86_64__)
constexpr std::uint32_t architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t architecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t architecture = 0; // no filter is known: not available
#endif

constexpr std::uint64_t making_and_removing =
    LANDLOCK_ACCESS_FS_REMOVE_DIR | LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_CHAR |
    LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_MAKE_SOCK |
    LANDLOCK_ACCESS_FS_MAKE_FIFO | LANDLOCK_ACCESS_FS_MAKE_BLOCK | LANDLOCK_ACCESS_FS_MAKE_SYM;
constexpr std::uint64_t all_writing = LANDLOCK_ACCESS_FS_WRITE_FILE | making_and_removing;

/// System calls that fail with EPERM: what Landlock of the first kernels does not cover, and what no reader of a file needs.
constexpr int refused_calls[] = {
    SYS_socket,
    SYS_socketpair,
    SYS_connect,
    SYS_bind,
    SYS_listen,
    SYS_ptrace,
    SYS_process_vm_writev,
    SYS_truncate,
    SYS_fchmod,
    SYS_fchmodat,
    SYS_fchown,
    SYS_fchownat,
    SYS_utimensat,
    SYS_setxattr,
    SYS_lsetxattr,
    SYS_fsetxattr,
    SYS_removexattr,
    SYS_lremovexattr,
    SYS_fremovexattr,
    SYS_mount,
    SYS_umount2,
    SYS_pivot_root,
    SYS_chroot,
    SYS_unshare,
    SYS_setns,
    SYS_io_uring_setup,
    SYS_bpf,
    SYS_keyctl,
    SYS_add_key,
    SYS_request_key,
    SYS_perf_event_open,
    SYS_userfaultfd,
    SYS_open_by_handle_at,
    SYS_kill,
    SYS_tkill,
    SYS_tgkill,
    SYS_rt_sigqueueinfo,
    SYS_rt_tgsigqueueinfo,
    SYS_pidfd_send_signal,
    SYS_init_module,
    SYS_finit_module,
    SYS_kexec_load,
    SYS_reboot,
    SYS_swapon,
    SYS_sethostname,
    SYS_setdomainname,
    SYS_settimeofday,
    SYS_clock_settime,
    SYS_adjtimex,
    SYS_clock_adjtime,
    SYS_acct,
    SYS_quotactl,
#if defined(__x86_64__)
    SYS_chmod,
    SYS_chown,
    SYS_lchown,
    SYS_utime,
    SYS_utimes,
    SYS_futimesat,
#endif
};

/// Later calls than those of Linux 5.17 (set_mempolicy_home_node), some of which change files too, are as on a kernel that has none of them.
constexpr std::uint32_t first_unknown_call = 451;

sock_filter statement(int code, std::uint32_t value) {
  return BPF_STMT(static_cast<std::uint16_t>(code), value);
}

sock_filter jump(int code, std::uint32_t value, std::uint8_t if_true, std::uint8_t if_false) {
  return BPF_JUMP(static_cast<std::uint16_t>(code), value, if_true, if_false);
}

/// Where the number `call` stands: `action`.
void on_call(std::vector<sock_filter>& program, int call, std::uint32_t action) {
  program.push_back(jump(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, 1));
  program.push_back(statement(BPF_RET | BPF_K, action));
}

/// Where the number `call` is that of an open whose flags ask to empty a file that is not open for writing: Landlock of the first kernels
/// takes that for reading.
void refuse_emptying(std::vector<sock_filter>& program, int call, std::size_t flags_argument) {
  const auto flags =
      static_cast<std::uint32_t>(offsetof(seccomp_data, args) + flags_argument * sizeof(std::uint64_t));
  program.push_back(jump(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, 6));
  program.push_back(statement(BPF_LD | BPF_W | BPF_ABS, flags));
  program.push_back(statement(BPF_ALU | BPF_AND | BPF_K, O_TRUNC | O_ACCMODE));
  program.push_back(jump(BPF_JMP | BPF_JEQ | BPF_K, O_TRUNC | O_RDONLY, 1, 0));
  program.push_back(jump(BPF_JMP | BPF_JEQ | BPF_K, O_TRUNC | O_ACCMODE, 0, 1));
  program.push_back(statement(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM));
  program.push_back(statement(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
}

std::vector<sock_filter> make_filter(Processes processes) {
  constexpr std::uint32_t end = SECCOMP_RET_KILL_PROCESS, refuse = SECCOMP_RET_ERRNO | EPERM,
                          absent = SECCOMP_RET_ERRNO | ENOSYS;
  std::vector<sock_filter> program;
  program.push_back(statement(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, arch)));
  program.push_back(jump(BPF_JMP | BPF_JEQ | BPF_K, architecture, 1, 0));
  program.push_back(statement(BPF_RET | BPF_K, end));
  program.push_back(statement(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)));
#if defined(__x86_64__)
  constexpr std::uint32_t first_of_x32 = 0x40000000; // another numbering of the same calls
  program.push_back(jump(BPF_JMP | BPF_JGE | BPF_K, first_of_x32, 0, 1));
  program.push_back(statement(BPF_RET | BPF_K, end));
#endif
  program.push_back(jump(BPF_JMP | BPF_JGE | BPF_K, first_unknown_call, 0, 1));
  program.push_back(statement(BPF_RET | BPF_K, absent));
  for (const int call : refused_calls)
    on_call(program, call, refuse);
  on_call(program, SYS_openat2, absent); // its flags lie in memory, where a filter does not see them
  refuse_emptying(program, SYS_openat, 2);
#if defined(__x86_64__)
  refuse_emptying(program, SYS_open, 1);
#endif
  if (processes == Processes::allowed) {
    program.push_back(statement(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
    return program;
  }
#if defined(__x86_64__)
  on_call(program, SYS_fork, end);
  on_call(program, SYS_vfork, end);
#endif
  on_call(program, SYS_clone3, absent); // as openat2: the C library takes clone
  program.push_back(jump(BPF_JMP | BPF_JEQ | BPF_K, SYS_clone, 0, 3));
  program.push_back(statement(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, args)));
  program.push_back(jump(BPF_JMP | BPF_JSET | BPF_K, CLONE_THREAD, 1, 0));
  program.push_back(statement(BPF_RET | BPF_K, end));
  program.push_back(statement(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  return program;
}

const std::vector<sock_filter>& filter(Processes processes) {
  static const std::vector<sock_filter> none = make_filter(Processes::refused),
                                        any = make_filter(Processes::allowed);
  return processes == Processes::refused ? none : any;
}

/// Allows `rights` below (or, of a file, at) a path.
bool allow(int rules, const char* path, std::uint64_t rights) {
  const int place = ::open(path, O_PATH | O_CLOEXEC);
  if (place < 0)
    return false;
  landlock_path_beneath_attr rule{};
  rule.allowed_access = rights;
  rule.parent_fd = place;
  const long status = ::syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
  (void)::close(place);
  return status == 0;
}

} // namespace

bool Confinement::available() {
  if (const char* wish = std::getenv("FRETWORK_CONFINEMENT"); wish && std::string(wish) == "off")
    return false;
  const long version = ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  std::uint32_t action = SECCOMP_RET_KILL_PROCESS;
  return architecture != 0 && version >= 1 &&
         ::syscall(SYS_seccomp, SECCOMP_GET_ACTION_AVAIL, 0, &action) == 0;
}

Confinement::Confinement(const std::filesystem::path& writable, Processes processes) : processes_(processes) {
  (void)filter(processes); // made here: the child between fork and exec must not allocate
  landlock_ruleset_attr handled{};
  handled.handled_access_fs = all_writing;
  rules_ = static_cast<int>(::syscall(SYS_landlock_create_ruleset, &handled, sizeof handled, 0));
  if (rules_ < 0 || !allow(rules_, writable.c_str(), all_writing) ||
      !allow(rules_, "/dev/null", LANDLOCK_ACCESS_FS_WRITE_FILE)) {
    const std::string why = std::strerror(errno);
    if (rules_ >= 0)
      (void)::close(rules_);
    throw Error("a child process cannot be confined to " + writable.string() + ": " + why +
                "; set mesh.trusted = true if you trust the file that it reads");
  }
}

Confinement::~Confinement() { (void)::close(rules_); }

bool Confinement::enforce() const noexcept {
  const std::vector<sock_filter>& program = filter(processes_);
  const sock_fprog code{static_cast<unsigned short>(program.size()),
                        const_cast<sock_filter*>(program.data())};
  return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         ::syscall(SYS_landlock_restrict_self, rules_, 0) == 0 &&
         ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &code) == 0;
}

} // namespace fretwork::core
