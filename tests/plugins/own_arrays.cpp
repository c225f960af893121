// Plugin: a physics "own arrays" with an array of each kind, which only declares and fills them. The history then has
// how far each is from what its rule promises on soil that deforms evenly: fields are those of the material's places X
// = x - u, and sums are kept.
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>

#include "discretisation/cell_map.hpp"
#include "framework/physics.hpp"
#include "framework/surface_points.hpp"
#include "framework/term_faces.hpp"
#include "physics/soil.hpp"
#include "simulation/plugin.hpp"

using namespace mudline;

namespace {

double linear(const Point& X) { return 3 - 2 * X[0] + 5 * X[1] + X[2]; }
double wavy(const Point& X) { return 1.5 + 0.3 * std::sin(7 * X[0]) * std::cos(5 * X[1]); }
double kind(const Point& X) { return X[0] < 0.5 ? 1 : 2; }
constexpr double border = 0.17;  // [m] nearer than this to the border of the kinds a row may have either

class OwnArrays : public Term, public Reports {
 public:
  OwnArrays(const Space& space, std::shared_ptr<Soil> soil) : space_(space), soil_(std::move(soil)) {}
  std::string name() const override { return "own arrays"; }
  Role role() const override { return Role::none; }

  void declare_state(StateStore& store) override {
    const Mesh& mesh = space_.mesh();
    const SoilBlock& b = soil_->blocks.front();
    const StateVariable origin{"origin", 1, "m"}, number{"kind", 1, "-", Transfer::nearest};
    const auto part = [](const char* name, const char* unit) { return StateVariable{name, 1, unit, Transfer::total}; };
    points_ = store.declare(ArrayInfo::at_points(
        "own points", {origin, number, part("content", "J"), {"ratio", 1, "-", Transfer::mass, 0.0}}, mesh, b.block,
        b.points));
    surface_ = std::make_shared<SurfacePoints>(mesh, "top", SurfacePoints::At::corners, 3);
    rows_ = store.declare(ArrayInfo::on_surface("own surface", {origin, number, part("heat", "J")}, surface_));
    nodes_ = store.declare(ArrayInfo::at_nodes("own nodes", {origin, number}, mesh));
    held_ = store.declare(ArrayInfo::at_nodes("own held", {part("force", "N")}, mesh, "bottom"));
    sum_ = store.declare(ArrayInfo::of_sum("own sum", {{"volume time", 1, "m3 s"}}));
    clock_ = store.declare(ArrayInfo::of_model("own clock", {{"time", 1, "s"}}));
    store_ = &store;
  }
  void start(State& state) const {
    const CoordinateView& x = state.coordinates;
    const PointView &points = state.arrays[points_], &rows = state.arrays[rows_], &nodes = state.arrays[nodes_];
    const SoilBlock& b = soil_->blocks.front();
    for (int row = 0; row < b.elements * b.points; ++row) {
      const Point X = b.place(row / b.points, row % b.points, x);
      points(row, 0) = linear(X);
      points(row, 1) = kind(X);
      points(row, 2) = wavy(X) * volume(row, x);
      points(row, 3) = wavy(X);
    }
    const std::vector<Point> places = surface_->places(x);
    const std::vector<double> areas = surface_->areas(x);
    for (std::size_t row = 0; row < places.size(); ++row) {
      rows(row, 0) = linear(places[row]);
      rows(row, 1) = kind(places[row]);
      rows(row, 2) = wavy(places[row]) * areas[row];
    }
    for (std::size_t row = 0; row < nodes.extent(0); ++row) {
      const Point X = place_of(x, store_->info(nodes_).nodes[row]);
      nodes(row, 0) = linear(X);
      nodes(row, 1) = kind(X);
    }
    const std::vector<int>& bottom = store_->info(held_).nodes;
    for (std::size_t row = 0; row < bottom.size(); ++row) state.arrays[held_](row, 0) = 1 + place_of(x, bottom[row])[0];
  }

  int residual(const StepView& view, const ResidualView&) override {
    if (view.kind != StepView::Kind::step) return 0;
    double whole = 0;
    for (int row = 0; row < rows_of_points(); ++row) whole += volume(row, view.x_old);
    view.trial->arrays[sum_](0, 0) = view.committed->arrays[sum_](0, 0) + view.dt * whole;
    view.trial->arrays[clock_](0, 0) = view.committed->arrays[clock_](0, 0) + view.dt;
    return 0;
  }
  void jacobian(const StepView&, Assembler&, double) override {}

