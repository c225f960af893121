#pragma once

#include <map>
#include <string>
#include <vector>

#include "simulation/doubts.hpp"
#include "simulation/model.hpp"

namespace mudline {

/// Watches how deep surfaces that should only touch lie in each other. A penalty gives way: of the way that a body has
/// come since it touched, what the contact gives way is no deformation of the soil, and a geometry that overlaps by a
/// good part of a side is another one. Warns once per contact and stage, and at the run's end.
///
/// The way is that of the body's surface (or of the nodes of both surfaces) since the stage began or, where it does not
/// touch then, since it last did not. A restart within a stage counts from the restart.
class PenetrationWatch {
 public:
  /// Its quantities, of the section "plausibility".
  static void declare(Doubts& doubts);
  explicit PenetrationWatch(const Doubts& doubts) : doubts_(doubts) {}
  /// `report`: of the contacts in the committed state. Collective, as look().
  void begin_stage(const Model& model, const Report& report);
  void look(const Model& model, const Report& report);
  void end_stage(const Model& model, const Report& report);
  /// The greatest that was warned of.
  void tell_end() const;

 private:
  struct Record {
    BodyPlacement placement;    // of the body
    std::vector<Point> places;  // of the nodes of both surfaces
    double depth = 0;           // [m] when they were there
    double way = 0;             // [m] greatest since
    bool told = false;          // in this stage: there was a warning
    // of the last warning: the quantity, the side's length [m], and the greatest since
    std::string quantity, over;
    double side = 0, worst = 0, worst_depth = 0, worst_time = 0;
    void keep(double depth, double share, double time);
  };
  /// What the sides are like where the contact presses.
  struct Pressed {
    double side = 0, penalty = 0, stiffness = 0;  // means: [m] edges, [Pa/m], [Pa/m] M/h of the elements behind
  };
  /// `least`: penetration over the side below which it is not compared with the way.
  void look(const Model& model, const Report& report, double least);
  void look_at(const Model& model, const std::string& name, const Contact& contact, double depth, double least,
               Record& record);
  void start_way(const Model& model, const ContactPartners& partners, Record& record) const;
  std::vector<Point> places(const Model& model, const ContactPartners& partners) const;
  double way(const Model& model, const ContactPartners& partners, const Record& record) const;
  double shortest_side(const Model& model, const std::string& surface) const;
  Pressed pressed(const Model& model, const std::string& name, const Contact& contact) const;

  const Doubts doubts_;
  std::map<std::string, Record> records_;  // by contact
};

}  // namespace mudline
