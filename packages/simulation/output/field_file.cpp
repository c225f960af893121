#include "simulation/output/field_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "core/errors.hpp"
#include "core/log.hpp"
#include "core/run_error.hpp"
#include "simulation/output/atomic_file.hpp"
#include "simulation/output/collective.hpp"
#include "simulation/output/field_index.hpp"
#include "simulation/output/field_layout.hpp"
#include "simulation/output/hdf5_tools.hpp"
#include "simulation/output/id_order.hpp"
#include "simulation/output/seal.hpp"
#include "simulation/output/whole_file.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

/// Names that must agree on all ranks, because otherwise the ranks would create different datasets and wait for each
/// other for ever.
std::string signature(const std::vector<OutputField>& fields) {
  std::string text;
  for (const auto& field : fields)
    text += field.name + '\n' + field.unit + '\n' + std::to_string(field.components) + '\n';
  return text + '\n';
}

std::map<std::string, xdmf::Field> read_fields(hid_t file, const std::string& group) {
  std::map<std::string, xdmf::Field> fields;
  const auto parent = h5::open_group(file, group);
  for (const std::string& link : h5::names(parent)) {
    const auto dataset = h5::open_dataset(parent, link);
    fields[link] = {h5::text_attribute(dataset, "name"), h5::text_attribute(dataset, "unit"),
                    static_cast<int>(h5::integer_attribute(dataset, "components"))};
  }
  return fields;
}

/// Rotation of a pose: in the plane the angle [rad] between -pi and pi, in space the matrix, row by row.
std::vector<double> rotation(const BodyPose& pose, int dimension) {
  const auto& m = pose.turn.matrix;
  if (dimension == 2) return {std::atan2(m[1][0], m[0][0])};
  return {&m[0][0], &m[0][0] + 9};
}

Point moved(const Point& point, const BodyPose& pose) {
  const Point arm = point - pose.centre, turned = pose.turn(arm);
  // without rotation the sum is exact to the last bit
  return turned == arm ? point + pose.shift : pose.centre + pose.shift + turned;
}

}  // namespace

struct FieldFile::File {
  File(const Mesh& mesh, const std::string& stem, int number);

  void create(const Mesh& mesh);
  void write_mesh(const Mesh& mesh);
  void open(const Mesh& mesh, const FieldRestart& restart);
  void mark(const std::string& name);
  void look_at_old_files(std::size_t steps, const FieldRestart& restart);
  xdmf::StepMesh mesh_of(hid_t step) const;
  std::string wrong_fields(const std::vector<OutputField>& fields, std::size_t rows) const;
  std::string bad_value(const std::vector<OutputField>& fields) const;
  std::map<std::string, xdmf::Field> write_fields(hid_t file, const std::string& group,
                                                  const std::vector<OutputField>& fields, const IdOrder& order) const;
  void write_bodies(hid_t file, const std::map<std::string, BodyPose>& poses) const;
  void publish();
  void fail_alike(const std::string& message) const;

  Teuchos::RCP<const Teuchos::Comm<int>> owner;  // keeps the communicator alive
  MPI_Comm comm;
  int rank, dimension, number;
  xdmf::StepMesh on;  // mesh of the steps that are written now
  IdOrder nodes, elements;
  FieldIndex index;  // the same on every rank; rank 0 writes it
  FieldMarks marks;
};

FieldFile::File::File(const Mesh& mesh, const std::string& path_stem, int mesh_number)
    : owner(mesh.comm()),
      comm(raw_communicator(*mesh.comm())),
      rank(mesh.comm()->getRank()),
      dimension(mesh.dimension()),
      number(mesh_number),
      nodes(comm, field_layout::owned_ids(mesh), mesh.num_global_nodes()),
      elements(comm, field_layout::element_ids(mesh), mesh.num_global_elements()),
      index(path_stem, rank == 0) {
  index.geometry = mudline::name(mesh.geometry());
  index.regions = mesh.regions();
  on = {FieldIndex::mesh_name(number), nodes.global_count(), elements.global_count(), 0};
}

void FieldFile::File::fail_alike(const std::string& message) const {
  const std::string agreed = agreed_message(comm, message);
  if (!agreed.empty()) throw RunError(index.path() + ": " + agreed);
}

