#pragma once

#include <map>
#include <string>
#include <vector>

#include "checks/doubts.hpp"
#include "simulation/model.hpp"
#include "simulation/observer.hpp"

namespace mudline {

/// Watches the penetration of contacts. Penetration into a soft penalty is a part of the body's displacement that does
/// not deform the soil, and an overlap of a good part of a side changes the geometry. Warns once per contact and stage,
/// and at the run's end.
///
/// Penetrations are compared with the displacement of the body's surface (or of the nodes of both surfaces) since the
/// stage began or, where they do not touch then, since they last did not. After a restart within a stage it is counted
/// from the restart.
class PenetrationWatch : public Observer {
 public:
  /// Declares its quantities, which belong to the section "plausibility".
  static void declare(Doubts& doubts);
  explicit PenetrationWatch(const Doubts& doubts) : doubts_(doubts) {}
  void begin_stage(const RunView& run) override;
  void step(const RunView& run) override { look(run, least_of_side); }
  void end_stage(const RunView& run) override { look(run, least_at_end); }
  /// Warns once more of the largest penetration of every contact that a warning named.
  void end_run(const RunView& run, RunEnd end) override;

 private:
  /// Change of the penetration, in lengths of a side, above which it is compared with the displacement: during a stage,
  /// and at its end. While a round body touches less than a side, its displacement only compresses the penalty spring,
  /// and before a plastic soil yields the spring is often softer than the soil; at a stage's end that does not count.
  static constexpr double least_of_side = 0.25, least_at_end = 0.05;
  struct Record {
    BodyPlacement placement;    // of the body
    std::vector<Point> places;  // [m] positions of the nodes of both surfaces
    double depth = 0;           // [m] penetration at that placement
    double displacement = 0;    // [m] largest displacement since
    bool told = false;          // there was a warning in this stage
    // the last warning: its quantity, the side's length [m], and the largest values since
    std::string quantity, over;
    double side = 0, worst = 0, worst_depth = 0, worst_time = 0;
    void keep(double depth, double share, double time);
  };
  /// Means over the sides on which the contact presses.
  struct Pressed {
    double side = 0, penalty = 0, stiffness = 0;  // [m] edges, [Pa/m], [Pa/m] M/h of the elements behind
  };
  /// `least`: change of the penetration over the side's length below which it is not compared with the displacement.
  void look(const RunView& run, double least);
  void look_at(const Model& model, const std::string& name, const Contact& contact, double depth, double least,
               Record& record);
  void start_record(const Model& model, const ContactPartners& partners, Record& record) const;
  std::vector<Point> places(const Model& model, const ContactPartners& partners) const;
  double displacement(const Model& model, const ContactPartners& partners, const Record& record) const;
  double shortest_side(const Model& model, const std::string& surface) const;
  Pressed pressed(const Model& model, const std::string& name, const Contact& contact) const;

  const Doubts doubts_;
  std::map<std::string, Record> records_;  // by contact
};

}  // namespace mudline
