#include "simulation/output/checkpoint_file.hpp"

#include <filesystem>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "core/errors.hpp"
#include "discretisation/mesh.hpp"
#include "simulation/output/collective.hpp"
#include "simulation/output/hdf5_tools.hpp"
#include "simulation/output/whole_file.hpp"

namespace mudline {

namespace {

constexpr const char* format_name = "mudline checkpoint";
constexpr long long format_version = 1;
constexpr int signature_length = 6;

std::vector<long long> row_of(const MeshSignature& mesh) {
  return {mesh.global_nodes, mesh.global_elements, mesh.local_nodes,
          mesh.owned_nodes,  mesh.local_elements,  mesh.numbering};
}

/// Array names may hold "/", which HDF5 would take for a group.
std::string escaped(const std::string& name) {
  std::string result;
  for (char c : name) result += c == '/' ? "%2F" : c == '%' ? "%25" : std::string(1, c);
  return result;
}

std::string unescaped(const std::string& link) {
  std::string result;
  for (std::size_t i = 0; i < link.size(); ++i) {
    if (link[i] != '%') {
      result += link[i];
    } else {
      result += link.compare(i, 3, "%2F") == 0 ? '/' : '%';
      i += 2;
    }
  }
  return result;
}

/// Numbers 0, n_0, n_0 + n_1, ...: where each rank's part begins.
std::vector<long long> offsets_of(MPI_Comm comm, long long length) {
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  std::vector<long long> offsets(ranks + 1, 0);
  MPI_Allgather(&length, 1, MPI_LONG_LONG, offsets.data() + 1, 1, MPI_LONG_LONG, comm);
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  return offsets;
}

h5::Slab part(const std::vector<long long>& offsets, int rank) {
  return {static_cast<hsize_t>(offsets.back()), 0, static_cast<hsize_t>(offsets[rank]),
          static_cast<hsize_t>(offsets[rank + 1] - offsets[rank])};
}

template <class T>
void write_arrays(MPI_Comm comm, hid_t file, const std::string& kind,
                  const std::map<std::string, std::vector<T>>& arrays) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  const auto values = h5::create_group(file, kind), tables = h5::create_group(file, kind + " offsets");
  for (const auto& [name, array] : arrays) {
    const std::vector<long long> offsets = offsets_of(comm, static_cast<long long>(array.size()));
    h5::write(values, escaped(name), array, part(offsets, rank));
    const hsize_t length = offsets.size();
    h5::write(tables, escaped(name), offsets, {length, 0, 0, rank == 0 ? length : 0});
  }
}

template <class T>
std::map<std::string, std::vector<T>> read_arrays(int rank, hid_t file, const std::string& kind) {
  std::map<std::string, std::vector<T>> arrays;
  const auto values = h5::open_group(file, kind), tables = h5::open_group(file, kind + " offsets");
  for (const std::string& link : h5::names(values))
    arrays[unescaped(link)] = h5::read<T>(values, link, part(h5::read_all<long long>(tables, link), rank));
  return arrays;
}

template <class Map>
void append_names(std::string& text, const Map& map) {
  for (const auto& entry : map) text += entry.first + '\n';
  text += '\n';
}

void write_content(MPI_Comm comm, hid_t file, const MeshSignature& mesh, const CheckpointData& data) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks);
  h5::set_attribute(file, "format", std::string(format_name));
  h5::set_attribute(file, "format version", format_version);
  h5::set_attribute(file, "ranks", static_cast<long long>(ranks));
  h5::write(file, "mesh", row_of(mesh), {hsize_t(ranks), signature_length, hsize_t(rank), 1});
  write_arrays(comm, file, "arrays", data.arrays);
  write_arrays(comm, file, "integers", data.integers);
  const auto scalars = h5::create_group(file, "scalars"), texts = h5::create_group(file, "texts");
  for (const auto& [name, value] : data.scalars)
    h5::write(scalars, escaped(name), std::vector<double>{value}, {1, 0, 0, hsize_t(rank == 0)});
  for (const auto& [name, text] : data.texts) h5::write_text(texts, escaped(name), text, rank);
}

std::string count(long long number, const std::string& thing) {
  return std::to_string(number) + " " + thing + (number == 1 ? "" : "s");
}

