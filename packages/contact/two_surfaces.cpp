#include "contact/two_surfaces.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "discretisation/mesh_topology.hpp"

namespace mudline {

void TwoSurfaceParameters::parameters(Parameters& p) {
  p.required("slave", slave, "Side set that looks for the other surface: the finer or the softer one");
  p.required("master", master, "Side set that it looks for");
  EnforcementParameters::parameters(p);
  p.add("capture distance", capture_distance, "m", non_negative(),
        "What is farther from the other surface, or deeper in it, does not see it; 0: the slave's longest side");
  p.add("reach", reach, "m", non_negative(),
        "Pieces of the surfaces that are farther apart than this at the start never meet: keeps the matrix sparse "
        "where surfaces slide little; "
        "0: any two may meet; in space 0: three times the slave's longest side");
  p.add("advance limit", advance_limit, "-", positive(),
        "Largest approach of the surfaces in one step, as a fraction of the slave's shortest side; while they are far "
        "apart, half their distance");
  p.add("damping", damping, "s/m", non_negative(), damping_documentation);
  p.add("slave heat share", heat_share, "-", closed(0, 1),
        "In a model with temperature: share of the heat of friction that warms the slave; the rest warms the master");
  ContactLaws::declare_normal_law(p);
}

void check_two_sets(const Mesh& mesh, int dimension, const Section& section, const std::string& slave,
                    const std::string& master) {
  if (mesh.dimension() != dimension)
    section.fail(dimension == 2
                     ? "is for the plane; allowed in space for two deformable surfaces: point to face"
                     : "is for space; allowed in the plane for two deformable surfaces: node to segment, mortar",
                 "type");
  require_boundary(mesh, section, "slave", slave);
  require_boundary(mesh, section, "master", master);
  if (slave == master)
    section.fail("is '" + slave + "', the slave too: a surface does not touch itself; name two sets", "master");
  const auto &first = mesh.nodes_of_set(slave), &second = mesh.nodes_of_set(master);
  std::vector<int> both;
  std::set_intersection(first.begin(), first.end(), second.begin(), second.end(), std::back_inserter(both));
  const int here = static_cast<int>(both.size());
  int any = 0;
  Teuchos::reduceAll(*mesh.comm(), Teuchos::REDUCE_MAX, here, Teuchos::outArg(any));
  if (any > 0)
    section.fail(
        "'" + master + "' shares nodes with the slave '" + slave + "': surfaces that may part need nodes of their own",
        "master");
  for (const auto& [entry, set] : {std::pair<std::string, std::string>{"slave", slave}, {"master", master}}) {
    const long long local = static_cast<long long>(mesh.side_sets().at(set).size());
    long long all = 0;
    Teuchos::reduceAll(*mesh.comm(), Teuchos::REDUCE_SUM, local, Teuchos::outArg(all));
    if (all == 0) section.fail("side set '" + set + "' has no sides", entry);
  }
}

void check_heat_share(const ContactContext& context, const Section& section, const ContactLaws& laws) {
  const char* const entry = "slave heat share";
  if (!section.has_parameter(entry)) return;
  if (!laws.friction()) section.fail("has a meaning only with 'friction', which makes the heat", entry);
  if (context.space.find("temperature") < 0) section.fail("needs a model with the field 'temperature'", entry);
}

void check_overlap_of_two(const ContactSurface& slave, const Section& section, const std::string& name,
                          double least_gap) {
  const Mesh& mesh = slave.mesh();
  double everywhere = 0;
  Teuchos::reduceAll(*mesh.comm(), Teuchos::REDUCE_MIN, least_gap, Teuchos::outArg(everywhere));
  const double edge = slave.shortest(mesh.coordinates());
  if (-everywhere <= 0.5 * edge) return;
  char text[200];
  std::snprintf(
      text, sizeof text,
      "' overlaps the master by %.4g m at the start, more than half of its shortest side, %.4g m; move one of the two",
      -everywhere, edge);
  section.fail("surface '" + name + text, "slave");
}

double closing_limit(const Space& space, const ContactSurface& slave,
                     const std::vector<MasterSurface::MasterSide>& master, double advance_limit,
                     const State& committed) {
  const auto& first = space.node_dof(space.find("displacement"));
  const ConstCoordinateView& x = committed.coordinates;
  const int axes = slave.mesh().dimension();
  const auto velocity = [&](int node) {
    Point v{};
    for (int i = 0; i < axes; ++i) v[i] = committed.rate(first(node) + i);
    return v;
  };
  // speeds are relative to the master's mean. It is the same on all ranks that have slave sides, since these have the
  // whole master
  Point mean{};
  double nodes = 0, fastest[2] = {0, 0}, nearest = 1e300;
  for (const auto& side : master)
    for (int a = 0; a < side.count; ++a, ++nodes) mean += velocity(side.node[a]);
  mean = 1 / std::max(1.0, nodes) * mean;
  const auto speed = [&](int node) { return length(velocity(node) - mean); };
  for (const SurfaceSide& side : slave.sides()) {
    for (int a = 0; a < side.count; ++a) fastest[0] = std::max(fastest[0], speed(side.node[a]));
    const auto box = side_box(side.node, side.count, x);
    for (const auto& other : master) {
      const auto there = side_box(other.node, other.count, x);
      Point apart;
      for (int i = 0; i < 3; ++i) apart[i] = std::max({0.0, there.low[i] - box.high[i], box.low[i] - there.high[i]});
      nearest = std::min(nearest, length(apart));
    }
  }
  if (!slave.sides().empty())
    for (const auto& side : master)
      for (int a = 0; a < side.count; ++a) fastest[1] = std::max(fastest[1], speed(side.node[a]));
  const Teuchos::Comm<int>& comm = *slave.mesh().comm();
  double largest[2], least = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, 2, fastest, largest);
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, nearest, Teuchos::outArg(least));
  const double closing = largest[0] + largest[1];
  return closing > 0 ? std::max(advance_limit * slave.shortest(x), 0.5 * least) / closing : 1e300;
}

std::string beyond_reach_hint(const Comm& comm, const std::string& name, bool here) {
  const int mine = here ? 1 : 0;
  int any = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(any));
  return any == 0
             ? ""
             : "surfaces of contact '" + name + "' met that were farther apart at the start than its 'reach': raise it";
}

SlaveSums report_slave(const Comm& comm, int axes, const std::string& contact, const TwoSurfaceParameters& deck,
                       const SlaveSums& here, Report& values) {
  constexpr int sums = 7;
  const double local[sums] = {here.force[0], here.force[1], here.force[2], here.area,
                              here.slides,   here.heat,     here.damped};
  double sum[sums];
  SlaveSums all;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, sums, local, sum);
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, here.deepest, Teuchos::outArg(all.deepest));
  all.force = {sum[0], sum[1], sum[2]};
  all.area = sum[3];
  all.slides = sum[4];
  all.heat = sum[5];
  all.damped = sum[6];
  for (int i = 0; i < axes; ++i) values[contact + "/force on slave " + axis_names[i]] = {"N", all.force[i]};
  values[contact + "/contact area"] = {"m2", all.area};
  values[contact + "/maximum penetration"] = {"m", all.deepest};
  if (deck.damping > 0) values[contact + "/damping heat"] = {"J", all.damped};
  return all;
}

}  // namespace mudline
