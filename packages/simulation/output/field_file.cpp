#include "simulation/output/field_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "core/errors.hpp"
#include "simulation/output/atomic_file.hpp"
#include "simulation/output/collective.hpp"
#include "simulation/output/field_layout.hpp"
#include "simulation/output/hdf5_tools.hpp"
#include "simulation/output/id_order.hpp"
#include "simulation/output/xdmf.hpp"

namespace mudline {

namespace {

constexpr const char* format_name = "mudline fields";
constexpr long long format_version = 1;

std::string step_name(std::size_t index) {
  char text[32];
  std::snprintf(text, sizeof text, "%06zu", index);
  return text;
}

/// Names that must agree on all ranks, lest the ranks create different datasets and wait for each other for ever.
std::string signature(const std::vector<OutputField>& fields) {
  std::string text;
  for (const auto& field : fields)
    text += field.name + '\n' + field.unit + '\n' + std::to_string(field.components) + '\n';
  return text + '\n';
}

}  // namespace

struct FieldFile::File {
  File(const Mesh& mesh, const std::string& stem);

  void create(const Mesh& mesh);
  void open(const Mesh& mesh, double restart_time);
  std::map<std::string, xdmf::Field> read_fields(const std::string& group) const;
  std::string wrong_fields(const std::vector<OutputField>& fields, std::size_t rows) const;
  std::string bad_value(const std::vector<OutputField>& fields) const;
  std::map<std::string, xdmf::Field> write_fields(hid_t step, const std::string& group,
                                                  const std::vector<OutputField>& fields, const IdOrder& order) const;
  void write_bodies(hid_t step, const std::map<std::string, BodyPose>& poses) const;
  void record(const xdmf::Step& step);
  void publish();
  void fail_alike(const std::string& message) const;

