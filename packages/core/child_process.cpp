#include "core/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <new>
#include <optional>

#include "core/confinement.hpp"
#include "core/errors.hpp"
#include "core/told.hpp"

namespace mudline {

namespace {

enum class Kind : char { answer, input_error, no_memory, failure };

void write_all(int to, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(to, data, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;  // the parent no longer reads
    data += written;
    size -= static_cast<std::size_t>(written);
  }
}

/// Whether a signal keeps its default action: it comes from a fault of the process itself, or stops or continues it.
bool keeps_its_meaning(int signal) {
  switch (signal) {
    case SIGSEGV:
    case SIGBUS:
    case SIGFPE:
    case SIGILL:
    case SIGABRT:
    case SIGTRAP:
    case SIGSYS:
    case SIGCHLD:
    case SIGCONT:
    case SIGTSTP:
    case SIGTTIN:
    case SIGTTOU:
      return true;
    default:
      return false;
  }
}

constexpr int parent_ended = SIGUSR2;
pid_t parent = 0;

/// Ends the child and all processes that it has started, which are one process group.
void on_parent_ended(int) {
  if (::getppid() != parent) ::kill(0, SIGKILL);
}

/// Puts the child in a process group of its own that ends with the parent and ignores other signals.
void stand_alone() {
  ::setpgid(0, 0);
  // the child must not run handlers of this program and of MPI, which print stack traces
  for (int signal = 1; signal <= SIGRTMAX; ++signal) std::signal(signal, keeps_its_meaning(signal) ? SIG_DFL : SIG_IGN);
  std::signal(parent_ended, on_parent_ended);
  ::prctl(PR_SET_PDEATHSIG, parent_ended);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  on_parent_ended(0);  // the parent may have ended already
}

/// Closes the program's files in the child: neither results, whose locks would outlive it, nor connections may stay
/// open.
void close_files(int but) {
  constexpr long close_range = 436;  // the system call's number, in Linux since 5.9
  const unsigned first = STDERR_FILENO + 1, own = static_cast<unsigned>(but);
  if (::syscall(close_range, own + 1, ~0U, 0) == 0) {
    if (own > first) ::syscall(close_range, first, own - 1, 0);
  } else {
    const long most = std::min(::sysconf(_SC_OPEN_MAX), 65536L);
    for (int file = STDERR_FILENO + 1; file < most; ++file)
      if (file != but) ::close(file);
  }
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, file);
}

[[noreturn]] void be_child(int to, const std::string& folder, bool confined,
                           const std::function<std::vector<char>()>& work) {
  stand_alone();
  close_files(to);
  if (!folder.empty()) {
    if (::chdir(folder.c_str()) != 0) ::_exit(1);
    for (const char* place : {"HOME", "TMPDIR", "GMSH_HOME"}) ::setenv(place, folder.c_str(), 1);
  }
  if (confined) confine_to(folder);
  Kind kind = Kind::answer;
  std::vector<char> bytes;
  const auto say = [&](Kind what, const std::string& text) {
    kind = what;
    bytes.assign(text.begin(), text.end());
  };
  try {
    bytes = work();
  } catch (const InputError& error) {
    say(Kind::input_error, error.what());
  } catch (const std::bad_alloc&) {
    say(Kind::no_memory, "");
  } catch (const std::exception& error) {
    say(Kind::failure, error.what());
  } catch (...) {
    say(Kind::failure, "an exception of unknown type");
  }
  const unsigned long long size = bytes.size();
  write_all(to, reinterpret_cast<const char*>(&kind), sizeof kind);
  write_all(to, reinterpret_cast<const char*>(&size), sizeof size);
  write_all(to, bytes.data(), bytes.size());
  ::_exit(0);  // runs no destructors of the parent's objects
}

/// Reads to the end; false when the time is over. The time in which this process was stopped does not count.
bool read_all(int from, double limit, std::vector<char>& bytes) {
  using Clock = std::chrono::steady_clock;
  constexpr double slice = 0.5;  // [s]
  std::vector<char> piece(1 << 16);
  for (double left = limit;;) {
    const auto start = Clock::now();
    pollfd ready{from, POLLIN, 0};
    const int found = ::poll(&ready, 1, static_cast<int>(std::ceil(1e3 * std::clamp(left, 0.0, slice))));
    left -= std::min(std::chrono::duration<double>(Clock::now() - start).count(), 2 * slice);
    if (found > 0) {
      const ssize_t count = ::read(from, piece.data(), piece.size());
      if (count == 0) return true;
      if (count > 0) bytes.insert(bytes.end(), piece.begin(), piece.begin() + count);
      if (count < 0 && errno != EINTR) return true;
    } else if (left <= 0) {
      return false;
    }
  }
}

/// Blocks signals during a fork, while the child still has the program's handlers.
class NoSignals {
 public:
  NoSignals() {
    sigset_t all;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~NoSignals() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  NoSignals(const NoSignals&) = delete;
  NoSignals& operator=(const NoSignals&) = delete;

 private:
  sigset_t before_{};
};

/// Ends the child's process group, with all that it has started; returns how the child itself ended.
int end_of(pid_t child, bool kill_it) {
  ::setpgid(child, child);  // in case the child has not done so yet
  if (kill_it) ::kill(child, SIGKILL);
  siginfo_t info{};
  while (::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
  }
  ::kill(-child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

std::vector<char> attempt(const std::function<std::vector<char>()>& work, const ChildBounds& bounds) {
  std::optional<PrivateFolder> folder;
  int ends[2];
  try {
    if (bounds.own_folder) folder.emplace();
    if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(std::strerror(errno));
  } catch (const std::runtime_error& error) {
    throw ChildLost(std::string("could not be started: ") + error.what(), false);
  }
  std::fflush(nullptr);
  parent = ::getpid();
  pid_t child = 0;
  {
    const NoSignals held;
    child = ::fork();
    if (child == 0) be_child(ends[1], folder ? folder->path() : "", !bounds.may_change_files, work);
  }
  const int error = errno;
  ::close(ends[1]);
  if (child < 0) {
    ::close(ends[0]);
    throw ChildLost(std::string("could not be started: ") + std::strerror(error), false);
  }
  std::vector<char> bytes;
  const bool in_time = read_all(ends[0], bounds.limit, bytes);
  ::close(ends[0]);
  const int status = end_of(child, !in_time);
  if (!in_time) throw ChildLost("had not finished after " + told(bounds.limit, "%g s") + " and was stopped", true);
  Kind kind{};
  unsigned long long size = 0;
  constexpr std::size_t head = sizeof kind + sizeof size;
  if (bytes.size() >= head) std::memcpy(&size, bytes.data() + sizeof kind, sizeof size);
  if (bytes.size() < head || bytes.size() != head + size) {
    if (!WIFSIGNALED(status)) throw ChildLost("broke off", false);
    const int signal = WTERMSIG(status);
    throw ChildLost(
        (keeps_its_meaning(signal) ? "crashed (signal " : "was killed (signal ") + std::to_string(signal) + ")", false);
  }
  std::memcpy(&kind, bytes.data(), sizeof kind);
  bytes.erase(bytes.begin(), bytes.begin() + head);
  if (kind == Kind::answer) return bytes;
  if (kind == Kind::no_memory) throw std::bad_alloc();
  const std::string text(bytes.begin(), bytes.end());
  if (kind == Kind::input_error) throw InputError(text);
  throw std::runtime_error(text);
}

}  // namespace

std::vector<char> in_child_process(const std::function<std::vector<char>()>& work, const ChildBounds& bounds) {
  try {
    return attempt(work, bounds);
  } catch (const ChildLost& lost) {
    if (lost.timed_out) throw;
  }
  return attempt(work, bounds);
}

}  // namespace mudline
