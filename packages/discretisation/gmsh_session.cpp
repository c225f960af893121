#include "discretisation/gmsh_session.hpp"

#include <gmsh.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/errors.hpp"
#include "core/text.hpp"

namespace mudline {

namespace {

/// Gmsh between initialize and finalize. It keeps its log and the parameters of a geometry beyond finalize: both are emptied.
class GmshSession {
 public:
  GmshSession() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    // Errors go to the log only: an exception from within Gmsh's threaded meshing would end the program.
    gmsh::option::setNumber("General.AbortOnError", 0);
    gmsh::onelab::clear();
    gmsh::logger::start();
  }
  ~GmshSession() {
    try {
      gmsh::logger::stop();
      gmsh::finalize();
    } catch (...) {  // nothing of what was read depends on a clean end
    }
  }
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;
};

/// Names of the parameters that the open geometry defines, without those in which Gmsh describes itself.
std::vector<std::string> geometry_parameters() {
  std::vector<std::string> all, own;
  gmsh::onelab::getNames(all);
  for (const std::string& name : all)
    if (name.compare(0, 5, "Gmsh/") != 0 && name.compare(0, 7, "ONELAB/") != 0) own.push_back(name);
  return own;
}

bool ends_with_newline(const std::string& file) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  if (stream.tellg() <= 0) return false;
  stream.seekg(-1, std::ios::end);
  return stream.get() == '\n';
}

void override_parameters(const std::string& file, const GmshOverrides& overrides, const SourcePosition& position) {
  // The first reading, with the geometry's own values, tells which parameters there are.
  const std::vector<std::string> known = geometry_parameters();
  for (const auto& item : overrides)
    if (std::find(known.begin(), known.end(), item.first) == known.end())
      position.section()
          .section("parameters")
          .fail("unknown parameter '" + item.first + "' of '" + short_name(file) + "'; it defines " +
                    (known.empty() ? "none (DefineConstant with a Name)" : join(known)),
                item.first);
  gmsh::clear();
  for (const auto& [name, value] : overrides) gmsh::onelab::setNumber(name, {value});
  gmsh::open(file);
}

}  // namespace

bool is_gmsh_geometry(const std::string& file) { return std::filesystem::path(file).extension() == ".geo"; }

std::string short_name(const std::string& file) { return std::filesystem::path(file).filename().string(); }

std::string gmsh_error() {
  std::vector<std::string> lines;
  gmsh::logger::get(lines);
  const std::string mark = "Error: ";
  for (const std::string& line : lines)
    if (line.compare(0, mark.size(), mark) == 0) return trim(line.substr(mark.size()));
  return "";
}

void with_gmsh(const std::string& file, const SourcePosition& position, const std::function<void()>& work) {
  const GmshSession session;
  try {
    work();
  } catch (const InputError&) {
    throw;
  } catch (...) {  // Gmsh throws ints and texts, depending on its version; its log knows more
    const std::string error = gmsh_error();
    position.fail("Gmsh, reading '" + short_name(file) + "': " + (error.empty() ? "it gave no reason" : error), "file");
  }
}

void open_in_gmsh(const std::string& file, const GmshOverrides& overrides, const SourcePosition& position) {
  if (is_gmsh_geometry(file) && !ends_with_newline(file))
    position.fail("'" + short_name(file) + "' has no newline at its end, Gmsh would read nothing of it; add one", "file");
  gmsh::open(file);
  if (!overrides.empty()) override_parameters(file, overrides, position);
  const std::string error = gmsh_error();
  if (!error.empty()) position.fail("Gmsh, reading '" + short_name(file) + "': " + error, "file");
}

GmshOverrides gmsh_overrides(const Section& section, const std::string& file) {
  GmshOverrides result;
  const Section given = section.section("parameters");
  Parameters p(given);
  for (const std::string& name : given.parameter_names()) p.required(name, result[name], "-", any(), "");
  p.finish();
  if (!result.empty() && !is_gmsh_geometry(file)) {
    const std::string extension = std::filesystem::path(file).extension().string();
    given.fail("a " + extension + " file has no parameters; they need a .geo file");
  }
  return result;
}

}  // namespace mudline
