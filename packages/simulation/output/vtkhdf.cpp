#include "simulation/output/vtkhdf.hpp"

#include <map>

namespace mudline::vtkhdf {

namespace {

constexpr unsigned char poly_line = 4, triangle = 5;  // cells of VTK

/// `text` with every "/" replaced, which in a name would be a group.
std::string without_slash(const std::string& text, const std::string& instead) {
  std::string result;
  for (char c : text) result += c == '/' ? instead : std::string(1, c);
  return result;
}

/// Name of a field as programs show it: "velocity [m per s]". Names that differ in "/" alone are refused before.
std::string shown(const xdmf::Field& field) {
  return without_slash(field.name, " ") + " [" + without_slash(field.unit, " per ") + "]";
}

h5::Handle begin_grid(hid_t file) {
  auto grid = h5::create_group(file, "VTKHDF");
  h5::set_attribute(grid, "Version", std::vector<long long>{2, 0});
  h5::set_ascii_attribute(grid, "Type", "UnstructuredGrid");
  return grid;
}

/// Where a step's part of the arrays begins, for every step.
struct Offsets {
  std::vector<long long> parts, points, cells, nodes_of_cells;
};

h5::Handle write_steps(hid_t grid, const std::vector<xdmf::Step>& steps, const Offsets& offsets) {
  auto group = h5::create_group(grid, "Steps");
  h5::set_attribute(group, "NSteps", static_cast<long long>(steps.size()));
  std::vector<double> times;
  for (const auto& step : steps) times.push_back(step.time);
  h5::write_alone(group, "Values", times);
  h5::write_alone(group, "NumberOfParts", std::vector<long long>(steps.size(), 1));
  h5::write_alone(group, "PartOffsets", offsets.parts);
  h5::write_alone(group, "PointOffsets", offsets.points);
  h5::write_alone(group, "CellOffsets", offsets.cells);
  h5::write_alone(group, "ConnectivityIdOffsets", offsets.nodes_of_cells);
  return group;
}

/// Fields of all steps; those that a step lacks are NaN there. `file_of`: path of a step's file.
void write_fields(hid_t grid, const xdmf::Model& model, const std::vector<xdmf::Step>& steps, bool at_nodes,
                  hid_t offsets) {
  std::map<std::string, xdmf::Field> all;
  for (const auto& step : steps)
    for (const auto& [link, field] : at_nodes ? step.nodal : step.cell) all[link] = field;
  std::vector<long long> begin;
  long long rows = 0;
  for (const auto& step : steps) {
    begin.push_back(rows);
    rows += at_nodes ? step.mesh.nodes : step.mesh.elements;
  }
  const auto group = h5::open_group(grid, at_nodes ? "PointData" : "CellData");
  // VTK's symmetric tensors are xx yy zz xy yz xz, the files' xx xy xz yy yz zz
  const std::vector<int> tensor{0, 3, 5, 1, 4, 2};
  for (const auto& [link, field] : all) {
    std::vector<h5::Source> sources;
    for (const auto& step : steps) {
      const auto& fields = at_nodes ? step.nodal : step.cell;
      const auto found = fields.find(link);
      const bool there = found != fields.end() && found->second.components == field.components;
      sources.push_back({there ? model.path(step.file) : "", (at_nodes ? "/nodal/" : "/cell/") + link,
                         hsize_t(at_nodes ? step.mesh.nodes : step.mesh.elements)});
    }
    h5::write_virtual<double>(group, shown(field), sources, field.components == 1 ? 0 : field.components,
                              field.components == 6 ? tensor : std::vector<int>{});
    h5::write_alone(offsets, shown(field), begin);
  }
}

/// Field data: the names of the regions, the same in every step, and the number of the step.
void write_field_data(hid_t grid, hid_t table, const std::vector<xdmf::Step>& steps,
                      const std::vector<std::string>& regions) {
  const auto group = h5::open_group(grid, "FieldData");
  const auto offsets = h5::create_group(table, "FieldDataOffsets"), sizes = h5::create_group(table, "FieldDataSizes");
  std::vector<long long> numbers, rows, one_each, all_each;
  for (const auto& step : steps) {
    rows.push_back(static_cast<long long>(numbers.size()));
    numbers.push_back(step.number);
    one_each.insert(one_each.end(), {1, 1});
    all_each.insert(all_each.end(), {1, static_cast<long long>(regions.size())});
  }
  h5::write_alone(group, "step", numbers);
  h5::write_alone(offsets, "step", rows);
  h5::write_alone(sizes, "step", one_each, 2);
  h5::write_texts(group, "region names", regions);
  h5::write_alone(offsets, "region names", std::vector<long long>(steps.size(), 0));
  h5::write_alone(sizes, "region names", all_each, 2);
}

}  // namespace

void write_soil(hid_t file, const xdmf::Model& model, const std::vector<xdmf::Step>& steps,
                const std::vector<std::string>& regions) {
  const auto grid = begin_grid(file);
  for (const char* name : {"PointData", "CellData", "FieldData"}) h5::create_group(grid, name);

  // a mesh is a part, which all of its steps share
  std::vector<long long> points, cells, nodes_of_cells;
  std::vector<h5::Source> connectivity, ends, types, region, places;
  std::vector<long long> region_offsets;
  Offsets offsets;
  long long first_point = 0, first_cell = 0, first_node = 0;
  const xdmf::StepMesh* mesh = nullptr;
  for (const auto& step : steps) {
    if (!mesh || mesh->file != step.mesh.file) {
      if (mesh) {
        first_cell += mesh->elements;
        first_node += mesh->topology_length - mesh->elements;
      }
      mesh = &step.mesh;
      points.push_back(mesh->nodes);
      cells.push_back(mesh->elements);
      nodes_of_cells.push_back(mesh->topology_length - mesh->elements);
      const std::string path = model.path(mesh->file);
      const auto rows = static_cast<hsize_t>(mesh->elements);
      connectivity.push_back({path, "/mesh/connectivity", hsize_t(nodes_of_cells.back())});
      ends.push_back({path, "/mesh/offsets", rows + 1});
      types.push_back({path, "/mesh/types", rows});
      region.push_back({path, "/mesh/region", rows});
    }
    offsets.parts.push_back(static_cast<long long>(cells.size()) - 1);
    offsets.points.push_back(first_point);
    offsets.cells.push_back(first_cell);
    offsets.nodes_of_cells.push_back(first_node);
    places.push_back({model.path(step.file), "/coordinates", hsize_t(mesh->nodes)});
    first_point += mesh->nodes;
  }
  h5::write_alone(grid, "NumberOfPoints", points);
  h5::write_alone(grid, "NumberOfCells", cells);
  h5::write_alone(grid, "NumberOfConnectivityIds", nodes_of_cells);
  h5::write_virtual<double>(grid, "Points", places, 3);
  h5::write_virtual<long long>(grid, "Connectivity", connectivity, 0);
  h5::write_virtual<long long>(grid, "Offsets", ends, 0);
  h5::write_virtual<unsigned char>(grid, "Types", types, 0);
  h5::write_virtual<int>(h5::open_group(grid, "CellData"), "region", region, 0);

  const auto table = write_steps(grid, steps, offsets);
  const auto by_point = h5::create_group(table, "PointDataOffsets"),
             by_cell = h5::create_group(table, "CellDataOffsets");
  write_fields(grid, model, steps, true, by_point);
  write_fields(grid, model, steps, false, by_cell);
  h5::write_alone(by_cell, "region", offsets.cells);
  write_field_data(grid, table, steps, regions);
}

void write_body(hid_t file, const std::string& link, const SurfaceTriangles& outline,
                const std::vector<xdmf::Step>& steps) {
  const auto grid = begin_grid(file);
  const bool in_space = !outline.facets.empty();
  const auto points = static_cast<long long>(outline.points.size());
  std::vector<long long> connectivity, ends{0};
  for (const auto& facet : outline.facets) connectivity.insert(connectivity.end(), facet.begin(), facet.end());
  if (!in_space)
    for (long long i = 0; i < points; ++i) connectivity.push_back(i);
  const std::size_t of_a_cell = in_space ? 3 : connectivity.size();
  for (std::size_t end = of_a_cell; of_a_cell > 0 && end <= connectivity.size(); end += of_a_cell)
    ends.push_back(static_cast<long long>(end));
  const std::vector<unsigned char> types(ends.size() - 1, in_space ? triangle : poly_line);
  std::vector<h5::Source> places;
  Offsets offsets;
  const std::vector<long long> none(steps.size(), 0);
  offsets.parts = offsets.cells = offsets.nodes_of_cells = none;
  for (const auto& step : steps) {
    offsets.points.push_back(static_cast<long long>(places.size()) * points);
    places.push_back({step.file + ".h5", "/bodies/" + link + "/coordinates", hsize_t(points)});
  }
  h5::write_alone(grid, "NumberOfPoints", std::vector<long long>{points});
  h5::write_alone(grid, "NumberOfCells", std::vector<long long>{static_cast<long long>(types.size())});
  h5::write_alone(grid, "NumberOfConnectivityIds", std::vector<long long>{static_cast<long long>(connectivity.size())});
  h5::write_virtual<double>(grid, "Points", places, 3);
  h5::write_alone(grid, "Connectivity", connectivity);
  h5::write_alone(grid, "Offsets", ends);
  h5::write_alone(grid, "Types", types);
  for (const char* name : {"PointData", "CellData", "FieldData"}) h5::create_group(grid, name);
  write_steps(grid, steps, offsets);
}

}  // namespace mudline::vtkhdf