void FieldFile::File::create(const Mesh& mesh) {
  std::error_code problem;
  if (rank == 0) {
    // An index of an earlier run would refer to steps that no longer exist.
    index.remove_files();
    std::filesystem::create_directories(index.folder(), problem);
  }
  fail_alike(problem ? "cannot create the folder '" + index.folder() + "': " + problem.message() : "");
  write_mesh(mesh);
  // a run that starts from another one's remeshed state has that mesh as its first one
  if (number > 0) {
    fail_alike(rank == 0 ? link_file(index.mesh_path(number), index.mesh_path(0)) : "");
    mark(FieldIndex::mesh_name(0));
  }
  index.model.mesh = on;
  publish();
}

void FieldFile::File::write_mesh(const Mesh& mesh) {
  fail_alike(write_whole(comm, index.mesh_path(number), field_layout::mesh_size(mesh), [&](hid_t file) {
    on.topology_length = field_layout::write_mesh(file, comm, mesh, nodes, elements);
  }));
  mark(FieldIndex::mesh_name(number));
}

/// Notes the fingerprint of a file that was written just now.
void FieldFile::File::mark(const std::string& name) {
  std::uint64_t found = 0;
  std::string lost;
  if (rank == 0) {
    const std::string path = index.file_path(name);
    const auto read = file_fingerprint(path);
    found = read.value_or(0);
    if (!read) lost = "'" + path + "', written just now, cannot be read";
  }
  fail_alike(lost);
  MPI_Bcast(&found, 1, MPI_UINT64_T, 0, comm);
  marks[name] = found;
}

/// Refuses files of the first `steps` steps and of their meshes that differ from the marks. Files without a mark, of a
/// run by an earlier version, get one now. Every rank reads its share.
void FieldFile::File::look_at_old_files(std::size_t steps, const FieldRestart& restart) {
  marks = restart.marks;
  if (restart.own) return;
  std::vector<std::string> names;
  for (int k = 0; k < std::max(number, 1); ++k) names.push_back(FieldIndex::mesh_name(k));
  for (std::size_t k = 0; k < steps; ++k) names.push_back(FieldIndex::step_name(k));
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  std::vector<std::uint64_t> here(2 * names.size(), 0), found(here.size());  // fingerprint, and whether there is one
  for (std::size_t i = rank; i < names.size(); i += ranks)
    if (const auto read = file_fingerprint(index.file_path(names[i]))) {
      here[2 * i] = *read;
      here[2 * i + 1] = 1;
    }
  MPI_Allreduce(here.data(), found.data(), static_cast<int>(here.size()), MPI_UINT64_T, MPI_SUM, comm);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto known = marks.find(names[i]);
    if (found[2 * i + 1] == 1 && (known == marks.end() || known->second == found[2 * i])) {
      marks[names[i]] = found[2 * i];
      continue;
    }
    const std::string what =
        index.file_path(names[i]) +
        (found[2 * i + 1] == 1 ? ": the file was changed since the run wrote it" : ": the file is missing");
    if (!restart.accept_loss)
      throw InputError(what +
                       "; put a copy of it back, run without --restart, or go on all the same by "
                       "--accept-changes");
    log::warn(what);
    marks[names[i]] = found[2 * i];
  }
}

/// The mesh of a step; steps of earlier versions do not name it, and it is the first one.
xdmf::StepMesh FieldFile::File::mesh_of(hid_t step) const {
  if (!h5::has_attribute(step, "mesh")) return index.model.mesh;
  return {h5::text_attribute(step, "mesh"), h5::integer_attribute(step, "nodes"),
          h5::integer_attribute(step, "elements"), h5::integer_attribute(step, "topology length")};
}

