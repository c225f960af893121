#include "core/confinement.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#if __has_include(<linux/seccomp.h>)
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#endif

namespace mudline {

namespace {

// Constants of <linux/landlock.h>, which older systems lack; the numbers are the same on every architecture.
constexpr long create_ruleset = 444, add_rule = 445, restrict_self = 446;
constexpr unsigned ask_version = 1, path_beneath = 1;

struct Ruleset {
  std::uint64_t files;
};
struct __attribute__((packed)) PathRule {
  std::uint64_t allowed;
  std::int32_t folder;
};

constexpr std::uint64_t bits(int first, int last) {
  std::uint64_t result = 0;
  for (int k = first; k <= last; ++k) result |= std::uint64_t{1} << k;
  return result;
}
constexpr std::uint64_t execute = bits(0, 0), write_file = bits(1, 1);
constexpr std::uint64_t remove_and_make = bits(4, 12);  // files, folders, links, devices
constexpr std::uint64_t refer = bits(13, 13);           // since version 2: links and moves between folders
constexpr std::uint64_t truncate = bits(14, 14);        // since version 3

long landlock_version() { return ::syscall(create_ruleset, nullptr, 0, ask_version); }

void restrict_files(const std::string& folder) {
  const long version = landlock_version();
  if (version < 1) return;
  const std::uint64_t writes =
      write_file | remove_and_make | (version >= 2 ? refer : 0) | (version >= 3 ? truncate : 0);
  const Ruleset handled{execute | writes};
  const int rules = static_cast<int>(::syscall(create_ruleset, &handled, sizeof handled, 0));
  if (rules < 0) return;
  if (!folder.empty()) {
    const PathRule own{writes, ::open(folder.c_str(), O_PATH | O_CLOEXEC)};
    if (own.folder >= 0) {
      ::syscall(add_rule, rules, path_beneath, &own, 0);
      ::close(own.folder);
    }
  }
  ::syscall(restrict_self, rules, 0);
  ::close(rules);
}

/// Makes system calls that start programs or open connections fail with "not permitted".
void refuse_calls() {
#if defined(SECCOMP_RET_ERRNO) && (defined(__x86_64__) || defined(__aarch64__))
#ifdef __x86_64__
  constexpr std::uint32_t architecture = AUDIT_ARCH_X86_64;
#else
  constexpr std::uint32_t architecture = AUDIT_ARCH_AARCH64;
#endif
  constexpr std::uint32_t refused = SECCOMP_RET_ERRNO | 1;  // EPERM
  sock_filter filter[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, arch)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, architecture, 0, 4),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_execve, 2, 0),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_execveat, 1, 0),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_socket, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, refused),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  sock_fprog program{sizeof filter / sizeof filter[0], filter};
  ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program);
#endif
}

}  // namespace

bool can_confine_files() { return landlock_version() >= 1; }

void confine_to(const std::string& folder) {
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return;
  restrict_files(folder);
  refuse_calls();
}

PrivateFolder::PrivateFolder() {
  std::error_code none;
  const std::filesystem::path place = std::filesystem::temp_directory_path(none);
  path_ = (none ? std::filesystem::path("/tmp") : place) / "mudline-XXXXXX";
  if (::mkdtemp(path_.data()) == nullptr) throw std::runtime_error("no temporary folder can be made: '" + path_ + "'");
}

PrivateFolder::~PrivateFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace mudline
