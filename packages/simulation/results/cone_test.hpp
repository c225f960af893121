#pragma once

#include <string>
#include <vector>

#include "simulation/filter.hpp"
#include "simulation/observer.hpp"

namespace mudline {

/// What a cone penetration test measures, and what follows from it, in columns of the history and in the results:
/// net cone resistance, excess pore pressures at up to three filters (u1 on the cone's face, u2 behind its shoulder, u3
/// behind the sleeve), pore pressure ratio B_q, cone factor N_kt, and from the dissipation of u2 the coefficient of
/// consolidation c_h (Teh and Houlsby 1991, Geotechnique 41, 17-34).
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
  void follow_dissipation(const RunView& run, const std::string& filter, bool moves, ResultTable& to) const;

  std::string body_;
  Function strength_, overburden_;
  double height_ = FilterSettings().height;  // [m] of every filter
  double rigidity_ = 0;
  double area_ = 0;                       // [m2] of the cone's section
  std::string reaction_;                  // column of the force on the cone
  std::vector<FilterSettings> settings_;  // of those filters that the deck gives
  std::vector<Filter> filters_;           // they, on the run's present mesh
};

}  // namespace mudline
