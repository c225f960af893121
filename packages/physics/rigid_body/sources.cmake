# Paths relative to packages/physics
set(rigid_body_sources
  nodal_exchange.cpp
  rigid_body/contour_piece.cpp
  rigid_body/contour.cpp
  rigid_body/rounded_polygon.cpp
  rigid_body/contour_shape.cpp
  rigid_body/motion.cpp
  rigid_body/contour_volume.cpp
  rigid_body/curve_piece.cpp
  rigid_body/contour_approximation.cpp
  rigid_body/path_shape.cpp
  rigid_body/library_shapes.cpp
  rigid_body/released_motion.cpp
  rigid_body/body_terms.cpp
  rigid_body/rigid_body.cpp)
if(MUDLINE_GMSH)
  list(APPEND rigid_body_sources rigid_body/curve_chain.cpp rigid_body/gmsh_curve_shape.cpp)
endif()
