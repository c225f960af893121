#include "simulation/stage_end.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/told.hpp"
#include "simulation/excess_pressure.hpp"
#include "simulation/model.hpp"
#include "simulation/output/history_file.hpp"

namespace mudline {

namespace {

/// A body that has moved faster moves more slowly than a speed, and would so after another step: where it turns back,
/// it is not at rest.
class AtRest : public StageEnd {
 public:
  void parameters(Parameters& p) {
    p.required("body", body_, "the body whose reference point is looked at");
    p.required(
        "speed", speed_, "m/s", positive(),
        "below this the body is at rest, if its acceleration over a step does not lift it above this; it must have "
        "been faster before");
  }
  void bind(const Model& model, const Section& section) override { model.body(body_, section, "body"); }
  double measure(const RunView& run, const std::vector<HistoryValue>&) const override {
    const RigidBody& body = *run.model.bodies().at(body_);
    return length(body.velocity(run.state)) + run.dt * length(body.acceleration(run.state));
  }
  bool reached(double now, double largest) const override { return now < speed_ && largest >= speed_; }
  std::string told_end(double now, double) const override {
    return "body '" + body_ + "' moves with less than " + told(now, "%.3g m/s");
  }

 private:
  std::string body_;
  double speed_ = 0;
};

/// The highest excess pore pressure anywhere has fallen to a share of the highest one in the stage.
class Dissipated : public StageEnd {
 public:
  void parameters(Parameters& p) {
    p.required("share", share_, "-", open(0, 1),
               "of the highest excess pore pressure of the stage: 0.9 ends it where a tenth is left");
  }
  void bind(const Model& model, const Section& section) override {
    if (!model.soil() || model.soil()->pressure < 0) section.fail("the model has no pore pressure", "type");
  }
  double measure(const RunView& run, const std::vector<HistoryValue>&) const override {
    return std::abs(run.pressure.highest().pressure);
  }
  bool reached(double now, double largest) const override { return largest > 0 && now <= (1 - share_) * largest; }
  std::string told_end(double now, double largest) const override {
    return "highest excess pore pressure " + told(largest / 1e3, "%.3g") + " -> " + told(now / 1e3, "%.3g kPa");
  }

 private:
  double share_ = 0;
};

/// A column of the history rises or falls to a value, or has passed its peak.
class ColumnReaches : public StageEnd {
 public:
  void parameters(Parameters& p) {
    p.required("column", column_, "name of a column of the history, without its unit: contact/pile/reaction y");
    p.add(rises, rises_to_, "the column's unit", any(), "the stage ends when the column is at this value or above");
    p.add(falls, falls_to_, "the column's unit", any(), "the stage ends when the column is at this value or below");
    p.add("falls by", falls_by_, "-", open(0, 1),
          "the stage ends when the column's magnitude has fallen by this share of its peak in the stage: 0.05");
  }
  void bind(const Model&, const Section& section) override {
    for (const char* entry : {rises, falls, "falls by"})
      if (section.has_parameter(entry)) given_.push_back(entry);
    if (given_.size() != 1)
      section.fail("needs one of 'rises to', 'falls to' and 'falls by'" +
                   (given_.empty() ? "" : "; it has '" + join(given_, "' and '") + "'"));
    section_ = section;
  }
  bool needs_columns() const override { return true; }
  void check(const std::vector<HistoryValue>& row) override {
    const HistoryValue* const value = find_value(row, column_);
    if (value == nullptr) {
      std::vector<std::string> known;
      for (const HistoryValue& other : row) known.push_back(other.name);
      const std::string near = nearest(column_, known);
      section_->fail("'" + column_ + "' is no column of the history" +
                         (near.empty() ? "; the first line of the .csv names them" : " (did you mean '" + near + "'?)"),
                     "column");
    }
    unit_ = value->unit;
    if (given_.front() == "falls by") return;
    const auto* const quantities = section_->quantities(given_.front());
    if (quantities == nullptr || !quantities->front()) return;
    try {
      (given_.front() == rises ? rises_to_ : falls_to_) = number_in(unit_, *quantities->front());
    } catch (const InputError& error) {
      section_->fail(error.what(), given_.front());
    }
  }
  double measure(const RunView&, const std::vector<HistoryValue>& row) const override {
    const HistoryValue* const value = find_value(row, column_);
    return value == nullptr ? 0.0 : value->value;
  }
  bool reached(double now, double largest) const override {
    if (given_.front() == "falls by") return std::abs(now) <= (1 - falls_by_) * largest;
    return given_.front() == rises ? now >= rises_to_ : now <= falls_to_;
  }
  std::string told_end(double now, double largest) const override {
    const std::string present = column_ + " " + told(now, "%.6g ") + unit_;
    return given_.front() == "falls by" ? present + " after a peak of " + told(largest, "%.6g ") + unit_ : present;
  }

 private:
  static constexpr const char* rises = "rises to";
  static constexpr const char* falls = "falls to";

  std::string column_, unit_;
  double rises_to_ = 0, falls_to_ = 0, falls_by_ = 0.05;
  std::vector<std::string> given_;  // which of the three
  std::optional<Section> section_;  // of the deck
};

}  // namespace

void register_stage_ends(Registry<StageEnd>& registry) {
  registry.add<AtRest>("at rest", "a body that has moved comes to rest");
  registry.add<Dissipated>("dissipated", "a share of the excess pore pressure is dissipated (degree of consolidation)");
  registry.add<ColumnReaches>(
      "history", "a column of the history (force, depth, pressure) reaches a value, or its peak is passed");
}

}  // namespace mudline
