#include "core/foreign_library.hpp"

#include <dlfcn.h>
#include <execinfo.h>
#include <fcntl.h>
#include <link.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cfenv>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <stdexcept>

#include "core/guarded.hpp"

namespace mudline {

namespace {

// Data that a signal handler may read: none of it allocates once it is set.

struct LoadedCode {
  std::uintptr_t begin, end;
  char name[128];
};
constexpr int most_libraries = 256;
LoadedCode loaded[most_libraries];
std::atomic<int> libraries{0};

char being_loaded[sizeof LoadedCode::name];  // file whose static initialisers are running

int own_rank = 0;
pid_t own_process = 0;       // forked children are not guarded
int error_output_copy = -1;  // copy, for the last message after somebody has closed the descriptor
std::atomic<bool> armed{false}, ending{false};
constexpr int deadly[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
std::array<char, 1 << 16> signal_stack;  // endless recursion uses up the ordinary stack

/// The nearest foreign library on the call stack; null: none.
const char* library_on_stack() {
  void* frames[128];
  const int depth = backtrace(frames, 128);
  for (int i = 0; i < depth; ++i)
    for (int k = 0; k < libraries; ++k) {
      const auto at = reinterpret_cast<std::uintptr_t>(frames[i]);
      if (at >= loaded[k].begin && at < loaded[k].end) return loaded[k].name;
    }
  return being_loaded[0] != '\0' ? being_loaded : nullptr;
}

/// Ends the process at once, as the C library's _exit does.
[[noreturn]] void leave(int code) {
  for (;;) syscall(SYS_exit_group, code);
}

/// Writes the pieces as one line with one system call, so that ranks do not mix, and ends the process.
[[noreturn]] void end(std::initializer_list<const char*> pieces, int code) {
  if (own_rank > 0) {
    signal(SIGTERM, SIG_DFL);  // from the launcher, once the first rank has ended
    sleep(2);
  }
  char line[2000];
  std::size_t length = 0;
  for (const char* piece : pieces)
    for (; *piece != '\0' && length + 1 < sizeof line; ++piece) line[length++] = *piece == '\n' ? ' ' : *piece;
  line[length++] = '\n';
  if (write(STDERR_FILENO, line, length) < 0 && error_output_copy >= 0) {
    [[maybe_unused]] const auto written = write(error_output_copy, line, length);
  }
  leave(code);
}

const char* words(int number) {
  switch (number) {
    case SIGSEGV:
      return "invalid memory access, SIGSEGV";
    case SIGBUS:
      return "invalid memory access, SIGBUS";
    case SIGFPE:
      return "arithmetic fault such as an integer division by zero, SIGFPE";
    case SIGILL:
      return "illegal instruction, SIGILL";
    default:
      return "abort, SIGABRT";
  }
}

void on_deadly_signal(int number) {
  // The search of the stack may itself crash where the stack is damaged.
  if (ending.exchange(true)) end({"error: the program crashed (", words(number), ")"}, 1);
  if (const char* library = library_on_stack())
    end({"error: the library '", library, "' crashed (", words(number), ") while it was being called"}, 1);
  end({"error: the program crashed (", words(number), "); this is a fault in mudline or in a library it is built on"},
      1);
}

[[noreturn]] void end_for(const char* library, const char* how) {
  end({"error: the library '", library, "' ended the program (", how, ") while it was being called"}, 1);
}

/// `inside`, `own`: how a library, or else this program, has ended the process.
void end_from_inside(const char* inside, const char* own) {
  if (!armed.exchange(false)) return;
  if (const char* library = library_on_stack()) end_for(library, inside);
  end({"error: the program was ended from inside by ", own}, 1);
}

void at_exit() {
  if (armed) std::fflush(stdout);
  end_from_inside("a STOP or a call of exit", "a call of exit");
}

void at_quick_exit() { end_from_inside("a call of quick_exit", "a call of quick_exit"); }

/// "the library 'a'", or "one of the libraries 'a', 'b'".
std::string loaded_libraries() {
  std::string names;
  for (int k = 0; k < libraries; ++k) names += (k > 0 ? ", '" : "'") + std::string(loaded[k].name) + "'";
  return (libraries > 1 ? "one of the libraries " : "the library ") + names;
}

bool same_file(const struct stat& a, const struct stat& b) { return a.st_dev == b.st_dev && a.st_ino == b.st_ino; }

// The state at the start of the program.
int own_rounding = FE_TONEAREST;
struct stat own_folder {};
std::array<struct stat, 3> own_streams{};  // standard input, output and error; st_ino 0: not there

void on_terminate() {
  std::string what = "an exception was thrown where none may leave";
  if (std::current_exception()) {
    try {
      throw;
    } catch (...) {
      what = what_was_thrown();
    }
  }
  const char* library = library_on_stack();
  end({"error: ", library ? "the library '" : "the program", library ? library : "", library ? "'" : "",
       " ended by an exception that could not be caught: ", what.c_str()},
      1);
}

void copy_name(const std::string& path, char (&name)[sizeof LoadedCode::name]) {
  std::strncpy(name, path.c_str() + (path.find_last_of('/') + 1), sizeof name - 1);
}

/// The address range of a library that has just been loaded.
void remember(void* handle, const std::string& path) {
  struct Search {
    const char* file;
    std::uintptr_t begin, end;
  };
  const link_map* map = nullptr;
  if (dlinfo(handle, RTLD_DI_LINKMAP, &map) != 0 || map == nullptr) return;
  Search search{map->l_name, 0, 0};
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* data) {
        auto& s = *static_cast<Search*>(data);
        if (std::strcmp(info->dlpi_name, s.file) != 0) return 0;
        for (int i = 0; i < info->dlpi_phnum; ++i) {
          if (info->dlpi_phdr[i].p_type != PT_LOAD) continue;
          const std::uintptr_t begin = info->dlpi_addr + info->dlpi_phdr[i].p_vaddr;
          if (s.end == 0 || begin < s.begin) s.begin = begin;
          s.end = std::max<std::uintptr_t>(s.end, begin + info->dlpi_phdr[i].p_memsz);
        }
        return 1;
      },
      &search);
  const int k = libraries;
  for (int i = 0; i < k; ++i)
    if (loaded[i].begin == search.begin) return;  // loaded before
  if (search.end == 0 || k == most_libraries) return;
  loaded[k].begin = search.begin;
  loaded[k].end = search.end;
  copy_name(path, loaded[k].name);
  libraries = k + 1;
}

/// The symbol that the loader did not find, by its message; "" where it complains of something else.
std::string missing_symbol(const std::string& message) {
  const std::string words = "undefined symbol: ";
  const std::size_t at = message.find(words);
  if (at == std::string::npos) return "";
  const std::size_t begin = at + words.size();
  return message.substr(begin, message.find_first_of(" ,", begin) - begin);
}

void* open_library(const std::string& path, int more = 0) {
  try {
    return dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL | more);
  } catch (...) {
    throw std::runtime_error("its initialisation throws: " + fault_thrown());
  }
}

