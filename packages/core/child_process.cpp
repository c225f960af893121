#include "core/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "core/errors.hpp"

namespace mudline {

namespace {

enum class Kind : char { answer, input_error, failure };

void write_all(int to, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(to, data, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;  // nobody reads any more
    data += written;
    size -= static_cast<std::size_t>(written);
  }
}

[[noreturn]] void be_child(int to, const std::function<std::vector<char>()>& work) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  // handlers of this program and of MPI, which print stack traces, are not for the child
  for (int signal = 1; signal < 32; ++signal) std::signal(signal, SIG_DFL);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
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
  } catch (const std::exception& error) {
    say(Kind::failure, error.what());
  } catch (...) {
    say(Kind::failure, "an exception of unknown type");
  }
  const unsigned long long size = bytes.size();
  write_all(to, reinterpret_cast<const char*>(&kind), sizeof kind);
  write_all(to, reinterpret_cast<const char*>(&size), sizeof size);
  write_all(to, bytes.data(), bytes.size());
  ::_exit(0);  // no destructor of what is the parent's
}

/// Reads to the end; false when the time is over.
bool read_all(int from, double limit, std::vector<char>& bytes) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  std::vector<char> piece(1 << 16);
  for (;;) {
    const double left = limit - std::chrono::duration<double>(Clock::now() - start).count();
    if (left <= 0) return false;
    pollfd ready{from, POLLIN, 0};
    const int found = ::poll(&ready, 1, static_cast<int>(std::min(std::ceil(1e3 * left), 1e9)));
    if (found <= 0) continue;  // interrupted, or the time is over
    const ssize_t count = ::read(from, piece.data(), piece.size());
    if (count == 0) return true;
    if (count > 0) bytes.insert(bytes.end(), piece.begin(), piece.begin() + count);
    if (count < 0 && errno != EINTR) return true;
  }
}

std::string short_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%g s", seconds);
  return text;
}

}  // namespace

std::vector<char> in_child_process(const std::function<std::vector<char>()>& work, double limit) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe to a child process");
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child < 0) {
    ::close(ends[0]);
    ::close(ends[1]);
    throw std::runtime_error("no child process can be started");
  }
  if (child == 0) be_child(ends[1], work);
  ::close(ends[1]);
  std::vector<char> bytes;
  const bool in_time = read_all(ends[0], limit, bytes);
  ::close(ends[0]);
  if (!in_time) ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!in_time) throw ChildLost("had not finished after " + short_text(limit) + " and was stopped", true);
  Kind kind{};
  unsigned long long size = 0;
  constexpr std::size_t head = sizeof kind + sizeof size;
  if (bytes.size() >= head) std::memcpy(&size, bytes.data() + sizeof kind, sizeof size);
  if (bytes.size() < head || bytes.size() != head + size)
    throw ChildLost(WIFSIGNALED(status) ? "crashed (signal " + std::to_string(WTERMSIG(status)) + ")" : "broke off",
                    false);
  std::memcpy(&kind, bytes.data(), sizeof kind);
  bytes.erase(bytes.begin(), bytes.begin() + head);
  if (kind == Kind::answer) return bytes;
  const std::string text(bytes.begin(), bytes.end());
  if (kind == Kind::input_error) throw InputError(text);
  throw std::runtime_error(text);
}

}  // namespace mudline
