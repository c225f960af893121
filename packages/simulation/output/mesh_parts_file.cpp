#include "simulation/output/mesh_parts_file.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <type_traits>

#include "core/deck.hpp"
#include "core/deck_changes.hpp"
#include "core/deck_xml.hpp"
#include "core/errors.hpp"
#include "core/run_error.hpp"
#include "discretisation/agree.hpp"
#include "discretisation/distribute.hpp"
#include "simulation/output/collective.hpp"
#include "simulation/output/hdf5_tools.hpp"
#include "simulation/output/whole_file.hpp"

namespace mudline {

namespace {

constexpr const char* parts_kind = "mudline mesh parts";
constexpr int parts_version = 1;

/// Writes or reads the members of a type as objects of an HDF5 group under their names.
class GroupArchive {
 public:
  GroupArchive(hid_t group, bool reading) : group_(group), reading_(reading) {}
  template <class T>
  GroupArchive& operator()(const std::string& name, T& value) {
    move(name, value);
    return *this;
  }

 private:
  template <class T>
  void move(const std::string& name, T& value) {
    if constexpr (std::is_integral_v<T> || std::is_enum_v<T>) {
      if (reading_)
        value = static_cast<T>(h5::integer_attribute(group_, name));
      else
        h5::set_attribute(group_, name, static_cast<long long>(value));
    } else {
      within(name, [&](GroupArchive& group) { value.transfer(group); });
    }
  }
  void move(const std::string& name, std::string& text) {
    if (reading_)
      text = h5::read_text(group_, name);
    else
      h5::write_text(group_, name, text, 0);
  }
  void move(const std::string& name, Bounds& bounds) {
    std::vector<double> ends(bounds.low.begin(), bounds.low.end());
    ends.insert(ends.end(), bounds.high.begin(), bounds.high.end());
    move(name, ends);
    if (ends.size() != 6) throw std::runtime_error("'" + name + "' is no box");
    std::copy_n(ends.begin(), 3, bounds.low.begin());
    std::copy_n(ends.begin() + 3, 3, bounds.high.begin());
  }
  void move(const std::string& name, std::vector<double>& values) { numbers(name, values); }
  void move(const std::string& name, std::vector<int>& values) { numbers(name, values); }
  void move(const std::string& name, std::vector<long long>& values) { numbers(name, values); }
  void move(const std::string& name, std::vector<char>& flags) {
    std::vector<int> values(flags.begin(), flags.end());
    numbers(name, values);
    flags.assign(values.begin(), values.end());
  }
  void move(const std::string& name, std::vector<Side>& sides) {
    std::vector<int> values;
    for (const Side& side : sides) values.insert(values.end(), {side.block, side.element, side.side});
    numbers(name, values);
    sides.clear();
    for (std::size_t i = 0; i + 2 < values.size(); i += 3) sides.push_back({values[i], values[i + 1], values[i + 2]});
  }
  template <class T>
  void move(const std::string& name, std::vector<T>& items) {
    within(name, [&](GroupArchive& group) {
      auto count = static_cast<long long>(items.size());
      group("count", count);
      items.resize(count);
      for (std::size_t i = 0; i < items.size(); ++i) group(std::to_string(i), items[i]);
    });
  }
  template <class V>
  void move(const std::string& name, std::map<std::string, V>& items) {
    within(name, [&](GroupArchive& group) {
      if (reading_)
        for (const std::string& link : h5::names(group.group_)) items[h5::unescaped(link)];
      for (auto& [key, item] : items) group(h5::escaped(key), item);
    });
  }

  template <class T>
  void numbers(const std::string& name, std::vector<T>& values) {
    if (reading_)
      values = h5::read_all<T>(group_, name);
    else
      h5::write(group_, name, values, {values.size(), 0, 0, values.size()});
  }
  template <class Action>
  void within(const std::string& name, Action&& action) {
    const h5::Handle handle = reading_ ? h5::open_group(group_, name) : h5::create_group(group_, name);
    GroupArchive group(handle, reading_);
    action(group);
  }

  hid_t group_;
  bool reading_;
};

long long fingerprint_of(MeshPart& part) {
  ByteStream stream;
  stream(part);
  return static_cast<long long>(fingerprint(stream.bytes().data(), stream.bytes().size()));
}

/// Fingerprint of the content of the mesh's files.
long long fingerprint_of(const std::vector<std::string>& files) {
  std::uint64_t hash = fingerprint(nullptr, 0);
  std::vector<char> piece(1 << 20);
  for (const std::string& path : files) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw InputError(path + ": the file of the mesh cannot be read");
    while (file) {
      file.read(piece.data(), static_cast<std::streamsize>(piece.size()));
      hash = fingerprint(piece.data(), static_cast<std::size_t>(file.gcount()), hash);
    }
  }
  return static_cast<long long>(hash);
}

/// The deck entries on which the parts depend, as XML.
std::string origin_of(const MeshRecipe& recipe) {
  Teuchos::ParameterList origin("origin");
  origin.sublist("mesh") = recipe.section().list();
  std::string contacts;
  for (const auto& [first, second] : recipe.contacts().pairs) contacts += first + " with " + second + "; ";
  for (const std::string& surface : recipe.contacts().surfaces) contacts += surface + "; ";
  origin.set("surfaces in contact", contacts);
  return write_xml(origin);
}

std::string part_name(int rank) { return "part " + std::to_string(rank); }

std::size_t size_of(MeshPart& part) {
  ByteStream stream;
  stream(part);
  return stream.bytes().size() + part.is_vertex.size() * sizeof(int);
}

std::size_t objects_of(const MeshPart& part) {
  return 30 + 8 * part.blocks.size() + 4 * part.set_nodes.size() + 2 * part.regions.size();
}

void write_content(hid_t file, const MeshRecipe& recipe, MeshCutter& cutter, int ranks) {
  h5::set_attribute(file, "kind", std::string(parts_kind));
  h5::set_attribute(file, "format", static_cast<long long>(parts_version));
  h5::set_attribute(file, "parts", static_cast<long long>(ranks));
  h5::set_attribute(file, "fingerprint of files", fingerprint_of(recipe.source().files()));
  h5::write_text(file, "origin", origin_of(recipe), 0);
  for (int rank = 0; rank < ranks; ++rank) {
    MeshPart part = cutter.part(rank);
    const h5::Handle group = h5::create_group(file, part_name(rank));
    h5::set_attribute(group, "fingerprint", fingerprint_of(part));
    GroupArchive archive(group, false);
    part.transfer(archive);
  }
}

}  // namespace

