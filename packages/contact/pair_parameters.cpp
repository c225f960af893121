// What the deck says of a pair of deformable surfaces, and binding it to the model.
#include <algorithm>

#include "contact/pair_contact.hpp"

namespace mudline {

void PairParameters::parameters(Parameters& p) {
  TwoSurfaceParameters::parameters(p);
  p.add("quadrature degree", quadrature_degree, "-", closed(1, 11),
        "Polynomial degree that the integration over a segment is exact for");
}

void PairContact::document(Parameters& p) {
  PairParameters().parameters(p);
  declare_friction(p);
}

void PairContact::parameters(Parameters& p) {
  deck_.parameters(p);
  declare_friction(p);
}

void PairContact::check(const Section& section) {
  name_ = section.name();
  const Space& space = context_.space;
  const Mesh& mesh = space.mesh();
  displacement_ = space.find("displacement");
  if (displacement_ < 0) section.fail("contact needs a model with the field 'displacement'", "type");
  check_two_sets(mesh, section, deck_.slave, deck_.master);
  deck_.check(section);
  friction_ = friction_of_two(context_, section);
  slave_ = std::make_unique<ContactSurface>(space, deck_.slave, false, BodyUnknowns());
  master_ = std::make_unique<MasterSurface>(mesh, deck_.master);
  nodes_ = order(mesh.blocks().front().shape) + 1;
  axisymmetric_ = mesh.geometry() == Geometry::axisymmetric;
  rule_ = line_quadrature(deck_.quadrature_degree);
  gap_tolerance_ = deck_.gap_tolerance > 0 ? deck_.gap_tolerance : 1e-6 * slave_->shortest(mesh.coordinates());
  capture_ = slave_->longest(mesh.coordinates());
  check_overlap(section);
}

void PairContact::check_overlap(const Section& section) const {
  const Mesh& mesh = context_.space.mesh();
  const auto& x = mesh.coordinates();
  PairLaw look;
  look.nodes = nodes_;
  look.rule = rule_;
  look.capture = 4 * capture_;
  look.penalty = 1;
  double deepest = 0;
  master_->sort(x);
  PairForce force;
  for (std::size_t s = 0; s < slave_->sides().size(); ++s) {
    const SurfaceSide& side = slave_->sides()[s];
    const auto box = side_box(side.node, side.count, x);
    for (int m : master_->near(box, look.capture)) {
      const PairCoordinates at = coordinates({static_cast<int>(s), m, 0}, x);
      if (pair_segment(look, at, at, false, force)) deepest = std::min(deepest, force.sums.closest);
    }
  }
  check_overlap_of_two(*slave_, section, deck_.slave, deepest);
}

}  // namespace mudline
