#include "core/unit.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>

#include "core/errors.hpp"
#include "core/pi.hpp"
#include "core/text.hpp"
#include "core/written_number.hpp"

namespace mudline {

namespace {

constexpr double minute = 60, hour = 3600, day = 86400, year = 365.25 * day;

const std::map<std::string, Unit>& units() {
  const std::array<int, 6> none{}, metre{1}, kilogram{0, 1}, second{0, 0, 1}, kelvin{0, 0, 0, 1}, radian{0, 0, 0, 0, 1},
      celsius{0, 0, 0, 0, 0, 1}, newton{1, 1, -2}, pascal{-1, 1, -2}, joule{2, 1, -2}, watt{2, 1, -3};
  static const std::map<std::string, Unit> all{{"%", {0.01, none}},
                                               {"m", {1, metre}},
                                               {"km", {1e3, metre}},
                                               {"cm", {1e-2, metre}},
                                               {"mm", {1e-3, metre}},
                                               {"um", {1e-6, metre}},
                                               {"kg", {1, kilogram}},
                                               {"g", {1e-3, kilogram}},
                                               {"t", {1e3, kilogram}},
                                               {"Mg", {1e3, kilogram}},
                                               {"s", {1, second}},
                                               {"us", {1e-6, second}},
                                               {"ms", {1e-3, second}},
                                               {"min", {minute, second}},
                                               {"h", {hour, second}},
                                               {"hour", {hour, second}},
                                               {"hours", {hour, second}},
                                               {"d", {day, second}},
                                               {"day", {day, second}},
                                               {"days", {day, second}},
                                               {"week", {7 * day, second}},
                                               {"weeks", {7 * day, second}},
                                               {"month", {year / 12, second}},
                                               {"months", {year / 12, second}},
                                               {"a", {year, second}},
                                               {"year", {year, second}},
                                               {"years", {year, second}},
                                               {"N", {1, newton}},
                                               {"kN", {1e3, newton}},
                                               {"MN", {1e6, newton}},
                                               {"Pa", {1, pascal}},
                                               {"kPa", {1e3, pascal}},
                                               {"MPa", {1e6, pascal}},
                                               {"GPa", {1e9, pascal}},
                                               {"bar", {1e5, pascal}},
                                               {"J", {1, joule}},
                                               {"kJ", {1e3, joule}},
                                               {"MJ", {1e6, joule}},
                                               {"W", {1, watt}},
                                               {"kW", {1e3, watt}},
                                               {"K", {1, kelvin}},
                                               {"degC", {1, celsius}},
                                               {"rad", {1, radian}},
                                               {"deg", {pi / 180, radian}}};
  return all;
}

/// What is written for a unit of the map above, or how much one of it is.
const std::map<std::string, std::string>& foreign_units() {
  static const std::map<std::string, std::string> all{{"tonne", "t"},
                                                      {"tonnes", "t"},
                                                      {"sec", "s"},
                                                      {"second", "s"},
                                                      {"seconds", "s"},
                                                      {"mins", "min"},
                                                      {"minute", "min"},
                                                      {"minutes", "min"},
                                                      {"hr", "h"},
                                                      {"hrs", "h"},
                                                      {"yr", "year"},
                                                      {"yrs", "years"},
                                                      {"metre", "m"},
                                                      {"metres", "m"},
                                                      {"meter", "m"},
                                                      {"meters", "m"},
                                                      {"micron", "um"},
                                                      {"microns", "um"},
                                                      {"degree", "deg"},
                                                      {"degrees", "deg"},
                                                      {"degF", "5/9 K, and 32 degF are 0 degC"},
                                                      {"psi", "6.894757 kPa"},
                                                      {"ksi", "6.894757 MPa"},
                                                      {"psf", "47.88026 Pa"},
                                                      {"ksf", "47.88026 kPa"},
                                                      {"tsf", "95.76052 kPa"},
                                                      {"ft", "0.3048 m"},
                                                      {"feet", "0.3048 m"},
                                                      {"in", "25.4 mm"},
                                                      {"inch", "25.4 mm"},
                                                      {"inches", "25.4 mm"},
                                                      {"lb", "0.4535924 kg"},
                                                      {"lbs", "0.4535924 kg"},
                                                      {"lbf", "4.448222 N"},
                                                      {"kip", "4.448222 kN"},
                                                      {"kips", "4.448222 kN"},
                                                      {"kgf", "9.80665 N"},
                                                      {"pcf", "157.0875 N/m3"},
                                                      {"atm", "101.325 kPa"}};
  return all;
}

/// Reads a product of units from the front of a text.
class Product {
 public:
  explicit Product(const std::string& text) : text_(text) {}
  /// Nothing where a part is no unit.
  std::optional<Unit> read() {
    if (!read_product(1)) return {};
    return at_ == text_.size() ? std::optional<Unit>(unit_) : std::nullopt;
  }

