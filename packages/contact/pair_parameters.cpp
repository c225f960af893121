// What the deck says of a pair of deformable surfaces, and binding it to the model.
#include <algorithm>

#include "contact/pair_contact.hpp"
#include "contact/two_surfaces.hpp"

namespace mudline {

void PairParameters::parameters(Parameters& p) {
  p.required("slave", slave, "Side set whose points look for the other surface: the finer or the softer one");
  p.required("master", master, "Side set that they look for");
  p.add("quadrature degree", quadrature_degree, "-", closed(1, 11), "Polynomial degree that the integration over a segment is exact for");
  p.add("penalty", penalty, "Pa/m", non_negative(), "Pressure per penetration; 0: penalty factor times the slave's stiffness over element size");
  p.add("penalty factor", penalty_factor, "-", positive(), "Automatic penalty: multiple of constrained modulus over element height");
  p.choice("enforcement", enforcement,
           {{"augmented Lagrangian", Enforcement::augmented_lagrangian}, {"penalty", Enforcement::penalty}},
           "augmented Lagrangian: multipliers carry the pressure, found by repeated solves of a step (Uzawa) until the gap tolerance "
           "is met; penalty: pressure = penalty times penetration");
  p.add("gap tolerance", gap_tolerance, "m", non_negative(),
        "Augmented Lagrangian: largest gap of the touching surface, weighted by the multipliers' shapes, and stretch where it "
        "sticks; 0: a millionth of the slave's shortest side");
  p.add("most augmentations", most_augmentations, "-", closed(1, 10000),
        "Augmented Lagrangian: solves of a step after the first; where these do not meet the gap tolerance, the step is cut");
  p.add("capture distance", capture_distance, "m", non_negative(),
        "Points that are farther from the other surface, or deeper in it, do not see it; 0: the slave's longest side");
  p.add("reach", reach, "m", non_negative(),
        "Pairs of sides that are farther apart than this at the start never meet: keeps the matrix sparse where surfaces slide little; "
        "0: any two may meet");
  p.add("advance limit", advance_limit, "-", positive(),
        "Largest approach of the surfaces in one step, as a fraction of the slave's shortest side; while they are far apart, half their distance");
}

namespace {
void friction_section(Parameters& p) {
  p.passes_on("friction", "Friction along the surface; 'type' names a friction law; absent: smooth surfaces");
}
}  // namespace

void PairContact::document(Parameters& p) {
  PairParameters().parameters(p);
  friction_section(p);
}

void PairContact::parameters(Parameters& p) {
  deck_.parameters(p);
  friction_section(p);
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
