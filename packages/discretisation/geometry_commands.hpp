#pragma once

#include <string>
#include <vector>

namespace mudline {

/// How Gmsh will treat a file.
enum class GmshContent {
  data,     // a mesh or a CAD model: nothing in it is executed
  commands  // a geometry or options: an executed script
};

/// Decides by the first bytes (meshes) and the extension (CAD models), as Gmsh itself does.
GmshContent gmsh_content(const std::string& file);

/// The first command by which a file, or one that it includes, merges or brings along (its .opt file), would write
/// files, start programs or end Gmsh: "plate.geo:4: 'Save' writes a file"; "" where there is none. Comments and strings
/// are no commands. Where Gmsh might read a passage in two ways (it goes back in the file at loops and macros, and
/// looks for the end of a condition in strings and comments too) both readings count.
std::string system_command(const std::string& file);

/// The file itself and those that it includes, merges or brings along, as far as their names are constant.
std::vector<std::string> files_reached(const std::string& file);

/// Allows files for Gmsh to contain such commands (`--allow-commands`). Like the log level, this holds for the whole
/// program.
void permit_commands(bool permitted);
bool commands_permitted();

}  // namespace mudline
