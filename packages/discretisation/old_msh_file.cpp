#include "discretisation/old_msh_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>

#include "core/errors.hpp"
#include "core/text.hpp"

namespace mudline {

namespace {

using Tag = TaggedMesh::Tag;

std::string in_quotes(std::string_view text) { return "'" + printable(beginning(std::string(text), 60)) + "'"; }

class Reader {
 public:
  Reader(const std::string& file, int dimension) : in_(file), elements_(in_, dimension), dimension_(dimension) {}
  TaggedMesh read();
  void read_all();
  const MshElements& elements() const { return elements_; }

 private:
  void read_section(const std::string& name);
  void skip_section(const std::string& name);
  void read_format();
  void read_names();
  void read_nodes(const std::string& section);
  void add_node(Tag tag, const Point& place);
  void read_elements(const std::string& section);
  void read_element();
  std::size_t read_binary_elements();
  /// The number of things that a section announces; each takes at least so many bytes.
  std::size_t read_count(const std::string& what, std::size_t bytes);
  void expect_line(const std::string& what);
  void expect_end(const std::string& section);
  MshElements::Tags tags(const long long* tags, std::size_t count) const;

  MshInput in_;
  MshElements elements_;
  int dimension_;
  double version_ = 1;
  bool nodes_read_ = false, elements_read_ = false;
  std::vector<long long> numbers_;  // of one element
  std::string announced_;           // "line 12 announces 50 nodes"
};

TaggedMesh Reader::read() {
  read_all();
  return elements_.mesh();
}

void Reader::read_all() {
  while (in_.next_line())  // text between sections is no part of the mesh
    if (in_.line()[0] == '$') read_section(std::string(in_.line().substr(1)));
  for (const auto& [read, name] : {std::pair{nodes_read_, "$Nodes"}, {elements_read_, "$Elements"}})
    if (!read) in_.fail("the file ends without a section " + std::string(name));
}

void Reader::read_section(const std::string& name) {
  if (name == "MeshFormat") return read_format();
  if (name == "PhysicalNames") return read_names();
  if (name == "Nodes" || name == "ParametricNodes" || name == "NOD") return read_nodes(name);
  if (name == "Elements" || name == "ELM") return read_elements(name);
  if (name.compare(0, 3, "End") == 0 || name.compare(0, 3, "END") == 0)
    in_.fail(in_quotes(in_.line()) + " stands without the beginning of its section");
  skip_section(name);
}

void Reader::skip_section(const std::string& name) {
  const std::size_t begin = in_.place();
  while (in_.next_line())
    if (in_.line() == "$End" + name) return;
  in_.fail_at(begin, "the section " + in_quotes("$" + name) + " has no end (" + in_quotes("$End" + name) + ")");
}

void Reader::read_format() {
  const std::string wanted =
      "expected the version, the kind of file (0: text, 1: binary) and the size of a number, "
      "such as '2.2 0 8', given ";
  expect_line(wanted);
  const auto words = in_.words();
  const auto version = words.size() == 3 ? msh_number(words[0]) : std::nullopt;
  if (!version || (words[1] != "0" && words[1] != "1") || words[2] != "8") in_.fail(wanted + in_quotes(in_.line()));
  if (!(*version >= 2 && *version < 3))
    in_.fail("the version " + in_quotes(words[0]) + " is unknown; allowed: 1 to 4.1");
  version_ = *version;
  if (words[1] == "1") {
    in_.set_binary(false);
    const int one = in_.integer();
    if (one == 1 << 24)
      in_.set_binary(true);
    else if (one != 1)
      in_.fail("a binary file has the number 1 here, in four bytes, to tell their order; given " + std::to_string(one));
  }
  expect_end("MeshFormat");
}

void Reader::read_names() {
  const std::size_t count = read_count("names", 5);
  for (std::size_t k = 0; k < count; ++k) {
    const std::string wanted = version_ > 2 ? "dimension number \"name\"" : "number \"name\"";
    expect_line("expected a name of a physical group (" + wanted + "), given ");
    const std::string_view line = in_.line();
    const std::size_t open = line.find('"'), close = line.rfind('"');
    const auto words = in_.words();
    const bool with_dimension = words.size() > 1 && words[1][0] != '"';  // since 2.1
    const auto first = msh_integer(words[0]), second = with_dimension ? msh_integer(words[1]) : first;
    if (open == std::string_view::npos || close == open || !first || !second ||
        (with_dimension && (*first < 0 || *first > 3)))
      in_.fail("expected a name of a physical group (" + wanted + "), given " + in_quotes(line));
    const std::string name(line.substr(open + 1, close - open - 1));
    if (const std::string bad = unfit(name); !bad.empty())
      in_.fail("the physical group " + std::to_string(*second) + " has the name " + in_quotes(name) + ", which holds " +
               bad);
    for (int d = 0; d <= 3; ++d)
      if (!with_dimension || d == *first) elements_.name_group(d, *second, name);
  }
  expect_end("PhysicalNames");
}

void Reader::read_nodes(const std::string& section) {
  if (nodes_read_) in_.fail("a second section " + in_quotes(in_.line()) + "; allowed: one");
  nodes_read_ = true;
  const bool parametric = section == "ParametricNodes";
  const std::size_t count = read_count("nodes", in_.binary() ? 28 : 8);
  for (std::size_t k = 0; k < count; ++k) {
    Point place{};
    if (in_.binary()) {
      const int tag = in_.integer();
      const std::size_t at = in_.place();
      for (double& x : place) x = in_.number();
      if (!std::all_of(place.begin(), place.end(), [](double x) { return std::isfinite(x); }))
        in_.fail_at(at, "node " + std::to_string(tag) + " has a coordinate that is no finite number");
      add_node(tag, place);
      if (!parametric) continue;
      const int on = in_.integer();  // a point, curve, surface or volume, and its number
      in_.integer();
      if (on < 3)
        for (int d = 0; d < on; ++d) in_.number();
      continue;
    }
    const std::string wanted = "expected node " + std::to_string(k + 1) + " (number x y z), given ";
    expect_line(wanted);
    const auto& words = in_.words();
    const auto tag = msh_integer(words[0]);
    if (!tag || words.size() < 4 || (words.size() > 4 && !parametric)) in_.fail(wanted + in_quotes(in_.line()));
    for (int i = 0; i < 3; ++i) {
      const auto x = msh_number(words[1 + i]);
      if (!x)
        in_.fail("node " + std::to_string(*tag) + " has the coordinate " + in_quotes(words[1 + i]) +
                 "; allowed: finite numbers");
      place[i] = *x;
    }
    add_node(*tag, place);
  }
  expect_end(section);
}

void Reader::add_node(Tag tag, const Point& place) {
  if (tag < 0) in_.fail("a node has the number " + std::to_string(tag) + "; allowed: 0 and more");
  if (!elements_.add_node(tag, place))
    in_.fail("the node " + std::to_string(tag) + " is given twice, at different places");
}

void Reader::read_elements(const std::string& section) {
  if (elements_read_) in_.fail("a second section " + in_quotes(in_.line()) + "; allowed: one");
  elements_read_ = true;
  const std::size_t count = read_count("elements", in_.binary() ? 8 : 6);
  for (std::size_t k = 0; k < count;) {
    if (in_.binary()) {
      const std::size_t added = read_binary_elements();
      if (added > count - k) in_.fail("there are more elements than the " + std::to_string(count) + " announced");
      k += added;
      continue;
    }
    expect_line("expected element " + std::to_string(k + 1) + ", given ");
    read_element();
    ++k;
  }
  expect_end(section);
}

void Reader::read_element() {
  std::vector<long long>& numbers = numbers_;
  numbers.clear();
  for (const std::string_view word : in_.words()) {
    const auto number = msh_integer(word);
    if (!number) in_.fail("an element consists of whole numbers, given " + in_quotes(word));
    numbers.push_back(*number);
  }
  const bool first_format = version_ < 2;
  const std::string wanted = first_format ? "number, type, physical and elementary tag, number of nodes, nodes"
                                          : "number, type, number of tags, tags, nodes";
  if (numbers.size() < (first_format ? 5 : 3))
    in_.fail("expected an element (" + wanted + "), given " + in_quotes(in_.line()));
  const MshElement& type = elements_.type(numbers[1]);
  const auto size = static_cast<long long>(numbers.size());
  if (!first_format && (numbers[2] < 0 || numbers[2] > size - 3))
    in_.fail("an element with " + std::to_string(numbers[2]) + " tags, and " + std::to_string(size - 3) +
             " numbers for tags and nodes");
  const long long head = first_format ? 5 : 3 + numbers[2];
  const std::string of_type =
      "an element of the type '" + std::string(type.name) + "' has " + std::to_string(type.nodes) + " nodes, given ";
  if (size - head != type.nodes) in_.fail(of_type + std::to_string(size - head));
  if (first_format && numbers[4] != type.nodes) in_.fail(of_type + std::to_string(numbers[4]));
  elements_.add(type, first_format ? tags(&numbers[2], 2) : tags(&numbers[2] + 1, static_cast<std::size_t>(numbers[2])),
                in_.place(), &numbers[head]);
}

/// A block of elements of one type: how many.
std::size_t Reader::read_binary_elements() {
  const int kind = in_.integer();
  const MshElement& type = elements_.type(kind);
  const int count = in_.integer(), num_tags = in_.integer();
  if (count < 1 || num_tags < 0) in_.fail("expected a number of elements and of their tags");
  const std::size_t numbers = 1 + static_cast<std::size_t>(num_tags) + type.nodes;
  if (in_.left() / (4 * numbers) < static_cast<std::size_t>(count))
    in_.fail(std::to_string(count) + " elements of " + std::to_string(numbers) +
             " numbers are announced, and the file ends before them: it is cut off, or the numbers are wrong");
  std::vector<long long> given(numbers);
  for (int e = 0; e < count; ++e) {
    given[0] = in_.integer();
    const std::size_t at = in_.place();
    for (std::size_t k = 1; k < numbers; ++k) given[k] = in_.integer();
    elements_.add(type, tags(&given[1], num_tags), at, &given[1 + num_tags]);
  }
  return count;
}

/// Physical and elementary tag, then in 2.2 the number of partitions and those, before that one partition.
MshElements::Tags Reader::tags(const long long* tags, std::size_t count) const {
  MshElements::Tags result;
  if (count > 0) result.group = std::llabs(std::max(tags[0], -std::numeric_limits<long long>::max()));
  if (count > 1) result.entity = tags[1];
  if (version_ >= 2.2 && count > 3 && tags[2] > 0) result.part = tags[3];
  if (version_ < 2.2 && count > 2) result.part = tags[2];
  return result;
}

std::size_t Reader::read_count(const std::string& what, std::size_t bytes) {
  const std::string wanted = "expected the number of " + what + ", given ";
  expect_line(wanted);
  const auto count = in_.words().size() == 1 ? msh_integer(in_.line()) : std::nullopt;
  if (!count || *count < 0) in_.fail(wanted + in_quotes(in_.line()));
  announced_ = in_.place_text(in_.place()) + " announces " + std::to_string(*count) + " " + what;
  if (in_.left() / bytes < static_cast<std::size_t>(*count))
    in_.fail(std::to_string(*count) + " " + what +
             " are announced, and the file ends before them: it is cut off, or the number is wrong");
  return static_cast<std::size_t>(*count);
}

/// Goes to a line within a section: `what` begins the message where there is none.
void Reader::expect_line(const std::string& what) {
  const std::string after = announced_.empty() ? "" : " (" + announced_ + ")";
  if (!in_.next_line()) in_.fail(what + "the end of the file" + after);
  if (in_.line()[0] == '$') in_.fail(what + in_quotes(in_.line()) + after);
}

void Reader::expect_end(const std::string& section) {
  const std::string end = (version_ < 2 ? "$END" : "$End") + section;
  const std::string after = announced_.empty() ? "" : " (" + announced_ + ")";
  if (!in_.next_line()) in_.fail("expected " + end + ", given the end of the file" + after);
  if (in_.line() != end) in_.fail("expected " + end + ", given " + in_quotes(in_.line()) + after);
  announced_.clear();
}

}  // namespace

bool is_old_msh(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string line;
  const auto next = [&] {
    if (!std::getline(stream, line)) return false;
    line = trim(line);
    return true;
  };
  while (next() && line == "$Comments") {
    while (line != "$EndComments")
      if (!next()) return true;
  }
  if (line == "$NOD") return true;
  if (line != "$MeshFormat") return false;
  if (!next()) return true;
  const auto version = msh_number(std::string_view(line).substr(0, line.find_first_of(" \t")));
  return !version || *version < 3;
}

TaggedMesh read_old_msh(const std::string& file, int dimension) { return Reader(file, dimension).read(); }

void add_groups_of_entities(const std::string& file, GroupsOfEntities& groups) {
  Reader reader(file, 3);
  reader.read_all();
  reader.elements().add_groups_of_entities(groups);
}

}  // namespace mudline
