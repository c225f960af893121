#include "simulation/output/result_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <sstream>

#include "core/errors.hpp"
#include "simulation/output/collective.hpp"

namespace mudline {

namespace {

struct Owner {
  std::string host;
  long process = 0;
  std::string text() const { return "process " + std::to_string(process) + " on host " + host; }
};

Owner myself() {
  char host[256] = "";
  gethostname(host, sizeof host - 1);
  return {host[0] != '\0' ? host : "unknown", static_cast<long>(getpid())};
}

/// The process that the file names; an empty host: none.
Owner read_owner(int file) {
  char text[400] = "";
  Owner owner;
  if (pread(file, text, sizeof text - 1, 0) > 0) std::istringstream(text) >> owner.host >> owner.process;
  return owner;
}

bool runs_here(const Owner& owner) { return kill(static_cast<pid_t>(owner.process), 0) == 0 || errno == EPERM; }

}  // namespace

ResultLock::ResultLock(const Teuchos::RCP<const Teuchos::Comm<int>>& comm, const std::string& stem)
    : path_(stem + ".lock") {
  const std::string error = agreed_message(raw_communicator(*comm), comm->getRank() == 0 ? take() : "");
  if (error.empty()) return;
  leave(false);
  throw InputError(error);
}

ResultLock::~ResultLock() { leave(true); }

void ResultLock::leave(bool remove) {
  if (file_ < 0) return;
  if (remove) unlink(path_.c_str());  // while it is still locked, so that it is not the file of another run
  close(file_);
  file_ = -1;
}

std::string ResultLock::take() {
  bool by_system = true;  // false: the file system has no locks, and the file's content decides
  for (;;) {
    file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (file_ < 0) return path_ + ": cannot be written: " + std::strerror(errno);
    if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
      if (errno == EWOULDBLOCK)
        return path_ + ": these results are being written by " + read_owner(file_).text() +
               "; wait for it, or give another output/name or output/folder";
      by_system = false;
    }
    // the run before may have removed the file just now
    struct stat mine {
    }, there{};
    if (fstat(file_, &mine) == 0 && stat(path_.c_str(), &there) == 0 && mine.st_ino == there.st_ino) break;
    leave(false);
  }
  const Owner before = read_owner(file_), now = myself();
  if (!before.host.empty() && before.host != now.host)
    return path_ + ": these results were begun by " + before.text() +
           ", of which nothing is known here; once it has ended, delete this file";
  if (!by_system && !before.host.empty() && runs_here(before))
    return path_ + ": these results are being written by " + before.text() +
           "; wait for it, or give another output/name or output/folder";
  const std::string text = now.host + " " + std::to_string(now.process) + "\n";
  if (ftruncate(file_, 0) != 0 || pwrite(file_, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size()))
    return path_ + ": cannot be written: " + std::strerror(errno);
  return "";
}

}  // namespace mudline
