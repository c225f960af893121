#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "discretisation/source_position.hpp"

namespace mudline {

/// Values for a geometry's named constants.
using GmshOverrides = std::map<std::string, double>;

/// Runs `work` with Gmsh open, silent and without the user's configuration files, so that a deck gives the same everywhere.
/// What Gmsh complains of becomes an InputError at the entry "file" of `position`.
void with_gmsh(const std::string& file, const SourcePosition& position, const std::function<void()>& work);

/// Opens a file within with_gmsh(), a geometry (.geo) with these values for its named constants. InputError for a file that
/// Gmsh cannot read, and for constants it does not have.
void open_in_gmsh(const std::string& file, const GmshOverrides& overrides, const SourcePosition& position);

/// Reads the sublist "parameters". InputError where the file is no geometry.
GmshOverrides gmsh_overrides(const Section& section, const std::string& file);

/// The first error that Gmsh has noted, in one line; "" when there is none.
std::string gmsh_error();

bool is_gmsh_geometry(const std::string& file);
/// A file's name without its folders.
std::string short_name(const std::string& file);

}  // namespace mudline
