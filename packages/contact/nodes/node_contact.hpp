#pragma once

#include "contact/nodes/smooth_surface.hpp"
#include "contact/pointwise_pair.hpp"

namespace mudline {

/// Deck entries of a node-to-segment contact, besides friction.
struct NodeParameters : PointwiseParameters {
  void parameters(Parameters& p);

  Drawing drawing = Drawing::hermite;
  double overhang = 0.1;  // [-] of the last piece
};

/// Contact of two deformable surfaces of the plane: the nodes of the slave, with their tributary areas, against the
/// master as it is drawn over its nodes. A node between two sides has two rows.
class NodeContact : public PointwisePairContact {
 public:
  explicit NodeContact(const ContactContext& context) : PointwisePairContact(context, deck_) {}
  static void document(Parameters& p) { declare_with_friction(p, NodeParameters()); }
  void parameters(Parameters& p) { declare_with_friction(p, deck_); }
  /// InputError for unknown, empty, equal or touching sets, and deep overlap at the start. Collective.
  void check(const Section& section);

 private:
  NodeParameters deck_;
};

}  // namespace mudline