MeshPartsReport write_mesh_parts(const MeshRecipe& recipe, int ranks, const std::string& path) {
  const GlobalMesh mesh = recipe.make();
  std::unique_ptr<MeshCutter> cutter;
  try {
    cutter = std::make_unique<MeshCutter>(mesh, ranks);
  } catch (const InputError& error) {
    recipe.section().fail(error.what());
  }
  MeshPartsReport report;
  FileSize size{1 << 16, 8};
  for (int rank = 0; rank < ranks; ++rank) {
    MeshPart part = cutter->part(rank);
    size.bytes += size_of(part);
    size.objects += objects_of(part);
    std::size_t elements = 0;
    for (const auto& block : part.blocks) elements += block.ids.size();
    report.elements = part.num_global_elements;
    report.nodes = part.num_global_nodes;
    report.element_share = std::max(report.element_share, static_cast<double>(elements) * ranks / report.elements);
    report.node_share = std::max(report.node_share, static_cast<double>(part.num_owned_nodes) * ranks / report.nodes);
  }
  const std::string error =
      write_whole(MPI_COMM_SELF, path, size, [&](hid_t file) { write_content(file, recipe, *cutter, ranks); });
  if (!error.empty()) throw RunError("mesh parts '" + path + "': " + error);
  return report;
}

namespace {

/// Refuses parts of another mesh than the recipe's.
void check_origin(hid_t file, const MeshRecipe& recipe) {
  Deck was, now;
  was.overlay(h5::read_text(file, "origin"), "origin");
  now.overlay(origin_of(recipe), "origin");
  const std::vector<DeckChange> changes = deck_changes(was.list(), now.list());
  if (!changes.empty())
    throw InputError("the parts are those of another mesh: " + one_line(changes) + "; run `mudline split` again");
  if (h5::integer_attribute(file, "fingerprint of files") != fingerprint_of(recipe.source().files()))
    throw InputError(
        "the parts are those of another mesh: the file that it is read from has changed since; run "
        "`mudline split` again");
}

MeshPart read_part(hid_t file, int rank) {
  const h5::Handle group = h5::open_group(file, part_name(rank));
  MeshPart part;
  GroupArchive archive(group, true);
  part.transfer(archive);
  if (h5::integer_attribute(group, "fingerprint") != fingerprint_of(part))
    throw InputError("'" + part_name(rank) + "' is damaged: its checksum does not fit its content");
  return part;
}

void check_kind(hid_t file, int ranks) {
  if (!h5::has_attribute(file, "kind") || h5::text_attribute(file, "kind") != parts_kind)
    throw InputError("no file of mesh parts, as `mudline split` writes it");
  if (h5::integer_attribute(file, "format") != parts_version)
    throw InputError("the mesh parts are of another format than this program's, " + std::to_string(parts_version));
  const long long parts = h5::integer_attribute(file, "parts");
  if (parts != ranks)
    throw InputError("the mesh was split for " + std::to_string(parts) + (parts == 1 ? " rank" : " ranks") +
                     ", but the run has " + std::to_string(ranks) + "; start it on " + std::to_string(parts) +
                     ", or run `mudline split` again with --ranks " + std::to_string(ranks));
}

}  // namespace

std::unique_ptr<Mesh> read_mesh_parts(const Teuchos::RCP<const Teuchos::Comm<int>>& comm, const MeshRecipe& recipe,
                                      const std::string& path) {
  MeshPart part;
  // Each rank opens the file by itself; an error in one part is seen by its rank and then reported on all.
  agree(*comm, [&] {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored))
      throw InputError(path + ": there is no such file of mesh parts; `mudline split` writes one");
    try {
      const h5::Handle file = h5::open_file(MPI_COMM_SELF, path, false);
      check_kind(file, comm->getSize());
      if (comm->getRank() == 0) check_origin(file, recipe);
      part = read_part(file, comm->getRank());
    } catch (const InputError& error) {
      throw InputError(path + ": " + error.what());
    } catch (const std::exception& failure) {
      throw InputError(path + ": the mesh parts cannot be read: " + failure.what());
    }
  });
  return std::make_unique<Mesh>(comm, recipe.geometry(), std::move(part));
}

}  // namespace mudline
