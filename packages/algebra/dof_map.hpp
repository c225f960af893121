#pragma once

#include <Kokkos_Core.hpp>

#include <string>
#include <vector>

#include "algebra/types.hpp"

namespace mudline {

/// One nodal field as the dof map needs it.
struct FieldLayout {
  std::string name;  // "displacement", "pore pressure", ...
  int components;
  std::vector<GlobalOrdinal> node_ids;  // global ids of this rank's nodes that carry the field, owned ones first
  int num_owned;                        // how many of node_ids this rank owns
  bool apart = false;                   // true for a few unknowns that are not on the mesh
};

/// Numbering of all unknowns. Global ids are 0 .. N-1; each rank owns a contiguous range, field after field, the
/// components of a node adjacent. The overlap map is the owned dofs followed by those of shared (ghost) nodes.
class DofMap {
 public:
  DofMap(RCP<const Comm> comm, std::vector<FieldLayout> fields);

  int num_fields() const { return static_cast<int>(fields_.size()); }
  const FieldLayout& field(int f) const { return fields_[f]; }
  /// Index of the named field, -1 if absent.
  int find(const std::string& name) const;

  const RCP<const Map>& owned() const { return owned_; }
  const RCP<const Map>& overlap() const { return overlap_; }
  /// Import from the owned to the overlap map.
  const RCP<const Import>& import() const { return import_; }
  RCP<const Comm> comm() const { return owned_->getComm(); }

  /// Local (overlap) index of component 0 of the i-th node of field f; components follow.
  int dof(int f, int i) const {
    return i < fields_[f].num_owned ? owned_begin_[f] + i * fields_[f].components
                                    : ghost_begin_[f] + (i - fields_[f].num_owned) * fields_[f].components;
  }
  /// Owned range [begin, end) of field f in the owned vector.
  int owned_begin(int f) const { return owned_begin_[f]; }
  int owned_end(int f) const { return owned_begin_[f] + fields_[f].num_owned * fields_[f].components; }
  int num_owned_dofs() const { return static_cast<int>(num_owned_dofs_); }
  int num_overlap_dofs() const { return static_cast<int>(num_overlap_dofs_); }
  /// Field of a local (overlap) dof.
  int field_of(int dof) const { return field_of_[dof]; }
  /// The owned dofs of one field as a map of its own (local order as in the owned range, the same global ids).
  const RCP<const Map>& field_map(int f) const { return field_maps_[f]; }

 private:
  std::vector<FieldLayout> fields_;
  std::vector<int> owned_begin_, ghost_begin_, field_of_;
  std::size_t num_owned_dofs_ = 0, num_overlap_dofs_ = 0;
  RCP<const Map> owned_, overlap_;
  RCP<const Import> import_;
  std::vector<RCP<const Map>> field_maps_;
};

}  // namespace mudline
