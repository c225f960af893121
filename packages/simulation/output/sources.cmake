# Sources of the output folder, relative to packages/simulation. Needs mudline::hdf5; the tests include hdf5.h too, to
# read the files back without our own code, so the package links it PUBLIC.
set(simulation_output_sources
  output/atomic_file.cpp
  output/checkpoint_file.cpp
  output/collective.cpp
  output/field_file.cpp
  output/field_index.cpp
  output/field_layout.cpp
  output/hdf5_tools.cpp
  output/history_file.cpp
  output/id_order.cpp
  output/mesh_parts_file.cpp
  output/result_lock.cpp
  output/seal.cpp
  output/vtkhdf.cpp
  output/whole_file.cpp
  output/xdmf.cpp)
