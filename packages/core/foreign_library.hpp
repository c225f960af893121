#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "core/symbol_supply.hpp"

namespace mudline {

/// A shared library with foreign code, a plugin or a UMAT. It stays loaded until the program ends; a crash in it is
/// reported with its name (ExitGuard).
class ForeignLibrary {
 public:
  ForeignLibrary() = default;
  /// Loads the file and runs its static initialisers. Functions that the library lacks are taken from `supplied`.
  /// Throws std::runtime_error, in one line, where the file cannot be loaded or an initialiser throws.
  explicit ForeignLibrary(const std::string& path, const std::vector<SuppliedFunction>& supplied = {});
  /// The address of a function; null: the library has none of this name.
  void* function(const std::string& name) const;

 private:
  void* handle_ = nullptr;
};

/// While the one object of this class lives, only the program itself can end the process normally. An exit(),
/// quick_exit() or _exit() or a Fortran STOP inside a library, a crash by a signal, and an exception that nobody could
/// catch become one line on standard error, which names the foreign library in which it happened, and exit code 1.
/// Crashes are reported so until the process ends.
class ExitGuard {
 public:
  /// Where all ranks fail alike, the line of the first rank is enough; the others wait for it.
  ExitGuard(int rank, int ranks);
  ~ExitGuard();
  ExitGuard(const ExitGuard&) = delete;
  ExitGuard& operator=(const ExitGuard&) = delete;
};

/// The nearest foreign library on the call stack while the ExitGuard lives; null: none.
const char* foreign_caller();

/// The file descriptors that are open at construction, beyond the standard three. Empty where no foreign library is
/// loaded, unless `loading` says that one is about to be.
class OpenDescriptors {
 public:
  explicit OpenDescriptors(bool loading = false);
  /// "" or a message that one of them has been closed or is another file now.
  std::string closed() const;

 private:
  struct Open {
    int number;
    dev_t device;
    ino_t file;
  };
  std::vector<Open> of_;
};

/// Ends the program, naming the libraries, where foreign code has changed the working folder or the rounding mode, or
/// closed a standard stream or, if given, one of the descriptors open before.
void check_foreign_code(const OpenDescriptors* before = nullptr);

/// Ends this process and, through the launcher, the other ranks, for a fault that the other ranks may not share and
/// where they would wait for this one in vain. Writes "error: <message>"; a rank other than the first writes it only
/// when the first has not ended everything within two seconds.
[[noreturn]] void end_with_error(const std::string& message, int code);

}  // namespace mudline
