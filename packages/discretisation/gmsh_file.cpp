#include "discretisation/gmsh_file.hpp"

#include <filesystem>

namespace mudline {

bool is_gmsh_geometry(const std::string& file) { return std::filesystem::path(file).extension() == ".geo"; }

std::string short_name(const std::string& file) { return std::filesystem::path(file).filename().string(); }

void GmshFile::parameters(Parameters& p, const std::string& formats) {
  p.required_file("file", name, formats);
  p.passes_on("parameters", "Values for the geometry's named constants (DefineConstant with a Name), by these names");
  p.add("time limit", time_limit, "s", positive(), "Gmsh is given up when it has not finished after this time");
}

GmshOverrides gmsh_overrides(const Section& section, const std::string& file) {
  GmshOverrides result;
  const Section given = section.section("parameters");
  Parameters p(given);
  for (const std::string& name : given.parameter_names())
    p.required(name, result[name], "as the geometry says", any(), "");
  p.finish();
  if (!result.empty() && !is_gmsh_geometry(file)) {
    const std::string extension = std::filesystem::path(file).extension().string();
    given.fail("a " + extension + " file has no parameters; they need a .geo file");
  }
  return result;
}

}  // namespace mudline
