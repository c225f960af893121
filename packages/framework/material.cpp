#include "framework/material.hpp"

#include <algorithm>

namespace mudline {

std::vector<std::string> Material::unused() const {
  std::vector<std::string> names;
  for (const auto& [group, values] : properties)
    if (used_.count(group) == 0) names.push_back(group);
  return names;
}

std::vector<std::shared_ptr<const Material>> materials_of(const std::string& region, const Mesh& mesh,
                                                          const Materials& all, const Section& materials) {
  std::vector<std::shared_ptr<const Material>> found;
  for (const auto& material : all) {
    for (const auto& name : material->regions) require_region(mesh, materials, material->name + "/regions", name);
    const bool here = material->regions.empty() ||
                      std::find(material->regions.begin(), material->regions.end(), region) != material->regions.end();
    if (here) found.push_back(material);
  }
  if (found.empty()) materials.fail("mesh region '" + region + "' has no material; name it in the 'regions' of one");
  return found;
}

}  // namespace mudline
