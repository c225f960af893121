#pragma once

#include <functional>
#include <string>
#include <vector>

#include "discretisation/byte_stream.hpp"
#include "discretisation/gmsh_file.hpp"
#include "discretisation/source_position.hpp"

namespace mudline {

/// Runs `work`, which gives bytes, in a process of its own with Gmsh open, silent and without the user's configuration
/// files, so that a deck gives the same result everywhere. An error of Gmsh, a crash of it, and a call that does not
/// return within the file's time limit become an InputError at the entry "file" of `position`; so does a file with
/// commands that would change the system (geometry_commands.hpp), unless they are permitted. The process may write only
/// in a folder of its own.
std::vector<char> gmsh_process(const GmshFile& file, const SourcePosition& position,
                               const std::function<std::vector<char>()>& work);

/// Runs `work` as gmsh_process() does, with a result of any type that a ByteStream can write.
template <class Result, class Work>
Result with_gmsh(const GmshFile& file, const SourcePosition& position, Work&& work) {
  ByteStream stream(gmsh_process(file, position, [&] {
    Result result = work();
    ByteStream written;
    written(result);
    return written.bytes();
  }));
  Result result;
  stream(result);
  return result;
}

/// Opens Gmsh in a process that ends with its work: silent, without the user's configuration files.
void start_gmsh();

/// Opens a file within with_gmsh(), a geometry (.geo) with the values for its named constants. Throws InputError for a
/// file that Gmsh cannot read, and for constants that it does not have.
void open_in_gmsh(const GmshFile& file, const SourcePosition& position);

/// The first error that Gmsh has logged, in one line; "" when there is none.
std::string gmsh_error();

}  // namespace mudline
