#pragma once

#include <Teuchos_Comm.hpp>
#include <Teuchos_RCP.hpp>

#include <string>

namespace mudline {

/// Keeps other runs from writing the results of the same stem during its lifetime. The file <stem>.lock names the
/// process and its host. The operating system locks it, so that it is free again however the process ends. Rank 0 holds
/// it.
class ResultLock {
 public:
  /// InputError that names the other process when one holds the lock or one of another host, whose state is unknown
  /// here, left the file; also when the file cannot be written. Collective.
  ResultLock(const Teuchos::RCP<const Teuchos::Comm<int>>& comm, const std::string& stem);
  ~ResultLock();
  ResultLock(const ResultLock&) = delete;
  ResultLock& operator=(const ResultLock&) = delete;

 private:
  /// Takes the lock on rank 0. Returns what is wrong, "" when nothing is.
  std::string take();
  void leave(bool remove);

  std::string path_;
  int file_ = -1;
};

}  // namespace mudline
