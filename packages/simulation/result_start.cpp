#include "simulation/result_start.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "ale/axial_section.hpp"
#include "ale/axial_transfer.hpp"
#include "algebra/raw_communicator.hpp"
#include "contact/point_rows.hpp"
#include "core/deck_changes.hpp"
#include "core/log.hpp"
#include "core/text.hpp"
#include "core/told.hpp"
#include "discretisation/agree.hpp"
#include "discretisation/mesh_topology.hpp"
#include "framework/surface_points.hpp"

namespace mudline {

namespace {

const std::string entry = "result";

/// A formula of a deck in space with the height called as in a plane deck.
std::string in_plane(std::string formula) {
  const auto letter = [&](std::size_t i) {
    return i < formula.size() && (std::isalnum(static_cast<unsigned char>(formula[i])) != 0 || formula[i] == '_');
  };
  for (std::size_t i = 0; i < formula.size(); ++i)
    if (formula[i] == 'z' && !(i > 0 && letter(i - 1)) && !letter(i + 1)) formula[i] = 'y';
  return formula;
}

/// What a contact's point bears, in the axisymmetric section.
struct SectionTraction {
  double radius, height;  // [m] its place
  double pressure;        // [Pa]
  double shear[2];        // [Pa] on the soil along the surface, as a vector: radial, upwards
  double slip;            // [m] path slid so far
};

/// The rows of a contact's points in the state.
struct ContactRows {
  int points, friction;  // handles; -1: there are none
  std::shared_ptr<const SurfacePoints> surface;

