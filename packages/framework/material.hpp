#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/registry.hpp"
#include "discretisation/mesh.hpp"

namespace mudline {

/// A group of properties that some physics needs of a material: a section of its deck entry, whose name is the name of
/// the registered type ("heat").
class Properties {
 public:
  virtual ~Properties() = default;
};

/// One entry of the deck's "materials": the material of some regions.
class Material {
 public:
  virtual ~Material() = default;
  std::string name;
  std::vector<std::string> regions;  // empty: every region
  /// The groups of properties that the entry has, by name.
  std::map<std::string, std::shared_ptr<const Properties>> properties;

  /// A group that a physics needs. InputError through `materials`, the deck's section, when it is missing.
  template <class T>
  std::shared_ptr<const T> require(const std::string& group, const Section& materials) const {
    used_.insert(group);
    const auto found = properties.find(group);
    if (found == properties.end())
      materials.section(name).fail("required section '" + group + "' is missing: a physics of this model needs it");
    return std::dynamic_pointer_cast<const T>(found->second);
  }
  /// Names of the groups that no physics has required.
  std::vector<std::string> unused() const;

 private:
  mutable std::set<std::string> used_;
};

using Materials = std::vector<std::shared_ptr<Material>>;

/// The materials that name a mesh region, in the deck's order. InputError through `materials`, the deck's section, when
/// none does, or when one names a region that the mesh does not have.
std::vector<std::shared_ptr<const Material>> materials_of(const std::string& region, const Mesh& mesh,
                                                          const Materials& all, const Section& materials);

}  // namespace mudline