/// Why this run cannot continue from the open file, or "".
std::string mismatch(hid_t file, int rank, int ranks, const MeshSignature& mesh) {
  if (!h5::has_attribute(file, "format") || h5::text_attribute(file, "format") != format_name)
    return "not a checkpoint of mudline";
  const long long version = h5::integer_attribute(file, "format version");
  if (version != format_version)
    return "format version " + std::to_string(version) + ", but this program reads version " +
           std::to_string(format_version);
  const long long written = h5::integer_attribute(file, "ranks");
  if (written != ranks)
    return "checkpoint was written on " + count(written, "rank") + "; run it on " + count(written, "rank");
  const auto all = h5::read_all<long long>(file, "mesh");
  const long long* old = &all[signature_length * rank];
  const auto now = row_of(mesh);
  if (old[0] != now[0] || old[1] != now[1])
    return "checkpoint belongs to a mesh of " + count(old[0], "node") + " and " + count(old[1], "element") +
           ", but this mesh has " + count(now[0], "node") + " and " + count(now[1], "element");
  if (!std::equal(now.begin(), now.end(), old))
    return "checkpoint belongs to a mesh of the same size that is numbered or partitioned differently; "
           "restart with the mesh and the build of the first run";
  return "";
}

}  // namespace

MeshSignature signature_of(const Mesh& mesh) {
  MeshSignature signature;
  signature.global_nodes = mesh.num_global_nodes();
  signature.global_elements = mesh.num_global_elements();
  signature.local_nodes = mesh.num_nodes();
  signature.owned_nodes = mesh.num_owned_nodes();
  std::uint64_t hash = fingerprint(mesh.node_ids().data(), mesh.node_ids().size() * sizeof(long long));
  for (const auto& block : mesh.blocks()) {
    signature.local_elements += block.num_elements;
    hash = fingerprint(block.global_ids.data(), block.global_ids.size() * sizeof(long long), hash);
  }
  signature.numbering = static_cast<long long>(hash);
  return signature;
}

CheckpointWriter::CheckpointWriter(Teuchos::RCP<const Teuchos::Comm<int>> comm, const MeshSignature& mesh)
    : comm_(std::move(comm)), mesh_(mesh) {}

void CheckpointWriter::write(const std::string& path, const CheckpointData& data) const {
  const MPI_Comm mpi = raw_communicator(*comm_);
  std::string names;
  append_names(names, data.arrays);
  append_names(names, data.integers);
  append_names(names, data.scalars);
  append_names(names, data.texts);
  for (const auto& [name, text] : data.texts) names += text + '\n';
  if (!same_everywhere(mpi, names)) throw std::logic_error("the ranks give different names or texts to a checkpoint");

  const std::string error = write_whole(mpi, path, [&](hid_t file) { write_content(mpi, file, mesh_, data); });
  if (!error.empty()) throw std::runtime_error("checkpoint '" + path + "': " + error);
}

CheckpointReader::CheckpointReader(Teuchos::RCP<const Teuchos::Comm<int>> comm, const MeshSignature& mesh)
    : comm_(std::move(comm)), mesh_(mesh) {}

CheckpointData CheckpointReader::read(const std::string& path) const {
  const MPI_Comm mpi = raw_communicator(*comm_);
  const int rank = comm_->getRank();
  std::error_code ignored;
  std::string error;
  if (rank == 0 && !std::filesystem::is_regular_file(path, ignored)) error = path + ": there is no such checkpoint";
  error = agreed_message(mpi, error);
  if (!error.empty()) throw InputError(error);

  CheckpointData data;
  try {
    const auto file = h5::open_file(mpi, path, false);
    error = mismatch(file, rank, comm_->getSize(), mesh_);
    // The ranks agree before the collective reads begin.
    error = agreed_message(mpi, error);
    if (error.empty()) {
      data.arrays = read_arrays<double>(rank, file, "arrays");
      data.integers = read_arrays<int>(rank, file, "integers");
      const auto scalars = h5::open_group(file, "scalars"), texts = h5::open_group(file, "texts");
      for (const std::string& link : h5::names(scalars))
        data.scalars[unescaped(link)] = h5::read_all<double>(scalars, link).at(0);
      for (const std::string& link : h5::names(texts)) data.texts[unescaped(link)] = h5::read_text(texts, link);
    }
  } catch (const std::runtime_error& failure) {
    // A damaged file: every rank reads the same description of it, so every rank arrives here.
    throw InputError(path + ": the checkpoint cannot be read: " + failure.what());
  }
  if (!error.empty()) throw InputError(path + ": " + error);
  return data;
}

}  // namespace mudline