  ContactRows(const StateStore& store, const std::string& contact)
      : points(store.find(contact + "/points")), friction(store.find(contact + "/friction")) {
    if (points >= 0) surface = store.info(points).surface;
  }
  /// A row starts with a traction, see PointContact::first_act().
  void set(const State& to, int row, const Point& place, const SectionTraction& traction) const {
    to.arrays[points](row, PointRows::pressure_column) = traction.pressure;
    if (friction < 0) return;
    const Point shear = AxialSection(place).vector({traction.shear[0], traction.shear[1], 0});
    for (int i = 0; i < 3; ++i) to.arrays[friction](row, i) = shear[i];
    to.arrays[friction](row, PointRows::slip_column(3)) = traction.slip;
  }
};

/// The tractions at all points of a contact of the result, on every rank.
std::vector<SectionTraction> tractions(const ResultState& result, const ContactRows& rows, const Comm& comm) {
  constexpr int width = sizeof(SectionTraction) / sizeof(double);
  const State& state = result.state();
  const std::vector<Point> places = rows.surface->places(state.coordinates);
  std::vector<double> mine;
  for (std::size_t row = 0; row < places.size(); ++row) {
    const PointView& points = state.arrays[rows.points];
    double shear[2] = {}, slip = 0;
    if (rows.friction >= 0) {
      const PointView& friction = state.arrays[rows.friction];
      const double area = points(row, PointRows::area_column(2));
      for (int i = 0; i < 2 && area > 0; ++i) shear[i] = friction(row, PointRows::force_column(1) + i) / area;
      slip = friction(row, PointRows::slip_column(1));
    }
    mine.insert(mine.end(),
                {places[row][0], places[row][1], points(row, PointRows::pressure_column), shear[0], shear[1], slip});
  }
  std::vector<double> all = all_gather(comm, mine);
  std::vector<SectionTraction> result_rows(all.size() / width);
  for (std::size_t k = 0; k < result_rows.size(); ++k) {
    const double* from = &all[k * width];
    result_rows[k] = {from[0], from[1], from[2], {from[3], from[4]}, from[5]};
  }
  return result_rows;
}

/// The traction at a place of the section, between those of the two nearest points.
SectionTraction between(const std::vector<SectionTraction>& all, const Point& place) {
  const SectionTraction* nearest[2] = {};
  double away[2] = {1e300, 1e300};
  for (const SectionTraction& at : all) {
    const double here = std::hypot(at.radius - place[0], at.height - place[1]);
    if (here >= away[1]) continue;
    const int rank = here < away[0] ? 0 : 1;
    if (rank == 0) away[1] = away[0], nearest[1] = nearest[0];
    away[rank] = here, nearest[rank] = &at;
  }
  if (nearest[1] == nullptr || away[0] + away[1] == 0) return *nearest[0];
  const SectionTraction &a = *nearest[0], &b = *nearest[1];
  const double share = away[0] / (away[0] + away[1]);
  const auto mean = [&](double of_a, double of_b) { return (1 - share) * of_a + share * of_b; };
  return {place[0],
          place[1],
          mean(a.pressure, b.pressure),
          {mean(a.shear[0], b.shear[0]), mean(a.shear[1], b.shear[1])},
          mean(a.slip, b.slip)};
}

}  // namespace

ResultStart::ResultStart(const Section& deck) {
  const Section physics = deck.section("physics");
  for (const std::string& name : physics.section_names()) {
    const Section initial = physics.section(name).section("initial state");
    if (!initial.has_parameter(entry)) continue;
    section_ = std::make_unique<const Section>(initial);
    start_ = RunStart::named(initial, entry, initial.text(entry));
  }
}

void ResultStart::read(const RCP<const Comm>& comm, Geometry geometry, const Section& deck) {
  agree(*comm, [&] {
    start_.find(*section_, entry);
    if (geometry != Geometry::space)
      section_->fail("a result is turned into space; the geometry of this mesh is another one", "type");
  });
  result_ = std::make_unique<const ResultState>(start_.checkpoint(), comm);
  agree(*comm, [&] {
    if (result_->model().mesh().geometry() != Geometry::axisymmetric)
      section_->fail("the result must be axisymmetric: another one cannot be turned into space", entry);
    const Section bodies = deck.section("bodies");
    for (const auto& [name, body] : result_->model().bodies())
      if (bodies.has_section(name)) place(*body, bodies.section(name));
  });
}

void ResultStart::place(const RigidBody& old, const Section& body) const {
  const State& state = result_->state();
  const double height = old.position(state)[1];
  if (const double speed = length(old.velocity(state)); speed > 0)
    log::info("  body '" + old.name() + "' moved at " + told(speed, "%.3g m/s") +
              " in the result; here it starts at rest");
  if (!body.has_parameter("position")) {
    body.list().set("position", Teuchos::Array<double>(std::vector<double>{0, 0, height}));
    return;
  }
  Point given{};
  Parameters(body).add("position", given, "m", "");
  const double apart = std::hypot(given[0], given[1], given[2] - height);
  if (apart > 0.005 * old.shadow(old.placement(state), {0, 1, 0}).width)
    body.fail("the body stands at {0, 0, " + number_text(height) + "} m at the end of the result '" +
                  section_->text(entry) + "'; without a position it stands there here too",
              "position");
}

void ResultStart::keep_places(const Section& before, const Section& deck) {
  const Section was = before.section("bodies"), bodies = deck.section("bodies");
  for (const std::string& name : bodies.section_names()) {
    const Section body = bodies.section(name);
    if (!body.has_parameter("position") && was.has_section(name) && was.section(name).has_parameter("position"))
      body.list().setEntry("position", was.section(name).list().getEntry("position"));
  }
}

NodalView ResultStart::apply(Model& model, const Deck& deck) const {
  const RCP<const Comm>& comm = model.mesh().comm();
  const ResultState& result = *result_;
  agree(*comm, [&] { compare(result, model); });
  State& state = model.store().committed();
  const Soil &from = *result.model().soil(), &to = *model.soil();
  NodalView reference;
  try {
    AxialTransfer transfer({from, result.state()}, {to, state});
    transfer.transfer_points(result.model().store(), model.store());
    const Space &old = result.model().space(), &now = model.space();
    for (int field = 0; field < now.num_fields(); ++field) {
      const Field& what = now.field(field);
      if (field == to.displacement || what.support == Support::apart) continue;
      const int there = old.find(what.name);
      if (there < 0 || what.components != 1)
        log::warn("the field '" + what.name + "' starts as the deck says: the result has none to take it from");
      else
        transfer.transfer_field(there, result.state().value, field, state.value);
    }
    if (to.pressure >= 0) {
      reference = NodalView("reference pressure", state.value.extent(0));
      transfer.transfer_field(from.pressure, result.pressure().reference(), to.pressure, reference);
    }
    const AxialTransfer::Fit& fit = transfer.fit();
    log::info("  its soil turned by " + told(360 * fit.turn, "%.4g degrees") + "; grains " +
              told(100 * fit.grains, "%+.2g %%") + (fit.restored ? ", put right" : ""));
    if (fit.in_sides > 0.1)
      log::warn(told(fit.outside, "%.0f of ") + told(fit.points, "%.0f points") +
                " of the mesh lie outside the soil of the result, by up to " +
                told(fit.in_sides, "%.2g of a side of its cells") + " at " + place_text(fit.where, 3) +
                "; they take the state nearby");
    take_contacts(result, model);
  } catch (const InputError& error) {
    section_->fail(error.what(), entry);
  }
  warn_of_materials(result.deck(), deck);
  return reference;
}

void ResultStart::compare(const ResultState& result, const Model& model) const {
  if (!result.model().soil()) section_->fail("the result has no soil", entry);
  const Soil &from = *result.model().soil(), &to = *model.soil();
  if ((from.pressure >= 0) != (to.pressure >= 0))
    section_->fail(std::string("the result has ") + (from.pressure >= 0 ? "a" : "no") +
                       " pore pressure, the physics here has " + (to.pressure >= 0 ? "one" : "none"),
                   entry);
  if (from.excess != to.excess)
    section_->fail("pore pressures of the result are " +
                       std::string(from.excess ? "in excess of water at rest" : "total") + ", here they are not",
                   entry);
  const Point old = from.gravity(result.state().time), now = to.gravity(0);
  const double difference = std::hypot(old[0] - std::hypot(now[0], now[1]), old[1] - now[2]);
  if (difference > 1e-6 * std::max(length(old), length(now)))
    section_->fail("gravity is " + number_text(old[1]) + " m/s2 along y in the result, which becomes z; here it is {" +
                       number_text(now[0]) + ", " + number_text(now[1]) + ", " + number_text(now[2]) + "} m/s2",
                   entry);
  const auto list = [](const Soil& soil) {
    std::string text;
    for (const auto& material : soil.materials)
      text += (text.empty() ? "" : ", ") + material->name + " (" + material->law + ")";
    return text;
  };
  if (list(from) != list(to))
    section_->fail("the materials of the result are " + list(from) + "; here they are " + list(to), entry);
  for (const auto& [name, contact] : model.contacts())
    if (model.store().find(contact->name() + "/film") >= 0)
      section_->fail("contact '" + name + "' has a film, which cannot start from a result", entry);
}

void ResultStart::take_contacts(const ResultState& result, Model& model) const {
  const Comm& comm = *model.mesh().comm();
  for (const auto& [name, contact] : model.contacts()) {
    const ContactRows now(model.store(), contact->name()), old(result.model().store(), contact->name());
    if (now.points < 0 || old.points < 0) continue;
    if (model.store().find(contact->name() + "/initial gap") < 0)
      log::warn("contact '" + name +
                "' starts with the gaps of its geometry; with 'initial gap' = 'in-situ stress' it starts with the "
                "tractions of the result");
    const std::vector<SectionTraction> all = tractions(result, old, comm);
    const std::vector<Point> places = now.surface->places(model.store().committed().coordinates);
    for (std::size_t row = 0; row < places.size() && !all.empty(); ++row)
      now.set(model.store().committed(), static_cast<int>(row), places[row],
              between(all, AxialSection::place(places[row])));
  }
}

void ResultStart::warn_of_materials(const Deck& was, const Deck& now) const {
  std::vector<DeckChange> changes = deck_changes(was.list().sublist("materials"), now.list().sublist("materials"));
  const auto alike = [](const DeckChange& change) { return in_plane(change.now) == change.was; };
  changes.erase(std::remove_if(changes.begin(), changes.end(), alike), changes.end());
  if (!changes.empty()) log::warn("materials differ from those of the result: " + one_line(changes));
}

}  // namespace mudline