void FieldFile::File::open(const Mesh& mesh, const FieldRestart& restart) {
  const std::size_t old = index.read(number == 0 ? &on : nullptr);
  if (static_cast<long long>(old) < restart.steps && !restart.accept_loss)
    throw InputError(index.path() + ": only " + std::to_string(old) + " of the " + std::to_string(restart.steps) +
                     " outputs up to the checkpoint are left; put a copy of the fields back, run without --restart, or "
                     "go on with outputs lost by --accept-changes");
  look_at_old_files(std::min<std::size_t>(old, restart.steps), restart);
  if (number > 0)
    write_mesh(mesh);
  else
    on = index.model.mesh;
  const bool by_time = static_cast<long long>(old) < restart.steps;
  std::string error;
  try {
    if (rank == 0)
      for (std::size_t k = 0; k < old; ++k) {
        const auto file = h5::open_file(MPI_COMM_SELF, index.step_path(k), false);
        const double time = h5::number_attribute(file, "time");
        if (by_time ? time > restart.time : static_cast<long long>(k) >= restart.steps) break;
        index.append({FieldIndex::step_name(k), time, h5::integer_attribute(file, "step"),
                      h5::text_attribute(file, "stage"), read_fields(file, "nodal"), read_fields(file, "cell"),
                      mesh_of(file)});
      }
  } catch (const std::runtime_error& failure) {
    error = failure.what();
  }
  error = agreed_message(comm, error);
  if (!error.empty())
    throw InputError(index.path() + ": the result of the first run cannot be continued: " + error +
                     "; move it away, or run without a restart");
  unsigned long long kept = index.steps;
  MPI_Bcast(&kept, 1, MPI_UNSIGNED_LONG_LONG, 0, comm);
  index.steps = kept;
  publish();
  if (rank == 0) index.remove_steps(index.steps);
}

/// Error text where fields have wrong sizes or equal names, or "".
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