/// Loads the library with those of the supplied functions that it lacks; the loader names them one after the other.
void* load(const std::string& path, const std::vector<SuppliedFunction>& supplied) {
  std::vector<SuppliedFunction> lacking;
  for (;;) {
    const int supply = lacking.empty() ? -1 : supplying_library(path, lacking);
    if (open_library(supply < 0 ? path : supply_path(supply))) return open_library(path, RTLD_NOLOAD);
    if (supply >= 0) close(supply);
    const std::string message = last_line(dlerror()), missing = missing_symbol(message);
    const auto is_missing = [&](const SuppliedFunction& f) { return f.name == missing; };
    const auto found = std::find_if(supplied.begin(), supplied.end(), is_missing);
    if (found != supplied.end() && std::none_of(lacking.begin(), lacking.end(), is_missing)) {
      lacking.push_back(*found);
      continue;
    }
    if (missing.empty() || supplied.empty()) throw std::runtime_error(message);
    std::string names;
    for (const SuppliedFunction& f : supplied) names += (names.empty() ? "" : ", ") + f.name;
    throw std::runtime_error("it calls '" + missing + "', which it does not have; mudline supplies " + names);
  }
}

}  // namespace

ForeignLibrary::ForeignLibrary(const std::string& path, const std::vector<SuppliedFunction>& supplied) {
  const OpenDescriptors before(true);
  copy_name(path, being_loaded);
  std::fenv_t arithmetic;
  std::fegetenv(&arithmetic);
  try {
    handle_ = load(path, supplied);
  } catch (...) {
    being_loaded[0] = '\0';
    throw;
  }
  being_loaded[0] = '\0';
  std::fesetenv(&arithmetic);  // undoes the flush-to-zero mode that loading -ffast-math code sets
  remember(handle_, path);
  check_foreign_code(&before);
}

