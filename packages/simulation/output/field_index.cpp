#include "simulation/output/field_index.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "core/errors.hpp"
#include "core/log.hpp"
#include "simulation/output/atomic_file.hpp"
#include "simulation/output/hdf5_tools.hpp"
#include "simulation/output/vtkhdf.hpp"
#include "simulation/output/whole_file.hpp"

namespace mudline {

namespace {

constexpr const char* format_name = "mudline fields";
constexpr long long index_version = 2;

/// Reads the outline of a body: "contour" in the plane, "surface" and "triangles" in space.
SurfaceTriangles read_outline(hid_t body) {
  SurfaceTriangles outline;
  const auto links = h5::names(body);
  const bool in_space = std::find(links.begin(), links.end(), "surface") != links.end();
  const auto points = h5::read_all<double>(body, in_space ? "surface" : "contour");
  for (std::size_t i = 0, columns = in_space ? 3 : 2; i + columns <= points.size(); i += columns)
    outline.points.push_back({points[i], points[i + 1], in_space ? points[i + 2] : 0.0});
  if (!in_space) return outline;
  const auto corners = h5::read_all<int>(body, "triangles");
  for (std::size_t i = 0; i + 3 <= corners.size(); i += 3)
    outline.facets.push_back({corners[i], corners[i + 1], corners[i + 2]});
  return outline;
}

void write_outline(hid_t body, const SurfaceTriangles& outline) {
  const bool in_space = !outline.facets.empty();
  const hsize_t columns = in_space ? 3 : 2;
  std::vector<double> points;
  for (const Point& point : outline.points) points.insert(points.end(), point.begin(), point.begin() + columns);
  h5::write(body, in_space ? "surface" : "contour", points, {outline.points.size(), columns, 0, outline.points.size()});
  if (!in_space) return;
  std::vector<int> corners;
  for (const auto& facet : outline.facets) corners.insert(corners.end(), facet.begin(), facet.end());
  h5::write(body, "triangles", corners, {outline.facets.size(), 3, 0, outline.facets.size()});
}

}  // namespace

FieldIndex::FieldIndex(const std::string& path_stem, bool writer) : stem(path_stem), writer_(writer) {
  model.folder = std::filesystem::path(folder()).filename().string();
  model.index = std::filesystem::path(path()).filename().string();
}

std::string FieldIndex::step_name(std::size_t step) {
  char text[32];
  std::snprintf(text, sizeof text, "%06zu", step);
  return text;
}

std::string FieldIndex::mesh_name(int number) {
  char text[32];
  std::snprintf(text, sizeof text, "mesh_%03d", number);
  return number == 0 ? "mesh" : text;
}

std::size_t FieldIndex::read(const xdmf::StepMesh* first) {
  const std::string advice = "; move it away, or run without a restart";
  h5::Handle file;
  try {
    file = h5::open_file(MPI_COMM_SELF, path(), false);
  } catch (const std::runtime_error&) {
    throw InputError(path() + ": the result of the first run cannot be opened" + advice);
  }
  if (!h5::has_attribute(file, "format") || h5::text_attribute(file, "format") != format_name ||
      h5::integer_attribute(file, "format version") != index_version)
    throw InputError(path() + ": not a result of this version of mudline" + advice);
  const long long old_nodes = h5::integer_attribute(file, "nodes"),
                  old_elements = h5::integer_attribute(file, "elements");
  if (first && (old_nodes != first->nodes || old_elements != first->elements))
    throw InputError(path() + ": the result belongs to a mesh of " + std::to_string(old_nodes) + " nodes and " +
                     std::to_string(old_elements) + " elements, but this mesh has " + std::to_string(first->nodes) +
                     " and " + std::to_string(first->elements) + advice);
  model.mesh = {mesh_name(0), old_nodes, old_elements, h5::integer_attribute(file, "topology length")};
  for (const std::string& link : h5::names(h5::open_group(file, "metadata")))
    metadata[link] = h5::read_text(file, "metadata/" + link);
  for (const std::string& link : h5::names(h5::open_group(file, "bodies"))) {
    const auto body = h5::open_group(file, "bodies/" + link);
    add_body(link, h5::text_attribute(body, "name"), read_outline(body));
  }
  return h5::names(h5::open_group(file, "steps")).size();
}

void FieldIndex::add_body(const std::string& link, const std::string& name, const SurfaceTriangles& outline) {
  model.bodies[link] = {name, static_cast<long long>(outline.points.size()),
                        static_cast<long long>(outline.facets.size())};
  outlines[link] = outline;
}

void FieldIndex::append(const xdmf::Step& step) {
  ++steps;
  if (!writer_) return;
  if (for_vtk_ && (written_.empty() || written_.back().mesh.file != step.mesh.file)) {
    for_vtk_ =
        h5::has_link(h5::open_group(h5::open_file(MPI_COMM_SELF, file_path(step.mesh.file), false), "mesh"), "types");
    if (!for_vtk_) log::warn(vtk_path() + " is left out: " + file_path(step.mesh.file) + " is of an earlier version");
  }
  written_.push_back(step);
  grids_ += xdmf::grid(model, step);
}

std::string FieldIndex::write_for_vtk() {
  try {
    std::string error = write_atomically(
        vtk_path(), h5::file_image([this](hid_t file) { vtkhdf::write_soil(file, model, written_, regions); }));
    for (const auto& [name, shape] : outlines) {
      if (!error.empty()) break;
      const std::string& link = name;
      const SurfaceTriangles& outline = shape;
      error = write_atomically(vtk_path(link),
                               h5::file_image([&](hid_t file) { vtkhdf::write_body(file, link, outline, written_); }));
    }
    vtk_steps_ = steps;
    return error;
  } catch (const std::runtime_error& failure) {
    return failure.what();
  }
}

void FieldIndex::remove_for_vtk() const {
  std::error_code ignored;
  std::filesystem::remove(vtk_path(), ignored);
  for (const auto& entry : std::filesystem::directory_iterator(folder(), ignored))
    if (entry.path().extension() == ".vtkhdf") std::filesystem::remove(entry.path(), ignored);
}

std::string FieldIndex::write(bool complete) {
  if (!writer_) return "";
  FileSize size{0, 8 + metadata.size() + 3 * outlines.size() + steps};
  for (const auto& [link, text] : metadata) size.bytes += text.size();
  for (const auto& [link, outline] : outlines)
    size.bytes += outline.points.size() * sizeof(Point) + outline.facets.size() * sizeof(outline.facets[0]);
  std::string error = write_whole(MPI_COMM_SELF, path(), size, [this](hid_t file) {
    h5::set_attribute(file, "format", std::string(format_name));
    h5::set_attribute(file, "format version", index_version);
    h5::set_attribute(file, "geometry", geometry);
    h5::set_attribute(file, "nodes", model.mesh.nodes);
    h5::set_attribute(file, "elements", model.mesh.elements);
    h5::set_attribute(file, "topology length", model.mesh.topology_length);
    h5::link_to_file(file, "mesh", model.path("mesh"), "/mesh");
    const auto texts = h5::create_group(file, "metadata"), bodies = h5::create_group(file, "bodies"),
               links = h5::create_group(file, "steps");
    for (const auto& [link, text] : metadata) h5::write_text(texts, link, text, 0);
    for (const auto& [link, outline] : outlines) {
      const auto body = h5::create_group(bodies, link);
      h5::set_attribute(body, "name", model.bodies.at(link).name);
      write_outline(body, outline);
    }
    for (std::size_t k = 0; k < steps; ++k) h5::link_to_file(links, step_name(k), model.path(step_name(k)), "/");
  });
  // They may name only steps that exist.
  std::error_code ignored;
  if (error.empty() && steps > 0) error = write_atomically(stem + ".xdmf", xdmf::document(grids_));
  if (steps == 0) std::filesystem::remove(stem + ".xdmf", ignored);
  const bool due = vtk_steps_ != steps && (complete || 10 * steps >= 11 * vtk_steps_);
  if (error.empty() && due && for_vtk_) error = write_for_vtk();
  if (steps == 0 || !for_vtk_) remove_for_vtk();
  return error;
}

std::string FieldIndex::missing() const {
  std::vector<std::string> paths{path(), mesh_path(0)};
  if (steps > 0) paths.push_back(stem + ".xdmf");
  if (steps > 0 && for_vtk_) {
    paths.push_back(vtk_path());
    for (const auto& entry : outlines) paths.push_back(vtk_path(entry.first));
  }
  for (std::size_t k = 0; k < steps; ++k) paths.push_back(step_path(k));
  std::error_code ignored;
  for (const std::string& file : paths)
    if (!std::filesystem::is_regular_file(file, ignored)) return file;
  return "";
}

void FieldIndex::remove_files() const {
  std::error_code ignored;
  std::filesystem::remove(stem + ".xdmf", ignored);
  std::filesystem::remove(path(), ignored);
  remove_for_vtk();
  remove_steps(0);
}

void FieldIndex::remove_steps(std::size_t first) const {
  std::error_code ignored;
  if (first == 0)
    for (int number = 1; std::filesystem::remove(mesh_path(number), ignored); ++number) {
    }
  // Steps are numbered without gaps.
  for (std::size_t k = first; std::filesystem::remove(step_path(k), ignored); ++k) {
  }
}

}  // namespace mudline
