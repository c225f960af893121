#pragma once

// Layout of meshes and fields in the HDF5 file; used by field_file.cpp only (it includes hdf5.h).
#include <string>
#include <vector>

#include "discretisation/mesh.hpp"
#include "simulation/output/hdf5_tools.hpp"
#include "simulation/output/id_order.hpp"
#include "simulation/output/whole_file.hpp"

namespace mudline::field_layout {

/// Global ids of this rank's elements, block after block, and of its owned nodes.
std::vector<long long> element_ids(const Mesh& mesh);
std::vector<long long> owned_ids(const Mesh& mesh);

/// Number of columns as stored: plane vectors get z = 0, other numbers stay.
int stored_components(int components);

/// Writes (own row, component) values as a dataset in the order of the ids. Collective.
h5::Handle write_rows(hid_t parent, const std::string& name, const std::vector<double>& values, int components,
                      const IdOrder& order);

/// Size of what write_mesh will write.
FileSize mesh_size(const Mesh& mesh);

/// Writes the group "mesh": topology, regions and reference coordinates. Returns the topology's length. Collective.
long long write_mesh(hid_t file, MPI_Comm comm, const Mesh& mesh, const IdOrder& nodes, const IdOrder& elements);

}  // namespace mudline::field_layout
