#include "core/search_docs.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>
#include <sstream>

#include "core/errors.hpp"
#include "core/text.hpp"

namespace mudline {

namespace {

/// What practice calls by other names than the decks: words to the names that decks have.
const std::map<std::string, std::vector<std::string>>& other_names() {
  static const std::map<std::string, std::vector<std::string>> names{
      {"absorbing boundary", {"absorbing"}},
      {"adhesion factor", {"alpha"}},
      {"adhesion", {"coulomb", "strength"}},
      {"ale", {"mesh motion", "remeshing"}},
      {"alpha method", {"alpha", "coulomb"}},
      {"b_q", {"cone penetration test"}},
      {"bearing capacity", {"undrained strength", "friction angle"}},
      {"branch", {"start"}},
      {"c", {"cohesion"}},
      {"capacity", {"history", "prescribed velocity", "force"}},
      {"c_h", {"cone penetration test", "rigidity index"}},
      {"checkpoint", {"checkpoint steps"}},
      {"clay", {"modified cam clay", "s-clay1s", "tresca"}},
      {"coefficient of consolidation", {"cone penetration test", "rigidity index"}},
      {"consolidation", {"quasi-static", "hydraulic conductivity", "pore pressure"}},
      {"cpt", {"cone penetrometer"}},
      {"cu", {"undrained strength"}},
      {"cyclic load", {"cycles"}},
      {"cyclic", {"cycles"}},
      {"degree of consolidation", {"dissipated"}},
      {"dilatancy", {"dilation angle"}},
      {"dissipation test", {"cone penetration test", "dissipated", "held"}},
      {"dissipation", {"dissipated", "cone penetration test"}},
      {"drainage", {"pore pressure", "drainage"}},
      {"driven pile", {"flat pile"}},
      {"dt", {"time step"}},
      {"e", {"Young's modulus", "void ratio"}},
      {"e0", {"void ratio"}},
      {"elasticity", {"linear elastic", "neo-hookean"}},
      {"embedment", {"position", "tip height"}},
      {"encastre", {"fixed"}},
      {"g0", {"small-strain stiffness"}},
      {"gamma_0.7", {"small-strain stiffness"}},
      {"groundwater level", {"water level"}},
      {"groundwater", {"water level"}},
      {"inclined load", {"prescribed velocity", "force"}},
      {"infinite elements", {"absorbing"}},
      {"initial stress", {"initial state"}},
      {"interface", {"contacts", "friction", "coulomb"}},
      {"ir", {"rigidity index"}},
      {"jacked pile", {"flat pile"}},
      {"k", {"hydraulic conductivity", "permeability"}},
      {"kappa", {"swelling slope"}},
      {"lambda", {"compression slope"}},
      {"liquefaction", {"hypoplasticity"}},
      {"load test", {"prescribed velocity", "force"}},
      {"load", {"traction", "pressure", "force"}},
      {"lysmer", {"absorbing"}},
      {"m", {"critical stress ratio"}},
      {"mcc", {"modified cam clay"}},
      {"mohr coulomb", {"mohr-coulomb"}},
      {"n_kt", {"cone penetration test"}},
      {"newton", {"newton", "solver"}},
      {"nu", {"Poisson's ratio"}},
      {"ocr", {"overconsolidation ratio"}},
      {"paraview", {"output", "field interval"}},
      {"permeability", {"hydraulic conductivity", "constant", "kozeny-carman", "log-linear"}},
      {"phi", {"friction angle"}},
      {"phreatic level", {"water level"}},
      {"pile", {"flat pile"}},
      {"pinned", {"fixed"}},
      {"pop", {"preoverburden pressure"}},
      {"pore water pressure", {"pore pressure"}},
      {"psi", {"dilation angle"}},
      {"pull out", {"prescribed velocity", "film"}},
      {"pull-out", {"prescribed velocity", "film"}},
      {"pull-out capacity", {"history", "prescribed velocity"}},
      {"pullout", {"prescribed velocity", "film"}},
      {"pwp", {"pore pressure"}},
      {"quiet boundary", {"absorbing"}},
      {"rate effect", {"rate coefficient"}},
      {"rate effects", {"rate coefficient"}},
      {"rayleigh", {"mass damping", "stiffness damping"}},
      {"restart", {"checkpoint steps", "start"}},
      {"roller", {"fixed"}},
      {"rollers", {"fixed"}},
      {"roughness", {"coulomb", "friction"}},
      {"s_u", {"undrained strength"}},
      {"sand", {"mohr-coulomb", "drucker-prager", "hypoplasticity"}},
      {"set-up", {"held", "start", "branches"}},
      {"settlement", {"displacement", "fixed"}},
      {"setup", {"held", "start", "branches"}},
      {"shaft friction", {"coulomb", "friction"}},
      {"shear strength", {"undrained strength", "cohesion"}},
      {"skin friction", {"coulomb", "friction"}},
      {"step size", {"time step"}},
      {"su", {"undrained strength"}},
      {"support", {"fixed"}},
      {"supports", {"fixed"}},
      {"symmetry", {"fixed"}},
      {"t50", {"dissipated", "cone penetration test"}},
      {"t90", {"dissipated", "cone penetration test"}},
      {"teh and houlsby", {"cone penetration test", "rigidity index"}},
      {"terminal velocity", {"free", "drag coefficient"}},
      {"terzaghi", {"biot", "dissipated"}},
      {"undrained shear strength", {"undrained strength"}},
      {"unit weight", {"unit weight", "density", "grain density"}},
      {"user material", {"umat"}},
      {"viscous boundary", {"absorbing"}},
      {"water table", {"water level"}},
      {"weight", {"gravity", "density", "grain density"}},
      {"young", {"Young's modulus"}},
  };
  return names;
}

/// What one name stands for, in all places where it means the same.
struct Hit {
  std::string name, meaning, unit;
  std::vector<std::string> places;
  int score = 0;
};

class Search {
 public:
  explicit Search(const std::string& words) : whole_(lower_case(trim(words))) {
    std::istringstream text(whole_);
    words_.assign(std::istream_iterator<std::string>(text), {});
    const auto other = other_names().find(whole_);
    if (other != other_names().end()) others_ = other->second;
  }