  void histories(const StepView& view, Report& report) override {
    const State& state = *view.committed;
    const CoordinateView& x = state.coordinates;
    const CoordinateView X("places at the start", x.extent(0), x.extent(1));
    const auto& dof = space_.node_dof(soil_->displacement);
    for (std::size_t node = 0; node < x.extent(0); ++node)
      for (std::size_t i = 0; i < x.extent(1); ++i) X(node, i) = x(node, i) - state.value(dof(node) + i);
    Errors of_points, of_surface, of_nodes;
    const SoilBlock& b = soil_->blocks.front();
    const PointView &points = state.arrays[points_], &rows = state.arrays[rows_], &nodes = state.arrays[nodes_];
    double content = 0, grains = 0, whole = 0, heat = 0, force = 0;
    for (int row = 0; row < rows_of_points(); ++row) {
      of_points.add(b.place(row / b.points, row % b.points, X), points(row, 0), points(row, 1));
      content += points(row, 2);
      grains += volume(row, x) / (1 + points(row, 3));
      whole += volume(row, x);
    }
    const std::vector<Point> places = surface_->places(X);
    for (std::size_t row = 0; row < places.size(); ++row) {
      of_surface.add(places[row], rows(row, 0), rows(row, 1));
      heat += rows(row, 2);
    }
    for (std::size_t row = 0; row < nodes.extent(0); ++row)
      of_nodes.add(place_of(X, store_->info(nodes_).nodes[row]), nodes(row, 0), nodes(row, 1));
    for (std::size_t row = 0; row < state.arrays[held_].extent(0); ++row) force += state.arrays[held_](row, 0);
    report["own/points off"] = {"m", all(Teuchos::REDUCE_MAX, of_points.off)};
    report["own/points of a wrong kind"] = {"-", all(Teuchos::REDUCE_SUM, of_points.wrong)};
    report["own/surface off"] = {"m", all(Teuchos::REDUCE_MAX, of_surface.off)};
    report["own/surface of a wrong kind"] = {"-", all(Teuchos::REDUCE_SUM, of_surface.wrong)};
    report["own/nodes off"] = {"m", all(Teuchos::REDUCE_MAX, of_nodes.off)};
    report["own/nodes of a wrong kind"] = {"-", all(Teuchos::REDUCE_SUM, of_nodes.wrong)};
    report["own/content"] = {"J", all(Teuchos::REDUCE_SUM, content)};
    report["own/heat"] = {"J", all(Teuchos::REDUCE_SUM, heat)};
    report["own/force"] = {"N", all(Teuchos::REDUCE_SUM, force)};
    whole = all(Teuchos::REDUCE_SUM, whole);
    report["own/volume"] = {"m3", whole};
    report["own/grains"] = {"-", all(Teuchos::REDUCE_SUM, grains) / whole};
  }

 private:
  struct Errors {
    double off = 0, wrong = 0;
    void add(const Point& X, double origin, double number) {
      off = std::max(off, std::abs(origin - linear(X)));
      const bool is_kind = number == 1 || number == 2, clear = std::abs(X[0] - 0.5) > border;
      if (!is_kind || (clear && number != kind(X))) wrong += 1;
    }
  };
  double all(Teuchos::EReductionType operation, double mine) const {
    double result = 0;
    Teuchos::reduceAll(*space_.mesh().comm(), operation, mine, Teuchos::outArg(result));
    return result;
  }
  int rows_of_points() const { return soil_->blocks.front().elements * soil_->blocks.front().points; }
  template <int Dim>
  double volume_in(int row, const ConstCoordinateView& x) const {
    const SoilBlock& b = soil_->blocks.front();
    Mat<double, Dim> slope = {};
    for (int a = 0; a < b.u.nodes; ++a)
      for (int i = 0; i < Dim; ++i)
        for (int k = 0; k < Dim; ++k) slope[i][k] += x(b.nodes(row / b.points, a), i) * b.u.dN(row % b.points, a, k);
    return b.u.weights(row % b.points) * determinant(slope);
  }
  double volume(int row, const ConstCoordinateView& x) const {
    return x.extent(1) == 2 ? volume_in<2>(row, x) : volume_in<3>(row, x);
  }

  const Space& space_;
  std::shared_ptr<Soil> soil_;
  std::shared_ptr<const SurfacePoints> surface_;
  const StateStore* store_ = nullptr;
  int points_ = -1, rows_ = -1, nodes_ = -1, held_ = -1, sum_ = -1, clock_ = -1;
};

class OwnPhysics : public Physics {
 public:
  void parameters(Parameters&) {}
  std::vector<Field> fields() const override { return {}; }
  void build(PhysicsContext& context, const Section&) override {
    auto term = std::make_unique<OwnArrays>(context.space, context.shared.find<Soil>());
    arrays_ = term.get();
    context.terms.push_back(std::move(term));
  }
  void initialise(StateStore& store, const Section&) override { arrays_->start(store.committed()); }

 private:
  const OwnArrays* arrays_ = nullptr;
};

}  // namespace

MUDLINE_PLUGIN(registries) {
  registries.physics.add<OwnPhysics>("own arrays", "an array of each kind, and what is wrong with it");
}