  Teuchos::RCP<const Teuchos::Comm<int>> owner;  // keeps the communicator alive
  MPI_Comm comm;
  int rank;
  std::string stem;
  IdOrder nodes, elements;
  h5::Handle file;
  xdmf::Model model;
  std::map<std::string, std::vector<std::array<double, 2>>> contours;  // by link name
  std::size_t steps = 0;
  std::string grids;  // the XML of the steps so far, on rank 0
};

FieldFile::File::File(const Mesh& mesh, const std::string& path_stem)
    : owner(mesh.comm()),
      comm(raw_communicator(*mesh.comm())),
      rank(mesh.comm()->getRank()),
      stem(path_stem),
      nodes(comm, field_layout::owned_ids(mesh), mesh.num_global_nodes()),
      elements(comm, field_layout::element_ids(mesh), mesh.num_global_elements()) {
  model.hdf5 = std::filesystem::path(stem + ".h5").filename().string();
  model.nodes = nodes.global_count();
  model.elements = elements.global_count();
}

void FieldFile::File::fail_alike(const std::string& message) const {
  const std::string agreed = agreed_message(comm, message);
  if (!agreed.empty()) throw std::runtime_error(stem + ".h5: " + agreed);
}

void FieldFile::File::create(const Mesh& mesh) {
  // An XDMF file of an earlier run would refer to steps that no longer exist.
  std::error_code ignored;
  if (rank == 0) std::filesystem::remove(stem + ".xdmf", ignored);
  file = h5::create_file(comm, stem + ".h5");
  h5::set_attribute(file, "format", std::string(format_name));
  h5::set_attribute(file, "format version", format_version);
  h5::set_attribute(file, "geometry",
                    std::string(mesh.geometry() == Geometry::axisymmetric ? "axisymmetric" : "plane strain"));
  h5::set_attribute(file, "nodes", model.nodes);
  h5::set_attribute(file, "elements", model.elements);
  for (const char* group : {"metadata", "bodies", "steps"}) h5::create_group(file, group);
  model.topology_length = field_layout::write_mesh(file, comm, mesh, nodes, elements);
  h5::check(H5Fflush(file, H5F_SCOPE_GLOBAL), "flush '" + stem + ".h5'");
}

void FieldFile::File::open(const Mesh& mesh, double restart_time) {
  const std::string path = stem + ".h5", advice = "; move it away, or run without a restart";
  try {
    file = h5::open_file(comm, path, true);
  } catch (const std::runtime_error&) {
    throw InputError(path + ": the result of the first run cannot be opened" + advice);
  }
  if (!h5::has_attribute(file, "format") || h5::text_attribute(file, "format") != format_name ||
      h5::integer_attribute(file, "format version") != format_version)
    throw InputError(path + ": not a result of this version of mudline" + advice);
  const long long old_nodes = h5::integer_attribute(file, "nodes"),
                  old_elements = h5::integer_attribute(file, "elements");
  if (old_nodes != model.nodes || old_elements != model.elements)
    throw InputError(path + ": the result belongs to a mesh of " + std::to_string(old_nodes) + " nodes and " +
                     std::to_string(old_elements) + " elements, but this mesh has " + std::to_string(model.nodes) +
                     " and " + std::to_string(model.elements) + advice);
  model.topology_length = static_cast<long long>(h5::size(file, "mesh/topology"));
  for (const std::string& link : h5::names(h5::open_group(file, "bodies"))) {
    const auto points = h5::read_all<double>(file, "bodies/" + link + "/contour");
    auto& contour = contours[link];
    for (std::size_t i = 0; i + 1 < points.size(); i += 2) contour.push_back({points[i], points[i + 1]});
    const auto body = h5::open_group(file, "bodies/" + link);
    model.bodies[link] = {h5::text_attribute(body, "name"), static_cast<long long>(contour.size())};
  }

  const auto group = h5::open_group(file, "steps");
  bool keep = true;
  for (std::size_t k = 0; h5::exists(group, step_name(k)); ++k) {
    const std::string name = step_name(k);
    xdmf::Step step;
    {
      const auto old = h5::open_group(group, name);
      step = {"/steps/" + name, 0.0, 0, "", {}, {}};
      // A step without its time was cut short by a crash: the time is written last.
      keep = keep && h5::has_attribute(old, "time") && h5::number_attribute(old, "time") <= restart_time;
      if (keep) {
        step.time = h5::number_attribute(old, "time");
        step.number = h5::integer_attribute(old, "step");
        step.stage = h5::text_attribute(old, "stage");
        step.nodal = read_fields(step.group + "/nodal");
        step.cell = read_fields(step.group + "/cell");
      }
    }
    if (keep)
      record(step);
    else
      h5::remove(group, name);
  }
  publish();
}

std::map<std::string, xdmf::Field> FieldFile::File::read_fields(const std::string& group) const {
  std::map<std::string, xdmf::Field> fields;
  const auto parent = h5::open_group(file, group);
  for (const std::string& link : h5::names(parent)) {
    const h5::Handle dataset(H5Dopen2(parent, link.c_str(), H5P_DEFAULT), H5Dclose,
                             "find '" + group + "/" + link + "'");
    fields[link] = {h5::text_attribute(dataset, "name"), h5::text_attribute(dataset, "unit"),
                    static_cast<int>(h5::integer_attribute(dataset, "components"))};
  }
  return fields;
}

/// What is wrong with the shape of the call, or "".
std::string FieldFile::File::wrong_fields(const std::vector<OutputField>& fields, std::size_t rows) const {
  std::vector<std::string> links;
  for (const auto& field : fields) {
    const int c = field.components;
    if (c != 1 && c != 2 && c != 3 && c != 6)
      return "field '" + field.name + "' has " + std::to_string(c) + " components; allowed: 1, 2, 3, 6";
    if (field.values.size() != rows * c)
      return "field '" + field.name + "' has " + std::to_string(field.values.size()) + " values on a rank that has " +
             std::to_string(rows) + " rows of " + std::to_string(c);
    const std::string link = h5::link_name(field.name);
    if (std::find(links.begin(), links.end(), link) != links.end()) return "two fields are called '" + field.name + "'";
    links.push_back(link);
  }
  return "";
}

std::string FieldFile::File::bad_value(const std::vector<OutputField>& fields) const {
  for (const auto& field : fields)
    for (double value : field.values)
      if (!std::isfinite(value))
        return "field '" + field.name + "' holds a value that is not finite (" + std::to_string(value) +
               "); nothing was written";
  return "";
}

std::map<std::string, xdmf::Field> FieldFile::File::write_fields(hid_t step, const std::string& group_name,
                                                                 const std::vector<OutputField>& fields,
                                                                 const IdOrder& order) const {
  std::map<std::string, xdmf::Field> written;
  const auto group = h5::create_group(step, group_name);
  for (const auto& field : fields) {
    const std::string link = h5::link_name(field.name);
    const int columns = field_layout::stored_components(field.components);
    const auto dataset = field_layout::write_rows(group, link, field.values, field.components, order);
    h5::set_attribute(dataset, "name", field.name);
    h5::set_attribute(dataset, "unit", field.unit);
    h5::set_attribute(dataset, "components", static_cast<long long>(columns));
    written[link] = {field.name, field.unit, columns};
  }
  return written;
}

void FieldFile::File::write_bodies(hid_t step, const std::map<std::string, BodyPose>& poses) const {
  const auto group = h5::create_group(step, "bodies");
  for (const auto& [link, body] : model.bodies) {
    const auto found = poses.find(body.name);
    const BodyPose pose = found == poses.end() ? BodyPose() : found->second;
    const double c = std::cos(pose.angle), s = std::sin(pose.angle);
    const auto place = h5::create_group(group, link);
    h5::set_attribute(place, "displacement", std::vector<double>{pose.shift[0], pose.shift[1]});
    h5::set_attribute(place, "rotation", std::vector<double>{pose.angle});
    std::vector<double> points;
    if (rank == 0)
      for (const auto& point : contours.at(link)) {
        const double x = point[0] - pose.centre[0], y = point[1] - pose.centre[1];
        // a body that does not turn keeps every bit
        if (pose.angle == 0)
          points.insert(points.end(), {point[0] + pose.shift[0], point[1] + pose.shift[1], 0.0});
        else
          points.insert(points.end(), {pose.centre[0] + pose.shift[0] + c * x - s * y, pose.centre[1] + pose.shift[1] + s * x + c * y, 0.0});
      }
    h5::write(place, "coordinates", points, {hsize_t(body.points), 3, 0, rank == 0 ? hsize_t(body.points) : 0});
  }
}

void FieldFile::File::record(const xdmf::Step& step) {
  if (rank == 0) grids += xdmf::grid(model, step);
  ++steps;
}

/// Brings the file to a state that a reader may see, then the XDMF that refers to it.
void FieldFile::File::publish() {
  fail_alike(H5Fflush(file, H5F_SCOPE_GLOBAL) < 0 ? "cannot be flushed (disk full?)" : "");
  std::string error;
  if (rank == 0) {
    std::error_code ignored;
    if (steps > 0)
      error = write_atomically(stem + ".xdmf", xdmf::document(grids));
    else
      std::filesystem::remove(stem + ".xdmf", ignored);
  }
  fail_alike(error);
}

FieldFile::FieldFile(const Mesh& mesh, const std::string& path_stem, std::optional<double> restart_time)
    : file_(std::make_unique<File>(mesh, path_stem)) {
  std::error_code ignored;
  const bool found = std::filesystem::is_regular_file(path_stem + ".h5", ignored);
  if (restart_time && broadcast(file_->comm, found ? "found" : "") == "found")
    file_->open(mesh, *restart_time);
  else
    file_->create(mesh);
}

FieldFile::~FieldFile() = default;

void FieldFile::set_metadata(const std::string& name, const std::string& text) {
  const std::string same = broadcast(file_->comm, text), link = h5::link_name(name);
  const auto group = h5::open_group(file_->file, "metadata");
  if (h5::exists(group, link)) h5::remove(group, link);
  h5::write_text(group, link, same, file_->rank);
}

void FieldFile::add_body(const std::string& name, const std::vector<std::array<double, 2>>& contour) {
  File& f = *file_;
  const std::string link = h5::link_name(name);
  const auto group = h5::open_group(f.file, "bodies");
  if (h5::exists(group, link)) {
    // After a restart: the steps already written describe this contour.
    if (contour.size() != f.contours[link].size())
      throw InputError(f.stem + ".h5: body '" + name + "' has another contour than in the first run");
  } else if (f.steps > 0) {
    throw std::invalid_argument("body '" + name + "' is added after the first step was written");
  } else {
    const auto body = h5::create_group(group, link);
    h5::set_attribute(body, "name", name);
    std::vector<double> points;
    if (f.rank == 0)
      for (const auto& point : contour) points.insert(points.end(), point.begin(), point.end());
    h5::write(body, "contour", points, {contour.size(), 2, 0, f.rank == 0 ? contour.size() : 0});
  }
  f.contours[link] = contour;
  f.model.bodies[link] = {name, static_cast<long long>(contour.size())};
}

void FieldFile::write(double time, int step, const std::string& stage, const std::vector<double>& coordinates,
                      const std::vector<OutputField>& nodal, const std::vector<OutputField>& cell,
                      const std::map<std::string, BodyPose>& poses) {
  File& f = *file_;
  const std::vector<OutputField> place{{"coordinates", "m", 2, coordinates}};
  std::string wrong = f.wrong_fields(place, f.nodes.local_count());
  if (wrong.empty()) wrong = f.wrong_fields(nodal, f.nodes.local_count());
  if (wrong.empty()) wrong = f.wrong_fields(cell, f.elements.local_count());
  for (const auto& entry : poses)
    if (f.model.bodies.count(h5::link_name(entry.first)) == 0) wrong = "there is no body '" + entry.first + "'";
  wrong = agreed_message(f.comm, wrong);
  if (wrong.empty() && !same_everywhere(f.comm, stage + '\n' + signature(nodal) + signature(cell)))
    wrong = "the ranks give different fields to write";
  if (!wrong.empty()) throw std::invalid_argument(wrong);

  std::string bad = f.bad_value(place);
  if (bad.empty()) bad = f.bad_value(nodal);
  if (bad.empty()) bad = f.bad_value(cell);
  f.fail_alike(bad);

  xdmf::Step written{"/steps/" + step_name(f.steps), time, step, stage, {}, {}};
  std::string error;
  try {
    const auto group = h5::create_group(f.file, written.group);
    field_layout::write_rows(group, "coordinates", coordinates, 2, f.nodes);
    written.nodal = f.write_fields(group, "nodal", nodal, f.nodes);
    written.cell = f.write_fields(group, "cell", cell, f.elements);
    f.write_bodies(group, poses);
    h5::set_attribute(group, "step", static_cast<long long>(step));
    h5::set_attribute(group, "stage", stage);
    h5::set_attribute(group, "time", std::vector<double>{time});
  } catch (const std::runtime_error& failure) {
    error = std::string(failure.what()) + " (disk full?)";
  }
  f.fail_alike(error);
  f.record(written);
  f.publish();
}

int FieldFile::num_steps() const { return static_cast<int>(file_->steps); }

}  // namespace mudline