 private:
  char next() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  void skip_blanks() {
    while (next() == ' ') ++at_;
  }
  bool read_product(int sign) {
    if (!read_factor(sign)) return false;
    for (;;) {
      const std::size_t before = at_;
      skip_blanks();
      if (next() == '\0' || next() == ')') return true;
      const bool divides = next() == '/';
      if (divides || next() == '*')
        ++at_;
      else if (at_ == before)
        return false;
      skip_blanks();
      if (!read_factor(divides ? -sign : sign)) return false;
    }
  }
  bool read_factor(int sign) {
    if (next() == '(') {
      ++at_;
      if (!read_product(sign) || next() != ')') return false;
      ++at_;
      return true;
    }
    std::size_t end = at_;
    while (end < text_.size() && std::isalpha(static_cast<unsigned char>(text_[end])) != 0) ++end;
    if (end == at_ && next() == '%') ++end;
    if (end == at_ && next() == '1') {  // as in 1/s
      ++at_;
      return true;
    }
    const auto found = units().find(text_.substr(at_, end - at_));
    if (found == units().end()) return false;
    at_ = end;
    const int power = sign * read_power();
    unit_.factor *= std::pow(found->second.factor, power);
    for (std::size_t k = 0; k < unit_.powers.size(); ++k) unit_.powers[k] += power * found->second.powers[k];
    return true;
  }
  /// The power that stands behind a unit; 1 where there is none.
  int read_power() {
    const std::size_t begin = at_;
    if (next() == '^') ++at_;
    const int sign = next() == '-' ? -1 : 1;
    if (sign < 0) ++at_;
    int power = 0, digits = 0;
    for (; digits < 2 && std::isdigit(static_cast<unsigned char>(next())) != 0; ++digits)
      power = 10 * power + (text_[at_++] - '0');
    if (digits > 0) return sign * power;
    at_ = begin;  // what stands there is no power
    return 1;
  }

  const std::string& text_;
  std::size_t at_ = 0;
  Unit unit_;
};

/// Where the number ends that the text begins with; 0: it begins with none.
std::size_t end_of_number(const std::string& text) {
  for (std::size_t end = text.size(); end > 0; --end)
    if (std::isdigit(static_cast<unsigned char>(text[end - 1])) != 0 || text[end - 1] == '.')
      if (parse_number(text.substr(0, end))) return end;
  return 0;
}

}  // namespace

double ValueWithUnit::plain() const {
  const Unit degree = units().at("deg");
  return number * (unit.powers == degree.powers ? unit.factor / degree.factor : unit.factor);
}

std::optional<Unit> parse_unit(const std::string& text) {
  const std::string whole = trim(text);
  if (whole == "-") return Unit();
  return Product(whole).read();
}

std::optional<ValueWithUnit> parse_quantity(const std::string& text) {
  const std::string whole = trim(text);
  const std::size_t end = end_of_number(whole);
  if (end == 0 || end == whole.size()) return {};
  const auto unit = parse_unit(whole.substr(end));
  if (!unit || whole.back() == '-') return {};
  return ValueWithUnit{*parse_number(whole.substr(0, end)), *unit, whole};
}

std::string unknown_unit(const std::string& text) {
  const std::string whole = trim(text);
  const std::size_t end = end_of_number(whole);
  if (end == 0 || end == whole.size() || parse_quantity(whole)) return "";
  const std::string rest = trim(whole.substr(end));
  if (std::isalpha(static_cast<unsigned char>(rest[0])) == 0) return "";
  std::size_t end_of_word = 0;
  while (end_of_word < rest.size() && std::isalpha(static_cast<unsigned char>(rest[end_of_word])) != 0) ++end_of_word;
  const auto foreign = foreign_units().find(rest.substr(0, end_of_word));
  if (foreign != foreign_units().end()) {
    const auto& [name, meant] = *foreign;
    const bool number = std::isdigit(static_cast<unsigned char>(meant[0])) != 0;
    return "; '" + name + "' is no unit" +
           (number ? ": 1 " + name + " is " + meant : " (did you mean '" + meant + "'?)");
  }
  std::vector<std::string> names;
  for (const auto& entry : units()) names.push_back(entry.first);
  const std::string near = nearest(rest, names);
  return "; '" + rest + "' is no unit" +
         (near.size() > 1 ? " (did you mean '" + near + "'?)" : "; allowed: " + join(names));
}

std::string why_no_number(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto first = static_cast<unsigned char>(text[i]);
    if (first < 0x80) continue;
    // UTF-8: the first byte tells how many follow, which have six bits of the character each
    const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    unsigned code = first & (0xffU >> (length + 1));
    for (std::size_t k = 1; k < length && i + k < text.size(); ++k)
      code = code << 6U | (static_cast<unsigned char>(text[i + k]) & 0x3fU);
    char name[16];
    std::snprintf(name, sizeof name, "U+%04X", code);
    return "; it holds '" + text.substr(i, length) + "' (" + name +
           "); numbers and units are written in plain ASCII, such as -1, m2, um, deg";
  }
  const std::string whole = trim(text);
  const std::size_t comma = whole.find(',');
  if (comma != std::string::npos && comma > 0 && comma == whole.rfind(',') && whole.find('(') == std::string::npos &&
      std::isdigit(static_cast<unsigned char>(whole[comma - 1])) != 0 &&
      std::isdigit(static_cast<unsigned char>(whole[comma + 1])) != 0)
    return "; decimals need a point";
  return unknown_unit(text);
}

std::vector<std::string> units_like(const std::string& declared) {
  std::vector<std::string> names;
  const auto unit = parse_unit(declared);
  for (const auto& [name, known] : units())
    if (unit && known.powers == unit->powers) names.push_back(name);
  return names;
}

double number_in(const std::string& declared, const ValueWithUnit& quantity) {
  const auto unit = parse_unit(declared);
  if (!unit) return quantity.plain();
  if (unit->powers != quantity.unit.powers)
    throw InputError("'" + quantity.text + "' is no " + (declared == "-" ? "pure number" : "value in " + declared));
  return quantity.number * (quantity.unit.factor / unit->factor);
}

}  // namespace mudline
