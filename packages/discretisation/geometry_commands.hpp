#pragma once

#include <string>
#include <vector>

namespace mudline {

/// What Gmsh will take a file for.
enum class GmshContent {
  data,     // a mesh or a CAD model: nothing in it is carried out
  commands  // a geometry or options: a script
};

/// By the first bytes (meshes) and the extension (CAD models), as Gmsh decides itself.
GmshContent gmsh_content(const std::string& file);

/// The first command by which a file, or one that it includes, merges or brings along, would write files, start
/// programs or end Gmsh: "plate.geo:4: 'Save' writes a file"; "" where there is none. Comments and texts are no
/// commands. Where Gmsh might read a stretch in two ways (it goes back in the file at loops and macros, and looks for
/// the end of a condition in texts and comments too) both count.
std::string system_command(const std::string& file);

/// The file itself and those that it includes, merges or brings along, as far as their names need no working out.
std::vector<std::string> files_reached(const std::string& file);

/// For the whole program, like the level of the log: files for Gmsh may contain such commands (`--allow-commands`).
void permit_commands(bool permitted);
bool commands_permitted();

}  // namespace mudline
