#include "discretisation/gmsh_library.hpp"

#include <dlfcn.h>

#include <filesystem>

namespace mudline {

namespace {

const GmshLibrary* offered = nullptr;

// Gmsh's libraries look for their symbols in each other before they look in the program and its hundred libraries:
// loading takes 0.1 s instead of 0.3 s. The address sanitizer refuses that, and not every system has it.
#if defined(RTLD_DEEPBIND) && !defined(__SANITIZE_ADDRESS__)
constexpr int own_first = RTLD_DEEPBIND;
#else
constexpr int own_first = 0;
#endif

/// The library's file: beside the program, or in libexec/mudline of its installation; "": there is none.
std::string library_file() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  for (const char* place : {"mudline_gmsh.so", "../libexec/mudline/mudline_gmsh.so"})
    if (!error && std::filesystem::exists(folder / place, error)) return folder / place;
  return "";
}

}  // namespace

bool has_gmsh() { return offered != nullptr || !library_file().empty(); }

std::string needs_gmsh(const std::string& what) {
  return "'" + what + "' needs Gmsh, and this program was built without it (MUDLINE_GMSH=OFF)";
}

const GmshLibrary* find_gmsh_library(std::string& why) {
  if (offered) return offered;
  const std::string file = library_file();
  if (file.empty()) {
    why = "this program was built without Gmsh (MUDLINE_GMSH=OFF)";
  } else if (dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL | own_first) == nullptr) {  // else it has offered itself
    const char* const reason = dlerror();
    why = std::string("Gmsh cannot be loaded: ") + (reason ? reason : file.c_str());
  }
  return offered;
}

const GmshLibrary& gmsh_library(const SourcePosition& position) {
  std::string why;
  const GmshLibrary* const library = find_gmsh_library(why);
  if (!library) position.fail(why, "file");
  return *library;
}

void refuse_without_gmsh(const Parameters& p) {
  if (p.documenting() || has_gmsh()) return;
  const Section section = p.deck();
  section.fail(needs_gmsh(section.text("type")), "type");
}

void offer_gmsh_library(const GmshLibrary& library) { offered = &library; }

}  // namespace mudline
