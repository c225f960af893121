#include "discretisation/gmsh_session.hpp"

#include <gmsh.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/child_process.hpp"
#include "core/errors.hpp"
#include "core/text.hpp"
#include "discretisation/geometry_commands.hpp"

namespace mudline {

namespace {

/// Names of the parameters that the open geometry defines, without Gmsh's own.
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

void override_parameters(const GmshFile& file, const SourcePosition& position) {
  // The first reading, with the geometry's own values, tells which parameters there are.
  const std::vector<std::string> known = geometry_parameters();
  for (const auto& item : file.overrides)
    if (std::find(known.begin(), known.end(), item.first) == known.end())
      position.section()
          .section("parameters")
          .fail("unknown parameter '" + item.first + "' of '" + short_name(file.name) + "'; it defines " +
                    (known.empty() ? "none (DefineConstant with a Name)" : join(known)),
                item.first);
  gmsh::clear();
  for (const auto& [name, value] : file.overrides) gmsh::onelab::setNumber(name, {value});
  gmsh::open(file.name);
}

/// Refuses a .msh file that is no mesh, and commands that change the system without the user's permission.
void refuse_commands(const GmshFile& file, const SourcePosition& position) {
  if (std::filesystem::path(file.name).extension() == ".msh" && gmsh_content(file.name) != GmshContent::data)
    position.fail("'" + short_name(file.name) + "' is no mesh of Gmsh: it does not begin with $MeshFormat", "file");
  if (commands_permitted()) return;
  const std::string found = system_command(file.name);
  if (!found.empty())
    position.fail(found + "; a file that makes a mesh must not do that. Take it out, or, if you trust the file, give " +
                      "--allow-commands on the command line",
                  "file");
}

}  // namespace

void start_gmsh() {
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  // Errors go to the log only: an exception from within Gmsh's threaded meshing would end the process.
  gmsh::option::setNumber("General.AbortOnError", 0);
  gmsh::logger::start();
}

std::string gmsh_error() {
  std::vector<std::string> lines;
  gmsh::logger::get(lines);
  const std::string mark = "Error: ";
  for (const std::string& line : lines)
    if (line.compare(0, mark.size(), mark) == 0) return trim(line.substr(mark.size()));
  return "";
}

std::vector<char> gmsh_process(const GmshFile& file, const SourcePosition& position,
                               const std::function<std::vector<char>()>& work) {
  const auto in_gmsh = [&] {
    start_gmsh();
    try {
      return work();
    } catch (const InputError&) {
      throw;
    } catch (const std::bad_alloc&) {
      throw;
    } catch (...) {  // Gmsh throws ints or strings, depending on its version; its log says more
      const std::string error = gmsh_error();
      position.fail("Gmsh, reading '" + short_name(file.name) + "': " + (error.empty() ? "it gave no reason" : error),
                    "file");
    }
  };
  refuse_commands(file, position);
  try {
    const bool confined = !commands_permitted();
    return in_child_process(in_gmsh, {file.time_limit, !confined, confined});
  } catch (const ChildLost& lost) {
    position.fail("Gmsh, reading '" + short_name(file.name) + "', " + lost.what() +
                      (lost.timed_out ? "; does a boundary cut itself? 'time limit' gives it more time" : ""),
                  "file");
  }
}

void open_in_gmsh(const GmshFile& file, const SourcePosition& position) {
  std::error_code ignored;
  if (std::filesystem::file_size(file.name, ignored) == 0)
    position.fail("'" + short_name(file.name) + "' is empty", "file");
  if (is_gmsh_geometry(file.name) && !ends_with_newline(file.name))
    position.fail("'" + short_name(file.name) + "' has no newline at its end, Gmsh would read nothing of it; add one",
                  "file");
  gmsh::open(file.name);
  if (!file.overrides.empty()) override_parameters(file, position);
  const std::string error = gmsh_error();
  if (!error.empty()) position.fail("Gmsh, reading '" + short_name(file.name) + "': " + error, "file");
}

}  // namespace mudline