std::map<std::string, xdmf::Field> FieldFile::File::write_fields(hid_t file, const std::string& group_name,
                                                                 const std::vector<OutputField>& fields,
                                                                 const IdOrder& order) const {
  std::map<std::string, xdmf::Field> written;
  const auto group = h5::create_group(file, group_name);
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

void FieldFile::File::write_bodies(hid_t file, const std::map<std::string, BodyPose>& poses) const {
  const auto group = h5::create_group(file, "bodies");
  for (const auto& [link, body] : index.model.bodies) {
    const auto found = poses.find(body.name);
    const BodyPose pose = found == poses.end() ? BodyPose() : found->second;
    const auto place = h5::create_group(group, link);
    h5::set_attribute(place, "displacement", std::vector<double>(pose.shift.begin(), pose.shift.begin() + dimension));
    h5::set_attribute(place, "rotation", rotation(pose, dimension));
    std::vector<double> points;
    if (rank == 0)
      for (const Point& point : index.outlines.at(link).points) {
        const Point now = moved(point, pose);
        points.insert(points.end(), now.begin(), now.end());
      }
    h5::write(place, "coordinates", points, {hsize_t(body.points), 3, 0, rank == 0 ? hsize_t(body.points) : 0});
  }
}

/// Writes the index, so that readers find the steps so far.
void FieldFile::File::publish() { fail_alike(index.write()); }

std::optional<std::map<std::string, std::string>> metadata_of(const std::string& path_stem) {
  const std::string path = FieldIndex(path_stem, false).path();
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return std::nullopt;
  try {
    const auto file = h5::open_file(MPI_COMM_SELF, path, false);
    if (h5::names(h5::open_group(file, "steps")).empty()) return std::nullopt;
    std::map<std::string, std::string> texts;
    for (const std::string& link : h5::names(h5::open_group(file, "metadata")))
      texts[link] = h5::read_text(file, "metadata/" + link);
    return texts;
  } catch (const std::runtime_error&) {
    return std::map<std::string, std::string>{};  // a file is there, but it cannot be read
  }
}

FieldFile::FieldFile(const Mesh& mesh, const std::string& path_stem, std::optional<FieldRestart> restart, int number)
    : file_(std::make_unique<File>(mesh, path_stem, number)) {
  std::error_code ignored;
  const std::string path = file_->index.path();
  const bool found = broadcast(file_->comm, std::filesystem::is_regular_file(path, ignored) ? "found" : "") == "found";
  if (restart && !found && restart->steps > 0 && !restart->accept_loss)
    throw InputError(path + ": the file is missing, which should lead to the " + std::to_string(restart->steps) +
                     " outputs up to the checkpoint; put a copy of it back, run without --restart, or go on with "
                     "outputs lost by --accept-changes");
  if (restart && found)
    file_->open(mesh, *restart);
  else
    file_->create(mesh);
}

FieldFile::~FieldFile() = default;

void FieldFile::set_metadata(const std::string& name, const std::string& text) {
  file_->index.metadata[h5::link_name(name)] = broadcast(file_->comm, text);
}

void FieldFile::add_body(const std::string& name, const BodyOutline& outline) {
  FieldIndex& index = file_->index;
  const std::string link = h5::link_name(name);
  const bool in_space = file_->dimension == 3;
  if (in_space == outline.facets.empty())
    throw std::invalid_argument("body '" + name + "': triangles are what a body in space has, and it alone");
  const auto found = index.outlines.find(link);
  if (found != index.outlines.end() && index.model.bodies.at(link).name != name)
    throw InputError("bodies/" + name + ": in the results it would have the name of the body '" +
                     index.model.bodies.at(link).name + "', " + link + "; give one of them another name");
  if (found != index.outlines.end()) {
    // After a restart the outline must be that of the steps already written.
    if (outline.points.size() != found->second.points.size() || outline.facets != found->second.facets)
      throw InputError(index.path() + ": body '" + name + "' has another " + (in_space ? "surface" : "contour") +
                       " than in the first run");
  } else if (index.steps > 0) {
    throw std::invalid_argument("body '" + name + "' is added after the first step was written");
  }
  index.add_body(link, name, outline);
}

void FieldFile::write(double time, int step, const std::string& stage, const std::vector<double>& coordinates,
                      const std::vector<OutputField>& nodal, const std::vector<OutputField>& cell,
                      const std::map<std::string, BodyPose>& poses) {
  File& f = *file_;
  const std::vector<OutputField> place{{"coordinates", "m", f.dimension, coordinates}};
  std::string wrong = f.wrong_fields(place, f.nodes.local_count());
  if (wrong.empty()) wrong = f.wrong_fields(nodal, f.nodes.local_count());
  if (wrong.empty()) wrong = f.wrong_fields(cell, f.elements.local_count());
  for (const auto& entry : poses)
    if (f.index.model.bodies.count(h5::link_name(entry.first)) == 0) wrong = "there is no body '" + entry.first + "'";
  wrong = agreed_message(f.comm, wrong);
  if (wrong.empty() && !same_everywhere(f.comm, stage + '\n' + signature(nodal) + signature(cell)))
    wrong = "the ranks give different fields to write";
  if (!wrong.empty()) throw std::invalid_argument(wrong);

  std::string bad = f.bad_value(place);
  if (bad.empty()) bad = f.bad_value(nodal);
  if (bad.empty()) bad = f.bad_value(cell);
  f.fail_alike(bad);

  xdmf::Step written{FieldIndex::step_name(f.index.steps), time, step, stage, {}, {}, f.on};
  FileSize size{coordinates.size() * sizeof(double), nodal.size() + cell.size() + 2 * poses.size() + 4};
  for (const auto* fields : {&nodal, &cell})
    for (const OutputField& field : *fields) size.bytes += field.values.size() * sizeof(double);
  size.bytes += size.bytes / 2;  // plane vectors get a third component
  for (const auto& [link, body] : f.index.model.bodies) size.bytes += 3 * sizeof(double) * body.points;
  f.fail_alike(write_whole(f.comm, f.index.step_path(f.index.steps), size, [&](hid_t file) {
    h5::set_attribute(file, "time", std::vector<double>{time});
    h5::set_attribute(file, "step", static_cast<long long>(step));
    h5::set_attribute(file, "stage", stage);
    if (f.number > 0) {  // steps on the first mesh need no mesh of their own: the index has it
      h5::set_attribute(file, "mesh", f.on.file);
      h5::set_attribute(file, "nodes", f.on.nodes);
      h5::set_attribute(file, "elements", f.on.elements);
      h5::set_attribute(file, "topology length", f.on.topology_length);
      h5::link_to_file(file, "mesh", f.on.file + ".h5", "/mesh");
    }
    field_layout::write_rows(file, "coordinates", coordinates, f.dimension, f.nodes);
    written.nodal = f.write_fields(file, "nodal", nodal, f.nodes);
    written.cell = f.write_fields(file, "cell", cell, f.elements);
    f.write_bodies(file, poses);
  }));
  f.mark(written.file);
  f.index.append(written);
  f.publish();
}

void FieldFile::complete() { file_->fail_alike(file_->index.write(true)); }

const FieldMarks& FieldFile::marks() const { return file_->marks; }

std::string FieldFile::missing() const { return file_->index.missing(); }

int FieldFile::num_steps() const { return static_cast<int>(file_->index.steps); }

}  // namespace mudline
