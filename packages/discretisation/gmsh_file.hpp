#pragma once

#include <map>
#include <string>

#include "core/parameters.hpp"

namespace mudline {

/// Values for a geometry's named constants.
using GmshOverrides = std::map<std::string, double>;

/// A file for Gmsh and how it is to be read.
struct GmshFile {
  std::string name;
  GmshOverrides overrides;
  double time_limit = 600;  // [s]
  void parameters(Parameters& p, const std::string& formats);
};

/// Reads the sublist "parameters". Throws InputError where the file is no geometry.
GmshOverrides gmsh_overrides(const Section& section, const std::string& file);

bool is_gmsh_geometry(const std::string& file);
/// A file's name without its folders.
std::string short_name(const std::string& file);

}  // namespace mudline
