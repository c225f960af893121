#pragma once

#include <Trilinos_version.h>
#include <Kokkos_Macros.hpp>

#include "simulation/registries.hpp"

#define MUDLINE_STRINGIFY_(x) #x
#define MUDLINE_STRINGIFY(x) MUDLINE_STRINGIFY_(x)

#ifdef NDEBUG
#define MUDLINE_BUILD_KIND "release"
#else
#define MUDLINE_BUILD_KIND "debug"
#endif

/// Text that must be equal in a plugin and in the program that loads it: interface version, compiler, Trilinos, build
/// kind.
#define MUDLINE_ABI \
  "interface 22; gcc " MUDLINE_STRINGIFY(__GNUC__) "; Trilinos " TRILINOS_VERSION_STRING "; " MUDLINE_BUILD_KIND

/// The body of a plugin, once per shared library:
///     MUDLINE_PLUGIN(registries) { registries.skeletons.add<mudline::PointwiseSkeleton<MyClay>>("my clay", "..."); }
#define MUDLINE_PLUGIN(registries)                                    \
  extern "C" const char* mudline_plugin_abi() { return MUDLINE_ABI; } \
  extern "C" void mudline_plugin_register(mudline::Registries& registries)

namespace mudline {

/// Loads the shared libraries that the deck's section "plugins" names and lets them register. The libraries stay loaded
/// until the program ends. InputError: a file that is missing, is no plugin, or was built against something else.
void load_plugins(const Section& section, Registries& registries);

/// Parameters of the section "plugins".
void document_plugins(Parameters& p);

}  // namespace mudline
