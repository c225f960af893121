#include "geometry/stl_file.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>

#include "core/errors.hpp"
#include "core/text.hpp"

namespace mudline {

namespace {

constexpr std::size_t head = 80, count_size = 4, record = 50, normal_size = 12;

/// Adds the facet of the last three points.
void add_facet(SurfaceTriangles& result) {
  const int last = static_cast<int>(result.points.size());
  result.facets.push_back({last - 3, last - 2, last - 1});
}

std::size_t binary_count(const std::string& bytes) {
  std::uint32_t count = 0;  // little-endian, as the machines are that this runs on
  if (bytes.size() >= head + count_size) std::memcpy(&count, bytes.data() + head, count_size);
  return count;
}

SurfaceTriangles binary(const std::string& bytes) {
  SurfaceTriangles result;
  for (std::size_t f = 0; f < binary_count(bytes); ++f) {
    float corner[3][3];
    std::memcpy(corner, bytes.data() + head + count_size + f * record + normal_size, sizeof corner);
    for (const auto& x : corner) {
      for (const float value : x)
        if (!std::isfinite(value))
          throw InputError("facet " + std::to_string(f + 1) + " has a corner that is no number");
      result.points.push_back({x[0], x[1], x[2]});
    }
    add_facet(result);
  }
  return result;
}

SurfaceTriangles ascii(const std::string& text) {
  SurfaceTriangles result;
  std::istringstream lines(text);
  std::string line, word;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::istringstream words(line);
    words >> word;
    const std::string place = "line " + std::to_string(number) + ": ";
    if (words && word == "vertex") {
      Point x{};
      for (double& value : x) {
        words >> word;
        const auto parsed = words ? parse_number(word) : std::nullopt;
        if (!parsed || !std::isfinite(*parsed)) throw InputError(place + "a vertex has three numbers");
        value = *parsed;
      }
      result.points.push_back(x);
    } else if (words && word == "endloop") {
      if (result.points.size() != 3 * (result.facets.size() + 1))
        throw InputError(place + "a facet has three vertices");
      add_facet(result);
    }
  }
  if (result.points.size() != 3 * result.facets.size()) throw InputError("the file ends within a facet");
  return result;
}

}  // namespace

SurfaceTriangles read_stl(const std::string& file) {
  const std::optional<std::string> content = file_content(file);
  if (!content) throw InputError("the file cannot be read");
  const std::string& bytes = *content;
  SurfaceTriangles result;
  if (bytes.size() >= head + count_size && bytes.size() == head + count_size + record * binary_count(bytes))
    result = binary(bytes);
  else if (bytes.rfind("solid", 0) == 0)
    result = ascii(bytes);
  else
    throw InputError(
        "the file is no STL file: it neither starts with 'solid' nor has the length that its number of facets gives");
  if (result.facets.empty()) throw InputError("the file has no facets, or is a binary one that was cut short");
  return result;
}

}  // namespace mudline
