// What the deck says of a pair of deformable surfaces, and binding it to the model.
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cstdio>

#include "contact/pair_contact.hpp"

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
  require_side_set(mesh, section, "slave", deck_.slave);
  require_side_set(mesh, section, "master", deck_.master);
  if (deck_.slave == deck_.master) section.fail("is '" + deck_.slave + "', the slave too: a surface does not touch itself; name two sets", "master");
  if (!augmented())
    for (const char* entry : {"gap tolerance", "most augmentations"})
      if (section.has_parameter(entry))
        section.fail("has a meaning only with 'enforcement' = augmented Lagrangian; here it is penalty", entry);
  if (section.has_section("friction")) friction_ = context_.frictions.create(section.section("friction"));
  if (friction_ && friction_->effective() && space.find("pore pressure") >= 0)
    section.section("friction").fail("effective needs the pore pressure between two surfaces, which a pair does not know; allowed here: total", "on");
  slave_ = std::make_unique<ContactSurface>(space, deck_.slave, false, BodyUnknowns());
  master_ = std::make_unique<MasterSurface>(mesh, deck_.master);
  if (slave_->num_global_sides() == 0) section.fail("side set '" + deck_.slave + "' has no sides", "slave");
  if (master_->num_global_sides() == 0) section.fail("side set '" + deck_.master + "' has no sides", "master");
  check_sets(section);
  nodes_ = order(mesh.blocks().front().shape) + 1;
  axisymmetric_ = mesh.geometry() == Geometry::axisymmetric;
  rule_ = line_quadrature(deck_.quadrature_degree);
  gap_tolerance_ = deck_.gap_tolerance > 0 ? deck_.gap_tolerance : 1e-6 * slave_->shortest(mesh.coordinates());
  capture_ = slave_->longest(mesh.coordinates());
  check_overlap(section);
}

void PairContact::check_sets(const Section& section) const {
  const Mesh& mesh = context_.space.mesh();
  const auto &slave = mesh.nodes_of_set(deck_.slave), &master = mesh.nodes_of_set(deck_.master);
  std::vector<int> both;
  std::set_intersection(slave.begin(), slave.end(), master.begin(), master.end(), std::back_inserter(both));
  int here = static_cast<int>(both.size()), any = 0;
  Teuchos::reduceAll(*mesh.comm(), Teuchos::REDUCE_MAX, here, Teuchos::outArg(any));
  if (any > 0)
    section.fail("'" + deck_.master + "' shares nodes with the slave '" + deck_.slave + "': surfaces that may part need nodes of their own", "master");
}

void PairContact::check_overlap(const Section& section) const {
  const Mesh& mesh = context_.space.mesh();
  const auto& x = mesh.coordinates();
  PairLaw look;
  look.nodes = nodes_;
  look.rule = rule_;
  look.capture = 4 * capture_;
  look.penalty = 1;
  double deepest = 0, everywhere = 0;
  master_->sort(x);
  PairForce force;
  for (std::size_t s = 0; s < slave_->sides().size(); ++s) {
    const SurfaceSide& side = slave_->sides()[s];
    const auto box = side_box(side.node, side.count, x);
    for (int m : master_->near(box[0], box[1], look.capture)) {
      const PairCoordinates at = coordinates({static_cast<int>(s), m, 0}, x);
      if (pair_segment(look, at, at, false, force)) deepest = std::min(deepest, force.sums.closest);
    }
  }
  Teuchos::reduceAll(*mesh.comm(), Teuchos::REDUCE_MIN, deepest, Teuchos::outArg(everywhere));
  const double edge = slave_->shortest(x);
  if (-everywhere <= 0.5 * edge) return;
  char text[200];
  std::snprintf(text, sizeof text, "' overlaps the master by %.4g m at the start, more than half of its shortest side, %.4g m; move one of the two",
                -everywhere, edge);
  section.fail("surface '" + deck_.slave + text, "slave");
}

}  // namespace mudline
