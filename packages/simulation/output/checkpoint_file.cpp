#include "simulation/output/checkpoint_file.hpp"

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "core/errors.hpp"
#include "core/run_error.hpp"
#include "discretisation/mesh.hpp"
#include "simulation/output/collective.hpp"
#include "simulation/output/hdf5_tools.hpp"
#include "simulation/output/seal.hpp"
#include "simulation/output/whole_file.hpp"

namespace mudline {

namespace {

constexpr const char* kind = "checkpoint";
constexpr int format_version = 4;
constexpr int signature_length = 8;

std::vector<long long> row_of(const MeshSignature& mesh) {
  return {mesh.global_nodes, mesh.global_elements, mesh.topology,       mesh.coordinates,
          mesh.local_nodes,  mesh.owned_nodes,     mesh.local_elements, mesh.numbering};
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
void write_arrays(MPI_Comm comm, hid_t file, const std::string& group,
                  const std::map<std::string, std::vector<T>>& arrays) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  const auto values = h5::create_group(file, group), tables = h5::create_group(file, group + " offsets");
  for (const auto& [name, array] : arrays) {
    const std::vector<long long> offsets = offsets_of(comm, static_cast<long long>(array.size()));
    h5::write(values, h5::escaped(name), array, part(offsets, rank));
    const hsize_t length = offsets.size();
    h5::write(tables, h5::escaped(name), offsets, {length, 0, 0, rank == 0 ? length : 0});
  }
}

/// Reads the part of `rank`, or of all ranks where it is negative.
template <class T>
std::map<std::string, std::vector<T>> read_arrays(int rank, hid_t file, const std::string& group) {
  std::map<std::string, std::vector<T>> arrays;
  const auto values = h5::open_group(file, group), tables = h5::open_group(file, group + " offsets");
  for (const std::string& link : h5::names(values))
    arrays[h5::unescaped(link)] = rank < 0
                                      ? h5::read_all<T>(values, link)
                                      : h5::read<T>(values, link, part(h5::read_all<long long>(tables, link), rank));
  return arrays;
}

std::map<std::string, std::string> read_texts(hid_t file) {
  std::map<std::string, std::string> texts;
  const auto group = h5::open_group(file, "texts");
  for (const std::string& link : h5::names(group)) texts[h5::unescaped(link)] = h5::read_text(group, link);
  return texts;
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
  h5::set_attribute(file, "ranks", static_cast<long long>(ranks));
  h5::write(file, "mesh", row_of(mesh), {hsize_t(ranks), signature_length, hsize_t(rank), 1});
  write_arrays(comm, file, "arrays", data.arrays);
  write_arrays(comm, file, "integers", data.integers);
  const auto scalars = h5::create_group(file, "scalars"), texts = h5::create_group(file, "texts");
  for (const auto& [name, value] : data.scalars)
    h5::write(scalars, h5::escaped(name), std::vector<double>{value}, {1, 0, 0, hsize_t(rank == 0)});
  for (const auto& [name, text] : data.texts) h5::write_text(texts, h5::escaped(name), text, rank);
}

std::string count(long long number, const std::string& thing) {
  return std::to_string(number) + " " + thing + (number == 1 ? "" : "s");
}

/// Why this run cannot continue from a file of this mesh, or "".
std::string mismatch(const std::vector<long long>& old, const std::vector<long long>& now) {
  if (old[0] != now[0] || old[1] != now[1])
    return "checkpoint belongs to a mesh of " + count(old[0], "node") + " and " + count(old[1], "element") +
           ", but this mesh has " + count(now[0], "node") + " and " + count(now[1], "element");
  if (old[2] != now[2]) return "checkpoint belongs to a mesh of the same size whose nodes are numbered differently";
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
  // Each item counts on one rank only, so that the sums do not depend on the partition.
  std::uint64_t here[2] = {0, 0}, all[2];
  for (const auto& block : mesh.blocks()) {
    signature.local_elements += block.num_elements;
    hash = fingerprint(block.global_ids.data(), block.global_ids.size() * sizeof(long long), hash);
    for (int e = 0; e < block.num_elements; ++e) {
      std::vector<long long> item{block.global_ids[e]};
      for (int a = 0; a < num_nodes(block.shape); ++a) item.push_back(mesh.node_ids()[block.nodes(e, a)]);
      here[0] += fingerprint(item.data(), item.size() * sizeof(long long),
                             fingerprint(block.region.data(), block.region.size()));
    }
  }
  for (int node = 0; node < mesh.num_owned_nodes(); ++node) {
    const Point at = mesh.place(node);
    here[1] += fingerprint(at.data(), mesh.dimension() * sizeof(double),
                           fingerprint(&mesh.node_ids()[node], sizeof(long long)));
  }
  MPI_Allreduce(here, all, 2, MPI_UINT64_T, MPI_SUM, raw_communicator(*mesh.comm()));
  signature.numbering = static_cast<long long>(hash);
  signature.topology = static_cast<long long>(all[0]);
  signature.coordinates = static_cast<long long>(all[1]);
  return signature;
}

void write_checkpoint(const Teuchos::Comm<int>& comm, const std::string& path, const MeshSignature& mesh,
                      const CheckpointData& data) {
  const MPI_Comm mpi = raw_communicator(comm);
  std::string names;
  append_names(names, data.arrays);
  append_names(names, data.integers);
  append_names(names, data.scalars);
  append_names(names, data.texts);
  for (const auto& [name, text] : data.texts) names += text + '\n';
  if (!same_everywhere(mpi, names)) throw std::logic_error("the ranks give different names or texts to a checkpoint");

  FileSize size{0, 8 + 2 * (data.arrays.size() + data.integers.size()) + data.scalars.size() + data.texts.size()};
  for (const auto& [name, array] : data.arrays) size.bytes += array.size() * sizeof(double);
  for (const auto& [name, array] : data.integers) size.bytes += array.size() * sizeof(long long);
  for (const auto& [name, text] : data.texts) size.bytes += text.size();
  const std::string error = write_whole_and_seal(mpi, path, size, kind, format_version,
                                                 [&](hid_t file) { write_content(mpi, file, mesh, data); });
  if (!error.empty()) throw RunError("checkpoint '" + path + "': " + error);
}

namespace {

void check_seal(const Teuchos::Comm<int>& comm, const std::string& path) {
  std::string error;
  if (comm.getRank() == 0) {
    std::error_code ignored;
    error = !std::filesystem::is_regular_file(path, ignored) ? "there is no such checkpoint"
                                                             : broken_seal(path, kind, format_version);
  }
  error = agreed_message(raw_communicator(comm), error);
  if (!error.empty()) throw InputError(path + ": " + error);
}

/// Runs an action that reads a checkpoint; errors of HDF5 become InputErrors with the file's name.
template <class Action>
void reading(const std::string& path, Action&& action) {
  try {
    action();
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& failure) {
    throw InputError(path + ": the checkpoint cannot be read: " + failure.what());
  }
}

}  // namespace

std::map<std::string, std::string> read_checkpoint_texts(const Teuchos::Comm<int>& comm, const std::string& path) {
  check_seal(comm, path);
  std::map<std::string, std::string> result;
  reading(path, [&] { result = read_texts(h5::open_file(raw_communicator(comm), path, false)); });
  return result;
}

std::vector<long long> read_checkpoint_integers(const Teuchos::Comm<int>& comm, const std::string& path,
                                                const std::string& name) {
  std::vector<long long> result;
  const bool first = comm.getRank() == 0;
  reading(path, [&] {
    const auto file = h5::open_file(raw_communicator(comm), path, false);
    const auto group = h5::open_group(file, "integers");
    for (const std::string& link : h5::names(group))
      if (first && h5::unescaped(link) == name) result = h5::read_all<long long>(group, link);
  });
  return result;
}

CheckpointData read_checkpoint(const Teuchos::Comm<int>& comm, const std::string& path, const MeshSignature& mesh) {
  check_seal(comm, path);
  const MPI_Comm mpi = raw_communicator(comm);
  const int rank = comm.getRank();
  CheckpointData data;
  reading(path, [&] {
    const auto file = h5::open_file(mpi, path, false);
    const long long written = h5::integer_attribute(file, "ranks");
    const auto all = h5::read_all<long long>(file, "mesh");
    const auto now = row_of(mesh);
    const std::string error = mismatch(all, now);
    if (!error.empty()) throw InputError(path + ": " + error);
    data.moved_nodes = all[3] != now[3];
    const long long* mine = &all[signature_length * std::min<long long>(rank, written - 1)];
    const bool same = written == comm.getSize() && std::equal(now.begin() + 4, now.end(), mine + 4);
    // either all ranks read their own part, or all read everything
    const bool same_partition = agreed_message(mpi, same ? "" : "no").empty();
    data.ranks = same_partition ? 0 : static_cast<int>(written);
    data.arrays = read_arrays<double>(same_partition ? rank : -1, file, "arrays");
    data.integers = read_arrays<long long>(same_partition ? rank : -1, file, "integers");
    const auto scalars = h5::open_group(file, "scalars");
    for (const std::string& link : h5::names(scalars))
      data.scalars[h5::unescaped(link)] = h5::read_all<double>(scalars, link).at(0);
    data.texts = read_texts(file);
  });
  return data;
}

}  // namespace mudline
