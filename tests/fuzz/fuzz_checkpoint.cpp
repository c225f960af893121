// fuzz_checkpoint SECONDS SEED: damaged checkpoints are refused in one line, or have the content of the undamaged one.
#include <Tpetra_Core.hpp>

#include <cstdio>

#include "core/errors.hpp"
#include "fuzz.hpp"
#include "simulation/output/checkpoint_file.hpp"

namespace {

using namespace mudline;

const char* const whole_file = "fuzz_checkpoint_whole.h5";
const char* const damaged_file = "fuzz_checkpoint_damaged.h5";

CheckpointData example() {
  CheckpointData data;
  for (int i = 0; i < 200; ++i) data.arrays["soil/effective stress"].push_back(-1e5 / (1 + i));
  data.arrays["body motion"] = {0.5, -0.25};
  data.integers["contact/cone/active"] = {0, 1, 1, -3};
  data.scalars["time"] = 0.3;
  data.scalars["stage"] = 1;
  data.texts["deck"] = "<ParameterList name=\"a\"/>\n";
  return data;
}

std::string read_damaged(const MeshSignature& mesh, const CheckpointData& whole, const std::string& bytes) {
  std::ofstream(damaged_file, std::ios::binary) << bytes;
  const CheckpointData read = read_checkpoint(*Tpetra::getDefaultComm(), damaged_file, mesh);
  const bool same = read.arrays == whole.arrays && read.integers == whole.integers && read.scalars == whole.scalars &&
                    read.texts == whole.texts;
  return same ? "" : "a damaged checkpoint was read, with other content";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "fuzz_checkpoint SECONDS SEED\n";
    return 2;
  }
  const double seconds = std::atof(argv[1]);
  const auto seed = std::strtoull(argv[2], nullptr, 10);
  Tpetra::ScopeGuard scope(&argc, &argv);
  const MeshSignature mesh{9, 4, 9, 9, 4, 77};
  write_checkpoint(*Tpetra::getDefaultComm(), whole_file, mesh, example());
  const CheckpointData whole = read_checkpoint(*Tpetra::getDefaultComm(), whole_file, mesh);
  const int code = mudline::fuzz::run(
      {mudline::fuzz::read_file(whole_file)}, {}, seconds, seed, "fuzz_failure.h5", [&](const std::string& bytes) {
        return mudline::fuzz::fault_of([&] { return read_damaged(mesh, whole, bytes); });
      });
  for (const char* path : {whole_file, damaged_file}) std::remove(path);
  return code;
}
