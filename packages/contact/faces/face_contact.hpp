#pragma once

#include "contact/faces/master_faces.hpp"
#include "contact/pointwise_pair.hpp"

namespace mudline {

/// Deck entries of a point-to-face contact, besides friction.
struct FaceParameters : PointwiseParameters {
  void parameters(Parameters& p);

  int quadrature_degree = 4;  // exact for the pressure of a linear gap on quadratic triangles
};

/// Contact of two deformable surfaces in space: the Gauss points of the slave's sides against the master's
/// faces, whose normals are smoothed. Moments on both surfaces cancel except for the gap times the friction.
class FaceContact : public PointwisePairContact {
 public:
  explicit FaceContact(const ContactContext& context) : PointwisePairContact(context, deck_) {}
  static void document(Parameters& p) { declare_with_friction(p, FaceParameters()); }
  void parameters(Parameters& p) { declare_with_friction(p, deck_); }
  /// InputError for unknown, empty, equal or touching sets, deep overlap at the start, and multipliers. Collective.
  void check(const Section& section);

 private:
  FaceParameters deck_;
};

}  // namespace mudline
