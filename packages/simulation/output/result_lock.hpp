#pragma once

#include <Teuchos_Comm.hpp>
#include <Teuchos_RCP.hpp>

#include <string>

namespace mudline {

/// While it lives no other run writes the results of the same stem: the file <stem>.lock, which names the process and
/// its host, locked by the operating system, so that it is free again however the process ends. Rank 0's.
class ResultLock {
 public:
  /// InputError that names the other process when there is one, or when one of another host left the file, of which
  /// nothing can be known, or when the file cannot be written. Collective.
  ResultLock(const Teuchos::RCP<const Teuchos::Comm<int>>& comm, const std::string& stem);
  ~ResultLock();
  ResultLock(const ResultLock&) = delete;
  ResultLock& operator=(const ResultLock&) = delete;

 private:
  /// Rank 0. Returns what is wrong, "" when nothing is.
  std::string take();
  void leave(bool remove);

  std::string path_;
  int file_ = -1;
};

}  // namespace mudline