void* ForeignLibrary::function(const std::string& name) const { return dlsym(handle_, name.c_str()); }

ExitGuard::ExitGuard(int rank, int ranks) {
  own_rank = ranks > 1 ? rank : 0;
  own_process = getpid();
  error_output_copy = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 64);
  own_rounding = std::fegetround();
  if (stat(".", &own_folder) != 0) own_folder = {};
  for (int i = 0; i < 3; ++i)
    if (fstat(i, &own_streams[i]) != 0) own_streams[i] = {};
  void* frame[1];
  backtrace(frame, 1);  // the first call loads a library, which a signal handler must not do
  stack_t stack{};
  stack.ss_sp = signal_stack.data();
  stack.ss_size = signal_stack.size();
  sigaltstack(&stack, nullptr);
  struct sigaction action {};
  action.sa_handler = on_deadly_signal;
  action.sa_flags = SA_ONSTACK | SA_NODEFER;
  for (const int number : deadly) sigaction(number, &action, nullptr);
  std::set_terminate(on_terminate);
  static const int registered = std::atexit(at_exit) + std::at_quick_exit(at_quick_exit);
  (void)registered;
  armed = true;
}

ExitGuard::~ExitGuard() { armed = false; }

const char* foreign_caller() { return armed && getpid() == own_process ? library_on_stack() : nullptr; }

OpenDescriptors::OpenDescriptors(bool loading) {
  if (libraries == 0 && !loading) return;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", none)) {
    const int number = std::atoi(entry.path().filename().c_str());
    struct stat what {};
    if (number > 2 && fstat(number, &what) == 0) of_.push_back({number, what.st_dev, what.st_ino});
  }
  // the descriptor of the listing itself is closed by now
  const auto closed = [](const Open& open) {
    struct stat what {};
    return fstat(open.number, &what) != 0;
  };
  of_.erase(std::remove_if(of_.begin(), of_.end(), closed), of_.end());
}

std::string OpenDescriptors::closed() const {
  for (const Open& open : of_) {
    struct stat now {};
    if (fstat(open.number, &now) != 0 || now.st_dev != open.device || now.st_ino != open.file)
      return "closed a file of the program";
  }
  return "";
}

void check_foreign_code(const OpenDescriptors* before) {
  if (libraries == 0 || !armed) return;
  std::string did = before ? before->closed() : "";
  struct stat now {};
  for (int i = 0; i < 3; ++i)
    if (own_streams[i].st_ino != 0 && (fstat(i, &now) != 0 || !same_file(now, own_streams[i])))
      did = "closed the standard " + std::string(i == 0 ? "input" : i == 1 ? "output" : "error output");
  if (own_folder.st_ino != 0 && (stat(".", &now) != 0 || !same_file(now, own_folder)))
    did = "changed the working folder, in which files would be written";
  if (std::fegetround() != own_rounding) did = "changed the rounding mode, in which all numbers are computed";
  if (!did.empty()) end_with_error(loaded_libraries() + " has " + did, 1);
}

void end_with_error(const std::string& message, int code) {
  armed = false;
  std::fflush(stdout);
  end({"error: ", message.c_str()}, code);
}

}  // namespace mudline

// The program exports these functions, so that calls of them in libraries that are loaded later come here. The C
// library itself uses other names.
extern "C" {
[[noreturn]] void _exit(int code) {
  if (const char* library = mudline::foreign_caller()) mudline::end_for(library, "a call of _exit");
  mudline::leave(code);
}
[[noreturn]] void _Exit(int code) { _exit(code); }
}
