#pragma once

#include <memory>
#include <string>

#include "simulation/observer.hpp"
#include "simulation/probes.hpp"

namespace mudline {

/// What a cone penetration test measures, and what follows from it, in columns of the history and in the results:
/// net cone resistance, excess pore pressure u2 at the filter, pore pressure ratio B_q, cone factor N_kt, and from the
/// dissipation at the filter the coefficient of consolidation c_h (Teh and Houlsby 1991, Geotechnique 41, 17-34).
class ConeTest : public Observer {
 public:
  void parameters(Parameters& p);
  void bind(const Model& model, const Section& section) override;
  void begin_run(const RunView& run) override;
  void remeshed(const RunView& run) override;
  void report(const RunView& run, Report& to) override;
  void results(const RunView& run, ResultTable& to) override;

 private:
  std::string column(const std::string& quantity) const { return "cone/" + name + "/" + quantity; }
  /// Excess pore pressure at the filter [Pa]. Collective.
  double pressure_at_filter(const RunView& run) const;
  void follow_dissipation(const RunView& run, double pressure, bool moves, ResultTable& to) const;

  std::string body_;
  Function strength_, overburden_;
  Point filter_{};  // [m] at the start
  bool has_filter_ = false;
  double rigidity_ = 0;
  double area_ = 0;                 // [m2] of the cone's section
  std::string reaction_;            // column of the force on the cone
  std::unique_ptr<Probes> probes_;  // null: no filter
};

}  // namespace mudline
