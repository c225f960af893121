#pragma once

#include "discretisation/byte_stream.hpp"
#include "discretisation/mesh.hpp"

namespace mudline {

/// A whole mesh to bytes or back, without what contacts ask of it.
inline void transfer_mesh(ByteStream& s, GlobalMesh& mesh) {
  std::size_t blocks = mesh.blocks.size();
  s(blocks);
  mesh.blocks.resize(blocks);
  for (auto& block : mesh.blocks) s(block.region)(block.shape)(block.nodes);
  s(mesh.coordinates)(mesh.side_sets)(mesh.node_sets);
}

}  // namespace mudline