  void look_at(const EntryDoc& entry) {
    behind_ = entry.name == "plausibility" ? 15 : entry.kind == "test" ? 5 : 0;
    const std::string place = entry.name + " (" + entry.kind + ")";
    add(entry.name, entry.summary, "", entry.kind, "", {});
    if (entry.kind != "section" && lower_case(entry.kind) == whole_) hit(place, entry.summary, "", "", 70);
    look_at(entry.parameters, entry.sections, place);
  }

  /// The nearest name of all that was looked at; "" if none is near.
  std::string nearest_name() const { return nearest(whole_, names_); }

  std::vector<Hit> best_first() {
    std::stable_sort(hits_.begin(), hits_.end(), [](const Hit& a, const Hit& b) { return a.score > b.score; });
    return hits_;
  }

 private:
  void look_at(const std::vector<ParameterDoc>& parameters, const std::vector<Parameters::SubsectionDoc>& sections,
               const std::string& place) {
    for (const ParameterDoc& doc : parameters) add(doc.name, doc.doc, doc.unit, "", place, doc.choices);
    for (const Parameters::SubsectionDoc& section : sections) {
      add(section.name, section.doc, "", "section", place, {});
      look_at(section.parameters, section.sections, place + ", " + section.name);
    }
  }

  /// Whether a word begins somewhere in the text; one of two letters must end there, too.
  static bool holds(const std::string& text, const std::string& word) {
    const auto in_word = [&](std::size_t i) {
      return i < text.size() && std::isalnum(static_cast<unsigned char>(text[i])) != 0;
    };
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
      if ((at == 0 || !in_word(at - 1)) && (word.size() > 2 || !in_word(at + word.size()))) return true;
    return false;
  }
  bool holds_all(const std::string& text) const {
    return whole_.size() > 1 &&
           std::all_of(words_.begin(), words_.end(), [&](const auto& word) { return holds(text, word); });
  }

  void add(const std::string& name, const std::string& meaning, const std::string& unit, const std::string& kind,
           const std::string& place, const std::vector<std::string>& choices) {
    const std::string bare = trim(name.substr(0, name.find('[')));  // without a unit
    const std::string here = lower_case(bare);
    const auto other = std::find(others_.begin(), others_.end(), bare);
    const auto choice =
        std::find_if(choices.begin(), choices.end(), [&](const auto& word) { return lower_case(word) == whole_; });
    names_.push_back(name);
    std::string shown = name + (kind.empty() || kind == "section" ? "" : " (" + kind + ")");
    int score = 0;
    if (here == whole_)
      score = 100;
    else if (other != others_.end())
      score = 90 - static_cast<int>(other - others_.begin());
    else if (holds_all(here))
      score = 60;
    else if (choice != choices.end()) {
      score = 65;
      shown += " = " + *choice;
    } else if (holds_all(here + " " + lower_case(meaning)))
      score = 20;
    if (score > 0) hit(shown, meaning, unit, place, score - behind_);
  }

  void hit(const std::string& name, const std::string& meaning, const std::string& unit, const std::string& place,
           int score) {
    for (Hit& known : hits_)
      if (known.name == name && known.meaning == meaning) {
        if (!place.empty()) known.places.push_back(place);
        return;
      }
    hits_.push_back({name, meaning, unit, {}, score});
    if (!place.empty()) hits_.back().places.push_back(place);
  }

  std::string whole_;
  std::vector<std::string> words_, others_, names_;
  std::vector<Hit> hits_;
  int behind_ = 0;  // what is taken off the scores of this entry
};

std::string line_of(const Hit& hit) {
  std::string line = hit.name;
  if (!hit.unit.empty() && hit.unit != "-" && hit.name.find('[') == std::string::npos) line += " [" + hit.unit + "]";
  if (!hit.places.empty()) line += ", in " + hit.places.front();
  if (hit.places.size() > 1) line += " and " + std::to_string(hit.places.size() - 1) + " more";
  return beginning(line + ": " + hit.meaning, 160);
}

}  // namespace

std::vector<std::string> search_docs(const std::vector<EntryDoc>& entries, const std::string& words, std::size_t most) {
  Search search(words);
  for (const EntryDoc& entry : entries) search.look_at(entry);
  const std::vector<Hit> hits = search.best_first();
  if (hits.empty()) {
    const std::string near = search.nearest_name();
    throw InputError("nothing is called '" + words + "', and no text of the reference holds it" +
                     (near.empty() ? "; `mudline list` shows all types" : " (did you mean '" + near + "'?)"));
  }
  const std::size_t shown = hits.size() > most ? most - 1 : hits.size();
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < shown; ++i) lines.push_back(line_of(hits[i]));
  if (shown < hits.size()) lines.push_back("and " + std::to_string(hits.size() - shown) + " more; name it closer");
  return lines;
}

}  // namespace mudline
