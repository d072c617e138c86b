#include "tools/import/process/system_calls.h"

#include <array>
#include <bit>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/sched.h>
#include <linux/seccomp.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <vector>

namespace scree {

namespace {

static_assert(std::endian::native == std::endian::little, "the low half of an argument comes first");

#if defined(__x86_64__)
constexpr uint32_t architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr uint32_t architecture = AUDIT_ARCH_AARCH64;
#else
constexpr uint32_t architecture = 0;  // no filter
#endif

/// Numbers from here on are those of another way to call, x32.
constexpr uint32_t numbers_end = 0x40000000;

/// What no reader of a file needs. Names of files are changed by some of these, which Landlock does not see
/// or only sees where it is.
constexpr std::array refused = {
    SYS_socket,
    SYS_socketpair,
    SYS_connect,
    SYS_bind,
    SYS_listen,
    SYS_accept,
    SYS_accept4,
    SYS_sendmsg,
    SYS_sendmmsg,
    SYS_io_uring_setup,
    SYS_io_uring_enter,
    SYS_io_uring_register,
    SYS_execve,
    SYS_execveat,
    SYS_ptrace,
    SYS_process_vm_readv,
    SYS_process_vm_writev,
    SYS_pidfd_open,
    SYS_pidfd_getfd,
    SYS_pidfd_send_signal,
    SYS_kcmp,
    SYS_tkill,
    SYS_rt_sigqueueinfo,
    SYS_rt_tgsigqueueinfo,
    SYS_setpriority,
    SYS_mount,
    SYS_umount2,
    SYS_pivot_root,
    SYS_chroot,
    SYS_move_mount,
    SYS_open_tree,
    SYS_fsopen,
    SYS_unshare,
    SYS_setns,
    SYS_name_to_handle_at,
    SYS_open_by_handle_at,
    SYS_keyctl,
    SYS_add_key,
    SYS_request_key,
    SYS_bpf,
    SYS_perf_event_open,
    SYS_userfaultfd,
    SYS_init_module,
    SYS_finit_module,
    SYS_delete_module,
    SYS_kexec_load,
    SYS_reboot,
    SYS_swapon,
    SYS_swapoff,
    SYS_sethostname,
    SYS_settimeofday,
    SYS_clock_settime,
    SYS_quotactl,
    SYS_acct,
    SYS_shmget,
    SYS_shmat,
    SYS_msgget,
    SYS_mq_open,
    SYS_truncate,
    SYS_mkdirat,
    SYS_mknodat,
    SYS_unlinkat,
    SYS_renameat2,
    SYS_linkat,
    SYS_symlinkat,
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
#if defined(__x86_64__)
    SYS_fork,
    SYS_vfork,
    SYS_creat,
    SYS_mkdir,
    SYS_rmdir,
    SYS_mknod,
    SYS_unlink,
    SYS_rename,
    SYS_renameat,
    SYS_link,
    SYS_symlink,
    SYS_chmod,
    SYS_chown,
    SYS_lchown,
    SYS_utime,
    SYS_utimes,
    SYS_futimesat,
#endif
};

/// Their arguments lie in memory, which a filter does not see; the C library has older calls in their place.
constexpr std::array unknown_here = {SYS_clone3, SYS_openat2};

constexpr uint32_t writing = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC;

class Filter {
 public:
  Filter() {
    load(offsetof(seccomp_data, arch));
    add(BPF_JMP | BPF_JEQ | BPF_K, architecture, 1, 0);
    refuse();
    load(offsetof(seccomp_data, nr));
    add(BPF_JMP | BPF_JGE | BPF_K, numbers_end, 0, 1);
    refuse();
    for (const long number : refused) {
      only_for(number, 1);
      refuse();
    }
    for (const long number : unknown_here) {
      only_for(number, 1);
      add(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | ENOSYS);
    }
    refuse_unless(SYS_clone, 0, BPF_JSET, CLONE_THREAD);
    refuse_unless(SYS_kill, 0, BPF_JEQ, static_cast<uint32_t>(::getpid()));
    refuse_unless(SYS_tgkill, 0, BPF_JEQ, static_cast<uint32_t>(::getpid()));
    refuse_unless(SYS_prlimit64, 0, BPF_JEQ, 0);
    refuse_where(SYS_ioctl, 1, BPF_JEQ, TIOCSTI);
    refuse_where(SYS_openat, 2, BPF_JSET, writing);
#if defined(__x86_64__)
    refuse_where(SYS_open, 1, BPF_JSET, writing);
#endif
    add(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
  }

  bool install() {
    sock_fprog program{static_cast<unsigned short>(rules_.size()), rules_.data()};
    return ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program, 0, 0) == 0;
  }

 private:
  void add(int code, uint32_t value, uint8_t jump_if = 0, uint8_t jump_else = 0) {
    rules_.push_back({static_cast<uint16_t>(code), jump_if, jump_else, value});
  }
  void load(size_t offset) {
    add(BPF_LD | BPF_W | BPF_ABS, static_cast<uint32_t>(offset));
  }
  void refuse() {
    add(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EACCES);
  }
  void only_for(long number, uint8_t rules) {
    add(BPF_JMP | BPF_JEQ | BPF_K, static_cast<uint32_t>(number), 0, rules);
  }
  void load_argument(size_t argument) {
    load(offsetof(seccomp_data, args) + 8 * argument);
  }
  void refuse_where(long number, size_t argument, int test, uint32_t value) {
    only_for(number, 4);
    load_argument(argument);
    add(BPF_JMP | test | BPF_K, value, 0, 1);
    refuse();
    add(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
  }
  void refuse_unless(long number, size_t argument, int test, uint32_t value) {
    only_for(number, 4);
    load_argument(argument);
    add(BPF_JMP | test | BPF_K, value, 1, 0);
    refuse();
    add(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
  }

  std::vector<sock_filter> rules_;
};

}  // namespace

bool has_filters() {
  return architecture != 0 && ::prctl(PR_GET_SECCOMP) >= 0;
}

Result<void> filter_system_calls() {
  if (!has_filters()) return {};
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && Filter().install()) return {};
  return fail(std::string("its reader cannot be confined: ") + std::strerror(errno));
}

}  // namespace scree
