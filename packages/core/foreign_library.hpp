#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace mudline {

/// A shared library with code of others, a plugin or a UMAT. Stays loaded until the program ends; a crash in it is told
/// with its name (ExitGuard).
class ForeignLibrary {
 public:
  ForeignLibrary() = default;
  /// Loads the file and runs its static initialisers. std::runtime_error in one line: it cannot be loaded, or what they
  /// threw.
  explicit ForeignLibrary(const std::string& path);
  /// The address of a function; null: the library has none of this name.
  void* function(const std::string& name) const;

 private:
  void* handle_ = nullptr;
};

/// While the one object of this class lives, the program ends in its own way only. An exit(), quick_exit() or _exit()
/// or a Fortran STOP inside a library, a crash by a signal, and an exception that nobody could catch become one line on
/// standard error, which names the foreign library in which it happened, and exit code 1. Crashes are told so until the
/// process ends.
class ExitGuard {
 public:
  /// `rank` of how many: the line of the first rank is enough where all fail alike; the others wait for it.
  ExitGuard(int rank, int ranks);
  ~ExitGuard();
  ExitGuard(const ExitGuard&) = delete;
  ExitGuard& operator=(const ExitGuard&) = delete;
};

/// The foreign library that is nearest on the stack while the ExitGuard lives; null: none.
const char* foreign_caller();

/// The descriptors that are open when this is made, beyond the standard three; nothing where no library is loaded,
/// unless one is about to be.
class OpenDescriptors {
 public:
  explicit OpenDescriptors(bool loading = false);
  /// "" or that one of them is closed, or another file.
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

/// Ends this process and, through the launcher, the other ranks: for a fault that the other ranks may not share, where
/// they wait for this one in vain. Writes "error: <message>"; from another rank than the first only when that has not
/// ended everything within two seconds.
[[noreturn]] void end_with_error(const std::string& message, int code);

}  // namespace mudline
