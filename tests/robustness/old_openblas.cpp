// Imitates an OpenBLAS that does not know the processor. Loaded before the program, it names the kernels of 2004 unless
// the environment chose others when it was loaded.
#include <cstdlib>
#include <string>

namespace {
const std::string name = std::getenv("OPENBLAS_CORETYPE") == nullptr ? "Prescott" : std::getenv("OPENBLAS_CORETYPE");
}

extern "C" const char* openblas_get_corename() { return name.c_str(); }
