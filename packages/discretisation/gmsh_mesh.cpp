#include "discretisation/gmsh_mesh.hpp"

#include <gmsh.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/errors.hpp"
#include "core/text.hpp"
#include "discretisation/gmsh_model.hpp"

namespace mudline {

namespace {

/// Gmsh between initialize and finalize, silent and without the user's configuration files, so that a deck gives the
/// same mesh everywhere. Gmsh keeps its log and the parameters of a geometry beyond finalize: both are emptied.
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
    } catch (...) {  // nothing of the mesh depends on a clean end
    }
  }
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;

  /// The first error that Gmsh has noted, in one line; "" when there is none.
  static std::string error() {
    std::vector<std::string> lines;
    gmsh::logger::get(lines);
    const std::string mark = "Error: ";
    for (const std::string& line : lines)
      if (line.compare(0, mark.size(), mark) == 0) return trim(line.substr(mark.size()));
    return "";
  }
};

/// Names of the parameters that the open geometry defines, without those in which Gmsh describes itself.
std::vector<std::string> geometry_parameters() {
  std::vector<std::string> all, own;
  gmsh::onelab::getNames(all);
  for (const std::string& name : all)
    if (name.compare(0, 5, "Gmsh/") != 0 && name.compare(0, 7, "ONELAB/") != 0) own.push_back(name);
  return own;
}

bool is_geometry(const std::string& file) { return std::filesystem::path(file).extension() == ".geo"; }

std::string short_name(const std::string& file) { return std::filesystem::path(file).filename().string(); }

bool ends_with_newline(const std::string& file) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  if (stream.tellg() <= 0) return false;
  stream.seekg(-1, std::ios::end);
  return stream.get() == '\n';
}

}  // namespace

void GmshMesh::parameters(Parameters& p) {
  position_.remember(p);
  declare_geometry(p);
  p.required_file("file", file_, "Mesh (.msh of any version) or geometry (.geo, meshed at the start)");
  p.add("order", order_, "-", closed(1, 2), "Order of the elements; a .msh file must have it");
  p.passes_on("parameters", "Values for the geometry's named constants (DefineConstant with a Name), by these names");
}

void GmshMesh::check(const Section& section) {
  const std::string extension = std::filesystem::path(file_).extension().string();
  if (extension != ".geo" && extension != ".msh")
    section.fail("expected a .msh or .geo file, given '" + short_name(file_) + "'", "file");
  const Section given = section.section("parameters");
  Parameters p(given);
  for (const std::string& name : given.parameter_names()) p.required(name, overrides_[name], "-", any(), "");
  p.finish();
  if (!overrides_.empty() && !is_geometry(file_)) given.fail("a .msh file has no parameters; they need a .geo file");
}

GlobalMesh GmshMesh::generate() const {
  const GmshSession session;
  try {
    if (is_geometry(file_)) {
      open_geometry();
    } else {
      gmsh::open(file_);
    }
    const std::string error = GmshSession::error();
    if (!error.empty()) position_.fail("Gmsh, reading '" + short_name(file_) + "': " + error, "file");
    return read_model();
  } catch (const InputError&) {
    throw;
  } catch (...) {  // Gmsh throws ints and texts, depending on its version; its log knows more
    const std::string error = GmshSession::error();
    position_.fail("Gmsh, reading '" + short_name(file_) + "': " + (error.empty() ? "it gave no reason" : error),
                   "file");
  }
}

GlobalMesh GmshMesh::read_model() const {
  try {
    return read_gmsh_model(order_);
  } catch (const InputError& error) {
    position_.fail("'" + short_name(file_) + "': " + error.what(), "file");
  }
}

void GmshMesh::open_geometry() const {
  if (!ends_with_newline(file_))
    position_.fail("'" + short_name(file_) + "' has no newline at its end, Gmsh would read nothing of it; add one",
                   "file");
  gmsh::open(file_);
  override_parameters();
  if (!GmshSession::error().empty()) return;
  gmsh::model::mesh::generate(2);
  if (GmshSession::error().empty()) gmsh::model::mesh::setOrder(order_);
}

void GmshMesh::override_parameters() const {
  if (overrides_.empty()) return;
  // The first reading, with the geometry's own values, tells which parameters there are.
  const std::vector<std::string> known = geometry_parameters();
  for (const auto& item : overrides_)
    if (std::find(known.begin(), known.end(), item.first) == known.end())
      position_.section()
          .section("parameters")
          .fail("unknown parameter '" + item.first + "' of '" + short_name(file_) + "'; it defines " +
                    (known.empty() ? "none (DefineConstant with a Name)" : join(known)),
                item.first);
  gmsh::clear();
  for (const auto& [name, value] : overrides_) gmsh::onelab::setNumber(name, {value});
  gmsh::open(file_);
}

}  // namespace mudline
