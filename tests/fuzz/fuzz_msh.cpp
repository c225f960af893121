// fuzz_msh SECONDS SEED mesh.msh...: mutated mesh files of Gmsh's formats 1 to 2.2 are either read and make a mesh, or
// are refused in one line.
#include "discretisation/distribute.hpp"
#include "discretisation/mesh_topology.hpp"
#include "discretisation/old_msh_file.hpp"
#include "fuzz.hpp"

namespace {

using namespace mudline;

const std::vector<std::string> words{"$Nodes\n",
                                     "$EndNodes\n",
                                     "$Elements\n",
                                     "$EndElements\n",
                                     "$PhysicalNames\n",
                                     "$MeshFormat\n2.2 1 8\n",
                                     "$Comments\n",
                                     "$NOD\n",
                                     "\n",
                                     "\r\n",
                                     "\"",
                                     " 17 ",
                                     " -1 ",
                                     " 99999999999999999999 ",
                                     " 2147483648 ",
                                     "1e999",
                                     "-nan",
                                     "\xff",
                                     std::string(1, '\0')};

std::string read_mesh(const std::string& text) {
  const std::string file = "fuzz_input.msh";
  std::ofstream(file, std::ios::binary) << text;
  if (!is_old_msh(file)) return "";
  for (const int dimension : {2, 3})
    for (const int order : {1, 2}) {
      const std::string fault = fuzz::fault_of([&] {
        const GlobalMesh mesh = global_mesh(read_old_msh(file, dimension), order, dimension);
        check_mesh(mesh, dimension == 2 ? Geometry::plane_strain : Geometry::space);
        check_seams(mesh, {});
        return std::string();
      });
      if (!fault.empty()) return fault;
    }
  return "";
}

}  // namespace

int main(int argc, char** argv) {
  return mudline::fuzz::run_on_files(argc, argv, "fuzz_msh", ".msh", words, read_mesh);
}
