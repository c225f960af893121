#include "simulation/output/xdmf.hpp"

#include <charconv>

#include "core/text.hpp"

namespace mudline::xdmf {

namespace {

std::string number(double value) {
  char text[32];
  return std::string(text, std::to_chars(text, text + sizeof text, value).ptr);
}

std::string heavy_of(const std::string& file, const std::string& path, const std::string& dimensions,
                     const std::string& type) {
  return "<DataItem Dimensions=\"" + dimensions + "\" " + type + " Format=\"HDF\">" + xml_escaped(file + ":" + path) +
         "</DataItem>";
}

std::string heavy(const Model& model, const std::string& file, const std::string& path, const std::string& dimensions,
                  const std::string& type) {
  return heavy_of(model.path(file), path, dimensions, type);
}

const char* const real = "NumberType=\"Float\" Precision=\"8\"";
const char* const integer = "NumberType=\"Int\" Precision=\"8\"";
const char* const small_integer = "NumberType=\"Int\" Precision=\"4\"";

std::string attributes(const Model& model, const Step& step, const std::map<std::string, Field>& fields,
                       const std::string& group, const std::string& centre, long long rows) {
  std::string text;
  for (const auto& [link, field] : fields) {
    const char* type = field.components == 1 ? "Scalar" : field.components == 3 ? "Vector" : "Tensor6";
    const std::string columns = field.components == 1 ? "" : " " + std::to_string(field.components);
    text += "        <Attribute Name=\"" + xml_escaped(field.name + " [" + field.unit + "]") + "\" AttributeType=\"" +
            type + "\" Center=\"" + centre + "\">" +
            heavy(model, step.file, group + "/" + link, std::to_string(rows) + columns, real) + "</Attribute>\n";
  }
  return text;
}

/// Topology of a body: its closed surface in space, its contour in the plane.
std::string body_topology(const Model& model, const std::string& link, const Body& body) {
  const std::string points = std::to_string(body.points), triangles = std::to_string(body.triangles);
  if (body.triangles > 0)
    return "<Topology TopologyType=\"Triangle\" NumberOfElements=\"" + triangles + "\">" +
           heavy_of(model.index, "/bodies/" + link + "/triangles", triangles + " 3", small_integer) + "</Topology>\n";
  std::string line;
  for (long long i = 0; i < body.points; ++i) line += (i == 0 ? "" : " ") + std::to_string(i);
  return "<Topology TopologyType=\"Polyline\" NumberOfElements=\"1\" NodesPerElement=\"" + points +
         "\"><DataItem Dimensions=\"1 " + points + "\" " + small_integer + " Format=\"XML\">" + line +
         "</DataItem></Topology>\n";
}

std::string body_grid(const Model& model, const Step& step, const std::string& link, const Body& body) {
  const std::string points = std::to_string(body.points);
  return "      <Grid Name=\"" + xml_escaped(body.name) + "\" GridType=\"Uniform\">\n        " +
         body_topology(model, link, body) + "        <Geometry GeometryType=\"XYZ\">" +
         heavy(model, step.file, "/bodies/" + link + "/coordinates", points + " 3", real) +
         "</Geometry>\n      </Grid>\n";
}

}  // namespace

std::string grid(const Model& model, const Step& step) {
  const StepMesh& on = step.mesh;
  const std::string nodes = std::to_string(on.nodes), elements = std::to_string(on.elements);
  const std::string about = "<Time Value=\"" + number(step.time) +
                            "\"/>\n"
                            "      <Information Name=\"step\" Value=\"" +
                            std::to_string(step.number) +
                            "\"/>\n"
                            "      <Information Name=\"stage\" Value=\"" +
                            xml_escaped(step.stage) + "\"/>\n";
  const std::string mesh = "        <Topology TopologyType=\"Mixed\" NumberOfElements=\"" + elements + "\">" +
                           heavy(model, on.file, "/mesh/topology", std::to_string(on.topology_length), integer) +
                           "</Topology>\n"
                           "        <Geometry GeometryType=\"XYZ\">" +
                           heavy(model, step.file, "/coordinates", nodes + " 3", real) +
                           "</Geometry>\n"
                           "        <Attribute Name=\"region\" AttributeType=\"Scalar\" Center=\"Cell\">" +
                           heavy(model, on.file, "/mesh/region", elements, small_integer) + "</Attribute>\n" +
                           attributes(model, step, step.nodal, "/nodal", "Node", on.nodes) +
                           attributes(model, step, step.cell, "/cell", "Cell", on.elements);

  if (model.bodies.empty())
    return "      <Grid Name=\"soil\" GridType=\"Uniform\">\n      " + about + mesh + "      </Grid>\n";
  std::string text = "      <Grid Name=\"model\" GridType=\"Collection\" CollectionType=\"Spatial\">\n      " + about +
                     "      <Grid Name=\"soil\" GridType=\"Uniform\">\n" + mesh + "      </Grid>\n";
  for (const auto& [link, body] : model.bodies) text += body_grid(model, step, link, body);
  return text + "      </Grid>\n";
}

std::string document(const std::string& grids) {
  return "<?xml version=\"1.0\"?>\n<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n<Xdmf Version=\"2.0\">\n  <Domain>\n"
         "    <Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Temporal\">\n" +
         grids + "    </Grid>\n  </Domain>\n</Xdmf>\n";
}

}  // namespace mudline::xdmf
