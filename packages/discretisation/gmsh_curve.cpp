#include "discretisation/gmsh_curve.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cmath>

#include "core/text.hpp"
#include "discretisation/gmsh_session.hpp"

namespace mudline {

namespace {

std::vector<std::string> as_text(const std::vector<int>& tags) {
  std::vector<std::string> result;
  for (int tag : tags) result.push_back(std::to_string(tag));
  return result;
}

std::vector<int> tags_of_group(const std::string& name, const SourcePosition& position) {
  gmsh::vectorpair groups;
  gmsh::model::getPhysicalGroups(groups, 1);
  std::vector<int> tags;
  std::vector<std::string> known;
  for (const auto& [dimension, group] : groups) {
    std::string label;
    gmsh::model::getPhysicalName(dimension, group, label);
    if (label.empty()) label = std::to_string(group);
    known.push_back(label);
    if (label != name) continue;
    std::vector<int> entities;
    gmsh::model::getEntitiesForPhysicalGroup(dimension, group, entities);
    tags.insert(tags.end(), entities.begin(), entities.end());
  }
  if (tags.empty())
    position.fail("unknown physical curve '" + name + "'" + suggestion(name, known) + "; the model has " +
                      (known.empty() ? "none" : join(known)),
                  "physical curve");
  return tags;
}

std::vector<int> existing(const std::vector<int>& tags, const SourcePosition& position) {
  gmsh::vectorpair all;
  gmsh::model::getEntities(all, 1);
  std::vector<int> known;
  for (const auto& entity : all) known.push_back(entity.second);
  for (int tag : tags)
    if (std::find(known.begin(), known.end(), tag) == known.end())
      position.fail("the model has no curve " + std::to_string(tag) + "; it has " +
                        (known.empty() ? "none" : join(as_text(known))),
                    "curves");
  return tags;
}

class Curve {
 public:
  Curve(int tag, const SourcePosition& position) : tag_(tag), position_(position) {
    std::vector<double> low, high;
    gmsh::model::getParametrizationBounds(1, tag, low, high);
    from_ = low.at(0);
    to_ = high.at(0);
  }

  CadCurve read() const {
    std::string type;
    gmsh::model::getType(1, tag_, type);
    CadCurve result{tag_, CadCurve::Kind::general, {}, {}};
    if (type == "Line") {
      result.kind = CadCurve::Kind::line;
      result.points = {at(from_), at(to_)};
      return result;
    }
    if (type == "Circle" && equal_speed()) {
      result.kind = CadCurve::Kind::circle;
      for (int i = 0; i <= 3; ++i) result.points.push_back(at(from_ + (to_ - from_) * i / 3));
      return result;
    }
    result.runs = polynomial_runs([this](double t) { return at(t); }, from_, to_, 1e-11 * extent());
    if (result.runs.empty()) position_.fail("curve " + std::to_string(tag_) + " of '" + type + "' has a gap", "file");
    return result;
  }

 private:
  PlanePoint at(double t) const {
    std::vector<double> x;
    gmsh::model::getValue(1, tag_, {t}, x);
    if (std::abs(x.at(2)) > 1e-9 * std::max(std::abs(x[0]), std::abs(x[1])))
      position_.fail("curve " + std::to_string(tag_) + " is not in the x-y plane: it has a point at (" +
                         number_text(x[0]) + ", " + number_text(x[1]) + ", " + number_text(x[2]) + ")",
                     "file");
    return {x[0], x[1]};
  }
  double extent() const {
    double result = 0;
    const PlanePoint start = at(from_);
    for (int i = 1; i <= 16; ++i) {
      const PlanePoint here = at(from_ + (to_ - from_) * i / 16);
      result = std::max(result, std::hypot(here[0] - start[0], here[1] - start[1]));
    }
    return result;
  }
  /// Some versions of Gmsh call an ellipse of its own kernel a circle; the chords over equal steps tell them apart.
  bool equal_speed() const {
    double shortest = 1e300, longest = 0;
    PlanePoint before = at(from_);
    for (int i = 1; i <= 12; ++i) {
      const PlanePoint here = at(from_ + (to_ - from_) * i / 12);
      const double chord = std::hypot(here[0] - before[0], here[1] - before[1]);
      shortest = std::min(shortest, chord);
      longest = std::max(longest, chord);
      before = here;
    }
    return longest - shortest <= 1e-9 * longest;
  }

  int tag_;
  const SourcePosition& position_;
  double from_ = 0, to_ = 1;
};

}  // namespace

std::vector<CadCurve> read_gmsh_curves(const GmshFile& file, const CurveSelection& selection,
                                       const SourcePosition& position) {
  return with_gmsh<std::vector<CadCurve>>(file, position, [&] {
    open_in_gmsh(file, position);
    const auto tags =
        selection.group.empty() ? existing(selection.tags, position) : tags_of_group(selection.group, position);
    std::vector<CadCurve> result;
    for (int tag : tags) result.push_back(Curve(tag, position).read());
    return result;
  });
}

}  // namespace mudline
